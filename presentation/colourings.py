"""The ways in which rods are coloured, each by one property, with its scale. The first is what a page begins with."""

from dataclasses import dataclass

import numpy as np

from frames_of_page import with_unknown

PLAIN = (87, 140, 191)
TOPS = (15.0, 30.0, 45.0, 60.0, 90.0)  # degrees that the scale of angles may end at
NEMATIC = 0.4                          # order above which there is a director to speak of
OUTLIERS = 2.0                         # percent of the values that a scale leaves out at either end


@dataclass
class Way:
    key: str
    label: str
    kind: str                  # direction, angle, scale, group or plain
    unit: str = ""
    note: str = ""
    values: np.ndarray = None  # of the rods of all frames, one frame after the other
    low: float = 0.0           # of the scale, and high
    high: float = 1.0
    directors: tuple = ()      # of the frames


def ways(run, frames, cells):
    """cells: (generation, age, family) of every frame, where cells grow."""
    scales = _scales(run, frames, cells)
    made = [Way("direction", "direction", "direction"), _angle(frames)] if frames[-1].length.any() or run.propelled else []
    if made and np.linalg.eigvalsh(_order_tensor(frames[-1]))[-1] > NEMATIC:
        made.reverse()
    plain = [Way("plain", "one colour", "plain")]
    if cells:
        made.insert(0, Way("family", "family", "group", values=_joined(of_frame[2] for of_frame in cells)))
    elif not made and frames[0].pressure is None:
        made, plain = plain, []
    ids = Way("id", "id", "group", values=_joined(np.arange(len(frame)) for frame in frames))
    return made + scales + [ids] + plain


def told(way, packed):
    """The entry for the page; the column that it needs is added to `packed`."""
    entry = {"key": way.key, "label": way.label, "kind": way.kind, "unit": way.unit, "note": way.note, "low": way.low, "high": way.high}
    if way.kind == "plain":
        entry["colour"] = PLAIN
    if way.kind == "angle":
        entry["directors"] = [[float(value) for value in director] for director in way.directors]
    if way.kind == "group" and way.key != "id":  # ids are the rows themselves
        packed.add(way.key, way.values.astype(np.uint16))
        entry["column"] = way.key
    if way.kind == "scale":
        known = way.values[np.isfinite(way.values)]
        least, greatest = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
        packed.add(way.key, with_unknown(way.values, least, greatest))
        entry.update(column=way.key, least=least, greatest=greatest)
    return entry


def _scales(run, frames, cells):
    made = []
    time_factor, time_unit = run.in_unit("time")
    length_unit = run.in_unit("max_overlap")[1]
    if frames[0].pressure is not None:
        factor, unit = run.in_unit("pressure_collision")
        made.append(_scale("pressure", "pressure of the rod", unit, factor * _joined(frame.pressure for frame in frames),
                           "in the step that led to the frame"))
    if cells:
        made.append(_scale("generation", "generation", "", _joined(of_frame[0] for of_frame in cells)))
        made.append(_scale("age", "age", time_unit, time_factor * _joined(of_frame[1] for of_frame in cells)))
    lengths = _joined(frame.length for frame in frames)
    if np.ptp(lengths) > 0.0:
        made.append(_scale("own_length", "length", length_unit, lengths))
    if len(frames) > 1:
        made.append(_scale("speed", "speed", f"{length_unit} per {time_unit}", _joined(speeds(frames)) / time_factor,
                           "displacement since the frame before, over its time"))
    return made


def _angle(frames):
    directors = tuple(director(frame) for frame in frames)
    angles = angles_to(directors[-1], frames[-1])
    top = next(top for top in TOPS if top >= min(np.percentile(angles, 95) if len(angles) else 0.0, TOPS[-1]))
    return Way("angle", "angle to the director", "angle", "°", high=top, directors=directors)


def _scale(key, label, unit, values, note=""):
    """The scale leaves out the outermost values."""
    known = values[np.isfinite(values)]
    low, high = np.percentile(known, [OUTLIERS, 100.0 - OUTLIERS]).tolist() if len(known) else (0.0, 1.0)
    low = 0.0 if 0.0 <= low < 0.3 * high else low
    return Way(key, label, "scale", unit, note, values, low, high if high > low else low + 1.0)


def speeds(frames):
    """(N) of every frame: how far each rod has come since the frame before over the time between; NaN where it was not there."""
    yield np.full(len(frames[0]), np.nan)
    for before, frame in zip(frames, frames[1:]):
        rows = np.searchsorted(before.id, frame.id)
        rows[rows == len(before)] = 0
        known = before.id[rows] == frame.id if len(before) else np.zeros(len(frame), bool)
        way = frame.unwrapped() - (before.unwrapped()[rows] if len(before) else 0.0)
        yield np.where(known, np.linalg.norm(way, axis=1) / (frame.time - before.time), np.nan)


def director(frame):
    return np.linalg.eigh(_order_tensor(frame))[1][:, -1]


def angles_to(axis, frame):
    """Of every rod, in degrees, 0 to 90."""
    return np.degrees(np.arccos(np.minimum(np.abs(frame.axis @ axis), 1.0)))


def _order_tensor(frame):
    mean = frame.axis.T @ frame.axis / max(len(frame), 1)
    if frame.dimensions == 2:
        return 2.0 * mean - np.diag([1.0, 1.0, 0.0])
    return 1.5 * mean - 0.5 * np.eye(3)


def _joined(values):
    return np.concatenate(list(values))
