"""The study's own record: rows are only ever appended, each safe on the disk before anything follows from it.

A row is a line of JSON. It holds the hash of the row before it, so that no row can be changed, left out or put in later without the chain
breaking. What belongs to one participant (answers, notes, trials) is in that participant's folder, so that it can be erased."""
import contextlib
import csv
import datetime
import errno
import fcntl
import getpass
import hashlib
import io
import json
import os
import time
from pathlib import Path

from .errors import StudyError

BEGIN = "0" * 64  # before the first row
FORMAT = 2  # of a row; since 2 there is journal.last
AFTER_LOSS = ("loss", "withdraw", "erased")  # rows that are written though others were lost: a person's data can be deleted at any time


class Journal:
    def __init__(self, path):
        self.path = Path(path)
        self.last = self.path.with_suffix(".last")  # a copy of the last row, by which a loss of rows at the end is seen
        self._good, self._known = 0, []  # bytes that were checked, and their rows: what is in the file never changes

    def rows(self):
        """All rows. An unfinished last line, of a crash, is set aside. Raises StudyError where a row was damaged or changed."""
        with self._locked() as file:
            return self._read(file)

    def append(self, kind, **fields):
        """Returns the row, once it is on the disk."""
        fields = {name: plain(value) if isinstance(value, str) else value for name, value in fields.items()}
        with self._locked() as file:
            rows = self._read(file)
            lost = self._lost(rows)
            if lost and kind not in AFTER_LOSS:
                raise StudyError(self.lacks(lost))
            if not any("format" in row for row in rows):
                self._begin_last()
            row = {"seq": len(rows) + 1, "format": FORMAT, "utc": utc_now(), "mono_ns": time.monotonic_ns(), "by": getpass.getuser(),
                   "type": kind, **fields, "before": rows[-1]["hash"] if rows else BEGIN}
            row["hash"] = hash_of(row)
            try:
                write_whole(file, (json.dumps(row, ensure_ascii=False) + "\n").encode(), self._good)
            except OSError as problem:
                raise StudyError(f"{self.path} cannot be written: {problem.strerror}. Nothing is begun; mend that and try again.") from None
            if not lost or kind == "loss":  # else the copy goes on to tell of the loss
                with contextlib.suppress(OSError):  # the row is safe; a copy that is old or torn tells of no loss
                    self.last.write_text(json.dumps(row) + "\n")
            return row

    def lost(self):
        """The rows that were written and lost, up to the last; empty where that is there."""
        with self._locked() as file:
            return self._lost(self._read(file))

    def lacks(self, row):
        return f"{self.path} lacks {row}, written before; restore it from a copy."

    def _begin_last(self):
        """From the first row on, a missing file tells that it was taken away."""
        try:
            self.last.touch(0o600)
            sync_folder(self.path.parent)
        except OSError as problem:
            raise StudyError(f"{self.last} cannot be made: {problem.strerror}. Nothing is begun; mend that and try again.") from None

    def _lost(self, rows):
        if not self.last.exists() and any("format" in row for row in rows):
            return f"{self.last.name}, the copy of its last row"
        for last in read_lines(self.last, {"seq": int, "utc": str, "mono_ns": int, "type": str, "hash": str})[0]:
            if last["hash"] not in [row["hash"] for row in rows[last["seq"] - 1:last["seq"]]]:
                what = " ".join(str(last[key]) for key in ("type", "participant", "step") if key in last)
                # Without rows that were written after the loss.
                first = sum((row["utc"], row["mono_ns"]) <= (last["utc"], last["mono_ns"]) for row in rows) + 1
                return f"row {last['seq']} ({what})" if first >= last["seq"] else f"rows {first} to {last['seq']} (the last: {what})"
        return ""

    @contextlib.contextmanager
    def _locked(self):
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            file = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o600)
            if not os.fstat(file).st_size:
                sync_folder(self.path.parent)
        except OSError as problem:
            raise StudyError(f"{self.path} cannot be opened: {problem.strerror}.") from None
        try:
            fcntl.flock(file, fcntl.LOCK_EX)
            yield file
        finally:
            os.close(file)

    def _read(self, file):
        size = os.fstat(file).st_size
        if size < self._good:
            raise StudyError(f"{self.path} has become shorter; restore it from a copy.")
        whole, _, torn = os.pread(file, size - self._good, self._good).rpartition(b"\n")
        if torn:
            try:
                self._set_aside(torn)
                os.ftruncate(file, size - len(torn))
                os.fsync(file)
            except OSError as problem:
                raise StudyError(f"{self.path} ends in an unfinished row, which cannot be set aside: {problem.strerror}; mend that and try again.") from None
        for line in whole.split(b"\n") if whole else []:
            self._known.append(self._checked(line))
            self._good += len(line) + 1
        return list(self._known)

    def _checked(self, line):
        number = len(self._known) + 1
        try:
            row = json.loads(line)
            good = row["seq"] == number and row["before"] == (self._known[-1]["hash"] if self._known else BEGIN) and row["hash"] == hash_of(row)
        except (ValueError, KeyError, TypeError, RecursionError):
            good = False
        if not good:
            raise StudyError(f"{self.path}:{number}: the row was damaged, changed, or one before it was taken away; restore the file from a copy.")
        return row

    def _set_aside(self, torn):
        with open(self.path.with_suffix(".torn"), "ab") as aside:
            aside.write(torn + b"\n")
            aside.flush()
            os.fsync(aside.fileno())
        sync_folder(self.path.parent)


def sum_of(path):
    """SHA-256 of a file; empty where there is none."""
    try:
        with open(path, "rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return ""


def hash_of(row):
    content = {key: value for key, value in row.items() if key != "hash"}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def utc_now():
    return datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def sync_folder(folder):
    file = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(file)
    finally:
        os.close(file)


def plain(text):
    """The text with "?" for what is no text: bytes of an argument that are not UTF-8."""
    return text.encode(errors="replace").decode()


def write_whole(file, line, end):
    """Safe on the disk on return. What may not last is cut off at the end of before, so that it is not read as what does."""
    try:
        if os.write(file, line) != len(line):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        os.fsync(file)
    except OSError:
        with contextlib.suppress(OSError):
            os.ftruncate(file, end)
        raise


def append_line(path, values):
    """A line of JSON in a participant's own file, safe on the disk on return."""
    line = (plain(json.dumps(values, ensure_ascii=False)) + "\n").encode()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o600)
        try:
            fcntl.flock(file, fcntl.LOCK_EX)
            size = os.fstat(file).st_size
            if not size:
                sync_folder(path.parent)
            # What a crash left of a line ends here, so that the next one stands for itself.
            write_whole(file, b"\n" + line if size and os.pread(file, 1, size - 1) != b"\n" else line, size)
        finally:
            os.close(file)
    except OSError as problem:
        raise StudyError(f"{path} cannot be written: {problem.strerror}.") from None


def read_lines(path, fields, allowed=lambda row: True):
    """The rows that append_line() wrote whole, and the numbers of the lines that are none: unfinished when the power failed, or damaged.
    \\param fields  the type of each by name
    \\param allowed  whether a row with them is one"""
    rows, skipped = [], []
    for number, line in enumerate(lines_of(path), 1):
        try:
            row = json.loads(line)
        except (ValueError, RecursionError):
            row = None
        if isinstance(row, dict) and all(isinstance(row.get(name), kind) for name, kind in fields.items()) and allowed(row):
            rows.append(row)
        elif line:
            skipped.append(number)
    return rows, skipped


def lines_of(path):
    """Bytes of each line of a record, ended by "\\n" alone; none where there is no file."""
    try:
        return Path(path).read_bytes().split(b"\n")
    except OSError:
        return []


def rows_of(path):
    """Rows by column of a table that a trial or a lesson wrote; bytes that are not UTF-8 are replaced. None where there is no file."""
    text = b"\n".join(lines_of(path)).decode(errors="replace")
    try:
        return list(csv.DictReader(io.StringIO(text, newline="\n")))
    except csv.Error as problem:
        raise StudyError(f"{path} is damaged: {problem}; restore it from a copy.") from None
