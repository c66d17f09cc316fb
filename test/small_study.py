"""A small study for the tests, and what drives in place of ./navvi."""
import functools
from types import SimpleNamespace

import pytest

from sessions import ROOT
from navvi_study import plan_file, rehearsal, runner, session, study

PACKAGE = ROOT / "navvi_ws/src/navvi_study"
EXAMPLE = PACKAGE / "studies/example_plan.yaml"
PLAN = """
study: small
title: A small study
groups: {all: {participants: sub-01..sub-04}}
conditions: {full: {picture: false}, plain: {picture: false, touch: false}}
worlds:
  sets: {a: {world: easy, seeds: [1]}, b: {world: easy, seeds: [2]}}
  reserve: {world: easy, seeds: 11..12}
operator: simulated
limit: 60
questionnaires: {after_condition: [tlx]}
outcomes: {primary: {measure: time, conditions: [plain, full]}}
exclusions: [{column: result, is: [aborted, invalid], reason: the trial broke off}]
"""


def small(folder, *changes):
    """A plan, with pairs of old and new text in place."""
    text = PLAN
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    folder.mkdir(exist_ok=True)
    path = folder / "small.yaml"
    path.write_text(text)
    return plan_file.load(path)


class Driver(runner.LoopRunner):
    """Instead of ./navvi: each trial's summary has the next result, or none is written."""

    def __init__(self, work, *results):
        self.work, self.results, self.driven = work, list(results), []

    def trial(self, participant, step, attempt, folder, lock):
        self.driven.append((attempt.world, attempt.seed))
        result = self.results.pop(0) if self.results else "reached"
        if result == "none":
            return
        if result == "killed":
            raise KeyboardInterrupt
        write_summary(folder / f"trial-{len(self.driven)}", result)


def write_summary(folder, result="reached", elapsed=20.0, reason="n/a"):
    folder.mkdir(parents=True)
    row = {"trial": folder.name, "started_utc": "2026-01-01T00:00:00Z", "result": result, "reason": reason, "elapsed_s": elapsed, "shelf_collision_count": 1,
           "obstacle_collision_count": 2, "path_length_m": 12.0, "first_path_length_m": 10.0}
    (folder / "summary.csv").write_text(",".join(row) + "\n" + ",".join(map(str, row.values())) + "\n")


def frozen(folder, *changes):
    kept = study.Study(small(folder, *changes))
    kept.freeze("test", None)
    return kept


def begin(kept, *results, driver=Driver, say=lambda line: None):
    """A session whose trials end so."""
    return session.Session(kept, driver(kept, *results), say=say, wait=False)


def words(kept, **more):
    """Of an action of `./navvi study`."""
    return SimpleNamespace(plan=kept.plan.file, **more)


def exclusion(kept, what, reason):
    return words(kept, what=what, reason=reason, no_replacement=False)


@pytest.fixture
def work(tmp_path):
    """A frozen study; work(*results) gives a session whose trials end so."""
    kept = frozen(tmp_path)
    given = functools.partial(begin, kept)
    given.study = kept
    return given


def trial_of(kept, name="sub-01", at=0):
    """An attempt of a participant, and its trial's folder."""
    attempt = kept.progress().person(name).attempts[at]
    return attempt, kept.attempt_folder(name, attempt.step, attempt.number) / attempt.trial


def write_record(folder, end=30.0):
    """A journal from 10 s of ROS time on, whose monotonic clock stands at 1000 s then and runs half as fast, and the events of it."""
    rows = [(10.0, 1000.0, "TRIAL_START", "x=0;y=0"), (15.0, 1002.5, "PROGRESS", "x=1;y=0"), (end, 1000.0 + (end - 10.0) / 2, "TRIAL_END", "x=2;y=0")]
    (folder / "journal.csv").write_text("trial,seq,sim_ns,mono_ns,type,fields,crc32\n" + "".join(
        f"t,{seq},{int(sim * 1e9)},{int(mono * 1e9)},{kind},{fields},00000000\n" for seq, (sim, mono, kind, fields) in enumerate(rows, 1)))
    (folder / "events.csv").write_text("onset_s,duration_s,trial,trial_type,robot_x_m,robot_y_m,detail\n2.500,0,t,goal reached,1.0,2.0,n/a\n"
                                       "3.500,0,t,intruder,1.0,2.0,/rostopic_7_1767225600000\n")


def rest(begun, name="sub-01"):
    """The steps that are left, done."""
    steps = []
    while (step := begun.next(name)) is not None:
        steps.append(step.name)
    return steps


def rehearsed(folder, trials_bench, said):
    return rehearsal.rehearse(plan_file.load(folder / "small.yaml"), trials_bench, "test", said.append)


@pytest.fixture
def bench(tmp_path):
    """Instead of trials_bench: a summary a trial, and it waits where a file says so."""
    small(tmp_path)
    path = tmp_path / "trials_bench"
    path.write_text(f"""#!/bin/sh
echo "$@" >> {tmp_path}/calls
if test -e {tmp_path}/wait && test $(wc -l < {tmp_path}/calls) -gt 3; then touch {tmp_path}/there; sleep 30; fi
for word in "$@"; do case $word in --out=*) out=${{word#--out=}}/trial-easy-1 ;; esac; done
mkdir -p $out
printf 'trial,started_utc,result,reason,elapsed_s,shelf_collision_count,obstacle_collision_count,path_length_m,first_path_length_m\ntrial-easy-1,2026-01-01T00:00:00Z,reached,n/a,20.0,1,2,12.0,10.0\n' > $out/summary.csv
""")
    path.chmod(0o755)
    return path
