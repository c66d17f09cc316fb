"""A session in Spanish, as a voice that crashes is no matter for what drives, rumbles and guides."""
import re
import time

from sessions import summary

KILLS = 20


def test_F4_a_voice_that_is_killed_twenty_times_stops_nobody(session):
    begun = session("world:=busy", "seed:=9507", "feedback/language:=es", "limit:=90")
    killed = 0
    journal = None
    while begun.process.poll() is None and killed < KILLS:
        time.sleep(2.0)
        journal = journal or next(begun.folder.glob("trial-*/journal.csv"), None)
        if journal and "TRIAL_START" in journal.read_text() and any("/espeak_voice " in line for line in begun.of_it().values()):
            begun.kill("/espeak_voice ")
            killed += 1
    text = begun.wait_until_ended()
    assert killed == KILLS, text[-3000:]
    result = summary(begun.folder)
    assert result["result"] in ("reached", "timeout") and result["safe_stop_count"] == "0", (result, text[-3000:])
    assert int(result["device_loss_count"]) >= KILLS - 1, result
    assert len(re.findall(r",CUE,.*modality=speech", journal.read_text())) > 3
