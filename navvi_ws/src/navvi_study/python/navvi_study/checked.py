"""YAML files read key by key: an unknown key or a wrong value is an error that names file, line, key and what is allowed.

Whatever a user hands in as a file is read here: regular files alone, bounded in bytes, depth and values, and cited in no error beyond a
value's first letters."""
import difflib
import os
import re
import stat

import yaml

from .errors import StudyError


REQUIRED = object()
LARGEST = 1 << 20  # bytes of a file, as in navvi_config's readers
LINE_ENDS = "\x85\u2028\u2029"
HUGE = 10 ** 40
DEEPEST = 32  # lists and mappings in one another
MOST = 20_000  # values of a file, those behind an alias counted each time


class _Loader(yaml.SafeLoader):
    """Refuses a key that is given twice and what is too deep or too much, and keeps the line of each key."""

    depth = count = 0

    def compose_node(self, parent, index):
        alias, line = self.check_event(yaml.AliasEvent), self.peek_event().start_mark.line + 1
        self.depth, self.count = self.depth + 1, self.count + 1
        node = super().compose_node(parent, index) if self.depth <= DEEPEST else None
        self.depth -= 1
        if node and not alias:
            below = [] if isinstance(node, yaml.ScalarNode) else [one for entry in node.value for one in (entry if isinstance(entry, tuple) else (entry,))]
            node.height = 1 + max((one.height for one in below), default=0)
            node.weight = 1 + sum(one.weight for one in below)
        if node and not hasattr(node, "height"):
            raise StudyError(f"{self.file}:{line}: an alias refers to a list or mapping that contains it; allowed are aliases of earlier ones.")
        if not node or node.height > DEEPEST:
            raise StudyError(f"{self.file}:{line}: lists and mappings are nested too deep; allowed are {DEEPEST} in one another.")
        if max(node.weight, self.count) > MOST:
            raise StudyError(f"{self.file}:{line}: there are too many values; allowed are {MOST}.")
        return node

    def construct_object(self, node, deep=False):
        try:
            value = super().construct_object(node, deep)
            if isinstance(value, int) and abs(value) > HUGE:
                raise ValueError
            return value
        except (ArithmeticError, AttributeError, LookupError, ValueError):  # such as a date that there is not
            raise StudyError(f"{self.file}:{node.start_mark.line + 1}: a value cannot be read as the date, number or type that it looks like; "
                             "allowed is to quote it, if it is text.") from None


def _mapping(loader, node, deep=True):
    keys = _Lined()
    for key_node, value_node in node.value:
        line = key_node.start_mark.line + 1
        key = loader.construct_object(key_node, deep=True)
        if not isinstance(key, str):
            raise StudyError(f"{loader.file}:{line}: the key {_shown(key)} is not text; quote it.")
        if key in keys:
            raise StudyError(f"{loader.file}:{line}: the key {_shown(key)} is given twice; once is allowed.")
        keys[key] = loader.construct_object(value_node, deep=True)
        keys.lines[key] = line
    return keys


class _Lined(dict):
    def __init__(self, *args):
        super().__init__(*args)
        self.lines = {}


_Loader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping)


def read(path, most=LARGEST):
    """The bytes of a regular file of at most so many. Raises StudyError."""
    try:
        with open(path, "rb", opener=lambda name, flags: os.open(name, flags | os.O_NONBLOCK)) as file:  # a pipe is not waited for
            about = os.fstat(file.fileno())
            if not stat.S_ISREG(about.st_mode):
                raise StudyError(f"{path} is a device, a pipe or a folder; allowed are regular files.")
            content = file.read(most + 1)
    except OSError as problem:
        raise StudyError(f"{path} cannot be read: {problem.strerror}.") from None
    if len(content) > most:
        raise StudyError(f"{path} is larger than {most >> 20} MiB; at most that is allowed.")
    return content


def load(path, below=""):
    """The file as a Section, of a file that is a list with all of it `below` a key. Raises StudyError."""
    content = read(path)
    try:
        loader = _Loader(content.decode())
        loader.file = path
        try:
            values = loader.get_single_data()
        finally:
            loader.dispose()
    except UnicodeDecodeError as problem:
        line = content.count(b"\n", 0, problem.start) + 1
        raise StudyError(f"{path}:{line}: a byte is not UTF-8; allowed is text in UTF-8.") from None
    except yaml.YAMLError as problem:
        mark, why = getattr(problem, "problem_mark", None), getattr(problem, "problem", None) or "a sign is not allowed in it"
        why = re.sub(r"'[^']{24,}'", "what stands there", why)  # an error cites no file
        raise StudyError(f"{path}:{mark.line + 1 if mark else 1}: cannot parse the YAML: {why}.") from None
    return Section(path, "", {below: values} if below else values)


class Section:
    """A mapping of a file. Each key is taken once; done() refuses those that are left."""

    def __init__(self, file, path, values):
        self.file, self.path, self.line = file, path, 1
        if not isinstance(values, dict):
            raise StudyError(f"{file}: {path or 'the file'} is {_shown(values) if path else _kind(values)}; allowed is a mapping of keys.")
        self.values, self.taken = values, set()

    def take(self, key, kind, default=REQUIRED):
        """The value of the key as `kind` makes it; the default where the key is absent."""
        self.taken.add(key)
        if key not in self.values:
            if default is REQUIRED:
                alike = difflib.get_close_matches(key, [other for other in self.values if other not in self.taken], 1)
                raise StudyError(f"{self.file}: the key \"{self._path(key)}\" is missing" + (f"; {_shown(alike[0])} is unknown." if alike else "."))
            return default
        try:
            return kind(self.values[key])
        except ValueError as allowed:
            raise self.error(key, f"is {_shown(self.values[key])}; allowed is {allowed}") from None

    def section(self, key, required=False):
        """The mapping below the key; an empty one where it is absent."""
        self.taken.add(key)
        if required and key not in self.values:
            raise StudyError(f"{self.file}: the key \"{self._path(key)}\" is missing.")
        return Section(self.file, self._path(key), self.values.get(key, _Lined()))

    def sections(self, key=None):
        """Name and mapping of each entry below the key, or of all that are here."""
        below = self.section(key) if key else self
        below.taken.update(below.values)
        return [(name, Section(below.file, below._path(name), value)) for name, value in below.values.items()]

    def items(self, key, default=REQUIRED):
        """A list of mappings."""
        values = self.take(key, list_of(anything), default)
        return [Section(self.file, f"{self._path(key)}[{at}]", value) for at, value in enumerate(values)]

    def error(self, key, words):
        """To be raised: what is wrong with the value of the key."""
        line = getattr(self.values, "lines", {}).get(key, 1)
        return StudyError(f"{self.file}:{line}: {_shown(self._path(key), 80)} {words}.")

    def done(self):
        for key in self.values:
            if key not in self.taken:
                known = ", ".join(sorted(self.taken))
                raise self.error(key, f"is unknown; known are: {known}")

    def _path(self, key):
        return f"{self.path}/{key}" if self.path else key


def _shown(value, most=40):
    """A key or value in an error: no more of it than says which one is meant."""
    if value is None or isinstance(value, (list, dict)):
        return _kind(value)
    if isinstance(value, bool):
        return str(value).lower()
    words = str(value)
    words = words if len(words) <= most else words[:most - 3] + "..."
    return f"\"{words}\"" if isinstance(value, str) else words


def _kind(value):
    return "empty" if value is None else "a list" if isinstance(value, list) else "a mapping" if isinstance(value, dict) else "one value"


def anything(value):
    return value


def text(value):
    if not isinstance(value, str) or not value.strip() or any(ord(letter) < 32 or letter in LINE_ENDS or "\ud800" <= letter <= "\udfff" for letter in value.strip()):
        raise ValueError("text of one line")
    return value.strip()


def code(value):
    """What stands in the record for a person, a condition, a set."""
    if not isinstance(value, str) or not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_-]{0,23}", value):
        raise ValueError("up to 24 letters, digits, - and _, a letter or digit first")
    return value


def flag(value):
    if not isinstance(value, bool):
        raise ValueError("true or false")
    return value


def number(least, most):
    def kind(value):
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not least <= value <= most:
            raise ValueError(f"a number from {least} to {most}")
        return float(value)
    return kind


def whole(least, most):
    def kind(value):
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
            raise ValueError(f"a whole number from {least} to {most}")
        return value
    return kind


def one_of(*words):
    def kind(value):
        if value not in words or isinstance(value, bool):
            raise ValueError("one of: " + ", ".join(str(word) for word in words))
        return value
    return kind


def list_of(kind):
    def kinds(value):
        if not isinstance(value, list) or not value:
            raise ValueError("a list with at least one entry")
        return [kind(entry) for entry in value]
    return kinds


def numbered(kind):
    """A list, or a span such as "101-110" or "sub-01..sub-20" where `kind` takes each of it."""
    def kinds(value):
        found = re.fullmatch(r"(.*?)(\d+)\.\.\1(\d+)", value) if isinstance(value, str) else None
        if not found:
            return list_of(kind)(value if isinstance(value, list) else [value])
        head, first, last = found.groups()
        if int(last) < int(first) or int(last) - int(first) > 9999:
            raise ValueError("a span that goes upwards, by 10000 at most")
        width = len(first) if first.startswith("0") or head else 0
        entries = [f"{head}{at:0{width}d}" for at in range(int(first), int(last) + 1)]
        return [kind(entry if head else int(entry)) for entry in entries]
    return kinds
