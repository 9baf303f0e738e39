"""tools/check says what was skipped and why; a skip that its caller does not allow fails. Other scripts take the place of set-up, build and ctest."""
import os
import re
import shutil

from programs import ROOT, run
from pytest import fixture, mark

RESULT = """<testsuite tests="5" failures="0" disabled="0" skipped="2">
<testcase name="a" time="1.5" status="run"><system-out>4 passed</system-out></testcase>
<testcase name="b" time="0.5" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/><system-out>skipped: no program &lt;x&gt;
</system-out></testcase>
<testcase name="c.d" time="0.5" status="notrun"><skipped/><system-out>s
SKIPPED [1] ../tests/c.py:3: no file
1 skipped</system-out></testcase>
<testcase name="e" time="0.5" status="run"><system-out>.s
SKIPPED [1] ../tests/e.py:3: one of two
1 passed, 1 skipped</system-out></testcase>
<testcase name="f" time="0.1" status="run"/>
</testsuite>
"""


@fixture
def check(folder):
    (folder / "tools").mkdir()
    (folder / "bin").mkdir()
    shutil.copy(ROOT / "tools/check", folder / "tools")
    (folder / "result.xml").write_text(RESULT)
    for path, text in (("tools/setup", ""), ("bin/cmake", ""), ("bin/emcc", "exit 1"),
                       ("bin/ctest", f'while [ "$1" != --output-junit ]; do shift; done; cp {folder}/result.xml "$2"')):
        (folder / path).write_text(f"#!/bin/sh\n{text}\n")
        (folder / path).chmod(0o755)

    def call(*words, code):
        return run(folder / "tools/check", *words, code=code, env={"PATH": f"{folder / 'bin'}:{os.environ['PATH']}"})
    return call


def test_skips_are_named_with_their_reasons(check):
    said = check(code=0).stdout
    assert said.endswith("Skipped:\nb: no program <x>\nc.d: no file\ne: one of two\n3 passed, 0 failed\n")
    assert re.search(r"^1\.5 a$", said, flags=re.M)


@mark.parametrize("allowed, refused", (("b c.d e", []), ("e b", ["c.d"]), ("", ["b", "c.d", "e"]), ("c b e", ["c.d"])))
def test_a_skip_that_is_not_allowed_fails(check, allowed, refused):
    done = check("--skips", allowed, code=1 if refused else 0)
    assert re.findall(r"tools/check: (\S+) may not be skipped here", done.stderr) == refused
    assert done.stdout.endswith(f"3 passed, {len(refused)} failed\n")


def test_the_submission_s_run_hides_nothing():
    """No failure of the set-up is passed over."""
    assert "||" not in (ROOT / ".ci/run").read_text()
