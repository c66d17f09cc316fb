"""One trial's own record, as trial_node left it: doc/record.md defines its rows."""
import ast
import bisect
import csv
import re
import struct
from dataclasses import dataclass
from urllib.parse import unquote

from .errors import StudyError
from .journal import lines_of, rows_of
from .measures import number

FORMATS = {"<f8": "d", "<f4": "f", "<u4": "I"}  # of NumPy's types; all else are texts
RESULTS = ("reached", "timeout", "refused", "aborted", "invalid")
TOLD = ("reason", "elapsed_s", "shelf_collision_count", "obstacle_collision_count")  # columns of each summary, besides its result


@dataclass(frozen=True)
class Row:
    type: str
    sim_ns: int
    mono_ns: int
    fields: dict

    def number(self, name):
        """None where the row has no such number."""
        return number(self.fields.get(name))


class Record:
    """\\param folder  of the trial; a record that cannot be read has no rows"""

    def __init__(self, folder):
        self.folder = folder
        self.rows = [row for line in lines_of(folder / "journal.csv") if (row := _row(line.decode(errors="replace")))]

    def first(self, kind):
        return next((row for row in self.rows if row.type == kind), None)

    def of(self, kind):
        return [row for row in self.rows if row.type == kind]

    def onset(self, row):
        """s of simulated time since the trial began, or since the first row where its beginning is lost."""
        return (row.sim_ns - (self.first("TRIAL_START") or self.rows[0]).sim_ns) / 1e9

    def onset_of(self, mono_ns):
        """The same for a time of the monotonic clock, such as a mark's, by the rows before and after it; None without a trial."""
        start = self.first("TRIAL_START")
        rows = sorted((row for row in self.rows if row.mono_ns), key=lambda row: row.mono_ns)
        if not start or not rows:
            return None
        at = bisect.bisect_right([row.mono_ns for row in rows], mono_ns)
        if at in (0, len(rows)):  # before the first row, or after the last, both clocks run alike
            near = rows[min(at, len(rows) - 1)]
            return (near.sim_ns + mono_ns - near.mono_ns - start.sim_ns) / 1e9
        before, after = rows[at - 1], rows[at]
        share = (mono_ns - before.mono_ns) / max(1, after.mono_ns - before.mono_ns)
        return (before.sim_ns + share * (after.sim_ns - before.sim_ns) - start.sim_ns) / 1e9

    def way(self):
        """(s, x, y) in map, once a second."""
        places = [(self.onset(row), row.number("x"), row.number("y")) for row in self.rows if row.type in ("TRIAL_START", "PROGRESS", "TRIAL_END")]
        return [place for place in places if None not in place]

    def cues(self):
        """(s, modality, kind, text) of each that was spoken, played or felt."""
        return [(self.onset(row), row.fields.get("modality", "n/a"), row.fields.get("kind", "n/a"), row.fields.get("text", "")) for row in self.of("CUE")]

    def track(self):
        """How robot and person moved, 50 rows a second, each a value by name; doc/record.md has their units. none without a track, or
        with one that is damaged from its beginning."""
        try:
            return _track((self.folder / "track.npy").read_bytes())
        except (OSError, ValueError, SyntaxError, LookupError, TypeError, ArithmeticError, RecursionError, MemoryError, struct.error):
            return []

    def events(self):
        """Rows of events.csv, by column; none where there is no such file."""
        return rows_of(self.folder / "events.csv")


def summary_of(folder):
    """The row of a trial's summary.csv by column. Raises StudyError where it is missing, cut off or damaged, as parse_summary() of C++ judges it."""
    path = folder / "summary.csv"
    try:
        text = path.read_bytes().decode(errors="replace")
        names, cells = csv.reader(text[:-1].split("\n"), strict=True)
        row = dict(zip(names, cells, strict=True))
        if not text.endswith("\n") or row["result"] not in RESULTS or not row.keys() >= {*TOLD}:
            raise ValueError
        return row
    except OSError as problem:
        raise StudyError(f"{path} cannot be read: {problem.strerror}; the folder of a trial that has ended is allowed.") from None
    except (ValueError, KeyError, csv.Error):
        raise StudyError(f"{path} is damaged; allowed is a line of titles and a line of as many cells, as a trial writes them. "
                         "Restore it from a copy.") from None


def _track(data):
    size = 10 + int.from_bytes(data[8:10], "little")
    fields = ast.literal_eval(data[10:size].decode())["descr"]
    row = struct.Struct("<" + "".join(FORMATS.get(kind) or kind[1:] + "s" for _, kind in fields))
    names = [name for name, _ in fields]
    rows = [dict(zip(names, values)) for values in row.iter_unpack(data[size:len(data) - (len(data) - size) % row.size])]
    # What a loss of power took out of the middle reads as zeros.
    ends = (at for at, one in enumerate(rows) if one["time"] <= (rows[at - 1]["time"] if at else 0.0))
    return rows[:next(ends, None)]


def _row(line):
    cells = line.split(",")
    if len(cells) != 7 or not all(re.fullmatch("-?[0-9]{1,19}", cell) for cell in cells[2:4]):
        return None
    fields = dict(pair.split("=", 1) for pair in cells[5].split(";") if "=" in pair)
    return Row(cells[4], int(cells[2]), int(cells[3]), {name: unquote(value) for name, value in fields.items()})
