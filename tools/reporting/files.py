"""Finding and reading the runs' own files. A file that cannot be used gives one sentence, never a traceback."""
import csv
import json
import math
import os
import pathlib


class Unreadable(Exception):
    """`path`: sentence."""

    def __init__(self, path, why):
        super().__init__(f"{path}: {why}")
        self.path = path


def find(folder, name):
    """All files of this name under `folder`, newest first; small versions (folders named *quick) are not mixed with the rest."""
    return [p for p in find_ending(folder, name) if p.name == name]


def find_ending(folder, ending):
    """All files whose names end so."""
    found = []
    for base, folders, names in os.walk(folder):
        folders[:] = sorted(f for f in folders if not f.endswith("quick"))
        found += [pathlib.Path(base) / name for name in names if name.endswith(ending)]
    return sorted(found, key=lambda p: -p.stat().st_mtime)


def read_json(path):
    """The object in a JSON file."""
    try:
        found = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, ValueError) as error:
        raise Unreadable(path, f"not a whole JSON file ({str(error).splitlines()[0]})") from None
    if not isinstance(found, dict):
        raise Unreadable(path, f"holds a {type(found).__name__}, expected an object")
    return found


def rows_with(path, rows, keys):
    """Checks that each of `rows` is an object with finite numbers under `keys`; returns the rows."""
    for k, row in enumerate(rows):
        for key in keys:
            value = row.get(key) if isinstance(row, dict) else None
            if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
                raise Unreadable(path, f"row {k + 1}: '{key}' is {value!r}, expected a number")
    return rows


def read_csv(path, columns):
    """Rows (dicts) of a CSV file that has these columns."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            missing = [c for c in columns if c not in (reader.fieldnames or [])]
            if missing:
                raise Unreadable(path, f"has no column '{missing[0]}', found {reader.fieldnames}")
            rows = list(reader)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise Unreadable(path, f"not a whole CSV file ({error})") from None
    if not rows:
        raise Unreadable(path, "has no rows: the runs have not come far enough")
    return rows


def to_number(path, line, column, text):
    try:
        value = float(text)
    except (TypeError, ValueError):
        raise Unreadable(path, f"line {line}: {column} is {text!r}, expected a number") from None
    if not math.isfinite(value):
        raise Unreadable(path, f"line {line}: {column} is {text}, expected a finite number")
    return value
