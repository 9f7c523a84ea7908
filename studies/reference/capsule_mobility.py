#!/usr/bin/env python3
"""Mobility of a single spherocylinder in a fluid without inertia, from the Stokes equations: makes capsule_mobility.csv

    python3 studies/reference/capsule_mobility.py [L/D ...]

Method of fundamental solutions: rings of point forces lie `depth` below the surface, in the middle plane's mirror images too, and their strengths
make the fluid on the surface move as the rigid body does (least squares at twice as many rings). The body's force or torque is the sum of them.
Forces vary round the axis as cos(m phi): m = 0 for motion along the axis, m = 1 for motion across it and for turning. D = viscosity = 1.
"""

import math
import sys

import numpy

LENGTHS = (0, 0.02, 0.05, 0.1, 0.2, 0.25, 0.35, 0.5, 0.75, 1, 1.5, 2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 30, 50, 100)
AZIMUTHS = 48  # points on a ring of forces
# Whether the strengths (radial, azimuthal, axial) are even (1) or odd (-1) in the distance from the middle plane.
PARITY = {"parallel": (-1, 1, 1), "perpendicular": (1, 1, -1), "rotational": (-1, -1, 1)}


def half_meridian(length, depth, spacing):
    """(rings, 2): distances from axis and middle plane of rings below one half of the surface."""
    radius = 0.5 - depth
    caps = max(6, math.ceil(0.25 * math.pi / spacing))
    angle = (numpy.arange(caps) + 0.5) / caps * 0.5 * math.pi
    cap = numpy.column_stack([radius * numpy.cos(angle), 0.5 * length + radius * numpy.sin(angle)])
    rings = math.ceil(0.5 * length / spacing)
    height = (numpy.arange(rings) + 0.5) / max(1, rings) * 0.5 * length
    return numpy.vstack([numpy.column_stack([numpy.full(rings, radius), height]), cap])


def velocities(places, rings, m):
    """(places, 3, rings, 3): amplitudes (radial, azimuthal, axial) of the velocity by rings of unit strength."""
    amplitude = numpy.zeros((len(places), 3, len(rings), 3))
    for angle in 2 * math.pi * (numpy.arange(AZIMUTHS) + 0.5) / AZIMUTHS:
        cos, sin = math.cos(angle), math.sin(angle)
        even, odd = (1.0, 0.0) if m == 0 else (cos, sin)
        forces = numpy.array([[cos * even, sin * even, 0], [-sin * odd, cos * odd, 0], [0, 0, even]])
        points = numpy.column_stack([rings[:, 0] * cos, rings[:, 0] * sin, rings[:, 1]])
        for x, y, component, direction in ((1, 0, 0, (1, 0, 0)), (0, 1, 1, (-1, 0, 0)), (1, 0, 2, (0, 0, 1))):
            here = numpy.column_stack([places[:, 0] * x, places[:, 0] * y, places[:, 1]])
            apart = here[:, None, :] - points[None]
            inverse = 1 / numpy.sqrt((apart**2).sum(axis=2))
            along = apart @ numpy.array(direction, dtype=float)
            for k, force in enumerate(forces):
                amplitude[:, component, :, k] += inverse * (force @ direction) + along * (apart @ force) * inverse**3
    return amplitude / (8 * math.pi * AZIMUTHS)


def rigid_motion(places, kind):
    """(places, 3): amplitudes of the velocity of a body that moves along or across its axis, or turns, at unit speed."""
    radius, height = places.T
    zero, one = numpy.zeros_like(radius), numpy.ones_like(radius)
    return numpy.column_stack({"parallel": [zero, zero, one], "perpendicular": [one, -one, zero],
                               "rotational": [height, -height, -radius]}[kind])


def mobility(length, kind, depth):
    """Velocity over force, or angular velocity over torque; the largest error of the velocity on the surface."""
    spacing = 0.6 * depth
    rings, places = half_meridian(length, depth, spacing), half_meridian(length, 0.0, 0.5 * spacing)
    m, used = (0, [0, 2]) if kind == "parallel" else (1, [0, 1, 2])
    matrix = velocities(places, rings, m) + velocities(places, rings * [1, -1], m) * PARITY[kind]
    matrix = matrix[:, used][..., used].reshape(len(places) * len(used), -1)
    wanted = rigid_motion(places, kind)[:, used].ravel()
    strength = numpy.linalg.lstsq(matrix, wanted, rcond=1e-14)[0]
    error = abs(matrix @ strength - wanted).max() / abs(wanted).max()
    radial, azimuthal, axial = numpy.insert(strength.reshape(len(rings), -1).T, 1, 0, axis=0)[[0, 1, 2]] if m == 0 else strength.reshape(-1, 3).T
    resistance = {"parallel": 2 * axial.sum(), "perpendicular": (radial - azimuthal).sum(),
                  "rotational": (rings[:, 1] * (radial - azimuthal) - rings[:, 0] * axial).sum()}[kind]
    return 1 / resistance, error


def main():
    print("length_over_diameter,parallel,perpendicular,rotational,largest_error_on_surface")
    for length in map(float, sys.argv[1:] or LENGTHS):
        depth = 0.1 if length <= 30 else 0.2
        found = [mobility(length, kind, depth) for kind in PARITY]
        print(f"{length:g}," + ",".join(f"{value:.6g}" for value, _ in found) + f",{max(error for _, error in found):.1e}", flush=True)


if __name__ == "__main__":
    main()
