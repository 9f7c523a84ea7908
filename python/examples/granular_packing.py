# # The stress of a granular packing, from its list of contacts
#
# Programs for granular matter write lists of contacts: who touches whom, where, and with what force. That is all that
# the stress formula needs. Here the list is made by jostle itself, from rods that grow, without thermal motion, until they are
# packed; then it is read back as if another program had written it.

import tempfile
from pathlib import Path

import numpy as np

import jostle

# ## A packing

scene = jostle.Scene(
    seed=2,
    box={"edges": [7.0, 7.0, 7.0]},
    rods={"count": 100, "length": 0.5},
    growth={"rate": 1.0, "division_length": 9.0},
    motion={"brownian": False},
    contact={"brownian_correction": False},
    time={"step": 0.005, "production": 10.0},
)
simulation = jostle.Simulation(scene)
while len(simulation.contacts) == 0 or (simulation.contacts["force"] > 0).sum() < 350:
    rods = simulation.rods  # as they are before the step, and stay
    simulation.step()
length = simulation.rods.length  # rods lengthen as a step begins
contacts = simulation.contacts[simulation.contacts["force"] > 0]
print(f"{len(rods)} rods of length {length.mean():.2f}, {len(contacts)} contacts with a force")

# ## The list, as another program might write it
#
# Bodies: centre, direction, length, diameter. Contacts: numbers of the two bodies, the point, which is where the
# surfaces meet, the vector from one centre to the other (nearest images), and the force on the second body.

folder = Path(tempfile.mkdtemp())
first, second = (np.searchsorted(rods.id, contacts[name]) for name in ("id_i", "id_j"))
separation = rods.centre[second] + contacts["image"] * simulation.edges - rods.centre[first]
point = (contacts["arm_i"][:, None] * rods.axis[first]
         + (0.5 * rods.diameter[first] + 0.5 * contacts["gap"])[:, None] * contacts["normal"])
force = contacts["force"][:, None] * contacts["normal"]
np.savetxt(folder / "bodies.csv", np.column_stack((rods.centre, rods.axis, length, rods.diameter)), delimiter=",",
           header="x,y,z,nx,ny,nz,length,diameter", comments="")
np.savetxt(folder / "contacts.csv", np.column_stack((first, second, point, separation, force)), delimiter=",",
           header="first,second,px,py,pz,sx,sy,sz,fx,fy,fz", comments="")

# ## The stress
#
# A body is its second moment; any shape will do, from `body_moments`. Points are relative to the centres of mass.

table = np.loadtxt(folder / "bodies.csv", delimiter=",", skiprows=1)
bodies = [jostle.body_moments("spherocylinder", length=row[6], diameter=row[7], axis=row[3:6]).at(row[:3])
          for row in table]
table = np.loadtxt(folder / "contacts.csv", delimiter=",", skiprows=1)
first, second = table[:, :2].astype(int).T
point, separation, force = table[:, 2:5], table[:, 5:8], table[:, 8:]
stress = jostle.contact_stress(bodies, first, second, point, point - separation, force, separation=separation)

volume = np.prod(simulation.edges)
sigma = stress.total / volume
print("stress, positive in compression:")
print(np.array2string(sigma, precision=4, suppress_small=True))
print(f"pressure {np.trace(sigma) / 3:.4f}")

# Every body has its own share, and the shares add up to the whole. The bare virial, from centre of mass to centre of
# mass, has the same pressure, but for bodies that are no spheres it is not symmetric:

print(f"most stressed body: {np.trace(stress.per_body, axis1=1, axis2=2).max() / np.trace(stress.total):.3f} of all")
print(f"the shares add up: {abs(stress.per_body.sum(axis=0) - stress.total).max() / volume < 1e-12}")
for name, tensor in (("whole formula", stress.total), ("bare virial", stress.virial)):
    asymmetry = np.linalg.norm(tensor - tensor.T) / np.linalg.norm(tensor)
    print(f"asymmetry of the {name}: {asymmetry:.3f}")

# jostle, which knows that these are rods, had the same stress:

print("as in the step:", np.allclose(sigma, simulation.stress_collision, rtol=1e-12))
