"""[pressure]: runs that go on to the same bits, and what they leave."""

import json
import signal

from jostle_command import (DONE, RODS, STOPPED, changed, column, command, finish, kill, require_same_results, rows_of, start,
                            wait_until, with_steps, write_scene)

PRESSED = changed(RODS, pressure={"external": 0.8})


def test_stopped_and_resumed(tmp_path):
    scene = changed(with_steps(PRESSED, 500), output={"series_every": 1, "checkpoint_every": 40})
    write_scene(tmp_path / "whole", scene)
    whole = finish(tmp_path / "whole")
    volume = column(whole / "series.csv", "volume")
    assert len(set(volume)) == len(volume) - 1 or len(set(volume)) == len(volume)  # it stays in the first step alone
    summary = json.loads((whole / "summary.json").read_text())
    assert summary["pressure_control"]["external"]["value"] == 0.8
    folder = tmp_path / "parts"
    write_scene(folder, scene)
    for rows, number, status in ((60, signal.SIGTERM, STOPPED), (250, signal.SIGKILL, -signal.SIGKILL)):
        process = start(folder)
        wait_until(lambda rows=rows: rows_of(folder / "run/series.csv") > rows, process)
        assert kill(process, number)[0] == status
        assert command(folder, "verify", "run").returncode == DONE
    require_same_results(finish(folder, threads=2), whole, same_command=False)


def test_a_limit_ends_the_run(tmp_path):
    write_scene(tmp_path, changed(PRESSED, pressure={"external": 5.0, "limit_volume_fraction": 0.27}))
    folder = finish(tmp_path)
    assert column(folder / "series.csv", "phi")[-1] > 0.26
    assert json.loads((folder / "summary.json").read_text())["rods"] == 50
