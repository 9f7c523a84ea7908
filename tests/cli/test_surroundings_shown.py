"""Fixed rods and walls in exports, pages and stills."""

import gsd.hoomd
import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import browser as browsers
from browser import Browser, differing, painted
from jostle_command import DONE, RODS, changed, command, finish, write_scene

HEADER = "x,y,z,nx,ny,nz,length,diameter"
FIXED = [HEADER, "1,1,1,0,0,1,1,1.5", "7,-1,4,1,0,0,0,2"]  # the second reaches in through a periodic face


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Rods in a slit, among two that stand still."""
    folder = tmp_path_factory.mktemp("slit")
    scene = changed(RODS, rods={"fixed": "fixed.csv", "count": 20}, box={"volume_fraction": None, "edges": [8.0, 9.0, 10.0],
                                                                        "periodic": [True, True, False]},
                    walls={"faces": [False, False, True]}, output={"trajectory_every": 100})
    write_scene(folder, scene)
    (folder / "fixed.csv").write_text("\n".join(FIXED) + "\n")
    return finish(folder)


def export(run, form):
    result = command(run.parent, "export", run.name, "--to", form)
    assert result.returncode == DONE and result.stderr == "", result.stderr


def lines_of(path):
    """(K, 2, 3) ends of the lines in a VTK file, and its arrays of points."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    points = vtk_to_numpy(data.GetPoints().GetData())
    arrays = {data.GetPointData().GetArrayName(k): vtk_to_numpy(data.GetPointData().GetArray(k))
              for k in range(data.GetPointData().GetNumberOfArrays())}
    return points.reshape(-1, 2, 3), arrays


def test_gsd_has_fixed_rods_as_types_of_their_own(run):
    export(run, "gsd")
    with gsd.hoomd.open(name=str(run / "trajectory.gsd"), mode="rb") as frames:
        for frame in frames:
            rods = frame.particles
            assert rods.N == 22 and list(frame.log["particles/id"][20:]) == [-1, -1]
            assert [rods.types[k] for k in rods.typeid[20:]] == ["fixed rod 1 x 1.5", "fixed rod 0 x 2"]
            assert not rods.types[rods.typeid[0]].startswith("fixed")
            middle = 0.5 * np.array([8, 9, 10])
            assert np.allclose(rods.position[20:], [[1, 1, 1] - middle, [7, 8, 4] - middle], atol=1e-6)
            assert list(rods.diameter[20:]) == [1.5, 2.0]


def test_vtk_has_them_and_the_walls_in_files_of_their_own(run):
    export(run, "vtk")
    ends, arrays = lines_of(run / "vtk/fixed.vtp")
    assert np.allclose(ends[0], [[1, 1, 0.5], [1, 1, 1.5]]) and np.allclose(arrays["radius"], [0.75, 0.75, 1, 1])
    walls, _ = lines_of(run / "vtk/walls.vtp")
    assert len(walls) == 8 and sorted(set(walls[:, :, 2].ravel())) == [0, 10]
    assert len(lines_of(run / "vtk/frame_000000.vtp")[0]) == 20
    export(run, "vtk")  # in the place of the first


def test_xyz_names_them(run):
    export(run, "xyz")
    lines = (run / "trajectory.xyz").read_text().splitlines()
    assert lines[0] == "22" and [line.split()[0] for line in lines[2:24]] == ["X"] * 20 + ["F"] * 2
    assert [line.split()[-1] for line in lines[22:24]] == ["-1", "-1"]


def test_the_page_draws_both(run, tmp_path):
    result = command(run.parent, "report", run.name, "--width", "120")
    assert result.returncode == DONE, result.stderr
    still = (run / "report/view.pov").read_text()
    assert still.count("<0.16,0.2,0.26>") == 8 and still.count("<0.45,0.45,0.45>") == 2
    browser = Browser(tmp_path, *browsers.WEBGL)
    try:
        browser.open(run / "report/report.html")
        assert browser.run("return JSON.parse(document.getElementById('run').textContent).fixed.counts") == [2]
        assert browser.run("return JSON.parse(document.getElementById('run').textContent).walls.counts") == [8]
        browser.wait("return document.querySelector('#view canvas').dataset.drawn === 'still'")
        both = browser.pixels("#view .stage")
        grey = (np.abs(both - both.mean(axis=2, keepdims=True)).max(axis=2) < 0.04) & painted(both)
        assert grey.mean() > 0.01  # the fixed rods
        browser.run("document.querySelector('.box input').click(); document.querySelector('#view canvas').dataset.drawn = ''")
        browser.wait("return document.querySelector('#view canvas').dataset.drawn === 'still'")
        assert differing(both, browser.pixels("#view .stage")) > 0.005  # box and walls
        assert browser.errors() == []
    finally:
        browser.close()
