"""A session is read by Lab Streaming Layer's own inlets, and the journal has the offset of its clock."""
import json
import math
import os
import re
import subprocess

import pytest

from sessions import DARK, Programs, rows_of

READER = """
import json, sys, time
import pylsl
names = ("events", "cues", "pose", "stick")
inlets, read = {}, {name: [] for name in names}
deadline = time.monotonic() + 120
while time.monotonic() < deadline and not any('"TRIAL_END"' in sample[0] for _, sample in read["events"]):
    for name in set(names) - set(inlets):
        for info in pylsl.resolve_byprop("name", f"NavVI_{name}", 1, 0.5)[:1]:
            inlets[name] = pylsl.StreamInlet(info, max_buflen=60, recover=False)
            inlets[name].open_stream()
            print(name, "is open", file=sys.stderr, flush=True)
    for name, inlet in inlets.items():
        try:
            samples, times = inlet.pull_chunk(timeout=0.05, max_samples=1000)
        except pylsl.LostError:
            deadline = 0
            break
        read[name] += [[time, sample] for time, sample in zip(times, samples)]
json.dump(read, sys.stdout)
"""


# Instead of pylsl: an outlet listens on all interfaces, as liblsl's.
ANY = """
import socket, time
IRREGULAR_RATE, cf_string, cf_double64, cf_float32, local_clock = 0.0, 1, 2, 3, time.monotonic
class Part:
    def append_child(self, *_):
        return self
    append_child_value = append_child
class StreamInfo(Part):
    def __init__(self, *_):
        self.desc = Part
class StreamOutlet:
    def __init__(self, _):
        self.socket = socket.create_server(("", 0))
    def push_sample(self, _):
        pass
"""


def test_streams_are_open_to_the_network_and_end_with_a_session_that_is_killed(session, tmp_path):
    (tmp_path / "pylsl.py").write_text(ANY)
    begun = session("world:=training", "lsl:=true", "limit:=300", PYTHONPATH=f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}")
    begun.wait_until_begun()

    def listening():
        """Addresses of the program of the streams."""
        sockets = subprocess.check_output(["ss", "-ltnpH"], text=True).splitlines()
        numbers = [number for number, line in begun.of_it().items() if "/lsl_outlets " in line]
        return [line.split()[3].rpartition(":")[0] for number in numbers for line in sockets if f"pid={number}," in line]
    begun.wait_until(lambda: listening().count("0.0.0.0") == 4, 30, "all four streams are open")
    assert {*listening()} == {"0.0.0.0", "127.0.0.1"}, "its ports of ROS are not"
    begun.kill("/roslaunch")
    begun.wait_until(lambda: not listening(), 10, "they have ended")


@pytest.fixture(scope="module")
def done(master, tmp_path_factory):
    """What inlets have read of a session, and the folder of its trial."""
    folder = tmp_path_factory.mktemp("lsl")
    if subprocess.run(["/usr/bin/python3", "-c", "import pylsl"], capture_output=True).returncode != 0:
        pytest.skip("pylsl is not installed; doc/study.md names the command")
    config = folder / "lsl.cfg"
    config.write_text("[multicast]\nResolveScope = machine\n[lab]\nKnownPeers = {127.0.0.1}\n")
    with Programs(dict(DARK, **{name: master[name] for name in ("ROS_MASTER_URI", "ROS_IP")}, LSLAPICFG=str(config)), folder / "log") as programs:
        reader = programs.start("/usr/bin/python3", "-c", READER, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        # A wait before the trial, so that the inlets are open: the simulated person presses start late.
        launch = programs.launch("live.launch", "operator:=simulated", "once:=true", "lsl:=true", "rviz:=false", "world:=training", "seed:=3", "limit:=60",
                                 f"out:={folder}")
        read = json.loads(reader.communicate(timeout=150)[0])
        launch.wait(60)
    return read, next(folder.glob("trial-*"))


def test_each_event_that_was_read_is_a_row_of_the_journal(done):
    read, trial = done
    written = {int(row["seq"]): row for row in rows_of(trial / "journal.csv")}
    events = [json.loads(sample[0]) for _, sample in read["events"]]
    assert "TRIAL_END" in {event["type"] for event in events} and len(events) > 10
    for (at, _), event in zip(read["events"], events):
        row = written[event["seq"]]
        assert (event["trial"], event["type"]) == (row["trial"], row["type"])
        assert ";".join(f"{name}={value}" for name, value in event["fields"].items()) == row["fields"]


def test_the_offset_in_the_journal_brings_both_clocks_together(done):
    read, trial = done
    written = {int(row["seq"]): row for row in rows_of(trial / "journal.csv")}
    offsets = [int(re.search(r"source=lsl;offset_ns=(-?\d+)", row["fields"]).group(1)) for row in written.values() if row["type"] == "CLOCK_OFFSET"]
    assert len(offsets) >= 5 and max(offsets) - min(offsets) < 50e6
    late = sorted(at - (int(written[json.loads(sample[0])["seq"]]["mono_ns"]) + offsets[0]) / 1e9 for at, sample in read["events"])
    assert -0.01 < late[0] and late[len(late) // 2] < 0.25, "no event is read before it was written, and most soon after"


def test_cues_pose_and_stick_are_streamed(done):
    read, _ = done
    cues = [json.loads(sample[0]) for _, sample in read["cues"]]
    assert {"speech", "sound"} & {cue["modality"] for cue in cues} and all(cue["stage"] != "unknown" for cue in cues)
    poses = [sample for _, sample in read["pose"]]
    assert len(poses) > 200 and math.dist(poses[0][:2], poses[-1][:2]) > 1.0
    assert any(forward > 0.3 for _, (_, forward) in read["stick"])
    times = [at for at, _ in read["pose"]]
    assert times == sorted(times)
