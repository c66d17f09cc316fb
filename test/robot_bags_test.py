"""Records of real robots, played into launch/robot.launch by their own clock: robot_bags.py says where they come from."""
import pytest

from robot_bags import BAGS, FOLDER, fetch, play, row

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
