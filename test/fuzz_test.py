"""Damaged files of a study and of a batch: each reader reads them, or refuses them with a sentence. NAVVI_FUZZ: how many of each kind."""
import contextlib
import os
import random
import struct

import pytest

from small_study import EXAMPLE, PACKAGE
from navvi_study import journal, plan_file, questionnaire, record
from navvi_study.errors import StudyError

ROUNDS = int(os.environ.get("NAVVI_FUZZ", "300"))
TOKENS = [b"nan", b"-1", b"1e308", b"9" * 30, b"", b" ", b"\n", b"\0", b"\xff\xfe", b"\xc2\xb2", b"{", b"}", b"[" * 3000, b"\"", b":", b",", b";", b"=",
          b"- ", b"*a", b"&a ", b"!!python/object:os.system ", b"null", b"%s"]


def damaged(data, chance):
    for _ in range(chance.randint(1, 4)):
        at = chance.randint(0, len(data))
        to = min(len(data), at + chance.randint(0, 1 << chance.randint(0, 12)))
        data = chance.choice([
            lambda: data[:at] + bytes([chance.randint(0, 255)]) + data[at + 1:], lambda: data[:at] + data[to:],
            lambda: data[:at] + data[at:to] * chance.randint(2, 9) + data[to:], lambda: data[:at] + chance.choice(TOKENS) + data[at:],
            lambda: data[:at] + chance.choice(TOKENS) + data[to:], lambda: data[:at]])()
    return data


def read_all(path):
    one = record.Record(path.parent)
    one.cues()
    if one.first("TRIAL_START"):
        one.way()
        one.onset_of(5)


def plan_of(path):
    plan_file.load(path)


def rows_of(path):
    kept = journal.Journal(path)
    before = path.read_bytes()
    try:
        kept.rows()
    finally:
        assert before.startswith(path.read_bytes()), "but for an unfinished last row, which is set aside"


TRIAL = (b"trial,seq,sim_ns,mono_ns,type,fields,crc32\ntrial-1,1,1000000000,5,TRIAL_START,x=1;y=2;yaw=0,1\n"
         b"trial-1,2,2000000000,6,CUE,modality=speech;kind=direction;text=go%20on,2\ntrial-1,3,3000000000,7,PROGRESS,x=1.5;y=2,3\n")
TRACK_HEADER = b"{'descr': [('time', '<f8'), ('x', '<f4'), ('cue', '|S8')], 'fortran_order': False, 'shape': (3,), }\n"
TRACK = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(TRACK_HEADER)) + TRACK_HEADER + b"".join(struct.pack("<df8s", i, 1.0, b"go") for i in range(1, 4))


@pytest.fixture(scope="module")
def study_journal(tmp_path_factory):
    kept = journal.Journal(tmp_path_factory.mktemp("journal") / "journal.jsonl")
    for number in range(4):
        kept.append("NOTE", text=f"row {number}", value={"a": [1, 2]})
    return kept.path.read_bytes()


@pytest.mark.parametrize("name, read", [
    ("plan.yaml", plan_of), ("tlx.yaml", questionnaire.load), ("journal.jsonl", rows_of), ("journal.csv", read_all),
    ("answers.jsonl", lambda path: journal.read_lines(path, {"text": str})), ("events.csv", journal.rows_of),
    ("track.npy", lambda path: record.Record(path.parent).track())], ids=lambda value: value if isinstance(value, str) else "")
def test_a_damaged_file_is_read_or_refused(name, read, tmp_path, study_journal):
    whole = {"plan.yaml": EXAMPLE.read_bytes(), "tlx.yaml": (PACKAGE / "studies/questionnaires/tlx.yaml").read_bytes(), "journal.csv": TRIAL,
             "events.csv": TRIAL, "track.npy": TRACK}.get(name, study_journal)
    (tmp_path / "questionnaires").symlink_to(PACKAGE / "studies/questionnaires")
    for number in range(ROUNDS):
        (tmp_path / name).write_bytes(damaged(whole, random.Random(number)))
        with contextlib.suppress(StudyError):
            try:
                read(tmp_path / name)
            except StudyError as refusal:
                assert str(refusal).isprintable() or "\n" in str(refusal), (number, str(refusal))
                raise
            except Exception as problem:
                raise AssertionError(f"number {number} of {name}") from problem
