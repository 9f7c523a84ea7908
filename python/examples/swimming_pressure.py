# # The pressure of swimming rods
#
# Rods that swim push each other, and so raise the collision pressure; and they carry their own active (swim) pressure,
# force of the propulsion times how far it has taken them ([theory](../theory/1-collision-stress.md#active-stress)).
# Here both are measured against the speed, for rods that tumble as bacteria do.

import numpy as np

import jostle

# A scene is made from keywords, one a table, with the keys of scene files. Lengths are in diameters, energies in kT.
# Sixty rods are enough to see the effect, and too few for a number to be published.

def scene(speed):
    return jostle.Scene(
        seed=4,
        box={"volume_fraction": 0.05},
        rods={"count": 60, "length": 2.0},
        motion={"self_propulsion": speed, "tumble_rate": 1.0} if speed > 0 else {},
        time={"step": 2e-3, "production": 1.0},
        output={"series_every": 20},
    )

# `run` returns the rows of the series, as a structured array. The first part, in which the rods forget their start and
# paths become as long as the active stress needs them, is left out. Error bars come from five blocks, each much longer
# than a rod remembers its direction.

def mean_and_error(values, blocks=5):
    means = [block.mean() for block in np.array_split(values, blocks)]
    return np.mean(means), np.std(means, ddof=1) / np.sqrt(blocks)

# What free swimmers have is theory, eq. (1.10): n U^2 exp(-rate time) tau/(3 mu_parallel), with tau the time in which
# one forgets its direction. The mobility of the scene, which turns forces into velocities, gives mu_parallel and D_R.

def free_active_pressure(simulation, speed):
    axis = simulation.rods.axis[0]
    across = np.cross(axis, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across)
    parallel = simulation.velocities(force=axis)[0][0] @ axis
    turning = simulation.kT * simulation.velocities(torque=across)[1][0] @ across
    rate = simulation.scene.motion.tumble_rate
    density = len(simulation) / simulation.volume
    return density * speed**2 * np.exp(-0.1) / (2 * turning + rate) / (3 * parallel)  # a tumble takes 0.1/rate

# The table: means, standard errors, and the formula.

print("speed   Z               collision pressure   active pressure   of free rods")
for speed in (0.0, 4.0, 8.0):
    simulation = jostle.Simulation(scene(speed))
    rows = simulation.run(24000)[400:]
    line = f"{speed:4.0f}"
    for name in ("Z", "pressure_collision", "pressure_active"):
        if name in rows.dtype.names:
            mean, error = mean_and_error(rows[name])
            line += f"    {mean:.4f} +- {error:.4f}"
    if speed > 0:
        line += f"    {free_active_pressure(simulation, speed):.4f}"
    print(line)

# Z holds the kinetic and the collision part only. At this density the active pressure is still that of free rods, within
# its error; the collision pressure has grown tenfold.
