"""The checker of examples/benchmark: stored answers, and codes that are wrong on purpose."""
import csv
import pathlib

from programs import ROOT, run
from pytest import mark

FOLDER = ROOT / "examples/benchmark"

def check(*words, code=0):
    done = run("/usr/bin/python3", FOLDER / "check.py", *words, code=code)
    return done.stdout + done.stderr

def answers(tmp_path, change):
    """The stored answers of LIGGGHTS, changed row by row."""
    with open(FOLDER / "answers/liggghts-mpm.csv", newline="", encoding="utf-8") as file:
        rows = [row for row in map(change, csv.DictReader(file)) if row]
    path = pathlib.Path(tmp_path) / "mine.csv"
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ("case", "quantity", "at", "value"))
        writer.writeheader()
        writer.writerows(rows)
    return path

def test_the_page_has_the_table():
    table = check("--cases", *sorted((FOLDER / "answers").glob("*.csv")))
    for line in table.splitlines():
        assert line in (FOLDER / "README.md").read_text(), line

def test_one_law_in_two_codes_gives_one_set_of_answers():
    """They run the same contacts; bars of 2e-6: answers have six digits."""
    one, other = ({(r["case"], r["quantity"], r["at"]): float(r["value"]) for r in csv.DictReader((FOLDER / f"answers/{name}.csv").read_text().splitlines())}
                  for name in ("liggghts-mpm", "lammps-granulaw"))
    assert one.keys() == other.keys()
    assert max(abs(one[k] / other[k] - 1) for k in one) < 2e-6

def test_a_code_that_books_no_plastic_work_is_found(tmp_path):
    """e 1 everywhere: every restitution is off by many uncertainties, and the status says so."""
    path = answers(tmp_path, lambda row: {**row, "value": 1.0} if row["quantity"] == "e" else row)
    text = check(path, "--most", 10, code=1)
    assert "mine is off by up to" in text
    assert text.count("+0.0 % (0.0)") < 10

@mark.parametrize("wrong, said", ((lambda row: {**row, "value": "nan"} if row["case"] == "bed" else row, "no number"), (lambda row: {**row, "case": row["case"].replace("press", "push")}, "no such row"),
                                  (lambda row: {**row, "value": "much"}, "columns are case,quantity,at,value")))
def test_what_is_no_answer_is_named(tmp_path, wrong, said):
    assert said in check(answers(tmp_path, wrong), "--most", 1e9, code=1)

def test_rows_may_be_missing(tmp_path):
    assert check(answers(tmp_path, lambda row: row if row["case"] == "press" else None))
