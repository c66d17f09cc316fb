"""A job: a simulated person is led from place to place, and confirms what is done at each."""
import pytest

from sessions import navvi, rows_of
from navvi_cli import trials
from navvi_cli.commands import run


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
