"""jostle report: one page and a set of pictures that show a run.

    report.py --out=FOLDER --width=PIXELS -- FOLDER     (an empty --out: report in the folder of the run)

Called by the command, which has read the command line.
"""

import argparse
import sys

import refusal
from refusal import Refusal

NEEDED = {"numpy": "python3-numpy", "matplotlib": "python3-matplotlib"}
WIDTHS = (100, 8000)


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", default="")
    parser.add_argument("--width", default="1600")
    parser.add_argument("folder")
    return parser.parse_args()


def width_of(text):
    if not text.isascii() or not text.isdigit() or not WIDTHS[0] <= int(text) <= WIDTHS[1]:
        raise Refusal(f"--width = {text}", f"is no such number of pixels (allowed: {WIDTHS[0]} to {WIDTHS[1]})")
    return int(text)


def is_ours(folder):
    """Whether the folder holds a report and nothing that would be lost with it."""
    import page

    names = {path.name for path in folder.iterdir()}
    marked = page.NAME in names and page.MARK in (folder / page.NAME).read_text(encoding="utf-8", errors="replace")
    return marked and all(name == page.NAME or name.endswith((".png", ".pov")) for name in names)


def view_of(run, folder, width):
    """(file name, caption) of the picture of the rods, or None, and why there is none."""
    try:
        refusal.require_modules({"h5py": "python3-h5py"})
        from trajectory import Trajectory
        trajectory = Trajectory(run.folder)
        frame = trajectory.frame(len(trajectory) - 1)
    except Refusal as reason:
        return None, str(reason)
    if len(frame) == 0:
        return None, "the last frame of the trajectory has no rods"
    import rods_view
    missing = rods_view.draw(frame, folder, width, run.propelled)
    if missing:
        return None, missing
    time = " ".join(part for part in (f"{frame.time:.4g}", run.unit("time")) if part)
    return (rods_view.PICTURE, f"The {len(frame)} rods at time {time}, as spherocylinders"), ""


def report():
    options = arguments()
    width = width_of(options.width)
    refusal.require_modules(NEEDED)
    import page
    import plots
    from output_place import place, replaced_folder
    from run_folder import read_run

    run = read_run(options.folder)
    target = place(options.out, run.folder / "report")
    with replaced_folder(target, is_ours) as folder:
        view, missing = view_of(run, folder, width)
        notes = [f"No view of the rods: {missing}"] if missing else []
        pictures = [(plots.draw(plot, run, folder), plot.title) for plot in plots.chosen(run)]
        (folder / page.NAME).write_text(page.text(run, folder, pictures, view, notes), encoding="utf-8")
    for note in notes:
        print(f"jostle: {note}", file=sys.stderr)
    print(target / page.NAME)


if __name__ == "__main__":
    raise SystemExit(refusal.exit_status(report))
