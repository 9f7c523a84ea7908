"""Units as people write them: µ D³/kT, not kT-1 D3 mu."""

NAMES = {"mu": "µ", "um": "µm", "length_unit": "ℓ", "viscosity_unit": "η", "time_unit": "τ"}
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
ORDER = ("mu", "viscosity_unit", "pN", "kT")  # these first


def readable(unit, scene):
    """(factor, unit) for a unit as the files write it: a number times the factor is in the unit, which is "" for 1."""
    factors = _factors(unit)
    rate = scene.get("growth", {}).get("rate", 0)
    times = factors.pop("time_unit", 0)
    if not rate or not times:
        return 1.0, text(unit)
    # The time that cells without much noise know is what they need to lengthen by D.
    for name, power in (("D", times), ("growth rate", -times)):
        factors[name] = factors.get(name, 0) + power
    return (rate / scene["rods"]["diameter"]) ** times, _text(factors)


def text(unit):
    """kT-1 D3 mu as it is printed: µ D³/kT."""
    return _text(_factors(unit))


def superscript(number):
    return str(number).translate(RAISED)


def with_unit(words, unit):
    """A number or a label and its unit."""
    return f"{words} ({unit})" if unit else words


def _text(factors):
    ordered = sorted(factors, key=lambda name: ORDER.index(name) if name in ORDER else len(ORDER))
    above = [_power(name, factors[name]) for name in ordered if factors[name] > 0]
    below = [_power(name, -factors[name]) for name in ordered if factors[name] < 0]
    under = " ".join(below)
    if not below:
        return " ".join(above)
    return (" ".join(above) or "1") + "/" + (f"({under})" if len(below) > 1 else under)


def _factors(unit):
    factors = {}
    for factor in unit.split():
        name = factor.rstrip("-0123456789")
        if name:
            factors[name] = int(factor[len(name):] or 1)
    return factors


def _power(name, power):
    return NAMES.get(name, name) + (superscript(power) if power != 1 else "")
