"""What tests of several ranks share: scenes, mpirun and the words that it starts, and what a run leaves whoever makes it."""

import os
import pathlib
import subprocess

from jostle_command import JOSTLE, RESULTS, changed, datasets, started

GOLDEN = pathlib.Path(__file__).resolve().parent.parent / "golden/scenes"
MPIRUN = os.environ.get("JOSTLE_MPIRUN", "")

CROWD = {
    "seed": 5,
    "box": {"volume_fraction": 0.3},
    "rods": {"count": 160, "length": 3.0, "start": "aligned"},  # a start that takes no time
    "time": {"step": 0.01, "equilibration": 0.0, "production": 0.3},
    "output": {"series_every": 5, "trajectory_every": 12, "checkpoint_every": 10, "stress_conventions": True},
}
SCENES = {
    "dense": changed(CROWD, output={"contacts": True, "stress_per_rod": True, "field_every": 10}),
    "polydisperse": changed(CROWD, rods={"length_deviation": 0.5, "diameter_deviation": 0.1}),
    "spheres": changed(CROWD, rods={"length": 0.0}, time={"step": 0.003, "production": 0.09}),
    "long": changed(CROWD, box={"volume_fraction": 0.1}, rods={"count": 60, "length": 20.0}),
    "few": changed(CROWD, box={"volume_fraction": 0.15}, rods={"count": 3, "start": "random"}),
    "plane": changed(CROWD, box={"volume_fraction": None, "area_fraction": 0.3, "dimensions": 2}),
    "pulled": changed(CROWD, forces={"on_rods": [1.0, 0.0, 0.0], "drift": True, "alignment_energy": 2.0}),
    "walls": changed(CROWD, box={"periodic": [True, True, False]}, walls={"faces": [False, False, True]},
                     output={"contacts": True}),
    "soft": changed(CROWD, contact={"model": "wca"}, time={"step": 0.0001, "production": 0.003}),
    "warm": changed(CROWD, solver={"warm_start": "always"}),
    "squeezed": changed(CROWD, box={"volume_fraction": 0.2}, schedule={"volume_fraction": [[0.3, 0.25]], "kT": [[0.2, 2.0]]}),
    "bath": changed(CROWD, pressure={"external": 2.0, "coupling": "orthogonal"}),
    "piston": changed(CROWD, box={"periodic": [True, True, False]}, walls={"faces": [False, False, True]},
                      pressure={"external": 2.0, "coupling": "piston"}),
    "pressed": changed(CROWD, box={"periodic": [True, True, False]}, walls={"faces": [False, False, True]},
                       fluid={"kT": 0.0}, pressure={"external": 20.0, "coupling": "piston"},
                       time={"step": 0.01, "equilibration": 0.0, "production": 0.3}),
    "fixed": changed(CROWD, rods={"length": 2.0, "fixed": str(GOLDEN / "fixed_rods.csv"), "start": "random"},
                     box={"volume_fraction": 0.15}, output={"contacts": True}),
    "chains": changed(CROWD, box={"volume_fraction": None, "edges": [14.0, 7.5, 7.5]},
                      rods={"count": None, "length": 2.0, "start": "file", "file": str(GOLDEN / "chains_rods.csv")},
                      springs={"file": str(GOLDEN / "chains_springs.csv")}, time={"step": 0.001, "production": 0.03}),
    "colony": changed(CROWD, box={"volume_fraction": None, "edges": [40.0, 40.0, 40.0], "periodic": [False, False, False]},
                      rods={"count": 1, "length": 2.0}, motion={"brownian": False},
                      growth={"rate": 1.0, "division_length": 3.0, "rate_deviation": 0.1, "stall_force": 100.0},
                      time={"step": 0.02, "production": 8.0}, output={"contacts": True, "stress_per_rod": True}),
    "dying": changed(CROWD, box={"volume_fraction": 0.1}, rods={"diameter_deviation": 0.05},
                     growth={"rate": 3.0, "division_length": 4.0, "death_rate": 0.5, "division_every": 3}),
    "sheared": changed(CROWD, flow={"shear_rate": 1.8, "start_strain": 0.3}),
    "swimmers": changed(CROWD, motion={"self_propulsion": 1.0, "self_propulsion_deviation": 0.3, "tumble_rate": 2.0,
                                       "tumble_time": 0.2, "reversal_rate": 1.0},
                        output={"active_stress_lag": 0.1}),
}


def launcher(ranks):
    """The options are for more ranks than processors, and a machine that has root only."""
    return [MPIRUN, "--oversubscribe", "--allow-run-as-root", "--mca", "btl", "self,vader", "--mca",
            "mpi_yield_when_idle", "1", "--bind-to", "none", "-n", str(ranks)]


def words(ranks, *options, threads=1):
    """As `run_arguments`, by so many ranks; 0: without a launcher."""
    own = [JOSTLE, "run", "scene.toml", "--out", "run", "--threads", str(threads), *options]
    return own if ranks == 0 else launcher(ranks) + own


def on_ranks(folder, ranks, *options, threads=1):
    return subprocess.run(words(ranks, *options, threads=threads), cwd=folder, capture_output=True, text=True,
                          timeout=120)


def start_on_ranks(folder, ranks, *options, threads=1):
    process = subprocess.Popen(words(ranks, *options, threads=threads), cwd=folder, text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
    started.append(process)
    return process


def lines_of_jostle(stderr):
    """What the command says, without what mpirun adds."""
    return [line for line in stderr.splitlines() if line.startswith("jostle: ")]


def require_same_files(folder, reference):
    """As require_same_results, which does not know of mpirun."""
    for name in RESULTS:
        assert (folder / name).exists() == (reference / name).exists(), name
        if (reference / name).exists():
            assert (folder / name).read_bytes() == (reference / name).read_bytes(), f"{name} differs"
    ours, theirs = datasets(folder / "trajectory.h5"), datasets(reference / "trajectory.h5")
    del ours["parameters/command_line"], theirs["parameters/command_line"]  # they tell the threads
    assert ours == theirs
    assert not list(folder.glob("*.tmp"))


def pid_of_rank(process, rank):
    """The process number of a rank, from the environment that mpirun has given it."""
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{number}/environ", "rb") as file:
                environment = file.read().split(b"\0")
            with open(f"/proc/{number}/stat") as file:
                parent = int(file.read().rsplit(")", 1)[1].split()[1])
        except (OSError, IndexError):
            continue
        if parent == process.pid and f"OMPI_COMM_WORLD_RANK={rank}".encode() in environment:
            return int(number)
    raise AssertionError(f"there is no rank {rank}")
