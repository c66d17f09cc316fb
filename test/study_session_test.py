"""A study of two simulated participants, two conditions and one world each, run live to its end and killed amid it."""
import json
import os
import signal
from pathlib import Path

import pytest

from sessions import ROOT, Command, eventually, rows_of, sourced
from small_study import small

CHANGES = [("participants: sub-01..sub-04", "participants: sub-01..sub-02"), ("{picture: false}", "{}"), ("{picture: false, touch: false}", "{touch: false}"),
           ("{world: easy, seeds: [1]}", "{world: training, seeds: [3]}"), ("{world: easy, seeds: [2]}", "{world: training, seeds: [4]}"),
           ("{world: easy, seeds: 11..12}", "{world: training, seeds: 11..14}"), ("limit: 60", "limit: 120")]


class Study:
    def __init__(self, folder):
        self.plan = small(folder, *CHANGES).file
        self.folder = folder / "small"

    def begin(self, action, *words):
        return Command("study", action, self.plan, *words)

    def run(self, *words):
        begun = self.begin(*words)
        said = begun.wait_until_ended(400)
        return begun.process.returncode, said

    def rows(self):
        path = self.folder / "journal.jsonl"
        return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []

    def wait_for(self, condition, seconds=120):
        assert eventually(condition, seconds), self.rows()[-3:]

    def table(self):
        return rows_of(self.folder / "trials.csv")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    study = Study(tmp_path_factory.mktemp("study"))
    assert study.run("freeze")[0] == 0
    # Killed while the first trial runs: the session ends with its command, and a trial in a world of the reserve follows.
    first = study.begin("next", "sub-01").process
    study.wait_for(lambda: "TRIAL_START" in "".join(path.read_text() for path in study.folder.glob("sub-01/*/trial-*/journal.csv")), 500)
    # So is the command that it has started.
    below = [int(number) for number in Path(f"/proc/{first.pid}/task/{first.pid}/children").read_text().split()]
    assert below
    for number in (first.pid, *below):
        os.kill(number, signal.SIGKILL)
    first.wait()
    study.wait_for(lambda: list(study.folder.glob("sub-01/*/trial-*/summary.csv")))
    study.wait_for(lambda: study.run("next", "sub-01", "--session")[0] == 0)
    assert study.run("run")[0] == 0  # the rest, to the report
    assert study.run("next", "sub-02")[0] == 3
    return study


def counted(done):
    return [row for row in done.table() if row["counts"] == "yes"]


def test_D3_nothing_is_lost_and_nothing_is_doubled(done):
    begun = [(row["participant"], row["step"], row["attempt"]) for row in done.rows() if row["type"] == "begin"]
    ended = [(row["participant"], row["step"], row["attempt"]) for row in done.rows() if row["type"] == "end"]
    assert begun == ended and len(begun) == len(set(begun)) == 5
    assert sorted((row["participant"], row["condition"]) for row in counted(done)) == [(name, condition) for name in ("sub-01", "sub-02") for condition in ("full", "plain")]


def test_each_trial_names_its_place_in_the_study_in_its_own_record(done):
    for row in counted(done):
        assert row["study"] == "small" and row["result"] == "reached" and row["bag"] == "ok"
        assert row["operator"] == "simulated" and row["compiler"].startswith("GCC") and row["cpu"] != ""
        assert f"feedback/haptics/enabled={'false' if row['condition'] == 'plain' else 'true'}" in row["parameters"]
        assert "feedback/locked=true" in row["parameters"]
        folder = next(done.folder.glob(f"{row['participant']}/*/{row['trial']}"))
        own = rows_of(folder / "summary.csv")[0]
        for name in ("condition", "group", "phase", "repeat", "attempt", "session"):
            assert own[name] == row[name], name


def test_the_report_has_both_conditions(done):
    text = (done.folder / "report.html").read_text()
    assert "all, full" in text and "all, plain" in text and "fewer than 5 participants" in text
    assert "Cues a minute" in text and text.count("The map of world training") == 3


def test_journal_bag_and_table_are_equal(done):
    code, said = done.run("verify")
    assert code == 0 and "5 trials, 0 differ." in said, said
    assert said.count("journal equal, bag equal, table equal.") == 5


def test_the_page_on_pandas_reads_tables_and_track(done):
    page = (ROOT / "doc/study.md").read_text().split("```python\n")[1].split("```")[0]
    assert len(page.splitlines()) <= 30
    result = sourced("/usr/bin/python3", "-c", page.replace('"touch_and_sounds"', json.dumps(str(done.folder))))
    assert result.returncode == 0, result.stderr
    assert "path_length_m" in result.stdout and float(result.stdout.split()[-1]) > 5.0
