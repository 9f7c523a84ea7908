"""Colours of the rods of a frame in pictures, by one of the ways of colourings.py: those of the page."""

import colorsys

import numpy as np
from matplotlib import colormaps

import colourings

COLOURS = colormaps["viridis"]  # even in lightness, and the same order for every kind of colour vision
GREY = (0.59, 0.61, 0.64)       # of what has no value
ALONG = np.array([[40, 98, 176], [38, 150, 120], [240, 190, 70]]) / 255  # of rods along x, y, z
SHADES = ((0.62, 0.5), (0.5, 0.62), (0.7, 0.42))  # (saturation, lightness) of groups, five by five


def of_frame(way, frames, number):
    """(N, 3) sRGB in 0..1 of the rods of frames[number]."""
    frame = frames[number]
    if way.kind == "direction":
        return frame.axis**2 @ ALONG
    if way.kind == "angle":
        return COLOURS(colourings.angles_to(way.directors[number], frame) / way.high)[:, :3]
    if way.kind == "plain":
        return np.tile(np.array(colourings.PLAIN) / 255, (len(frame), 1))
    first = sum(len(before) for before in frames[:number])
    values = way.values[first:first + len(frame)]
    if way.kind == "group":
        return np.array([_of_group(int(value)) for value in values]).reshape(-1, 3)
    known = np.isfinite(values)
    share = (np.where(known, values, way.low) - way.low) / (way.high - way.low)
    return np.where(known[:, None], COLOURS(share)[:, :3], GREY)


def _of_group(group):
    """Groups that follow each other have colours far apart: hues by the golden angle."""
    saturation, lightness = SHADES[group // 5 % 3]
    return colorsys.hls_to_rgb((group * 137.508 + 210.0) % 360.0 / 360.0, lightness, saturation)
