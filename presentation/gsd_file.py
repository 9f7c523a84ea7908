"""GSD: OVITO draws the rods as spherocylinders, freud reads them. Written as the Python package does (python/jostle/gsd_frames.py)."""

from run_folder import of_the_package

_frames = of_the_package("gsd_frames")
is_ours = _frames.is_ours


def write(path, trajectory):
    _frames.write(path, trajectory, trajectory.fixed)
