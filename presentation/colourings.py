"""The ways in which the page colours rods, each by one property, with its scale. The first is what the page begins with."""

import numpy as np

from frames_of_page import with_unknown

PLAIN = (87, 140, 191)
TOPS = (15.0, 30.0, 45.0, 60.0, 90.0)  # degrees that the scale of angles may end at
NEMATIC = 0.4                          # order above which there is a director to speak of
OUTLIERS = 2.0                         # percent of the values that a scale leaves out at either end


def colourings(run, packed, frames, cells):
    """Entries for the page; columns that they need are added to `packed`. cells: (generation, age, family) of every frame."""
    properties = _properties(run, frames, cells)
    scales = [_scale(packed, key, *told) for key, told in properties.items()]
    ways = [_direction(), _angle(frames)] if frames[-1].length.any() or run.propelled else []
    if ways and np.linalg.eigvalsh(_order_tensor(frames[-1]))[-1] > NEMATIC:
        ways.reverse()
    plain = {"key": "plain", "label": "one colour", "kind": "plain", "colour": PLAIN}
    if cells:
        family = np.concatenate([of_frame[2] for of_frame in cells])
        packed.add("family", family.astype(np.uint16))
        ways.insert(0, {"key": "family", "label": "family", "kind": "group", "column": "family"})
    elif not ways and "pressure" not in properties:
        ways, plain = [plain], None
    ways += scales + [{"key": "id", "label": "id", "kind": "group"}]
    return ways + ([plain] if plain else [])


def _properties(run, frames, cells):
    """key -> (label, unit, values of all frames, note)."""
    found = {}
    time_factor, time_unit = run.in_unit("time")
    length_unit = run.in_unit("max_overlap")[1]
    if frames[0].pressure is not None:
        factor, unit = run.in_unit("pressure_collision")
        found["pressure"] = ("pressure of the rod", unit, factor * _joined(frame.pressure for frame in frames),
                             "in the step that led to the frame")
    if cells:
        found["generation"] = ("generation", "", _joined(of_frame[0] for of_frame in cells), "")
        found["age"] = ("age", time_unit, time_factor * _joined(of_frame[1] for of_frame in cells), "")
    lengths = _joined(frame.length for frame in frames)
    if np.ptp(lengths) > 0.0:
        found["own_length"] = ("length", length_unit, lengths, "")
    if len(frames) > 1:
        found["speed"] = ("speed", f"{length_unit} per {time_unit}", _joined(speeds(frames)) / time_factor,
                          "displacement since the frame before, over its time")
    return found


def _direction():
    return {"key": "direction", "label": "direction", "kind": "direction"}


def _angle(frames):
    directors = [director(frame) for frame in frames]
    angles = np.degrees(np.arccos(np.minimum(np.abs(frames[-1].axis @ directors[-1]), 1.0)))
    top = next(top for top in TOPS if top >= min(np.percentile(angles, 95) if len(angles) else 0.0, TOPS[-1]))
    return {"key": "angle", "label": "angle to the director", "kind": "angle", "low": 0.0, "high": top, "unit": "°",
            "directors": [[float(value) for value in of_frame] for of_frame in directors]}


def _scale(packed, key, label, unit, values, note):
    """A colour scale; the column holds all values, the scale leaves out the outermost."""
    known = values[np.isfinite(values)]
    least, greatest = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    low, high = np.percentile(known, [OUTLIERS, 100.0 - OUTLIERS]).tolist() if len(known) else (0.0, 1.0)
    low = 0.0 if 0.0 <= low < 0.3 * high else low
    packed.add(key, with_unknown(values, least, greatest))
    return {"key": key, "label": label, "kind": "scale", "column": key, "least": least, "greatest": greatest,
            "low": low, "high": high if high > low else low + 1.0, "unit": unit, "note": note}


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


def _order_tensor(frame):
    return 1.5 * frame.axis.T @ frame.axis / max(len(frame), 1) - 0.5 * np.eye(3)


def _joined(values):
    return np.concatenate(list(values))
