"""The study as a data set of Motion-BIDS (https://bids.neuroimaging.io): the robot's way and the events of each trial that counts.

Nothing in it has a date. The same study gives the same bytes."""
import csv
import io
import json
import math
import re

from . import table
from .errors import StudyError
from .record import Record
from .study import delete, write_safely

RATE = 20.0  # Hz, of the way; odometry comes at another, even rate
VERSION = "1.10.0"
CHANNELS = (("x", "POS", "x", "m"), ("y", "POS", "y", "m"), ("yaw", "ORNT", "z", "rad"))
TRACKING = "odometry"
SHARE = "share"  # item of the consent: who did not say yes to it is left out
PARTICIPANTS = {"group": {"Description": "group of the plan"}}
EVENTS = {"onset": {"Description": "since the trial began, simulated time", "Units": "s"}, "duration": {"Units": "s"},
          "trial_type": {"Description": "what happened, as doc/record.md lists it, or the experimenter's mark, note, intervention, pause or abort"}}


def write(study, progress, read_way):
    """\\param read_way  takes a trial's folder and returns rows of (s, x, y, yaw)
    Returns the folder, which is written anew."""
    folder, plan = study.folder / "bids", progress.plan
    shared = agreed(study, progress)
    rows = [row for row in table.trials(study, progress) if row["counts"] == "yes" and shared[row["participant"]]]
    conditions = dict.fromkeys([*(one.name for one in plan.conditions), *(row["condition"] for row in rows)])  # a later plan may have one less
    for names, label in (plan.participants, _subject), (conditions, _label):
        first = {}
        for name in names:
            if (other := first.setdefault(label(name), name)) != name:
                raise StudyError(f"{plan.file}: {other} and {name} would both be {label(name)} in BIDS, which allows letters and digits.")
    delete(folder, "it is written anew")
    _json(folder / "dataset_description.json", {"Name": plan.title, "BIDSVersion": VERSION, "DatasetType": "raw",
                                                "GeneratedBy": [{"Name": "NavVI", "Version": progress.freezes[-1]["version"] if progress.freezes else "n/a"}]})
    write_safely(folder / "README", f"{plan.title}\n\nA robot in a simulated warehouse, driven by a person who is guided by touch, speech and sounds. "
                 f"The acquisition (acq) is the condition. Plan: {plan.hash()}\n")
    people = {row["participant"]: [row["group"], *table.about(study, progress.people[row["participant"]]).values()] for row in rows}
    items = {f"person_{item.name}": {"Description": item.ask} for one in plan.steps["at_begin"] for item in one.items}
    _tsv(folder / "participants.tsv", ["participant_id", "group", *items], [[_subject(name), *cells] for name, cells in sorted(people.items())])
    _json(folder / "participants.json", {**PARTICIPANTS, **items})
    runs = {}
    for row in rows:
        key = (row["participant"], row["session"], row["condition"])
        runs[key] = runs.get(key, 0) + 1
        _trial(folder, row, table.attempt_of(progress, row), runs[key], study, read_way)
    return folder


def agreed(study, progress):
    """By participant with a trial that counts: whether it is exported, as the person agreed to share or was never asked."""
    consent = progress.plan.steps["consent"]
    asked = consent and SHARE in [item.name for item in consent.items]
    driven = {row["participant"] for row in table.trials(study, progress) if row["counts"] == "yes"}
    # Of each consent that was asked: that of the plan may be another, without the item.
    given = {name: [row["answer"] for row in study.answers(name) if row["item"] == SHARE and row["step"].endswith("-consent")] for name in driven}
    return {name: given[name][-1:] == ["yes"] or not (asked or given[name]) for name in driven}


def _trial(folder, row, attempt, run, study, read_way):
    trial = study.attempt_folder(row["participant"], attempt.step, attempt.number) / row["trial"]
    subject = _subject(row["participant"])
    place = folder / subject / f"ses-{row['session']}" / "motion"
    name = f"{subject}_ses-{row['session']}_task-drive"
    end = f"acq-{_label(row['condition'])}_run-{run:02d}"
    track = f"{name}_tracksys-{TRACKING}_{end}"
    record = Record(trial)
    begun, ended = (record.first(kind).sim_ns / 1e9 for kind in ("TRIAL_START", "TRIAL_END"))
    way = resampled([place for place in read_way(trial) if begun <= place[0] <= ended], RATE)
    _tsv(place / f"{track}_motion.tsv", None, [[f"{value:.4f}" for value in values] for values in way])
    _tsv(place / f"{track}_channels.tsv", ["name", "component", "type", "tracked_point", "units"],
         [[channel, component, kind, "base_link", unit] for channel, kind, component, unit in CHANNELS])
    _json(place / f"{track}_motion.json", {
        "TaskName": "drive", "TaskDescription": f"Drive to the goal in world {attempt.world}, seed {attempt.seed}, condition {row['condition']}.",
        "SamplingFrequency": RATE, "TrackingSystemName": TRACKING, "MotionChannelCount": len(CHANNELS), "TrackedPointsCount": 1,
        "POSChannelCount": 2, "ORNTChannelCount": 1, "RecordingDuration": round(len(way) / RATE, 3), "RecordingType": "continuous",
        "SpatialAxes": "FLS", "RotationRule": "right-hand", "RotationOrder": "XYZ", "ManufacturersModelName": "navvi_sim",
        "SoftwareVersions": row.get("version", "n/a")})
    events = [[event["onset_s"], event["duration_s"], event["trial_type"], event.get("robot_x_m", "n/a"), event.get("robot_y_m", "n/a"),
               "n/a" if event["trial_type"] == "intruder" else event["detail"]]  # names of nodes have dates, such as /rostopic_7_1767225600000
              for event in table.events_of(study, row["participant"], attempt, row["trial"], words=False)]
    _tsv(place / f"{name}_{end}_events.tsv", ["onset", "duration", "trial_type", "robot_x", "robot_y", "detail"], events)
    _json(place / f"{name}_{end}_events.json", {**EVENTS, **{f"robot_{axis}": {"Description": "of the robot in map", "Units": "m"} for axis in "xy"},
                                                "detail": {"Description": table.EVENTS["detail"] + "; nodes and words are n/a here"}})


def resampled(way, rate):
    """Rows of (x, y, yaw) at an even rate from the first time on. \\param way  rows of (s, x, y, yaw), s rising"""
    rows, at = [], 0
    for step in range(int((way[-1][0] - way[0][0]) * rate) + 1 if way else 0):
        time = way[0][0] + step / rate
        while at + 2 < len(way) and way[at + 1][0] <= time:
            at += 1
        before, after = way[at], way[min(at + 1, len(way) - 1)]
        share = 0.0 if after[0] <= before[0] else min(1.0, (time - before[0]) / (after[0] - before[0]))
        turn = math.remainder(after[3] - before[3], 2 * math.pi)
        rows.append((before[1] + share * (after[1] - before[1]), before[2] + share * (after[2] - before[2]),
                     math.remainder(before[3] + share * turn, 2 * math.pi)))
    return rows


def way_of(trial):
    """Rows of (s, x, y, yaw) in map, by the track; of a record without one in odom, by the bag."""
    if track := Record(trial).track():
        return [(row["time"], row["x"], row["y"], row["yaw"]) for row in track]
    import rosbag  # of ROS, which only this needs
    rows = []
    with rosbag.Bag(str(trial / "trial.bag")) as bag:
        for _, message, _ in bag.read_messages(topics=["/odom"]):
            pose, time = message.pose.pose, message.header.stamp.to_sec()
            if not rows or time > rows[-1][0]:
                rows.append((time, pose.position.x, pose.position.y, 2 * math.atan2(pose.orientation.z, pose.orientation.w)))
    return rows


def _subject(participant):
    return "sub-" + _label(re.sub("^sub-", "", participant))


def _label(name):
    return re.sub("[^A-Za-z0-9]", "", name)


def _json(path, values):
    write_safely(path, json.dumps(values, indent=1) + "\n")


def _tsv(path, columns, rows):
    text = io.StringIO()
    writer = csv.writer(text, delimiter="\t", lineterminator="\n")
    writer.writerows(([columns] if columns else []) + rows)
    write_safely(path, text.getvalue())
