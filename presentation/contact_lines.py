"""Contact forces of the frames, as lines from the centre line of one rod to that of the other, the thicker the stronger."""

import numpy as np

from frames_of_page import packed_lines

MOST = 10**6         # lines of all frames; of more the page has none
THICKEST = 0.7       # of the diameter of a rod: the line of the largest forces
STRONG = 99.0        # percentile of the forces from which on lines are thickest


def packed_contacts(run, frames, extent):
    """Lines in the steps of the frames, or None where none were kept."""
    rows = run.table("contacts.csv")
    order = np.argsort(rows["step"], kind="stable")
    rows = {name: values[order] for name, values in rows.items()}
    lines = [_of_frame(frame, rows) for frame in frames]
    force = np.concatenate([of_frame[1] for of_frame in lines])
    if not 0 < len(force) <= MOST:
        return None
    thickest = THICKEST * max(frame.diameter.max(initial=0.0) for frame in frames)
    thickness = thickest * np.sqrt(np.minimum(force / np.percentile(force, STRONG), 1.0))
    return packed_lines("contacts", [frame.time for frame in frames], [of_frame[0] for of_frame in lines], thickness, extent)


def _of_frame(frame, rows):
    """Ends (K, 2, 3) and force (K) of the lines in this frame."""
    begin, end = np.searchsorted(rows["step"], [frame.step, frame.step + 1])
    here = {name: values[begin:end] for name, values in rows.items()}
    i, j = (np.searchsorted(frame.id, here[name].astype(np.int64)) for name in ("id_i", "id_j"))
    there = (i < len(frame)) & (j < len(frame))
    there[there] &= (frame.id[i[there]] == here["id_i"][there]) & (frame.id[j[there]] == here["id_j"][there])
    here = {name: values[there] for name, values in here.items()}
    i, j = i[there], j[there]
    normal = np.stack([here[f"normal_{axis}"] for axis in "xyz"], axis=1)
    # A wall, or a fixed rod, is on the side that the normal comes from; there i is j, and the line goes from the rod to it.
    at_wall = np.zeros(len(i), bool)
    for name in ("wall", "fixed"):
        if name in here:
            at_wall |= here[name] >= 0
    normal[at_wall] *= -1.0
    # Both ends as they were when the forces were found, at the begin of the step; the first rod's place is that at its end.
    arm = np.where(at_wall, here["arm_j"], here["arm_i"])
    first = frame.centre[i] + arm[:, None] * frame.axis[i]
    length = 0.5 * (np.where(at_wall, 0.0, frame.diameter[i]) + frame.diameter[j]) + here["gap"]
    return np.stack((first, first + length[:, None] * normal), axis=1), here["force"]
