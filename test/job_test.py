"""A job: a simulated person is led from place to place, and confirms what is done at each."""
from sessions import rows_of


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
