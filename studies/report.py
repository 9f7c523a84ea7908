"""What a study concludes: checks with pass and fail, tables, figures; written as JSON, CSV, PNG and SVG."""

import dataclasses
import json
import math

import figures
import runs


@dataclasses.dataclass
class Check:
    """One comparison: passed if measured and expected differ by no more than `allowed`."""

    name: str
    measured: float
    expected: float
    allowed: float
    rule: str  # how `allowed` comes about, in words

    @property
    def passed(self):
        return bool(abs(self.measured - self.expected) <= self.allowed)  # not so for nan


class Report:
    """Filled by a study's `evaluate`."""

    def __init__(self, name, title, question, folder):
        self.name, self.title, self.question, self.folder = name, title, question, folder
        self.checks, self.tables, self.pictures, self.remarks = [], [], [], []

    def compare(self, name, measured, expected, relative, errors=2.0):
        """Checks (mean, standard error) against (value, error): |mean - value| <= relative |value| + errors times the combined
        standard error."""
        allowed = relative * abs(expected[0]) + errors * math.hypot(measured[1], expected[1])
        rule = (f"{100 * relative:g} % + " if relative else "") + f"{errors:g} combined standard errors"
        self.checks.append(Check(name, float(measured[0]), float(expected[0]), float(allowed), rule))
        return self.checks[-1].passed

    def require(self, name, measured, lower=-math.inf, upper=math.inf):
        """Checks that a number lies between bounds."""
        nearest = min(max(measured, lower), upper)
        words = " and ".join(f"{word} {bound:g}" for word, bound in (("at least", lower), ("at most", upper))
                             if math.isfinite(bound))
        self.checks.append(Check(name, float(measured), float(nearest), 0.0, words))
        return self.checks[-1].passed

    def table(self, caption, header, rows):
        """A table of texts; `rows` may hold anything that has a text."""
        self.tables.append({"caption": caption, "header": header, "rows": [[str(cell) for cell in row] for row in rows]})

    def numbers(self, header, rows, name=None):
        """The numbers behind it, as CSV."""
        runs.write_csv(self.folder / f"{name or self.name}.csv", header, rows)

    def figure(self, figure, caption, name=None):
        figures.save(figure, self.folder / (name or self.name))
        self.pictures.append({"file": name or self.name, "caption": caption})

    def remark(self, text):
        """A paragraph of what was found."""
        self.remarks.append(text)

    @property
    def passed(self):
        return bool(self.checks) and all(check.passed for check in self.checks)

    def write(self, all_runs, quick):
        """verdict.json: everything that the validation page shows."""
        records = [run.record for run in all_runs]
        sessions = [session for record in records for session in record["sessions"]]
        verdict = {
            "study": self.name,
            "title": self.title,
            "question": self.question,
            "quick": quick,
            "passed": self.passed,
            "checks": [{"name": check.name, "passed": check.passed, "measured": check.measured,
                        "expected": check.expected, "allowed": check.allowed, "rule": check.rule}
                       for check in self.checks],
            "remarks": self.remarks,
            "tables": self.tables,
            "figures": self.pictures,
            "runs": len(all_runs),
            "steps": sum(record["steps"] for record in records),
            "rod_steps": sum(run.record["steps"] * run.summary["rods"] for run in all_runs),
            "processor_seconds": round(sum(session["wall_seconds"] * session["threads"] for session in sessions), 1),
            "killed": any(run.killed for run in all_runs),
            "processors": sorted({session["processor"] for session in sessions}),
            "versions": sorted({f"{record['version']} ({record['git']})" for record in records}),
        }
        (self.folder / "verdict.json").write_text(json.dumps(verdict, indent=1) + "\n", encoding="utf-8")

    def text(self):
        """What the terminal shows."""
        lines = [f"\n{self.title}\n"]
        for table in self.tables:
            lines += [table["caption"], markdown(table), ""]
        lines += [f"{remark}\n" for remark in self.remarks]
        failed = [check for check in self.checks if not check.passed]
        lines += [f"FAILED  {check.name}: {check.measured:.6g} against {check.expected:.6g}, allowed {check.allowed:.3g} "
                  f"({check.rule})" for check in failed]
        lines.append(f"{len(self.checks) - len(failed)} of {len(self.checks)} checks passed: "
                     f"{'PASS' if self.passed else 'FAIL'}")
        return "\n".join(lines)


def markdown(table):
    """A table as Markdown, columns aligned to the right."""
    rows = [table["header"], *table["rows"]]
    widths = [max(len(row[k]) for row in rows) for k in range(len(table["header"]))]
    lines = ["| " + " | ".join(cell.rjust(width) for cell, width in zip(row, widths)) + " |" for row in rows]
    lines.insert(1, "|" + "|".join("-" * (width + 1) + ":" for width in widths) + "|")
    return "\n".join(lines)


def with_error(value, error, digits=3, sign="-"):
    """In brackets where there is no error; `sign` "+": also of positive values."""
    text = f"{value:{sign}.{digits}f}"
    return f"({text})" if math.isnan(error) else f"{text} +- {error:.{digits}f}"


def per_cent(value, expected, error):
    difference = f"{100 * (value / expected - 1):+.2f}"
    return f"({difference})" if math.isnan(error) else f"{difference} +- {100 * error / expected:.2f}"
