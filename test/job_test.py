"""A job: a simulated person is led from place to place, and confirms what is done at each."""
import pytest

from sessions import WORLD, Programs, navvi, rows_of
from navvi_cli import trials
from navvi_cli.commands import run


#: Looks at the way that RViz shows before a trial begins: of a job that waits, then as if there were none, then of the job again.
WATCH = """
import sys, time, rospy
from nav_msgs.msg import Path
from navvi_msgs.msg import TrialState
rospy.init_node("watch")
shown, states = [], []
rospy.Subscriber("/navvi/preview", Path, lambda path: shown.append(len(path.poses)))
rospy.Subscriber("/navvi/trial_state", TrialState, lambda trial: states.append(trial.state))

def until(condition, seconds, what):
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            sys.exit(f"in {seconds} s it did not come true that {what}: {shown}")
        time.sleep(0.05)

until(lambda: states and states[-1] == TrialState.READY, 200, "the job waits to begin")
job = rospy.get_param("/trial_node/job")
rospy.set_param("/trial_node/job", "")
until(lambda: shown and shown[-1] > 1, 100, "the way to the world's goal is shown without a job")
rospy.set_param("/trial_node/job", job)
until(lambda: shown[-1] == 0, 30, "it is not shown of a job")
"""


def test_a_job_leads_from_place_to_place_and_ends_the_session(session, tmp_path):
    job = tmp_path / "round.yaml"
    places = [("packing table", 4, -6.2, "pick"), ("gate 4", 7, -3, "drop"), ("dock", 0, -6, "scan"), ("bay 7", -4, 6, "pick")]
    job.write_text("".join(f"- {{name: {name}, x: {x}, y: {y}, do: {task}}}\n" for name, x, y, task in places))
    begun = session("world:=training", "seed:=3", f"jobs:={job}", "limit:=150")
    begun.wait_until_ended(500)
    log = next(begun.folder.glob("session-*.log")).read_text()
    legs = [(next(row["fields"] for row in rows_of(trial / "journal.csv") if row["type"] == "TRIAL_START"), rows_of(trial / "summary.csv")[0])
            for trial in sorted(begun.folder.glob("trial-*"))]
    assert [row["result"] for _, row in legs] == ["reached"] * 4, log[-4000:]
    for (start, _), (name, _, _, task) in zip(legs, places):
        assert f"job_name={name};job_task={task}" in start
        assert f"{name}, {task}, then press start" in log
    assert "The job is done: 4 places." in log


def test_a_job_ends_where_a_place_takes_too_long_and_names_it(session, tmp_path):
    job = tmp_path / "round.yaml"
    job.write_text("- {name: packing table, x: 4, y: -6.2}\n- {name: bay 7, x: -4, y: 6}\n")
    begun = session("world:=training", "seed:=3", f"jobs:={job}", "limit:=4")
    begun.wait_until_ended(300)
    log = next(begun.folder.glob("session-*.log")).read_text()
    assert [rows_of(trial / "summary.csv")[0]["result"] for trial in sorted(begun.folder.glob("trial-*"))] == ["timeout"] * 2, log[-4000:]
    assert "The job is done: 2 places, not reached: packing table, bay 7." in log


def test_no_way_to_another_goal_is_shown_while_a_job_waits(desktop, tmp_path):
    job = tmp_path / "round.yaml"
    job.write_text("- {name: packing table, x: 2, y: 2}\n")
    with Programs(desktop, tmp_path / "log") as programs:
        programs.launch("live.launch", "operator:=keyboard", f"world:={WORLD}", "seed:=3", "once:=false", "speech:=false",
                        "feedback_parameters:={listener: topic}", f"jobs:={job}", f"out:={tmp_path}", "rviz:=true")
        programs.person("-c", WATCH, seconds=360)


def test_a_place_to_which_no_way_leads_is_refused_before_anything_starts(tmp_path):
    job = tmp_path / "round.yaml"
    job.write_text("- {name: packing table, x: 4, y: -6.2}\n- {name: attic, x: 400, y: 0}\n")
    refused = navvi("run", "world:=training", "seed:=3", f"jobs:={job}", "operator:=simulated", "rviz:=false", f"out:={tmp_path}")
    assert refused.returncode == 2 and " to 400.0,0.0: " in refused.stderr, refused
    assert not list(tmp_path.glob("trial-*"))


@pytest.mark.parametrize("ends, code", [(["attic refused", "dock reached"], 1), (["dock aborted", "attic reached", "dock reached"], 0),
                                        (["dock goal_at_start", "attic reached"], 0), (["dock reached", " aborted"], 1),
                                        ([" aborted", "dock reached", "attic reached"], 0), (["dock reached"], 1), ([" reached", "dock reached"], 1)])
def test_a_session_with_a_job_tells_whether_each_place_was_reached(monkeypatch, ends, code):
    monkeypatch.setattr(run.workspace, "show", lambda *words: None)
    monkeypatch.setattr(trials, "summed_up", lambda *words: ends)
    monkeypatch.setattr(trials, "conditions", lambda end: {"job_name": end.split(" ")[0]})
    monkeypatch.setattr(trials, "summary", lambda end: {"result": end.split(" ")[1], "reason": end.split(" ")[1]})
    monkeypatch.setattr(trials, "report", lambda end: int(not end.endswith("reached")))
    assert run.report("out", [], "", 2) == code
