"""jostle movie: the frames of a run as a film, seen by one camera and coloured on one scale.

    movie.py --out=FILE --view=V --colour=C --size=WIDTHxHEIGHT --fps=N --frames=FILE -- FOLDER

Empty --out: movie.mp4 in the folder of the run. --view: empty, x, y or z. Called by the command, which has read the command line.
"""

import argparse
import dataclasses
import re
import shutil
import sys

import refusal
from refusal import Refusal

NEEDED = {"numpy": "python3-numpy", "matplotlib": "python3-matplotlib", "h5py": "python3-h5py"}
MARK = "made by jostle movie"
NAME = "movie.mp4"


def arguments():
    parser = argparse.ArgumentParser()
    for name in ("out", "view", "colour", "frames"):
        parser.add_argument(f"--{name}", default="")
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--fps", default="12")
    parser.add_argument("folder")
    return parser.parse_args()


def size_of(text):
    found = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text)
    width, height = map(int, found.groups()) if found else (0, 0)
    if not (100 <= width <= 8000 and 100 <= height <= 8000):
        raise Refusal(f"--size = {text}", "is no such size (allowed: 100x100 to 8000x8000)", "Write it as 1280x720")
    return width, height


def rate_of(text):
    if not text.isascii() or not text.isdigit() or not 1 <= int(text) <= 120:
        raise Refusal(f"--fps = {text}", "is no such number of pictures a second (allowed: 1 to 120)")
    return text


def is_ours(path):
    return MARK.encode() in path.read_bytes()


def programs():
    missing = [name for name in ("povray", "ffmpeg") if shutil.which(name) is None]
    if missing:
        raise Refusal(" and ".join(missing), "is not installed" if len(missing) == 1 else "are not installed",
                      "Run: apt-get install " + " ".join(missing))


def all_frames(frames):
    """One frame with the rods of all of them, for a camera that sees every one."""
    import numpy as np

    joined = {name: np.concatenate([getattr(frame, name) for frame in frames])
              for name in ("id", "centre", "image", "axis", "length", "diameter")}
    return dataclasses.replace(frames[-1], edges=np.max([frame.edges for frame in frames], axis=0), **joined)


def draw_frames(run, rods, way, camera, width, folder):
    """Pictures 00000.png and so on in the folder."""
    import rod_colours
    import rods_view

    factor, unit = run.in_unit("time")
    for number, frame in enumerate(rods.frames):
        if sys.stderr.isatty():
            print(f"\rpicture {number + 1} of {len(rods.frames)}", end="", file=sys.stderr)
        missing = rods_view.draw(frame, folder, width, camera, rod_colours.of_frame(way, rods.frames, number), way, run.propelled,
                                 f"time {factor * frame.time:.4g} {unit}", f"{number:05d}.png", fixed=rods.fixed)
        if missing:
            raise Refusal(run.folder, f"frame {number} cannot be drawn: {missing}")
    if sys.stderr.isatty():
        print(file=sys.stderr)


def movie():
    options = arguments()
    (width, height), rate = size_of(options.size), rate_of(options.fps)
    programs()
    refusal.require_modules({"numpy": "python3-numpy"})
    from output_place import beside, keep_temporary_files_in, place, replaced_file
    from run_folder import read_run

    run = read_run(options.folder)
    target = place(options.out, run.folder / NAME, NAME)
    with replaced_file(target, is_ours) as temporary, beside(target) as folder:
        keep_temporary_files_in(folder)
        refusal.require_modules(NEEDED)
        import child_program
        import povray_scene
        import rods_of_page
        import rods_view
        from trajectory import Trajectory

        rods = rods_of_page.frames_of(run, Trajectory(run.folder, options.frames))
        way = rods_of_page.way_of(rods, options.colour)
        picture = height - round(rods_view.LEGEND * width)  # without the strip
        camera = povray_scene.Camera(all_frames(rods.frames), rods_of_page.view_of(options.view), width / max(picture, 1))
        draw_frames(run, rods, way, camera, width, folder)
        status, errors = child_program.run(
            [shutil.which("ffmpeg"), "-y", "-loglevel", "error", "-framerate", rate, "-i", "%05d.png", "-vf",
             "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
             "-metadata", f"comment={MARK}", "-f", "mp4", str(temporary.absolute())], folder)
        if status != 0:
            raise Refusal(target, f"ffmpeg failed with status {status}: {(errors.strip().splitlines() or ['no message'])[-1]}")
    print(f"{target}: {len(rods.frames)} pictures, {len(rods.frames) / int(rate):.3g} s")


if __name__ == "__main__":
    raise SystemExit(refusal.exit_status(movie))
