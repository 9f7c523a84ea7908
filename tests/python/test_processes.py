"""Numbers of threads, and what is brought from one process to another."""

import multiprocessing
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

import jostle

CROWDED = dict(seed=2, box={"edges": [9.0, 9.0, 9.0]}, rods={"count": 60, "length": 1.0}, time={"step": 0.5, "production": 9.0},
               solver={"method": "bbpgd", "max_iterations": 1})


def failing_steps(_):
    jostle.Simulation(jostle.Scene(**CROWDED)).run(50)


def failure():
    with pytest.raises(jostle.StepFailure) as caught:
        failing_steps(0)
    return caught.value


def test_errors_can_be_pickled():
    error = failure()
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is jostle.StepFailure and str(again) == str(error) and "max_iterations" in str(error)
    assert again.report.step == error.report.step and again.report.seconds == error.report.seconds
    assert np.array_equal(again.report.collision_virial, error.report.collision_virial)
    with pytest.raises(jostle.InputError) as caught:
        jostle.load("nowhere")
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is jostle.InputError and str(again) == str(caught.value) and again.problem == caught.value.problem
    again = pickle.loads(pickle.dumps(jostle.DiskError("full")))
    assert type(again) is jostle.DiskError and str(again) == "full"


def test_a_failed_step_in_a_pool():
    """It never answered: the error could not be read where it arrived."""
    with multiprocessing.get_context("fork").Pool(1) as pool:
        with pytest.raises(jostle.StepFailure, match="max_iterations"):
            pool.map_async(failing_steps, [0]).get(timeout=30)


FORK = """
import os, signal
import numpy as np
import jostle

jostle.set_thread_count(2)
scene = jostle.Scene(seed=3, box={"volume_fraction": 0.01}, rods={"count": 1200, "length": 1.0}, time={"step": 0.01, "production": 1.0})
simulation = jostle.Simulation(scene)
simulation.run(2)
child = os.fork()
if child == 0:
    signal.alarm(20)                      # where it waits for the threads of its parent
    assert jostle.thread_count() == 1
    try:
        jostle.set_thread_count(2)
        os._exit(3)
    except jostle.InputError as error:
        assert "was forked from one that had started threads" in str(error) and "spawn" in str(error)
    jostle.set_thread_count(1)
    simulation.run(3)
    os._exit(0 if np.isfinite(simulation.rods.centre).all() and simulation.clock.step == 5 else 4)
ended = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
simulation.run(3)
print(ended, jostle.thread_count(), simulation.clock.step)
"""


def test_a_fork_after_threads_were_started():
    result = subprocess.run([sys.executable, "-c", FORK], capture_output=True, text=True, timeout=60, check=True)
    assert result.stdout == "0 2 5\n", result.stderr


@pytest.mark.parametrize("count, message", [
    (0, "allowed: 1 to 4096"), (-1, "allowed: 1 to 4096"), (4097, "allowed: 1 to 4096"), (10**9, "allowed: 1 to 4096"),
    (10**30, "is no such number"), (1.5, "is no such number"), (True, "is no such number"), (None, "is no such number")])
def test_numbers_of_threads_that_are_none(count, message):
    before = jostle.thread_count()
    with pytest.raises(jostle.InputError, match=message):
        jostle.set_thread_count(count)
    assert jostle.thread_count() == before


def test_numbers_of_threads_in_the_environment_that_are_none():
    program = """
import numpy as np, jostle
ends = np.zeros((1000, 3))
for call in (jostle.thread_count, lambda: jostle.segment_distance(ends, ends + 1, ends, ends)):
    try: call()
    except jostle.InputError as error: print(error)
"""
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=True,
                            env={**os.environ, "OMP_NUM_THREADS": "99999999999"})
    assert result.stdout == 2 * "OMP_NUM_THREADS = 99999999999: is no number of threads (allowed: 1 to 4096)\n"
