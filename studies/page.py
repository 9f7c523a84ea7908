"""Makes docs/validation from the results of the full studies: one page, and beside it every figure and table."""

import json
import pathlib
import shutil

import report
import runs

LARGEST_FILE = 2_000_000  # bytes
FOLDER = pathlib.Path(__file__).resolve().parent.parent / "docs" / "validation"

HEAD = """# Validation

Is the pressure right, is the anisotropy of the stress, and what does a time step cost? Every figure and number here was made by

    studies/run all
    studies/run page

from runs of the program itself; one study alone by `studies/run NAME`, in a minute or less with `--quick`. Each leaves its runs, a CSV, PNG, SVG and a
verdict in studies/results/NAME, and exits 0 only if every check has passed. References: [studies/reference](../../studies/reference/README.md).
"""


def write(results, names):
    verdicts = []
    for name in names:
        path = results / name / "verdict.json"
        if not path.exists():
            raise runs.RunFailed(f"{path} is missing: studies/run {name} makes it")
        verdicts.append(json.loads(path.read_text(encoding="utf-8")))
    FOLDER.mkdir(parents=True, exist_ok=True)
    for verdict in verdicts:
        folder = results / verdict["study"]
        for picture in verdict["figures"]:
            for ending in (".png", ".svg"):
                file = folder / (picture["file"] + ending)
                if ending == ".png" or file.stat().st_size < LARGEST_FILE:  # pictures of thousands of cells are no vector graphics
                    shutil.copy(file, FOLDER)
        shutil.copy(folder / (verdict["study"] + ".csv"), FOLDER)
    text = "\n".join([HEAD, overview(verdicts), *(section(verdict) for verdict in verdicts)])
    (FOLDER / "README.md").write_text(text, encoding="utf-8")
    print(f"{FOLDER}/README.md")


def overview(verdicts):
    rows = [[f"[{verdict['title']}](#{verdict['study']})", "pass" if verdict["passed"] else "FAIL",
             f"{sum(check['passed'] for check in verdict['checks'])} of {len(verdict['checks'])}", str(verdict["runs"]),
             f"{verdict['rod_steps']:.2e}", runs.duration(verdict["processor_seconds"])] for verdict in verdicts]
    total = sum(verdict["processor_seconds"] for verdict in verdicts)
    versions = sorted({version for verdict in verdicts for version in verdict["versions"]})
    processors = sorted({processor for verdict in verdicts for processor in verdict["processors"]})
    return "\n".join([
        report.markdown({"header": ["study", "verdict", "checks passed", "runs", "rod steps", "time"], "rows": rows}),
        "", f"{runs.duration(total)} of runs in all, one thread each, on {', '.join(processors)}; jostle "
        f"{', '.join(versions)}.", ""])


def section(verdict):
    lines = [f'## <a name="{verdict["study"]}"></a>{verdict["title"]}', "",
             f"`studies/run {verdict['study']}`: **{'pass' if verdict['passed'] else 'FAIL'}**", "", verdict["question"], ""]
    for picture in verdict["figures"]:
        lines += [f"![{picture['caption']}]({picture['file']}.png)", "", picture["caption"], ""]
    for remark in verdict["remarks"]:
        lines += [remark, ""]
    for table in verdict["tables"]:
        lines += [table["caption"], "", report.markdown(table), ""]
    lines += [f"The numbers: [{verdict['study']}.csv]({verdict['study']}.csv).", ""]
    failed = [check for check in verdict["checks"] if not check["passed"]]
    rows = [[check["name"], f"{check['measured']:.6g}", f"{check['expected']:.6g}", f"{check['allowed']:.3g}", check["rule"]]
            for check in failed]
    if failed:
        lines += ["Checks that failed:", "",
                  report.markdown({"header": ["check", "measured", "expected", "allowed", "rule"], "rows": rows}), ""]
    return "\n".join(lines)
