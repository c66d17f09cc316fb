"""Zones of a session: who drives is led round them or held before them, and hears their names."""
import numpy
import rosbag

from sessions import WORLD, navvi, rows_of, summary


def test_a_session_with_zones_keeps_out_of_them_and_names_them(session, tmp_path):
    zones = tmp_path / "zones.yaml"
    zones.write_text("- {name: press, kind: keep_out, corners: [-1.9, -0.4, -1.4, -0.4, -1.4, 0.5, -1.9, 0.5]}\n"
                     "- {name: dock, kind: slow, speed: 0.3, corners: [-0.5, -3, 1, -3, 1, 3, -0.5, 3]}\n")
    begun = session(f"world:={WORLD}", "seed:=3", "start:=-3.2,0,0", "goal:=3.2,0.4", f"zones:={zones}", "limit:=150")
    text = begun.wait_until_ended(400)
    assert summary(begun.folder)["result"] == "reached", text[-3000:]
    trial = next(begun.folder.glob("trial-*"))
    rows = rows_of(trial / "journal.csv")
    assert any("zone_slow" in row["fields"] and row["type"] == "CUE" for row in rows), [row["fields"] for row in rows if row["type"] == "CUE"]
    assert "slow zone, dock" in next(begun.folder.glob("session-*.log")).read_text()
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        assert {"/navvi/zone", "/navvi/zones"} <= set(bag.get_type_and_topic_info().topics)
    track = numpy.load(trial / "track.npy")
    speeds = abs(track["speed"][abs(track["x"] - 0.25) < 0.75])
    assert len(speeds) > 50 and speeds.max() < 0.33, speeds
    off = numpy.hypot(numpy.maximum(abs(track["x"] + 1.65) - 0.25, 0.0), numpy.maximum(abs(track["y"] - 0.05) - 0.45, 0.0))
    assert off.min() >= 0.34, "m, from the robot's middle to the press"


def test_a_file_of_zones_that_cannot_be_used_is_refused_before_anything_starts(tmp_path):
    zones = tmp_path / "zones.yaml"
    zones.write_text("- {name: dock, kind: slow, corners: [0, 0, 1, 0, 1, 1]}\n")
    for file, says in ((zones, "line 1"), (tmp_path / "none.yaml", "none.yaml")):
        refused = navvi("run", f"zones:={file}", "operator:=simulated", "rviz:=false")
        assert refused.returncode == 2 and says in refused.stderr, refused
