"""Sessions led by other ways than words: by the motors alone, without any sound, and by a sound that lasts."""
import csv
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent


def session(folder, *words):
    """(summary, journal, kinds of the patterns that were felt) of a simulated person's trial."""
    import rosbag
    run = subprocess.run([str(ROOT / "navvi"), "run", "operator:=simulated", "rviz:=false", "world:=busy", "seed:=9601", "limit:=150",
                          f"out:={folder}", *words], text=True, capture_output=True, timeout=400, check=False)
    trial = next(folder.glob("trial-*"), None)
    assert trial, run.stdout[-3000:] + run.stderr[-1000:]
    with open(trial / "summary.csv", newline="") as file:
        summary = next(csv.DictReader(file))
    # A pattern stands apart from the pulses before it, so that of the arrival may begin when the record is over.
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        felt = {cue.kind for _, cue, _ in bag.read_messages("/navvi/cues") if cue.modality == cue.RUMBLE}
    return summary, (trial / "journal.csv").read_text(encoding="utf-8"), felt


def test_a_deafblind_person_reaches_the_goal_by_the_motors_alone(tmp_path):
    summary, _, felt = session(tmp_path, "operator/person/type:=deafblind", "feedback/lead:=hand", "speech:=false")
    assert summary["result"] == "reached" and summary["safe_stop_count"] == "0", summary
    assert summary["cues_spoken"] == "0" and summary["sounds_played"] in ("0", "n/a"), summary
    assert {"begun", "arrived"} <= felt


def test_a_person_is_led_by_a_sound_that_lasts_without_an_order_to_turn(tmp_path):
    summary, journal, _ = session(tmp_path, "operator/person/type:=typical", "feedback/lead:=flow")
    assert summary["result"] == "reached" and summary["safe_stop_count"] == "0", summary
    # Ticks that end a turn would mean that the sound was given up.
    assert not any(f"kind={order};" in journal for order in ("turn_now", "straight_then", "go_on", "turn_stop")), journal[-2000:]
