"""jostle report: one page and a set of pictures that show a run.

    report.py --out=FOLDER --width=PIXELS --megabytes=M --frame=N --view=V --colour=C --frames=FILE -- FOLDER

An empty --out: report in the folder of the run. --frames: H5MD to take in the place of the run's trajectory, if not empty.

Called by the command, which has read the command line.
"""

import argparse
import sys

import refusal
from refusal import Refusal

NEEDED = {"numpy": "python3-numpy", "matplotlib": "python3-matplotlib"}
WIDTHS = (100, 8000)
MEGABYTES = (0.1, 1000.0)


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", default="")
    parser.add_argument("--width", default="1600")
    parser.add_argument("--megabytes", default="20")
    parser.add_argument("--frame", default="-1")
    for name in ("view", "colour", "frames"):
        parser.add_argument(f"--{name}", default="")
    parser.add_argument("folder")
    return parser.parse_args()


def width_of(text):
    if not text.isascii() or not text.isdigit() or not WIDTHS[0] <= int(text) <= WIDTHS[1]:
        raise Refusal(f"--width = {text}", f"is no such number of pixels (allowed: {WIDTHS[0]} to {WIDTHS[1]})")
    return int(text)


def megabytes_of(text):
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not MEGABYTES[0] <= number <= MEGABYTES[1]:
        raise Refusal(f"--megabytes = {text}", f"is no such size (allowed: {MEGABYTES[0]:g} to {MEGABYTES[1]:g})")
    return number


def is_ours(folder):
    """Whether the folder holds a report and nothing that would be lost with it."""
    import page

    names = {path.name for path in folder.iterdir()}
    marked = page.NAME in names and page.MARK in (folder / page.NAME).read_text(encoding="utf-8", errors="replace")
    return marked and all(name == page.NAME or name.endswith((".png", ".pov")) for name in names)


def rods_of(run, megabytes, seen, frames):
    """The rods that turn, or None, and what there is to say about them."""
    try:
        refusal.require_modules({"h5py": "python3-h5py"})
        from trajectory import Trajectory
        trajectory = Trajectory(run.folder, frames)
    except Refusal as reason:
        return None, [f"No view of the rods: {reason}"]
    if trajectory.counts()[-1] == 0:
        return None, ["No view of the rods: the last frame of the trajectory has none"]
    import rods_of_page
    rods = rods_of_page.rods_of(run, trajectory, megabytes, rods_of_page.Seen(*seen))
    if frames and not (run.folder / "trajectory.journal").exists():
        rods.notes.append("The run kept no trajectory: shown are the rods of its last checkpoint.")
    return rods, rods.notes


def still_of(run, rods, folder, width):
    """(file name, caption) of the picture of the rods, or None, and why there is none."""
    import rod_colours
    import rods_view

    frame, way = rods.frames[rods.start], rods.ways[0]
    factor, unit = run.in_unit("time")
    time = " ".join(part for part in (f"{factor * frame.time:.4g}", unit) if part)
    missing = rods_view.draw(frame, folder, width, rods.camera, rod_colours.of_frame(way, rods.frames, rods.start), way,
                             run.propelled, f"time {time}", fixed=rods.fixed)
    if missing:
        return None, [f"No still picture of the rods: {missing}"]
    return (rods_view.PICTURE, f"The {len(frame)} rods at time {time}, as spherocylinders"), []


def colony_of(run, rods):
    """Curves and numbers of a colony."""
    import colony
    import curves

    factor, _ = run.in_unit("time")
    ages = [factor * age for _, age, _ in rods.cells] if rods and rods.cells else None
    of_frames = colony.curves(run, rods.frames, ages) if rods else []
    made = curves.chosen(run)
    made[1:1] = of_frames[:1]
    made[3:3] = of_frames[1:]
    return made, colony.tiles(run, rods, made)


def report():
    options = arguments()
    width, megabytes = width_of(options.width), megabytes_of(options.megabytes)
    refusal.require_modules({"numpy": "python3-numpy"})
    from output_place import beside, keep_temporary_files_in, place, replaced_folder
    from run_folder import read_run

    run = read_run(options.folder)
    target = place(options.out, run.folder / "report")
    with replaced_folder(target, is_ours) as folder, beside(target) as scratch:
        keep_temporary_files_in(scratch)
        refusal.require_modules(NEEDED)
        import curves
        import page
        import plots
        import viewer_parts
        rods, notes = rods_of(run, megabytes, (options.frame, options.view, options.colour), options.frames)
        still, missing = still_of(run, rods, folder, width) if rods else (None, [])
        drawn, tiles = colony_of(run, rods) if run.is_colony else (curves.chosen(run), page.average_tiles(run))
        for curve in drawn:
            plots.draw(curve, run.in_unit("time")[1], folder)
        notes += missing + ([] if viewer_parts.plotting() else [viewer_parts.MISSING])
        (folder / page.NAME).write_text(page.text(run, folder, drawn, still, rods, tiles, notes), encoding="utf-8",
                                        errors="replace")  # the name of a folder may be no UTF-8
    for note in notes:
        print(f"jostle: {refusal.on_one_line(note)}", file=sys.stderr)
    print(target / page.NAME)


if __name__ == "__main__":
    raise SystemExit(refusal.exit_status(report))
