"""Extended XYZ: exact lengths in OVITO (choose the shape "Spherocylinder" once), and for any reader of the format.

aspherical_shape is (radius, radius, length of the cylinder); orientation the quaternion (x, y, z, w) that turns +z to
the axis.
"""

import numpy as np

from run_folder import of_the_package

turning_z_to = of_the_package("gsd_frames").turning_z_to

PROPERTIES = "species:S:1:pos:R:3:orientation:R:4:aspherical_shape:R:3:id:I:1"
CREATOR = 'creator="jostle export"'
ROW = " %.8g" * 10 + " %d"
ROD, FIXED = "X", "F"  # X: no chemical element, to readers that ask for one; F: of rods that nothing moves, whose id is -1


def is_ours(path):
    try:
        with open(path, encoding="utf-8") as file:
            file.readline()
            return CREATOR in file.readline()
    except (OSError, UnicodeDecodeError):
        return False


def write(path, trajectory):
    with open(path, "w", encoding="utf-8") as file:
        fixed = trajectory.fixed
        for frame in trajectory:
            file.write(f"{len(frame) + (len(fixed) if fixed else 0)}\n{comment(frame)}\n")
            np.savetxt(file, rows(frame), fmt=ROD + ROW)
            if fixed:
                np.savetxt(file, rows(fixed), fmt=FIXED + ROW)


def comment(frame):
    x, y, z = frame.edges
    periodic = " ".join("T" if along else "F" for along in frame.periodic)
    return (f'Lattice="{x:.10g} 0 0 {frame.offset:.10g} {y:.10g} 0 0 0 {z:.10g}" Origin="0 0 0" pbc="{periodic}" Properties={PROPERTIES} '
            f"Time={frame.time:.10g} Step={frame.step} {CREATOR}")


def rows(frame):
    w, x, y, z = turning_z_to(frame.axis).T
    radius = 0.5 * frame.diameter
    return np.column_stack((frame.centre, x, y, z, w, radius, radius, frame.length, frame.id))
