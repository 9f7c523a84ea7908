"""`jostle movie`: every frame once, one camera, playable; `jostle report` from a frame, a side and with colours of one's choice."""

import json
import re
import shutil
import subprocess

import numpy as np
from matplotlib import image

from jostle_command import command, require_one_line, snapshot

SIZE = (160, 120)


def movie(folder, *options):
    return command(folder, "movie", "run", "--size", "{}x{}".format(*SIZE), *options)


def contents(folder):
    """All but the folders themselves, in which something lay for a while."""
    return {name: told for name, told in snapshot(folder).items() if told[0] != "folder"}


def pictures_of(film, folder):
    """(pictures, height, width, 3) of a film."""
    folder.mkdir()
    subprocess.run(["ffmpeg", "-loglevel", "error", "-i", film, folder / "%03d.png"], check=True, timeout=60)
    return np.array([image.imread(path)[:, :, :3] for path in sorted(folder.glob("*.png"))])


def test_a_film_has_every_frame(finished_copy):
    result = movie(finished_copy, "--fps", "5")
    assert result.returncode == 0, result.stderr
    film = finished_copy / "run/movie.mp4"
    assert result.stdout == "run/movie.mp4: 9 pictures, 1.8 s\n" and not list((finished_copy / "run").glob(".*"))
    told = json.loads(subprocess.run(["ffprobe", "-v", "error", "-show_streams", "-of", "json", film], check=True,
                                     capture_output=True, text=True, timeout=60).stdout)["streams"][0]
    assert (told["width"], told["height"], told["codec_name"], told["r_frame_rate"]) == (*SIZE, "h264", "5/1")
    pictures = pictures_of(film, finished_copy / "pictures")
    assert len(pictures) == 9
    moved = [np.abs(after - before).mean() for before, after in zip(pictures, pictures[1:])]
    assert min(moved) > 0.002  # rods move from each to the next
    # The camera does not: corners stay white, and the strip below tells one scale.
    assert pictures[:, :5, :5].min() > 0.9 and np.ptp(pictures[:, -8:, 60:120].mean(axis=(1, 2, 3))) < 0.01


def test_what_a_film_refuses(finished_copy):
    (finished_copy / "mine.mp4").write_text("keep")
    before = contents(finished_copy)
    require_one_line(movie(finished_copy, "--fps", "0"), "--fps = 0", "1 to 120")
    require_one_line(movie(finished_copy, "--colour", "red"), "red", "direction")
    require_one_line(movie(finished_copy, "--view", "up"), "up", "x, y, z")
    require_one_line(command(finished_copy, "movie", "run", "--size", "big"), "big", "1280x720")
    require_one_line(movie(finished_copy, "--out", "mine.mp4"), "is not replaced")
    assert contents(finished_copy) == before


def test_a_page_from_a_chosen_frame(finished_copy):
    shown = {}
    for name, options in {"last": (), "first": ("--frame", "0", "--view", "x", "--colour", "plain")}.items():
        assert command(finished_copy, "report", "run", "--width", "120", *options).returncode == 0
        shown[name] = (finished_copy / "run/report/report.html").read_text()
        shutil.copy(finished_copy / "run/report/view.png", finished_copy / f"{name}.png")
    starts = [int(re.search(r'"start": (\d+)', shown[name])[1]) for name in ("last", "first")]
    assert starts == [8, 0]
    assert re.search(r'"colourings": \[\{"key": "(\w+)"', shown["first"])[1] == "plain"
    assert re.search(r'"camera": \{"back": \[([^\]]*)\]', shown["first"])[1].startswith("1.0, ")
    stills = [(finished_copy / f"{name}.png").read_bytes() for name in shown]
    assert len(set(stills)) == 2
