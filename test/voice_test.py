"""A session in Spanish, as a voice that crashes is no matter for what drives, rumbles and guides."""
import csv
import os
import pathlib
import re
import signal
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
KILLS = 20


def voice_of(folder):
    """The process id of the voice of the session that records into `folder`, or None."""
    for line in subprocess.run(["pgrep", "-f", "^[^ ]*/espeak_voice "], capture_output=True, text=True).stdout.split():
        try:
            if str(folder).encode() in pathlib.Path(f"/proc/{line}/environ").read_bytes():
                return int(line)
        except OSError:  # it has just ended
            pass
    return None


def test_F4_a_voice_that_is_killed_twenty_times_stops_nobody(tmp_path):
    session = subprocess.Popen([str(ROOT / "navvi"), "run", "operator:=simulated", "rviz:=false", "world:=busy", "seed:=9507", "feedback/language:=es",
                                "limit:=90", f"out:={tmp_path}"], env=dict(os.environ, VOICE_TEST=str(tmp_path)), text=True, start_new_session=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    killed = 0
    journal = None
    while session.poll() is None and killed < KILLS:
        time.sleep(2.0)
        journal = journal or next(tmp_path.glob("trial-*/journal.csv"), None)
        if journal and "TRIAL_START" in journal.read_text() and (voice := voice_of(tmp_path)):
            os.kill(voice, signal.SIGKILL)
            killed += 1
    text = session.communicate(timeout=300)[0]
    assert killed == KILLS, text[-3000:]
    with open(next(tmp_path.glob("trial-*/summary.csv")), newline="") as file:
        summary = next(csv.DictReader(file))
    assert summary["result"] in ("reached", "timeout") and summary["safe_stop_count"] == "0", (summary, text[-3000:])
    assert int(summary["device_loss_count"]) >= KILLS - 1, summary
    assert len(re.findall(r",CUE,.*modality=speech", journal.read_text())) > 3
