"""Records of real robots, played into launch/robot.launch by their own clock: robot_bags.py says where they come from."""
import os
import types

import pytest

from robot_bags import BAGS, FOLDER, fetch, play, row
from sessions import ROOT, script

LEAST = 0.95  # of the scans that have a pose


@pytest.mark.parametrize("bag", BAGS, ids=lambda bag: bag.name)
def test_obstacles_are_sensed_on_a_robot_of_others(master, bag, tmp_path):
    FOLDER.mkdir(parents=True, exist_ok=True)
    file = fetch(bag, FOLDER)
    if not file:
        pytest.skip(f"{bag.name} is not in {FOLDER} and cannot be fetched; NAVVI_BAGS names another folder")
    for _ in range(2):  # a busy machine loses messages by itself
        found = play(bag, file, master, tmp_path)
        print(row(bag, found))
        if found["share"] >= LEAST:
            break
    assert found["scans"] >= 4 and found["share"] >= LEAST and found["near"] > max(40, 10 * found["seconds"])


def test_a_bag_is_on_the_disk_here_before_the_robot_deletes_its_copy(tmp_path, monkeypatch):
    """It does when it is asked for more than there is."""
    content, synced = os.urandom(100), [0]
    monkeypatch.setattr(os, "fsync", lambda number: synced.append(os.fstat(number).st_size))
    folder = tmp_path / "trial-1"
    folder.mkdir()
    bag = script(ROOT / "navvi_ws/src/navvi_study/scripts/robot_bag").Bag(folder / "trial.bag")
    bag.note.touch()

    def ask(end=False, offset=0):
        assert synced[-1] == offset
        return types.SimpleNamespace(running=False, part=content[offset:offset + 60])
    bag.ask = ask
    bag.fetch()
    assert bag.path.read_bytes() == content and synced == [0, 60, 100] and os.listdir(folder) == ["trial.bag"]
