import os
import shutil
import signal

import pytest

from jostle_command import (RODS, SPHERES, STOPPED, changed, command, finish, kill, rows_of, start, started,
                            wait_until, with_steps, write_scene)


def pytest_sessionstart(session):
    path = os.environ.get("JOSTLE", "jostle")
    if shutil.which(path) is None:
        pytest.exit(f"JOSTLE = {path}: there is no such program; set it to the path of the command", returncode=2)


@pytest.fixture(autouse=True)
def nothing_runs_on():
    """Ends what a failed test left running."""
    yield
    for process in started:
        if process.poll() is None:
            process.kill()
            process.communicate()
    started.clear()


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A finished run of RODS, with every file that a run can leave; tests copy it."""
    folder = tmp_path_factory.mktemp("finished")
    write_scene(folder, RODS)
    finish(folder)
    return folder


@pytest.fixture(scope="module")
def torn(tmp_path_factory):
    """A run that was stopped once, then killed: its files go on beyond its checkpoint."""
    folder = tmp_path_factory.mktemp("torn")
    write_scene(folder, changed(with_steps(RODS, 10**6), output={"checkpoint_every": 10**7}))
    process = start(folder)
    wait_until(lambda: rows_of(folder / "run/series.csv") > 8, process)
    assert kill(process, signal.SIGTERM)[0] == STOPPED
    rows = rows_of(folder / "run/series.csv")
    process = start(folder)
    wait_until(lambda: rows_of(folder / "run/series.csv") > rows + 8, process)
    assert kill(process)[0] == -signal.SIGKILL
    assert command(folder, "verify", "run").returncode == 0
    return folder


@pytest.fixture
def finished_copy(finished, tmp_path):
    return shutil.copytree(finished, tmp_path / "copy")


@pytest.fixture
def torn_copy(torn, tmp_path):
    return shutil.copytree(torn, tmp_path / "copy")


@pytest.fixture
def spheres(tmp_path):
    """A folder with a scene of spheres, not run yet."""
    write_scene(tmp_path, SPHERES)
    return tmp_path
