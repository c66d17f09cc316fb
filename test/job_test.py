"""A job: a simulated person is led from place to place, and confirms what is done at each."""
from sessions import rows_of


def test_a_job_leads_from_place_to_place_and_ends_the_session(session, tmp_path):
    job = tmp_path / "round.yaml"
    job.write_text("- {name: packing table, x: 4, y: -6.2, do: pick}\n- {name: gate 4, x: 7, y: -3, do: drop}\n")
    begun = session("world:=training", "seed:=3", f"jobs:={job}", "limit:=150")
    begun.wait_until_ended(400)
    log = next(begun.folder.glob("session-*.log")).read_text()
    legs = [(next(row["fields"] for row in rows_of(trial / "journal.csv") if row["type"] == "TRIAL_START"), rows_of(trial / "summary.csv")[0])
            for trial in sorted(begun.folder.glob("trial-*"))]
    assert [row["result"] for _, row in legs] == ["reached", "reached"], log[-4000:]
    for (start, _), (name, task) in zip(legs, (("packing table", "pick"), ("gate 4", "drop"))):
        assert f"job_name={name};job_task={task}" in start
        assert f"{name}, {task}, then press start" in log
    assert "The job is done: 2 places." in log
