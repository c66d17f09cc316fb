#!/usr/bin/env python3
"""Long sessions, watched from outside: memory, threads and descriptors of each program, pace, stops, and whether the record is whole.

soak.py RUN [ARGUMENT:=VALUE...] [--minutes=N] [--out=FOLDER], in a shell that knows the workspace. Writes a line for each program and second to
FOLDER/soak.csv, in place of those of an earlier such run, adds its figures to FOLDER/soak.md, and draws soak.png of soak.csv; the records stay in
FOLDER/RUN. Exit code 1: a bound is broken.

K1  goals in a loop in a busy hall, at up to 10 times real time
K2  the same at real time, while feedback_node and nav_node are killed in turn
K5  10 000 obstacles
K6  K2 beside two busy loops
K7  all nodes under valgrind, in a small hall
"""
import argparse
import collections
import csv
import os
import pathlib
import re
import shutil
import statistics
import sys
import time

import numpy
import rosbag
import rospy
from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Path
from navvi_msgs.msg import DriveState, Guidance, Obstacles, Scenario, StateHash, TrialEvent, TrialState

import sessions
from sessions import DARK, ROOT, Programs, Session, eventually, rows_of, sound, sourced

RUNS = {"K1": ("world:=busy", "sim/rate:=10", "operator/rate:=200"), "K2": ("world:=busy",), "K6": ("world:=busy",),
        "K5": ("world:=easy", "trial/record:=none", "nav/replan/only_if_it_matters:=false"), "K7": ("world:=training", "sim/rate:=0.2")}
PACE = {"K1": 9.5, "K5": 1.0}  # times real time, at least, on the mean
VALGRIND = "valgrind --leak-check=full --errors-for-leak-kinds=definite --log-file={}/%p.valgrind"
CHANGES = {  # of lines of launch files
    "K5": [(r'(<node name="sim_node".*>)', r'\1<remap from="navvi/obstacles" to="true_obstacles"/>')],
    "K7": [(r'(<node name="(?:sim|trial)_node" )', r'\1launch-prefix="VALGRIND" '), (r'(scripts/respawned&quot;)"', r'\1 VALGRIND"'),
           (r'(<node if.*name="operator_node" )', r'\1launch-prefix="VALGRIND" ')]}
KILLED = {"/feedback_node": "/navvi/command", "/nav_node": "/navvi/guidance"}  # in turn, and what tells that it is back
PAUSE = 45.0  # s between two kills; more than 5 of one node within 60 s end a session
COLUMNS = ("run", "second", "simulated", "load", "program", "pid", "kilobytes", "threads", "descriptors", "processor_s")
THING = numpy.dtype([("id", "<u4"), ("size", "<u4"), ("thing_class", "S5"), ("pose", "<f8", 7), ("velocity", "<f8", 3), ("cylinder", "<f8", 4)])


class Watch:
    """What a session says; sends the next goal where one is awaited."""

    def __init__(self, uri):
        os.environ.update(ROS_MASTER_URI=uri, ROS_IP="127.0.0.1")
        rospy.init_node("soak", disable_signals=True, disable_rostime=True)
        self.latest, self.rows, self.stops, self.plans, self.goals_sent = {}, collections.defaultdict(list), [], {}, 0
        self.goals = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1)
        for topic, kind, take in (("state_hash", StateHash, None), ("command", TwistStamped, None), ("scenario", Scenario, None),
                                  ("path", Path, None), ("guidance", Guidance, self.plan), ("trial_state", TrialState, self.choose),
                                  ("events", TrialEvent, self.row), ("drive_state", DriveState, self.stop)):
            rospy.Subscriber(f"/navvi/{topic}", kind, self.take, (f"/navvi/{topic}", take), tcp_nodelay=True)

    def take(self, msg, how):
        self.latest[how[0]] = time.monotonic(), msg
        if how[1]:
            how[1](msg)

    def plan(self, msg):
        self.plans[msg.plans] = msg.plan_time

    def row(self, msg):
        self.rows[msg.trial].append(msg.seq)

    def stop(self, msg):
        if msg.state == DriveState.STOPPED:
            self.stops.append(time.monotonic())

    def choose(self, msg):
        """There and back; the state is repeated four times a second."""
        if msg.state == TrialState.CHOOSE_GOAL and "/navvi/scenario" in self.latest:
            task, goal = self.latest["/navvi/scenario"][1], PoseStamped()
            goal.header.frame_id, goal.pose.orientation.w, self.goals_sent = "map", 1.0, self.goals_sent + 1
            goal.pose.position = task.start.position if len(self.rows) % 2 else task.goal
            self.goals.publish(goal)

    def simulated(self):
        return self.latest["/navvi/state_hash"][1].header.stamp.to_sec()

    def leads(self):
        return "/navvi/path" in self.latest and len(self.latest["/navvi/path"][1].poses) > 1

    def drives(self):
        return "/navvi/command" in self.latest and self.latest["/navvi/command"][1].twist.linear.x > 0.3

    def kill(self, session, program):
        """(program, s until the wheels were held, s until it is back)"""
        begin = time.monotonic()
        session.kill(program)
        eventually(lambda: self.latest[KILLED[program]][0] > begin + 0.3, 20)
        return program, next((at - begin for at in self.stops if at > begin), None), self.latest[KILLED[program]][0] - begin


class Crowd(Obstacles):
    """10 000 things that move where the first path does not lead, as bytes."""

    def __init__(self, path):
        super().__init__()
        way, draw = numpy.array([(pose.pose.position.x, pose.pose.position.y) for pose in path.poses]), numpy.random.default_rng(1)
        way = numpy.concatenate([numpy.linspace(a, b, 50) for a, b in zip(way, way[1:])])
        places = draw.uniform(way.min(0) - 6, way.max(0) + 6, (60000, 2))
        places = numpy.array([place for place in places if numpy.hypot(*(way - place).T).min() > 1.0][:10000])
        self.things = numpy.zeros(len(places), THING)
        self.things["id"], self.things["size"], self.things["thing_class"] = 100000 + numpy.arange(len(places)), 5, b"other"
        self.places, self.things["pose"][:, 6], self.things["cylinder"][:, :2] = places, 1.0, (0.1, 1.0)

    def serialize(self, buff):
        self.things["pose"][:, :2] = self.places + 0.3 * numpy.sin(self.header.stamp.to_sec() + numpy.arange(2 * len(self.places)).reshape(-1, 2))
        self.header.frame_id = "map"
        self.header.serialize(buff)
        buff.write(numpy.uint32(len(self.things)).tobytes() + self.things.tobytes())


def sample(number):
    """kB, threads, descriptors, s of the processor."""
    folder = pathlib.Path(f"/proc/{number}")
    status, spent = (folder / "status").read_text(), (folder / "stat").read_text().rpartition(")")[2].split()
    kilobytes, threads = (int(re.search(rf"{key}:\s+(\d+)", status)[1]) for key in ("VmRSS", "Threads"))
    return kilobytes, threads, len(os.listdir(folder / "fd")), sum(map(int, spent[11:13])) / os.sysconf("SC_CLK_TCK")


def name_of(line):
    named = re.search(r"__name:=(\w+)", line)
    return named[1] if named else pathlib.Path(re.sub(r"^\S*(python3|/sh|bash)( -\S+)* ", "", line).split()[0]).name


def changed(folder, name):
    """The command, with launch files of its own."""
    for part in "navvi_cli", "launch":
        shutil.copytree(ROOT / part, folder / part)
    shutil.copy(ROOT / "navvi", folder)
    for part in "navvi_ws", "rviz":
        (folder / part).symlink_to(ROOT / part)
    for file in (folder / "launch").iterdir():
        text = file.read_text()
        for old, new in CHANGES[name]:
            text = re.sub(old, new.replace("VALGRIND", VALGRIND.format(folder)), text)
        file.write_text(text)
    return folder


class Run:
    """A session of the name, sampled until the minutes are over."""

    def __init__(self, name, folder, minutes, words):
        self.name, self.out, self.kills, self.samples = name, folder / name, [], []
        shutil.rmtree(self.out, ignore_errors=True)
        self.out.mkdir(parents=True)
        if name in CHANGES:
            sessions.ROOT = changed(self.out / "navvi", name)
        self.session = Session(self.out, "seed:=3", "limit:=300", "once:=false", *RUNS[name], *words, **sound(self.out, "null"))
        with self.session, Programs(DARK) as beside:
            self.session.wait_until_ready()
            self.said = Watch(self.session.uri)
            self.session.wait_until(lambda: self.said.rows and self.said.leads(), 900, "a trial begins")
            for _ in range(2 if name == "K6" else 0):
                beside.start("sh", "-c", "while :; do :; done")
            self.watch(60.0 * minutes)
            self.session.end()
            self.session.wait_until_ended(60)
            eventually(lambda: not self.session.of_it(), 20)
            self.orphans = list(self.session.of_it().values())

    def watch(self, seconds):
        things = Crowd(self.said.latest["/navvi/path"][1]) if self.name == "K5" else None
        crowd = rospy.Publisher("/navvi/obstacles", Obstacles, queue_size=1) if things else None
        begin, due, kill_at = time.monotonic(), 0.0, PAUSE
        while (second := time.monotonic() - begin) < seconds and self.session.process.poll() is None:
            if things:
                things.header.stamp = self.said.latest["/navvi/command"][1].header.stamp
                crowd.publish(things)
            if second >= due:
                due = int(second) + 1.0
                self.take(round(second, 2))
            if self.name in ("K2", "K6") and second > kill_at and self.said.drives():
                self.kills.append((time.monotonic(), *self.said.kill(self.session, list(KILLED)[len(self.kills) % 2])))
                kill_at = second + PAUSE
            time.sleep(0.1)

    def take(self, second):
        """A line for each program."""
        simulated, load = self.said.simulated(), os.getloadavg()[0]
        for number, line in self.session.of_it().items():
            try:
                self.samples.append((self.name, second, round(simulated, 2), load, name_of(line), number, *sample(number)))
            except OSError:
                pass  # just ended

    def pace(self):
        """Simulated seconds per second, of each ten seconds."""
        times = sorted({row[1:3] for row in self.samples})
        return [(after[1] - before[1]) / (after[0] - before[0]) for before, after in zip(times, times[10:])]

    def trials(self):
        """(folder, rows of its journal, summary) of each that was begun."""
        for path in sorted(self.out.glob("trial-*/summary.csv")):
            yield path.parent, rows_of(path.parent / "journal.csv"), rows_of(path)[0]

    def lost(self):
        """Rows that are not in the journal, were not published, or are not in the bag, of each trial."""
        for folder, rows, told in self.trials():
            end = next(int(row["seq"]) for row in rows if row["type"] == "TRIAL_END")
            bagged = range(1, end + 1)
            if told["bag"] == "ok":
                with rosbag.Bag(str(folder / "trial.bag")) as bag:
                    bagged = [msg.seq for _, msg, _ in bag.read_messages("/navvi/events") if msg.trial == folder.name]
            numbers = [int(row["seq"]) for row in rows]
            yield (len(set(range(1, len(rows) + 1)) - set(numbers)) + len(set(numbers[:end]) - set(self.said.rows[folder.name]))
                   + len(set(numbers[:end]) - set(bagged)) + int(told["missed_messages"]))

    def false_stops(self):
        """Stops of a robot that drove, but for the 8 s after a kill."""
        for _, rows, _ in self.trials():
            for row in rows:
                if row["type"] == "SAFE_STOP" and not re.search("held=yes|moved=no", row["fields"]):
                    if not any(-0.5 < int(row["mono_ns"]) * 1e-9 - at < 8.0 for at, *_ in self.kills):
                        yield row["fields"]

    def grown(self):
        """Of each that lived on: name, MB at the end, MB more than when it was warm, MB/h, threads and descriptors more in the second half."""
        last = self.samples[-1][1]
        warm = min(300.0, last / 3)
        for name, number in sorted({(row[4], row[5]) for row in self.samples if row[1] == last}):
            rows = numpy.array([(row[1], *row[6:9]) for row in self.samples if row[5] == number and row[1] > warm])
            if len(rows) > 20 and rows[-1, 0] - rows[0, 0] > 0.9 * (last - warm):
                few, (early, late), megabytes = len(rows) // 10, numpy.array_split(rows, 2), rows[:, 1] / 1024
                begin, end = megabytes[:few].mean(), megabytes[-few:].mean()
                yield (name, end, end - begin, numpy.polyfit(rows[:, 0] / 3600, megabytes, 1)[0], *(late[:, 2:].mean(0) - early[:, 2:].mean(0)))

    def bags(self):
        """What `count_trial` says of each bag that differs from its summary."""
        for folder, _, told in self.trials():
            if told["bag"] == "ok":
                done = sourced("rosrun", "navvi_study", "count_trial", "bag", folder)
                if done.returncode:
                    yield f"{folder.name}: {done.stdout}{done.stderr}"

    def leaks(self):
        """(nodes that ended under valgrind, bytes definitely lost, errors)"""
        ended = [text for text in (path.read_text(errors="replace") for path in self.out.glob("navvi/*.valgrind")) if "ERROR SUMMARY" in text]
        lost, errors = (sum(int(found.replace(",", "")) for text in ended for found in re.findall(pattern, text))
                        for pattern in (r"definitely lost: ([\d,]+) bytes", r"ERROR SUMMARY: ([\d,]+) "))
        return len(ended), lost, errors

    def figures(self):
        """(what, figure, bound, whether it holds)"""
        pace, told, plans = self.pace(), [told for *_, told in self.trials()], list(self.said.plans.values())
        lost, stops, bags = sum(self.lost()), len(list(self.false_stops())), len(list(self.bags()))
        results = collections.Counter(one["result"] for one in told)
        # Of bounds on the wall clock, as sessions.within.
        slack = 2.0 if statistics.mean(row[3] for row in self.samples) > os.cpu_count() else 1.0
        yield "trials", f"{len(told)}: " + ", ".join(f"{count} {word}" for word, count in results.items()), "", bool(told)
        mean, least = round(statistics.mean(pace), 2), PACE.get(self.name, 0.0)
        yield "times real time, mean and 1st percentile", f"{mean:.2f}, {numpy.percentile(pace, 1):.2f}", f"{least:g}" if least else "", mean >= least
        yield "rows lost", f"{lost} of {sum(len(rows) for _, rows, _ in self.trials())}", "0", not lost
        yield "bags that differ", f"{bags}", "0", not bags
        yield "stops without a cause", f"{stops}", "0", not stops
        yield "programs left", f"{len(self.orphans)}", "0", not self.orphans
        if self.name == "K7":
            ended, lost, errors = self.leaks()
            yield "bytes definitely lost, errors", f"{lost}, {errors} in {ended} nodes", "0, 0", ended >= 5 and not lost + errors
            return
        slope = 1.0 if self.samples[-1][1] > 3000 else 1e9  # of less it says nothing
        for what, at, bound in ("MB grown", 2, 5.0), ("MB an hour", 3, slope), ("threads more", 4, 1), ("descriptors more", 5, 3):
            name, most = max(((one[0], one[at]) for one in self.grown()), key=lambda one: one[1])
            yield what, f"{most:.1f} ({name})", f"{bound:g}" if bound < 1e9 else "", most < bound
        yield "plans, ms, p99", f"{1000 * numpy.percentile(plans, 99):.0f} of {len(plans)}", "500", numpy.percentile(plans, 99) < 0.5 * slack
        for program in KILLED if self.kills else ():
            held, back = ([kill[at] for kill in self.kills if kill[1] == program] for at in (2, 3))
            if program == "/feedback_node":
                longest = max(one or 9.0 for one in held)
                yield "held after a kill, ms, longest", f"{1000 * longest:.0f} of {len(held)}", "250", longest < 0.25 * slack
            yield f"{program[1:]} back, s, longest", f"{max(back):.2f} of {len(back)}", "2", max(back) < 2.0 * slack
        for chain, bound in ("sensed", 1e9), ("motors", 100), ("pattern", 100), ("words", 400), ("silence", 1e9):
            times = [float(one[f"{chain}_p99_ms"]) for one in told if one[f"{chain}_p99_ms"] != "n/a"]
            if times and self.name == "K6":
                yield f"{chain}, ms, p99 of the worst trial", f"{max(times):.0f}", f"{bound}" if bound < 1e9 else "", max(times) < bound


def draw(folder):
    """Each program's memory, threads and descriptors over the minutes, a column a run."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    rows = rows_of(folder / "soak.csv")
    runs, names = (sorted({row[key] for row in rows}) for key in ("run", "program"))
    figure, axes = pyplot.subplots(3, len(runs), figsize=(3 + 2.5 * len(runs), 7), sharex="col", sharey="row", squeeze=False)
    for run, column in zip(runs, axes.T):
        of_run = collections.defaultdict(list)
        for row in rows:
            if row["run"] == run:
                of_run[row["program"], row["pid"]].append([float(row[key]) for key in ("second", "kilobytes", "threads", "descriptors")])
        for (name, _), samples in of_run.items():
            samples = numpy.array(samples) / (60, 1024, 1, 1)
            for at, axis in enumerate(column, 1):
                axis.plot(samples[:, 0], samples[:, at], color=f"C{names.index(name)}", linestyle="--" if names.index(name) > 9 else "-", linewidth=1)
        column[0].set_title(run)
        column[2].set_xlabel("minutes")
    for axis, name in zip(axes[:, 0], ("memory, MB", "threads", "descriptors")):
        axis.set_ylabel(name)
    lines = [pyplot.Line2D([], [], color=f"C{at}", linestyle="--" if at > 9 else "-") for at in range(len(names))]
    figure.legend(lines, names, loc="upper right", fontsize=7)
    figure.tight_layout(rect=(0, 0, 1 - 1.4 / (3 + 2.5 * len(runs)), 1))
    figure.savefig(folder / "soak.png", dpi=70)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", choices=[*RUNS])
    parser.add_argument("words", nargs="*", help="arguments of ./navvi run, such as sim/rate:=5")
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("soak"))
    words = parser.parse_args()
    run, table = Run(words.run, words.out.resolve(), words.minutes, words.words), words.out / "soak.csv"
    rows = [tuple(row.values()) for row in rows_of(table) if row["run"] != run.name] if table.exists() else []
    with open(table, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows, *run.samples])
    found, load = list(run.figures()), statistics.mean(row[3] for row in run.samples)
    broken = "broken" if load <= 4 * os.cpu_count() else "broken: too busy to judge"
    with open(words.out / "soak.md", "a") as file:
        for what, figure, bound, good in found:
            print(f"| {run.name} | {words.minutes:g} | {load:.1f} | {what} | {figure} | {bound} | {'' if good else broken} |", file=file)
    print((words.out / "soak.md").read_text())
    for name, megabytes, *more in run.grown():
        print(name, f"{megabytes:.1f} MB", *(f"{number:+.1f} {unit}" for number, unit in zip(more, ("MB", "MB/h", "threads", "descriptors"))))
    print(*run.orphans, *run.false_stops(), *run.bags(), *run.kills, sep="\n")
    draw(words.out)
    return not all(good for *_, good in found)


if __name__ == "__main__":
    sys.exit(main())
