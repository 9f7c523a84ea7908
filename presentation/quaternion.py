"""Orientations for formats in which a rod lies along its own z axis."""

import numpy as np


def turning_z_to(axis):
    """Unit quaternions (w, x, y, z) that turn +z to the axes, by the shortest way."""
    x, y, z = axis.T
    turned = np.stack((1.0 + z, -y, x, np.zeros_like(z)), axis=1)
    size = np.linalg.norm(turned, axis=1, keepdims=True)
    downwards = size[:, 0] < 1e-6  # half a turn about any axis across z
    turned[downwards] = (0.0, 1.0, 0.0, 0.0)
    size[downwards] = 1.0
    return (turned / size).astype(np.float32)
