"""What happens to the wheels when the person's side dies at full speed."""
import os

import pytest

from sessions import WORLD, Programs, eventually, within
from navvi_cli.arguments import LaunchFile, words_for
from navvi_cli.commands import run
from navvi_study.record import Record


@pytest.fixture
def session(master, tmp_path):
    with Programs(master) as session:
        session.launch("live.launch", "operator:=topic", f"world:={WORLD}", "start:=-3.2,0.4,0", "goal:=3,0.4", "speech:=false",
                       "feedback_parameters:={listener: topic}", "rviz:=false", f"out:={tmp_path}")
        yield session


def run_stick(session, *words):
    return session.person("stick.py", *words).split()


def by_pad(master, folder, plugged, *words):
    """A session of a person whose pad is in memory; what `programs.run` starts has none."""
    programs = Programs(master | plugged | {"ALSOFT_DRIVERS": "null"}, folder / "log")
    programs.launch("live.launch", "operator:=pad", f"world:={WORLD}", "start:=-3.2,0.4,0", "goal:=3,0.4", "speech:=false", "rviz:=false",
                    f"out:={folder}", *words)
    programs.env = master
    return programs


@pytest.mark.parametrize("letter, bound", [("u", 0.25), ("f", 0.5)], ids=["J1_is_unplugged", "J2_falls_silent"])
def test_a_pad_that_is_lost_at_full_speed_stops_the_robot(master, tmp_path, plugged, record_property, letter, bound):
    with by_pad(master, tmp_path, plugged) as programs:
        speed, held, still = map(float, run_stick(programs, "lose", letter, plugged["VIRTUAL_PAD"]))
    assert speed >= 0.8
    within(record_property, "wheels held", held, bound)
    within(record_property, "still", still, bound + 0.25)


@pytest.mark.parametrize("word", ["feedback/haptics/enabled:=false", "person:=anna"])
def test_motors_that_are_off_by_wish_keep_no_trial_from_its_begin(master, tmp_path, plugged, monkeypatch, word):
    monkeypatch.setenv("NAVVI_PEOPLE", str(tmp_path))
    (tmp_path / "anna.yaml").write_text("haptics:\n  enabled: false\n")
    words = words_for(LaunchFile("live.launch"), [word, "operator:=pad", "speech:=false", "trial/press_to_start:=false"])
    run.check_lists(words)
    with by_pad(master, tmp_path, plugged, *(f"{name}:={words[name]}" for name in ("feedback_parameters", "trial_parameters"))) as programs:
        assert eventually(lambda: [*tmp_path.glob("trial-*/journal.csv")], 120), programs.log.read_text()[-3000:]


def test_J3_pads_that_come_and_go_and_guides_that_are_killed_move_nothing_without_neutral(master, tmp_path, plugged):
    """The soak K4 has 2500 rounds, a fifth of them kills: in some 3 hours."""
    rounds = int(os.environ.get("NAVVI_CHURN", 10))
    with by_pad(master, tmp_path, plugged, "trial_parameters:={press_to_start: false}") as programs:
        told = programs.person("stick.py", "churn", rounds, plugged["VIRTUAL_PAD"], seconds=120 + 60 * rounds)
    speed, drove, ended, moved = map(float, told.split())
    assert speed >= 0.3 and drove == rounds, told
    assert not ended, "feedback_node has crashed"
    assert moved < 1e-3, "the stick was never neutral"


def test_C5_C7_only_the_guide_drives(session):
    pushed, alone, driven, pace, rate, intruder = run_stick(session, "intrude")
    assert float(pushed) >= 0.3
    assert float(alone) < 1e-3, "another node has moved the robot"
    assert float(driven) >= 0.3, "another node has taken the robot away from the person"
    assert float(pace) >= 0.9, "the simulation is slower"
    assert float(rate) >= 500, "commands a second: that was no flood"
    assert intruder == "/stick"


def test_C5_a_publisher_under_the_drivers_name_keeps_the_wheels_still_and_is_named(session):
    pushed, forged, intruder, driven = run_stick(session, "forge")
    assert float(pushed) >= 0.3
    assert float(forged) < 1e-3, "a forged name has moved the robot"
    assert intruder == "/feedback_node"
    assert float(driven) >= 0.3, "the person drives again once the other is gone"


def test_M2_a_second_node_of_the_drivers_name_does_not_take_the_wheels(session):
    pushed, *taken = run_stick(session, "twin")
    assert float(pushed) >= 0.3
    assert float(" ".join(taken)) < 1e-3, "its commands were never neutral"


def test_T1_a_jump_of_the_clock_by_another_publisher_stops_the_wheels_and_is_recorded(session, tmp_path, record_property):
    pushed, held, afterwards = map(float, run_stick(session, "clock"))
    assert pushed >= 0.3
    within(record_property, "wheels held", held, 0.25)
    assert afterwards < 1e-3, "the stick was never neutral"
    # The jump itself may end the trial before the stop that it causes is known.
    ends = [end.fields for folder in tmp_path.glob("trial-*") for end in Record(folder).of("TRIAL_END")]
    assert ("aborted", "time_went_back") in [(end["result"], end["reason"]) for end in ends], ends


def test_M4_what_is_no_message_takes_no_memory_and_does_not_hold_the_robot_up(session):
    pushed, links, slowest, grown = map(float, run_stick(session, "garbage"))
    print(f"{links:.0f} connections, slowest {slowest:.2f} m/s, grown by {grown:.1f} MB")
    assert links >= 60
    assert slowest >= 0.25, "the robot was held up"
    assert grown < 50


def test_T3_commands_that_piled_up_while_the_simulator_was_halted_do_not_move_the_robot(session, record_property):
    pushed, told, afterwards = map(float, run_stick(session, "pause"))
    within(record_property, "simulator lost", told, 1.0)
    assert pushed >= 0.8
    assert afterwards < 1e-3, "the stick was never neutral"


def test_S1_a_killed_simulator_is_announced_and_ends_the_trial(session, tmp_path, record_property):
    pushed, told = map(float, run_stick(session, "crash"))
    within(record_property, "simulator lost", told, 1.0)
    assert pushed >= 0.3

    def ends():
        return [(end.fields["result"], end.fields["reason"]) for folder in tmp_path.glob("trial-*") for end in Record(folder).of("TRIAL_END")]
    assert eventually(ends, 30) == [("aborted", "simulator_lost")]


def test_C2_a_guide_that_was_halted_moves_nothing_and_calls_nobody_else_lost(session, tmp_path, record_property):
    speed, halted, held, afterwards, *said = run_stick(session, "halt")
    assert float(speed) >= 0.8
    within(record_property, "wheels held", float(held), 0.25)
    assert float(afterwards) < 1e-3, "the stick was never neutral"
    stops = [stop for folder in tmp_path.glob("trial-*") for stop in Record(folder).of("SAFE_STOP")]
    while_pushed = [stop.fields["reason"] for stop in stops if 0.0 < stop.mono_ns * 1e-9 - float(halted) < 6.0]
    assert while_pushed == ["command_lost"], stops
    assert {"robot_stopped", "release_stick"} & set(said), said
    assert not {"simulator_lost", "guidance_lost", "proximity_lost"} & set(said), said


def test_C1_a_killed_feedback_node_stops_the_robot_and_its_successor_does_not_start_it(session, record_property):
    speed, held, still, afterwards, back, *said = run_stick(session, "kill")
    assert float(speed) >= 0.8
    within(record_property, "wheels held", float(held), 0.25)
    within(record_property, "still", float(still), 0.5)
    within(record_property, "back", float(back), 2.0)
    assert float(afterwards) < 1e-3, "the stick was never neutral"
    assert said[:1] == ["robot_stopped"]


@pytest.mark.parametrize("how", ["killed", "halted"])
def test_N1_where_nav_node_is_killed_or_halted_the_person_drives_on_and_it_comes_back(session, record_property, how):
    pushed, slowest, lost, back = map(float, run_stick(session, "unguided", how))
    assert pushed >= 0.3
    assert slowest >= 0.25, "the person may still drive"
    within(record_property, "guidance lost", lost, 1.0)
    within(record_property, "back", back, 2.0)
