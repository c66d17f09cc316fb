"""Damaged files of a study and of a batch: each reader reads them, or refuses them with a sentence. NAVVI_FUZZ: how many of each kind, and the
number of the first. And disks that fail, and programs that are killed, at each call of what writes such files."""
import contextlib
import errno
import io
import os
import random
import struct
import xmlrpc.client

import pytest

from small_study import EXAMPLE, PACKAGE
from navvi_study import journal, plan_file, questionnaire, record, study
from navvi_cli import near_master
from navvi_people import batch
from navvi_study.errors import StudyError

ROUNDS, FIRST = map(int, (os.environ.get("NAVVI_FUZZ", "300") + " 0").split()[:2])
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
    ("track.npy", lambda path: record.Record(path.parent).track()), ("rows-1.csv", lambda path: batch.done_in(path.parent))], ids=lambda value: value if isinstance(value, str) else "")
def test_a_damaged_file_is_read_or_refused(name, read, tmp_path, study_journal):
    whole = {"plan.yaml": EXAMPLE.read_bytes(), "tlx.yaml": (PACKAGE / "studies/questionnaires/tlx.yaml").read_bytes(), "journal.csv": TRIAL,
             "events.csv": TRIAL, "track.npy": TRACK, "rows-1.csv": b"1,easy,2\n2,easy,3\n"}.get(name, study_journal)
    (tmp_path / "questionnaires").symlink_to(PACKAGE / "studies/questionnaires")
    for number in range(FIRST, FIRST + ROUNDS):
        (tmp_path / name).write_bytes(damaged(whole, random.Random(number)))
        with contextlib.suppress(StudyError, batch.BatchError):
            try:
                read(tmp_path / name)
            except (StudyError, batch.BatchError) as refusal:
                assert str(refusal).replace("\n", "").isprintable(), (number, str(refusal))
                raise
            except Exception as problem:
                raise AssertionError(f"number {number} of {name}") from problem


class Bytes(xmlrpc.client.Transport):
    """In place of a connection: what is answered is said beforehand."""

    def single_request(self, *_, **__):
        return self.parse_response(io.BytesIO(self.answer))


@pytest.mark.parametrize("value", [{"a": {"b": 1.5}, "c": True}, ["http://127.0.0.1:1/"], [[1, "http://127.0.0.1:1/", "i", "TCPROS", "/chat", 1]]],
                         ids=["parameters", "publishers", "connections"])
def test_a_damaged_answer_of_a_foreign_master_is_read_or_refused(value):
    transport = Bytes()
    far = xmlrpc.client.ServerProxy("http://127.0.0.1:1/", transport=transport)
    whole = xmlrpc.client.dumps(((1, "", value),), methodresponse=True).encode()
    for number in range(FIRST, FIRST + ROUNDS):
        transport.answer = damaged(whole, random.Random(number))
        with contextlib.suppress(*near_master.LOST, near_master.REFUSED):
            assert len(near_master.ask(far, "getParam")) == 3, number


def test_a_record_without_any_time_of_the_monotonic_clock_places_no_mark(tmp_path):
    (tmp_path / "journal.csv").write_bytes(TRIAL.replace(b",5,", b",0,").split(b"trial-1,2,")[0])
    assert record.Record(tmp_path).first("TRIAL_START") and record.Record(tmp_path).onset_of(5) is None


class Disk:
    """The system's calls, of which one meets a fault: the program is killed before, after or amid it, it is short, or has an error."""

    def __init__(self, fault="", at=0):
        self.fault, self.at, self.count, self.synced, self.sizes = fault, at, 0, True, []
        self.last = ""

    def __getattr__(self, name):
        call = getattr(os, name) if name != "fsync" else lambda file: self.sizes.append(os.fstat(file).st_size)
        assert name != "replace" or self.last == "fsync", "a file is named before it is synced"
        self.last = name
        self.synced = name == "fsync" or self.synced and name in ("open", "close")
        return (lambda *words: self.meet(call, *words)) if name in ("open", "write", "fsync", "ftruncate", "replace") else call

    def meet(self, call, *words):
        self.count += 1
        if self.count != self.at:
            return call(*words)
        if self.fault in (errno.EIO, errno.ENOSPC):
            raise OSError(self.fault, os.strerror(self.fault))
        if self.fault in ("amid", "short") and call is os.write:
            words = words[0], words[1][:len(words[1]) // 2]
        done = None if self.fault == "before" else call(*words)
        if self.fault != "short":
            os._exit(9)
        return done


def append_row(path, number):
    with contextlib.closing(batch.Rows(path)) as rows:
        rows.append(f"{number},some\n")


#: How a file is written and read: answers and notes, rows of the study, of a batch, a file as a whole.
WRITTEN = {
    "notes.jsonl": (lambda path, number: journal.append_line(path, {"n": number}), lambda path: [row["n"] for row in journal.read_lines(path, {"n": int})[0]]),
    "journal.jsonl": (lambda path, number: journal.Journal(path).append("NOTE", n=number), lambda path: [row["n"] for row in journal.Journal(path).rows()]),
    "rows-1.csv": (append_row, lambda path: sorted(batch.done_in(path.parent))),
    "plan.yaml": (lambda path, number: study.write_safely(path, f"{number}\n" * 9), lambda path: [int(line) for line in journal.lines_of(path)[:-1]][-1:]),
}


def write_all(path, write, disk, known):
    """Three rows, where none ends the program; tells a pipe of each that is known to be safe. Returns the number of the calls."""
    for module in (journal, study, batch):
        module.os = disk
    for number in range(1, 4):
        with contextlib.suppress(StudyError):
            write(path, number)
            os.write(known, b"%d" % number)
    for module in (journal, study, batch):
        module.os = os
    return disk.count


@pytest.mark.parametrize("name", WRITTEN)
@pytest.mark.parametrize("fault", ["before", "amid", "after", "short", errno.EIO, errno.ENOSPC])
def test_L3_what_is_known_to_be_written_stays_and_what_was_refused_does_not(name, fault, tmp_path):
    write, read = WRITTEN[name]
    known, told = os.pipe()
    path = tmp_path / name
    calls = write_all(path, write, disk := Disk(), told)
    assert (disk.synced or name == "rows-1.csv") and 0 not in disk.sizes, "a row of a batch is made again"
    assert read(path)[-1] == 3 and os.read(known, 9) == b"123" and calls >= 6
    for at in range(1, calls + 1):
        path = tmp_path / str(at) / name
        path.parent.mkdir()
        child = os.fork()
        if child == 0:
            try:
                write_all(path, write, Disk(fault, at), told)
            finally:
                os._exit(0)
        os.waitpid(child, 0)
        os.write(told, b"\n")
        safe = [int(digit) for digit in os.read(known, 9).decode().strip()]
        left = read(path) if path.exists() else []
        if name == "plan.yaml":
            assert max(left, default=0) >= max(safe, default=0), (at, "the old one or the new one")
            continue
        more = [number for number in left if number not in safe]
        assert sorted(left) == sorted({*safe, *left}), (at, safe, left)
        assert not more or more == [len(safe) + 1] and (fault in ("before", "amid", "after") or name == "rows-1.csv"), (at, safe, left)
        write(path, 4)
        assert read(path) == [*left, 4], at
