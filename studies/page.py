"""Makes docs/validation from the results of full studies: one page, and beside it every figure and table.

Studies without results keep what the page says of them.
"""

import json
import pathlib
import re
import shutil

import report
import runs

LARGEST_FILE = 2_000_000  # bytes
FOLDER = pathlib.Path(__file__).resolve().parent.parent / "docs" / "validation"

HEAD = """# Validation

Is the pressure right, is the anisotropy of the stress, and what does a time step cost? Every figure and number here was made by

    studies/run all
    studies/run self_propelled
    studies/run colony
    studies/run page

from runs of the program itself; one study alone by `studies/run NAME`, in a minute or less with `--quick` (self_propelled: some minutes). Each leaves its runs, a CSV, PNG, SVG and a
verdict in studies/results/NAME, and exits 0 only if every check has passed.

- **Solver.** Steps of passive rods are solved to `solver.tolerance` = 1e-4 D, ten times finer than by default: a four hundredth of the default step.
- **Drag.** `capsule` ([decision 0028](../decisions/0028-capsule-drag.md)), where a study names no other.
- **Steps.** Reflected ([decision 0061](../decisions/0061-reflected-steps.md)), with arms of contacts half way ([decision 0083](../decisions/0083-arms-half-way.md)); the default rms step is 0.04 D, and 0.025 D where rods order ([decision 0087](../decisions/0087-shorter-steps-where-rods-order.md)).
- **Errors** are standard errors; twice them covers 95 %. Those of the program follow the order ([decision 0082](../decisions/0082-error-bars-follow-the-order.md)). A run that is too short for one has that of 16 blocks, and its section says so.
- **Builds.** All studies are by 20ac64fa60b0. Commits after it change no step, only how long a window has to be for an error bar ([decision 0026](../decisions/0026-clocks.md)).
- **Times** are of shared machines, at times four times slower than alone: the colony, here more than two hours, takes 34 minutes in a quiet one ([decision 0043](../decisions/0043-momentum-in-crowds.md)).
- **More.** Mixtures, very long rods, the steps of swimmers and of soft rods: [beside the studies](beside_the_studies.md). Walls, planes, forces, flow and pressure: [row by row](set_ups.md). References: [studies/reference](../../studies/reference/README.md).
"""

# How a section begins: what the overview is made of.
TITLE = re.compile(r'## <a name="(?P<name>\w+)"></a>(?P<title>.*)\n\n'
                   r"`studies/run \w+`: \*\*(?P<verdict>\w+)\*\*, (?P<checks>\d+ of \d+) checks\. "
                   r"Runs: (?P<runs>\d+), rod steps (?P<rod_steps>\S+), processor time (?P<time>.+?), "
                   r"on (?P<machine>.+?); jostle (?P<version>.+?)\.\n")


def write(results, names):
    """Renews what there are results of."""
    paths = [path for path in (results / name / "verdict.json" for name in names) if path.exists()]
    if not paths:
        raise runs.RunFailed(f"no full study has been run: studies/run {names[0]} makes {results / names[0] / 'verdict.json'}")
    verdicts = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    for verdict in verdicts:
        folder = results / verdict["study"]
        for picture in verdict["figures"]:
            for ending in (".png", ".svg"):
                file = folder / (picture["file"] + ending)
                if ending == ".png" or file.stat().st_size < LARGEST_FILE:  # pictures of thousands of cells are no vector graphics
                    shutil.copy(file, FOLDER)
        shutil.copy(folder / (verdict["study"] + ".csv"), FOLDER)
    page = FOLDER / "README.md"
    page.write_text(renewed(page.read_text(encoding="utf-8"), verdicts, names), encoding="utf-8")
    print(page)


def renewed(page, verdicts, names):
    """The page with the sections of these verdicts in place of theirs."""
    sections = {TITLE.match(text)["name"]: text for text in re.split(r"\n(?=## <a name)", page)[1:]}
    sections |= {verdict["study"]: section(verdict) for verdict in verdicts}
    texts = [sections[name] for name in names if name in sections]
    return "\n".join([HEAD, overview(texts), *texts])


def overview(sections):
    begins = [TITLE.match(text) for text in sections]
    rows = [[f"[{begin['title']}](#{begin['name']})", *begin.group("verdict", "checks", "runs", "rod_steps", "time", "machine", "version")]
            for begin in begins]
    return report.markdown({"header": ["study", "verdict", "checks passed", "runs", "rod steps", "processor time", "machine", "jostle"],
                            "rows": rows}) + "\n"


def section(verdict):
    passed = sum(check["passed"] for check in verdict["checks"])
    lines = [f'## <a name="{verdict["study"]}"></a>{verdict["title"]}', "",
             f"`studies/run {verdict['study']}`: **{'pass' if verdict['passed'] else 'FAIL'}**, {passed} of {len(verdict['checks'])} checks. "
             f"Runs: {verdict['runs']}, rod steps {verdict['rod_steps']:.2e}, processor time "
             f"{'more than ' if verdict.get('killed') else ''}{runs.duration(verdict['processor_seconds'])}, "
             f"on {', '.join(verdict['processors'])}; jostle {', '.join(verdict['versions'])}.", "", verdict["question"], ""]
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
