"""What is to be thought of a run, in a few lines: (state, words, more), state good, bad, or open where nothing can be said."""

EQUILIBRIUM = {"reached": ("good", "Equilibrium was reached"), "not reached": ("bad", "Equilibrium was not reached"),
               "too short to tell": ("bad", "Too short to tell whether this is equilibrium"),
               "not checked": ("open", "Whether this is equilibrium was not checked")}
# What equilibrium demands: as it is told where a run agrees, disagrees, and has no error bar to judge by.
CHECKS = {"total_stress_ratio": ("The whole stress is isotropic", "The whole stress is not isotropic",
                                 "Whether the whole stress is isotropic cannot be told"),
          "collision_stress_ratio": ("The collision stress fits the order", "The collision stress does not fit the order",
                                     "Whether the collision stress fits the order cannot be told")}
JUDGED = {True: "good", False: "bad", None: "open"}


def verdict(run):
    if run.record.get("exit_reason") == "extinct":
        return [("bad", "All cells have died", "there are no averages")]
    if not run.summary:
        return [("open", "The run is not done", "there are no averages yet")]
    if run.is_colony:
        lines = [("open", "Cells multiply", "no state lasts, so there are no averages")]
    else:
        lines = [_equilibrium(run), *_checks(run)]
    return lines + [_overlap(run)]


def _equilibrium(run):
    told = run.summary.get("equilibrium", {})
    known = "reached" if run.summary.get("equilibrated", True) else "not reached"
    state, words = EQUILIBRIUM[told.get("verdict", known)]
    if run.propelled:
        words = words.replace("Equilibrium", "A steady state").replace("equilibrium", "a steady state")
    factor, unit = run.in_unit("time")
    begin, end = factor * run.summary["equilibration_time"], factor * run.summary["time"]
    window = f"averages over times {begin:.3g} to {end:.4g} {unit}".strip()
    reason = told.get("in_words", "").partition(": ")[2] or ("use none of the averages" if state == "bad" else "")
    return (state, words, f"{reason}; {window}" if reason else window)


def _checks(run):
    for name, words in CHECKS.items():
        check = run.summary.get("checks", {}).get(name)
        if check is None:
            continue
        measured, error = check["measured"]["mean"], check["measured"].get("standard_error")
        if measured is None:
            continue
        state = JUDGED[check.get("agree")]
        ratio = f"{measured:.4g}" + ("" if error is None else f" ± {error:.2g}")
        yield (state, words[list(JUDGED.values()).index(state)],
               f"ratio along/across the director, measured: {ratio}; in equilibrium: {expected_range(check)}")


def expected_range(check):
    """The ratio in equilibrium, or from where to where it may be."""
    ends = [check["in_equilibrium"][end] for end in ("from", "to")]
    return "–" if None in ends else " to ".join(dict.fromkeys(f"{end:.4g}" for end in ends))


def _overlap(run):
    limit = run.scene.get("contact", {}).get("overlap_limit", 0.2)
    return ("good", f"Largest overlap {run.summary['max_overlap']:.2g} D", f"a run ends above {limit:g} D")
