"""Sessions led by other ways than words: by the motors alone, without any sound, and by a sound that lasts."""
import rosbag

from sessions import summary

HALL = ["world:=busy", "seed:=9601", "limit:=150"]


def led(begun):
    """(summary, journal, kinds of the patterns that were felt) of a simulated person's trial."""
    begun.wait_until_ended(400)
    trial = next(begun.folder.glob("trial-*"), None)
    assert trial, begun.text()[-4000:]
    # A pattern stands apart from the pulses before it, so that of the arrival may begin when the record is over.
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        felt = {cue.kind for _, cue, _ in bag.read_messages("/navvi/cues") if cue.modality == cue.RUMBLE}
    return summary(begun.folder), (trial / "journal.csv").read_text(encoding="utf-8"), felt


def test_a_deafblind_person_reaches_the_goal_by_the_motors_alone(session):
    result, _, felt = led(session(*HALL, "operator/person/type:=deafblind", "feedback/lead:=hand", "speech:=false"))
    assert result["result"] == "reached" and result["safe_stop_count"] == "0", result
    assert result["cues_spoken"] == "0" and result["sounds_played"] in ("0", "n/a"), result
    assert {"begun", "arrived"} <= felt


def test_a_person_is_led_by_a_sound_that_lasts_without_an_order_to_turn(session):
    result, journal, _ = led(session(*HALL, "operator/person/type:=typical", "feedback/lead:=flow"))
    assert result["result"] == "reached" and result["safe_stop_count"] == "0", result
    # Ticks that end a turn would mean that the sound was given up.
    assert not any(f"kind={order};" in journal for order in ("turn_now", "straight_then", "go_on", "turn_stop")), journal[-2000:]
