"""jostle export: the rods of a run in a format that other programs draw.

    export.py --to=FORMAT --out=PLACE -- FOLDER     (an empty PLACE: in FOLDER)

Called by the command, which has read the command line.
"""

import argparse
import importlib

import refusal
from refusal import Refusal

NEEDED = {"numpy": "python3-numpy", "h5py": "python3-h5py"}
# format: module of this folder, what it needs, name of the output in the folder of the run
FORMATS = {
    "gsd": ("gsd_file", {"gsd.hoomd": "python3-gsd"}, "trajectory.gsd"),
    "vtk": ("vtk_files", {}, "vtk"),
    "xyz": ("xyz_file", {}, "trajectory.xyz"),
}


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--to", required=True)
    parser.add_argument("--out", default="")
    parser.add_argument("folder")
    return parser.parse_args()


def export():
    options = arguments()
    if options.to not in FORMATS:
        raise Refusal(f'--to = "{options.to}"', f"there is no such format (allowed: {', '.join(FORMATS)})")
    module, needed, name = FORMATS[options.to]
    refusal.require_modules({**NEEDED, **needed})
    from output_place import place, replaced_file, replaced_folder
    from run_folder import require_run_folder
    from trajectory import Trajectory

    format_module = importlib.import_module(module)
    folder = require_run_folder(options.folder)
    trajectory = Trajectory(folder)
    is_folder = options.to == "vtk"
    target = place(options.out, folder / name, None if is_folder else name)
    with (replaced_folder if is_folder else replaced_file)(target, format_module.is_ours) as temporary:
        format_module.write(temporary, trajectory)
    frames = len(trajectory)
    print(f"{target}: {frames} frame{'s' if frames > 1 else ''}")


if __name__ == "__main__":
    raise SystemExit(refusal.exit_status(export))
