# # A motion of your own: rods in a magnetic field
#
# Rods with a magnetic moment m along their axis feel the torque m n x B in a field B. jostle has no such key; a
# function in Python adds it. Brownian rotation works against the field, and in a dilute suspension the mean of n.B/B is
# known: Langevin's function coth a - 1/a with a = m B/kT.

import numpy as np

import jostle

scene = jostle.Scene(
    seed=1,
    box={"volume_fraction": 0.02},
    rods={"count": 80, "length": 1.0},
    time={"step": 0.02, "production": 1.0},
)

# A motion is called at every step with the rods as they are, in the order of their ids, and returns their velocities,
# or velocities and angular velocities. `Simulation.velocities` turns forces and torques into these, by the mobility of
# the scene.

field = np.array([0.0, 0.0, 1.0])


def magnetic(moment):
    simulation = jostle.Simulation(scene)

    def motion(rods, clock):
        return simulation.velocities(torque=moment * np.cross(rods.axis, field))

    simulation.add_motion(motion)
    return simulation


# A callback looks at the rods every 100 steps, after they have turned into the field.

print("m B/kT   mean of n.B/B      Langevin")
for moment in (0.5, 2.0, 8.0):
    simulation = magnetic(moment)
    simulation.run(1500)
    seen = []
    simulation.run(16000, every=100, callback=lambda simulation: seen.append((simulation.rods.axis @ field).mean()))
    error = np.std(np.mean(np.reshape(seen, (8, -1)), axis=1), ddof=1) / np.sqrt(8)
    print(f"{moment:5.1f}    {np.mean(seen):.3f} +- {error:.3f}    {1 / np.tanh(moment) - 1 / moment:.3f}")

# What jostle did beside it (Brownian motion, collisions, their stress) goes on as ever: `simulation.series` has it.
