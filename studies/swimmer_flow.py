"""The flow around one swimmer L/D = 5, of the blob forces that the program gives it (theory, eqs. 7.2, 7.3, 7.11)."""

import math

import numpy
from scipy.special import erf

LENGTH, DIAMETER, BLOBS, WIDTH = 5.0, 1.0, 5, 1.11  # of rods L/D = 5 (src/jostle/hydrodynamics/rod_blobs.cpp)
SPREAD = WIDTH**2 * DIAMETER**2 / 12


def kernel(r):
    """(..., 3, 3) of the distances r (..., 3): the flow of a blob of force at another blob, times the viscosity."""
    distance = numpy.maximum(numpy.linalg.norm(r, axis=-1), 1e-3)
    alpha = 0.5 / math.sqrt(SPREAD)
    x = alpha * distance
    psi = erf(x) / (4 * math.pi * distance)
    chi = -((0.5 - 0.25 / x**2) * erf(x) + numpy.exp(-x**2) / (2 * math.sqrt(math.pi) * x)) / (4 * math.pi * distance)
    unit = r / distance[..., None]
    along = unit[..., :, None] * unit[..., None, :]
    return (psi + chi)[..., None, None] * numpy.eye(3) - (psi + 3 * chi)[..., None, None] * along


def blobs():
    """(places along the axis, weights of a lever) of the rod's blobs."""
    place = numpy.linspace(-LENGTH / 2, LENGTH / 2, BLOBS)
    apart = numpy.zeros((BLOBS, BLOBS, 3))
    apart[..., 0] = place[:, None] - place[None, :]
    turned = numpy.linalg.solve(kernel(apart)[..., 1, 1], place)
    return place, turned / (turned @ place)


def flow(points, dipole, axis=(1.0, 0.0, 0.0)):
    """(..., 3) velocity at points (..., 3) around a swimmer at the origin, in dipole/(viscosity D2)."""
    axis = numpy.asarray(axis)
    place, weight = blobs()
    return sum(dipole * w * kernel(points - s * axis) @ axis for s, w in zip(place, weight))


def far_flow(points, dipole, axis=(1.0, 0.0, 0.0)):
    """The same of a force dipole at a point (theory, eq. 7.12)."""
    distance = numpy.linalg.norm(points, axis=-1, keepdims=True)
    cosine = (points @ numpy.asarray(axis))[..., None] / distance
    return dipole * (3 * cosine**2 - 1) / (8 * math.pi * distance**3) * points


def draw(panel, dipole, half_width=12.0):
    """Streamlines in a plane through the axis; the colour is the logarithm of the speed."""
    grid = numpy.linspace(-half_width, half_width, 121)
    x, y = numpy.meshgrid(grid, grid)
    u = flow(numpy.stack([x, y, 0 * x], axis=-1), dipole)
    speed = numpy.log10(numpy.linalg.norm(u, axis=-1) + 1e-6)
    panel.streamplot(grid, grid, u[..., 0], u[..., 1], color=speed, cmap="viridis", density=1.1, linewidth=0.9, arrowsize=0.8)
    panel.plot([-LENGTH / 2, LENGTH / 2], [0, 0], color="black", linewidth=8, solid_capstyle="round")
    panel.set(xlim=(-half_width, half_width), ylim=(-half_width, half_width), aspect="equal", xlabel="x/D", ylabel="y/D",
              title="pusher" if dipole > 0 else "puller")
