"""Goals and jobs by keys alone, in the small window."""
import pytest

from sessions import rows_of

from by_hand import session

pytestmark = pytest.mark.accessibility


def test_three_goals_by_keys_alone(desktop, tmp_path):
    session(desktop, tmp_path, "keyboard", ["goal_reached"] * 3, "rviz:=false")


def test_a_job_of_four_places_by_keys_alone(desktop, tmp_path):
    job = tmp_path / "round.yaml"
    places = {"packing table": (-2.5, 3.5, "pick"), "gate 4": (2.5, -3.5, "drop"), "dock": (-2.5, -3.5, "scan"), "bay": (2.5, 3.5, "pick")}
    job.write_text("".join(f"- {{name: {name}, x: {x}, y: {y}, do: {do}}}\n" for name, (x, y, do) in places.items()))
    told = session(desktop, tmp_path, "job,gate 4", ["goal_reached"] * 4, "rviz:=false", f"jobs:={job}")
    driven = ["gate 4", "packing table", "dock", "bay"]
    said = [told.find(f"{name}, {places[name][2]}, then press enter") for name in driven]
    assert -1 not in said and said == sorted(said), told
    for trial, name in zip(sorted(tmp_path.glob("trial-*")), driven):
        start = next(row["fields"] for row in rows_of(trial / "journal.csv") if row["type"] == "TRIAL_START")
        assert f"job_name={name};job_task={places[name][2]}" in start
    assert "The job is done: 4 places." in (tmp_path / "log").read_text()
