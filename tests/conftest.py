"""Setting of all Python tests. ctest names the built programs in the environment (granulaw_pytest in tests/CMakeLists.txt)."""
import os
import shutil
import tempfile

import pytest

SKIPPED = 77  # ctest's SKIP_RETURN_CODE


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config):
    """One folder, with a short path, for all that these tests write. Open MPI works in it, too: in a folder that processes of other tests share, one
    that ends removes what one that starts has just made (`orte_session_dir failed`)."""
    config.folder = tempfile.mkdtemp(prefix="granulaw-")
    config.option.basetemp = f"{config.folder}/t"
    os.environ["OMPI_MCA_orte_tmpdir_base"] = tempfile.tempdir = config.folder


def pytest_unconfigure(config):
    shutil.rmtree(config.folder, ignore_errors=True)


def pytest_sessionfinish(session, exitstatus):
    counts = session.config.pluginmanager.getplugin("terminalreporter").stats
    if exitstatus in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED) and counts.get("skipped") and not counts.get("passed"):
        session.exitstatus = SKIPPED


@pytest.fixture
def here(tmp_path, monkeypatch):
    """The test works in a folder of its own, with a cache of runs of its own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path.parent / f"{tmp_path.name}-cache"))
    return tmp_path


@pytest.fixture
def folder(tmp_path):
    return tmp_path
