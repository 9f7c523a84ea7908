"""Layers: how far rods stand in sheets across their mean direction."""

import itertools

import numpy

from clusters import trajectory

SPACING = (0.8, 1.5)  # of layers, in rod lengths L + D
SLOPE = 0.9  # cosine between their normal and the director, at least


def layer_order(run, director):
    """(order, spacing): the largest mean |sum exp(i q.r)|/N over the frames of production, of all q that fit the periodic
    box and could be layers; about 1/sqrt(N) without layers, 1 for perfect ones."""
    with trajectory(run) as file:
        rods = file["particles/rods"]
        edges = numpy.diag(rods["box/edges"][...]) if rods["box/edges"].ndim == 2 else rods["box/edges"][...]
        positions = rods["position/value"][rods["position/step"][...] > run.equilibration]
    longest = run.scene["rods"]["length"] + 1.0
    modes = numpy.array([mode for mode in itertools.product(range(-9, 10), repeat=3) if any(mode)])
    q = 2 * numpy.pi * modes / edges
    size = numpy.linalg.norm(q, axis=1)
    spacing = 2 * numpy.pi / size
    fits = (spacing > SPACING[0] * longest) & (spacing < SPACING[1] * longest) & (numpy.abs(q @ director) > SLOPE * size)
    waves = numpy.abs(numpy.exp(1j * (positions @ q[fits].T)).mean(axis=1)).mean(axis=0)
    return waves.max(), spacing[fits][waves.argmax()]
