"""The calls of one seed: `misuse_calls.py SEED`. Prints each before it is made; status 1 with a traceback at an error that is not documented."""

import pickle
import random
import sys

import numpy as np

import jostle
from jostle import analysis

CALLS = 40
DOCUMENTED = (jostle.InputError, jostle.DiskError, jostle.StepFailure)
SCENE = """seed = 1
[box]
edges = [8.0, 8.0, 8.0]
[rods]
count = 6
length = 2.0
[motion]
self_propulsion = 0.1
[time]
step = 0.01
production = 1.0
"""
ODD = [None, True, 0, 1, -1, 2, 1.5, 2**31, 2**64, -2**64, 1e308, -1e308, 1e-320, float("nan"), float("inf"), "", "x", "\0", b"x", [], [1],
       {}, (), 1j, object(), np.zeros(0), np.zeros(3), np.ones((2, 3)), np.ones((3, 3)), np.full((2, 3), np.nan), np.eye(3),
       np.zeros((0, 3)), np.ones((2, 3), dtype="f4"), np.ones((2, 3), dtype=complex), np.array(["a"]), np.ones((4, 2, 3)), "sphere",
       "rods.csv", "/dev/null", "/proc/self/mem", SCENE]
ARGUMENTS = {
    "segment_distance": ["p0", "p1", "q0", "q1"],
    "solve_lcp": ["A", "b", "method", "tolerance", "max_iterations"],
    "body_moments": ["shape", "diameter", "length", "axis", "edges", "semi_axes", "points", "vertices", "triangles"],
    "combined": ["bodies"], "load": ["folder"], "set_thread_count": ["count"], "Scene": ["seed", "box", "rods", "time"],
    "Body": ["mass", "centre", "second_moment"],
}


def attempt(name, call):
    print(name, flush=True)
    try:
        return call()
    except DOCUMENTED as error:
        again = pickle.loads(pickle.dumps(error))  # errors travel between processes
        assert str(again) == str(error), "an error that pickling changes"
    except TypeError:  # Python's own word for an argument of a wrong type
        pass
    return None


def odd_rods(choose):
    names = ["centre", "axis", "length", "diameter", "edges", "time", "periodic", "speed"]
    sound = {"centre": np.zeros((2, 1, 3)), "edges": [9, 9, 9]}
    return {**sound, **{key: choose.choice(ODD) for key in choose.sample(names, choose.randint(1, 3))}}


def odd_analysis(choose, value):
    function = choose.choice([analysis.mean_square_displacements, analysis.orientation_memory, analysis.pair_correlation, analysis.structure_factor,
                              analysis.clusters])
    rods, more = choose.choice([value, odd_rods(choose)]), [choose.choice(ODD)] if function is analysis.clusters else []
    return f"{function.__name__} {rods!r:.400} {more!r:.200}", lambda: function(rods, *more)


def add_odd_column(scene, name, function):
    simulation = jostle.Simulation(scene)
    simulation.add_column(name, function)
    simulation.run(20)
    simulation.summary()


def odd_call(choose, simulation, scene):
    name = choose.choice(list(ARGUMENTS) + ["step", "run", "save", "resume", "add_motion", "set", "from_toml", "stress", "record", "add_column", "rods",
                                             "analysis"])
    value = choose.choice(ODD)
    told = f"{name} {value!r:.200}"
    if name in ARGUMENTS:
        wanted = ARGUMENTS[name]
        given = {key: choose.choice(ODD) for key in wanted[:choose.randint(1, len(wanted))]}
        return f"{name} {given!r:.400}", lambda: getattr(jostle, name)(**given)
    if name == "step":
        return told, simulation.step
    if name == "run":
        steps = choose.choice([value, 1, 3])
        if isinstance(steps, int) and steps > 100:
            steps = -steps
        return told, lambda: simulation.run(steps)
    if name == "save":
        return told, lambda: simulation.save(value)
    if name == "resume":
        return told, lambda: jostle.Simulation.resume(value)
    if name == "add_motion":
        return told, lambda: jostle.Simulation(scene, motions=lambda rods, clock: value).step()
    if name == "set":
        table, key = choose.choice([("rods", "length"), ("time", "step"), ("box", "edges"), ("rods", "start"), ("units", "system")])
        return told, lambda: setattr(getattr(scene.copy(), table), key, value)
    if name == "from_toml":
        return told, lambda: jostle.Scene.from_toml(value)
    if name == "record":
        return told, lambda: simulation.record(value, choose.choice(ODD))
    if name == "add_column":
        return told, lambda: add_odd_column(scene, choose.choice(["own", value]), choose.choice([value, lambda _: value]))
    if name == "rods":
        given = choose.choice([value, odd_rods(choose)])
        return f"rods {given!r:.400}", lambda: jostle.Simulation(scene, rods=given)
    if name == "analysis":
        return odd_analysis(choose, value)
    rods = simulation.rods
    return told, lambda: jostle.collision_stress(value, rods.axis, rods.length)


def main():
    choose = random.Random(int(sys.argv[1]))
    scene = jostle.Scene.from_toml(SCENE)
    simulation = jostle.Simulation(scene)
    threads = jostle.thread_count()
    for _ in range(CALLS):
        attempt(*odd_call(choose, simulation, scene))
        if jostle.thread_count() != threads:  # a number that was taken: the next steps must be able to use it
            attempt("step with other threads", simulation.step)
            jostle.set_thread_count(threads)
    simulation.step()


if __name__ == "__main__":
    main()
