import gc
import os
import signal
import subprocess
import sys
import threading
import time
import weakref

import numpy as np
import pytest

import jostle

COLUMNS = ("id", "centre", "axis", "length", "diameter", "image")


def state(simulation):
    return {name: getattr(simulation.rods, name).copy() for name in COLUMNS}


def same(one, other):
    return all(np.array_equal(one[name], other[name]) for name in COLUMNS)


@pytest.mark.parametrize("kind", ["rods", "cells"])
def test_same_bits_as_the_command(kind, request):
    run = jostle.load(request.getfixturevalue(f"run_of_{kind}"))
    simulation = jostle.Simulation(request.getfixturevalue(kind))
    rows = simulation.run(int(run.series["step"][-1]))
    assert rows.dtype == run.series.dtype
    assert rows.tobytes() == run.series.tobytes()
    ended = run.resume()
    assert ended.clock == simulation.clock and ended.clock.step == run.series["step"][-1]
    assert same(state(ended), state(simulation))
    contacts = simulation.contacts
    contacts = contacts[contacts["force"] > 0]
    written = run.contacts[run.contacts["step"] == simulation.clock.step]
    assert len(contacts) == len(written) > 0
    for name in ("id_i", "id_j", "force", "gap", "arm_i", "arm_j"):
        assert np.array_equal(contacts[name].astype(float), written[name])
    for a, letter in enumerate("xyz"):
        assert np.array_equal(contacts["normal"][:, a], written[f"normal_{letter}"])
        assert np.array_equal(contacts["image"][:, a], written[f"image_{letter}"])


def test_step_tells_what_the_row_holds(rods):
    rods.output.series_every = 1
    simulation = jostle.Simulation(rods)
    assert simulation.report is None and simulation.stress is None and len(simulation.contacts) == 0
    report = simulation.step()
    row = simulation.series[0]
    assert (report.step, report.time, report.rods, report.converged) == (0, 0.0, 50, True)
    assert np.array_equal(report.collision_virial, simulation.report.collision_virial)
    assert row["stress_xy"] == report.collision_virial[0, 1] * (1 / simulation.volume)
    assert np.allclose(simulation.stress_collision, report.collision_virial / simulation.volume, rtol=1e-15)
    for a, b in ("xx", "xy", "xz", "yy", "yz", "zz"):
        found = simulation.stress_orientation["xyz".index(a), "xyz".index(b)]
        assert row[f"stress_orientation_{a}{b}"] == pytest.approx(found, rel=1e-14)
    kinetic = 50 / simulation.volume * simulation.kT * np.eye(3)
    assert np.allclose(simulation.stress, kinetic + simulation.stress_orientation + simulation.stress_collision, rtol=1e-14)
    assert row["contacts"] == report.contacts == len(simulation.contacts)
    assert row["active_contacts"] == report.active_contacts == (simulation.contacts["force"] > 0).sum()
    assert row["residual"] == report.residual and row["max_overlap"] == report.max_overlap
    assert row["pressure"] == pytest.approx(np.trace(simulation.stress) / 3, rel=1e-14)
    assert set(report.seconds) == {"known_velocity", "find_contacts", "solve_contacts", "measure_stress", "advance"}
    assert list(simulation.columns) == list(simulation.series.dtype.names)
    assert simulation.columns["stress_xx"]["sign"] == "positive in compression"


def test_collision_stress_of_its_contacts(rods):
    """Without the correction of the time step the stress is that of the rods and gaps before the step."""
    rods.contact.brownian_correction = False
    simulation = jostle.Simulation(rods)
    for _ in range(20):
        before = simulation.rods
        simulation.step()
        found = jostle.collision_stress(before, simulation.contacts, simulation.volume, at="start")
        assert np.abs(found - simulation.stress_collision).max() <= 1e-12 * np.abs(found).max()


def test_contacts_name_the_right_cells_where_some_have_died(cells):
    """Rows of the dead are gone when contacts are looked at; the gaps tell whether the ids are right all the same."""
    cells.growth.death_rate = 2.0
    cells.growth.division_every = 1
    cells.rods.count = 40
    simulation = jostle.Simulation(cells)
    looked = 0
    for _ in range(200):
        before = simulation.rods
        simulation.step()
        if simulation.lineage["birth"].all():
            continue
        contacts = simulation.contacts
        i, j = (np.searchsorted(before.id, contacts[name]) for name in ("id_i", "id_j"))
        assert np.array_equal(before.id[i], contacts["id_i"]) and np.array_equal(before.id[j], contacts["id_j"])
        points = [before.centre[k] + contacts[arm][:, None] * before.axis[k] for k, arm in ((i, "arm_i"), (j, "arm_j"))]
        distance = np.linalg.norm(points[1] + contacts["image"] * simulation.edges - points[0], axis=1)
        # The points are those that are nearest half way through the known motion; before it, nearer ones may be by.
        farther = distance - 1.0 - contacts["gap"]
        assert np.all(farther > -1e-12) and np.all(farther < 2e-3)
        looked += len(contacts)
    assert looked >= 10


def test_arrays_belong_to_their_time(cells):
    """Across renumbering (at multiples of 512 steps), births, deaths, and the end of the simulation."""
    simulation = jostle.Simulation(cells)
    held, copies, counts = [], [], []
    for _ in range(30):
        rods = simulation.rods
        held.append([getattr(rods, name) for name in COLUMNS])
        copies.append([array.copy() for array in held[-1]])
        counts.append(len(simulation))
        simulation.run(20)
    assert simulation.clock.step > 512 and max(counts) > 12 and any(np.diff(counts) < 0)
    del simulation, rods
    gc.collect()
    filler = [np.full(10000, np.nan) for _ in range(200)]  # takes memory that was given back
    for arrays, expected, count in zip(held, copies, counts):
        for array, copy in zip(arrays, expected):
            assert len(array) == count and np.array_equal(array, copy)
    del filler
    ids = held[-1][0]
    assert np.array_equal(ids, np.sort(ids)) and len(set(ids)) == len(ids)


def test_arrays_are_views_that_cannot_be_written(rods):
    simulation = jostle.Simulation(rods)
    centre = simulation.rods.centre
    assert np.shares_memory(centre, simulation.rods.centre)  # no copy for every look
    for name in COLUMNS:
        array = getattr(simulation.rods, name)
        with pytest.raises(ValueError):
            array[...] = 0
        with pytest.raises(ValueError):
            array.flags.writeable = True
    with pytest.raises(AttributeError):
        simulation.rods.centre = centre
    simulation.step()
    assert not np.shares_memory(centre, simulation.rods.centre)
    assert np.abs(simulation.rods.centre - centre).max() > 0
    kept = weakref.ref(simulation)
    del simulation
    gc.collect()
    assert kept() is None and centre.shape == (50, 3) and np.isfinite(centre).all()


def test_callbacks(rods):
    simulation = jostle.Simulation(rods)
    seen = []
    rows = simulation.run(23, every=4, callback=lambda given: seen.append((given is simulation, given.clock.step)))
    assert seen == [(True, step) for step in (4, 8, 12, 16, 20)]
    assert list(rows["step"]) == [5, 10, 15, 20]
    assert list(simulation.run(2)["step"]) == [25] and list(simulation.series["step"]) == [5, 10, 15, 20, 25]
    seen.clear()
    simulation.run(10, callback=lambda given: seen.append((True, given.clock.step)))  # by default at every row
    assert seen == [(True, 30), (True, 35)]
    with pytest.raises(KeyError, match="of my own"):
        simulation.run(100, every=7, callback=lambda given: {}["of my own"])
    assert simulation.clock.step == 42
    whole = jostle.Simulation(rods)
    whole.run(100)
    simulation.run(58)
    assert same(state(simulation), state(whole)) and np.array_equal(simulation.series, whole.series)


def test_a_callback_may_make_steps(rods):
    simulation = jostle.Simulation(rods)
    simulation.run(3, every=1, callback=lambda given: given.step())
    assert simulation.clock.step == 6


@pytest.mark.parametrize("arguments", [{"steps": -1}, {"steps": 1.5}, {"steps": True}, {"steps": 2**64}, {"steps": "3"},
                                       {"steps": 1, "every": 0}])
def test_bad_numbers_of_steps(rods, arguments):
    with pytest.raises(jostle.InputError, match="is no such number"):
        jostle.Simulation(rods).run(**arguments)


def test_bad_arguments(rods):
    with pytest.raises(jostle.InputError, match="scene = a dict: is no scene"):
        jostle.Simulation({})
    with pytest.raises(jostle.InputError, match="motion = 3: cannot be called"):
        jostle.Simulation(rods, motions=[3])
    with pytest.raises(jostle.InputError, match="force = an array of shape"):
        jostle.Simulation(rods).velocities(force=np.zeros((3, 3)))


def test_a_failed_step(rods):
    rods.solver.max_iterations = 1
    rods.solver.method = "bbpgd"
    simulation = jostle.Simulation(rods)
    before = state(simulation)
    with pytest.raises(jostle.StepFailure, match="the contact problem was not solved within solver.max_iter") as raised:
        simulation.run(50)
    assert not raised.value.report.converged
    failed = raised.value.report.step
    assert simulation.clock.step == failed and len(simulation.contacts) == 0
    if failed == 0:
        assert same(state(simulation), before)


SLOW = """
import sys, jostle
scene = jostle.Scene.from_toml(sys.argv[1])
simulation = jostle.Simulation(scene)
print("ready", flush=True)
try:
    simulation.run(10**9)
except KeyboardInterrupt:
    step = simulation.clock.step
    assert [*simulation.series["step"]] == [*range(5, step + 1, 5)]
    whole = jostle.Simulation(scene)
    whole.run(step + 10)
    simulation.run(10)
    assert simulation.series.tobytes() == whole.series.tobytes()
    assert simulation.rods.centre.tobytes() == whole.rods.centre.tobytes()
    print("stopped", step)
"""


def test_ctrl_c(rods):
    process = subprocess.Popen([sys.executable, "-c", SLOW, rods.to_toml()], stdout=subprocess.PIPE, text=True,
                               env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.3)
    began = time.monotonic()
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert process.returncode == 0 and out.startswith("stopped ")
    step = int(out.split()[1])
    assert 0 < step < 10**6 and time.monotonic() - began < 30


def test_other_threads_run_meanwhile(rods):
    """The lock is released in a step; who looks meanwhile is told so, and never sees half a step."""
    simulation = jostle.Simulation(rods)
    done = threading.Event()
    refused, counted = [], [0]

    def look():
        while not done.is_set():
            counted[0] += 1
            try:
                assert np.isfinite(simulation.rods.centre).all()
            except RuntimeError as error:
                refused.append(str(error))

    watcher = threading.Thread(target=look)
    watcher.start()
    simulation.run(500)
    done.set()
    watcher.join()
    assert counted[0] > 0 and set(refused) <= {"another thread makes a step of this simulation"}
    whole = jostle.Simulation(rods)
    whole.run(500)
    assert same(state(simulation), state(whole))


@pytest.mark.parametrize("kind", ["rods", "cells"])
def test_resume_and_threads(kind, request, tmp_path):
    scene = request.getfixturevalue(kind)
    whole = jostle.Simulation(scene)
    whole.run(130)
    before = jostle.thread_count()
    try:
        jostle.set_thread_count(2)
        first = jostle.Simulation(scene)
        rows = [first.run(67)]
        first.save(tmp_path / "saved")
        jostle.set_thread_count(3)
        second = jostle.Simulation.resume(tmp_path / "saved")
        assert second.scene == first.scene and second.clock == first.clock
        rows.append(second.run(63))
    finally:
        jostle.set_thread_count(before)
    assert same(state(second), state(whole))
    assert np.concatenate(rows).tobytes() == whole.series.tobytes()


def test_resume_refuses(run_of_rods, rods, tmp_path):
    with pytest.raises(jostle.InputError, match="there is none to go on from"):
        jostle.Simulation.resume(tmp_path)
    with pytest.raises(jostle.InputError, match="holds a run of the command"):
        jostle.Simulation(rods).save(run_of_rods)
    jostle.Simulation(rods).save(tmp_path)
    content = bytearray((tmp_path / "checkpoint").read_bytes())
    content[200] ^= 1
    (tmp_path / "checkpoint").write_bytes(content)
    with pytest.raises(jostle.InputError, match="checkpoint"):
        jostle.Simulation.resume(tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError):
        jostle.Simulation(rods).save(tmp_path / "file" / "folder")


ONE = {"box": {"edges": [20, 20, 20]}, "rods": {"count": 1, "length": 4.0}, "motion": {"brownian": False},
       "time": {"step": 0.01, "production": 1.0}}


def test_motion_of_one_rod():
    """Moves along x at speed 2 and turns about z at rate 3, exactly."""
    simulation = jostle.Simulation(jostle.Scene(**ONE), lambda rods, clock: ([[2, 0, 0]], [[0, 0, 3]]))
    before = simulation.rods
    simulation.run(100)
    after = simulation.rods
    moved = after.centre + after.image * simulation.edges - before.centre
    assert np.allclose(moved, [[2, 0, 0]], atol=1e-13)
    cosine, sine = np.cos(3), np.sin(3)
    assert np.allclose(after.axis[0], [[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]] @ before.axis[0], atol=1e-13)


def test_motion_is_in_the_order_of_ids(cells):
    """What a motion sees, and what it moves, goes by ids, though rows of the simulation change places."""
    seen = []

    def motion(rods, clock):
        assert np.array_equal(rods.id, np.sort(rods.id))
        seen.append((clock.step, clock.time))
        velocity = np.zeros((len(rods), 3))
        velocity[rods.id == 7] = [50.0, 0, 0]
        return velocity

    cells.growth.rate = 0
    for key in ("division_length", "division_deviation", "death_rate"):
        setattr(cells.growth, key, 0)
    cells.motion.self_propulsion = 0
    cells.rods.length = 0
    simulation = jostle.Simulation(cells, motions=[motion])
    simulation.run(513)
    before = simulation.rods
    simulation.step()
    moved = simulation.rods.centre + simulation.rods.image * simulation.edges - before.centre - before.image * 12.0
    assert int(np.argmax(moved[:, 0])) == 7 and moved[7, 0] > 0.2
    assert [step for step, _ in seen] == list(range(514)) and seen[2][1] == 0.02


def test_push_by_the_mobility_of_the_scene():
    pushed = jostle.Simulation(jostle.Scene(**ONE))
    pushed.add_motion(lambda rods, clock: pushed.velocities(force=10 * rods.axis))
    before = pushed.rods
    pushed.run(10)
    speed = np.linalg.norm(pushed.velocities(force=10 * before.axis)[0])
    moved = pushed.rods.centre + pushed.rods.image * 20 - before.centre
    assert np.allclose(moved, 0.1 * speed * before.axis, atol=1e-12)
    assert np.allclose(pushed.velocities(torque=before.axis)[1], 0, atol=1e-15)


def test_velocities_within_a_step_that_numbers_rows_anew(rods):
    """The first step does: forces go to the rods that they are given for, whoever looked at them before."""
    force = np.random.default_rng(1).normal(size=(50, 3))
    found = []

    def motion(rods, clock):
        found.append(np.hstack(simulation.velocities(force=force)))
        return 0 * rods.centre

    simulation = jostle.Simulation(rods, motions=motion)
    expected = np.hstack(simulation.velocities(force=force))
    assert len(simulation.rods) == 50
    simulation.step()
    assert np.array_equal(found[0], expected)


def test_motions_see_the_rods_before_the_step(cells):
    """As long as they were, though cells lengthen as a step begins, and whether someone looked or not."""
    seen = []

    def motion(rods, clock):
        seen.append(rods.length.copy())
        return 0 * rods.centre

    simulation = jostle.Simulation(cells, motions=motion)
    for look in (False, True):
        before = state(simulation)["length"] if look else jostle.Simulation(cells).rods.length
        simulation.step()
        assert np.array_equal(seen[-1], before)


@pytest.mark.parametrize("motion, error, message", [
    (lambda rods, clock: 1 / 0, ZeroDivisionError, "division"),
    (lambda rods, clock: np.zeros((3, 3)), jostle.InputError, "velocities of a motion = an array of shape"),
    (lambda rods, clock: None, jostle.InputError, "velocities of a motion = an array of object"),
    (lambda rods, clock: (np.zeros((50, 3)), np.zeros(3)), jostle.InputError, "angular velocities of a motion"),
    (lambda rods, clock: np.full((50, 3), np.nan), jostle.InputError, "velocities of a motion = nan"),
    (lambda rods, clock: np.full((50, 3), 1e300), jostle.InputError, "take a rod by more than ten times its length in a"),
    (lambda rods, clock: np.full((50, 3), 1e6), jostle.InputError, "at most 1500\\). Use a smaller time.step"),
    (lambda rods, clock: (np.zeros((50, 3)), np.full((50, 3), 1e6)), jostle.InputError, "by more than a whole turn in a"),
    (lambda rods, clock: os.kill(os.getpid(), signal.SIGINT) or time.sleep(1), KeyboardInterrupt, ""),
])
def test_motions_that_fail_leave_the_simulation_whole(rods, motion, error, message):
    fails = [False]
    simulation = jostle.Simulation(rods, lambda given, clock: motion(given, clock) if fails[0] else 0 * given.centre)
    simulation.run(512)  # the failing step would renumber rows
    before, contacts = state(simulation), simulation.contacts
    fails[0] = True
    with pytest.raises(error, match=message):
        simulation.run(10)
    assert simulation.clock.step == 512 and same(state(simulation), before)
    assert np.array_equal(simulation.contacts, contacts)
    fails[0] = False
    simulation.run(8)
    whole = jostle.Simulation(rods)
    whole.run(520)
    assert same(state(simulation), state(whole)) and np.array_equal(simulation.series, whole.series)


def test_a_motion_that_fails_leaves_cells_as_long_as_they_were(cells):
    fails = [True]
    simulation = jostle.Simulation(cells, lambda given, clock: 1 / 0 if fails[0] else 0 * given.centre)
    before = state(simulation)
    with pytest.raises(ZeroDivisionError):
        simulation.step()
    assert same(state(simulation), before)
    fails[0] = False
    simulation.run(100)
    whole = jostle.Simulation(cells)
    whole.run(100)
    assert same(state(simulation), state(whole))


def test_no_step_after_one_that_ended_half_way(tmp_path):
    """40 founders have 6 bits of an id, a line the other 47: the division after those is refused once rods have moved."""
    cells = jostle.Scene(box={"edges": [60.0, 60.0, 60.0]}, rods={"count": 40, "length": 1.0}, seed=4,
                         growth={"rate": 1.0, "division_length": 3.0, "death_rate": 0.31},
                         time={"step": 0.05, "production": 200.0})
    simulation = jostle.Simulation(cells)
    with pytest.raises(jostle.InputError, match="has had 47 divisions in its line"):
        simulation.run(4000)
    step = simulation.clock.step
    for again in (simulation.step, lambda: simulation.run(10), lambda: simulation.save(tmp_path / "run")):
        with pytest.raises(RuntimeError, match="ended half way"):
            again()
    assert simulation.clock.step == step and not (tmp_path / "run/checkpoint").exists()


def test_the_number_of_threads_is_that_of_all_python_threads():
    before = jostle.thread_count()
    try:
        jostle.set_thread_count(3)
        seen = []
        other = threading.Thread(target=lambda: seen.append(jostle.thread_count()))
        other.start()
        other.join()
        assert seen == [3]
    finally:
        jostle.set_thread_count(before)


def test_a_motion_cannot_make_steps(rods):
    simulation = jostle.Simulation(rods)
    simulation.add_motion(lambda given, clock: simulation.step() and 0 * given.centre)
    with pytest.raises(RuntimeError, match="in the middle of a step"):
        simulation.step()
    assert simulation.clock.step == 0
    grows = jostle.Simulation(rods)
    grows.add_motion(lambda given, clock: grows.add_motion(lambda *_: 0) or 0 * given.centre)
    with pytest.raises(RuntimeError, match="in the middle of a step"):
        grows.run(2)


def test_a_motion_cannot_save(cells, tmp_path):
    """Within a step cells have grown and the clock has not moved: going on from there would be another run."""
    simulation = jostle.Simulation(cells)
    simulation.add_motion(lambda given, clock: simulation.save(tmp_path / "half") or 0 * given.centre)
    with pytest.raises(RuntimeError, match="in the middle of a step"):
        simulation.step()
    assert not (tmp_path / "half/checkpoint").exists()
    jostle.Simulation(cells).run(2, every=1, callback=lambda simulation: simulation.save(tmp_path / "whole"))
    assert jostle.Simulation.resume(tmp_path / "whole").clock.step == 2


def test_save_into_a_folder_that_cannot_be(rods, tmp_path):
    (tmp_path / "file").write_text("")
    simulation = jostle.Simulation(rods)
    for folder in (tmp_path / "file/run", tmp_path / "file", "/proc/nowhere", "\0"):
        with pytest.raises(jostle.DiskError, match="cannot make the folder"):
            simulation.save(folder)


def test_a_motion_that_holds_its_simulation_is_collected(rods):
    simulation = jostle.Simulation(rods)
    simulation.add_motion(lambda given, clock: 0 * given.centre + 0 * len(simulation))
    simulation.run(2)
    held = weakref.ref(simulation)
    del simulation
    gc.collect()
    assert held() is None


def test_random_motions_can_be_resumed(rods, tmp_path):
    def shake(given, clock):
        return np.random.default_rng((17, clock.step)).normal(size=given.centre.shape)

    whole = jostle.Simulation(rods, shake)
    whole.run(40)
    first = jostle.Simulation(rods, shake)
    first.run(25)
    first.save(tmp_path)
    second = jostle.Simulation.resume(tmp_path, shake)
    second.run(15)
    assert same(state(second), state(whole))
    without = jostle.Simulation(rods)
    without.run(40)
    assert not same(state(without), state(whole))


def test_rods_from_a_file(tmp_path):
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz\n1,1,1,1,0,0\n5,5,5,0,0,1\n")
    (tmp_path / "scene.toml").write_text('[box]\nedges = [9.0, 9.0, 9.0]\n[rods]\nstart = "file"\nfile = "rods.csv"\n'
                                         'length = 2.0\n[time]\nproduction = 1.0\n')
    simulation = jostle.Simulation(jostle.Scene.from_toml(tmp_path / "scene.toml"))
    assert np.array_equal(simulation.rods.centre, [[1, 1, 1], [5, 5, 5]])
    assert np.array_equal(simulation.rods.axis, [[1, 0, 0], [0, 0, 1]])
    assert simulation.periodic == (True, True, True) and np.array_equal(simulation.edges, [9, 9, 9])


def test_all_cells_may_die(cells):
    cells.growth.death_rate = 50.0
    simulation = jostle.Simulation(cells)
    simulation.run(1000)
    assert len(simulation) == 0 and simulation.rods.centre.shape == (0, 3)
    assert len(simulation.run(10)) == 0
    with pytest.raises(RuntimeError, match="all cells have died"):
        simulation.step()
