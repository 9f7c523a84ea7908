"""VTK XML for ParaView: trajectory.pvd names one .vtp file a frame with its time; each rod is a line of two points.

Arrays of lines: id, length, diameter, axis. Of points: radius, for tubes and spheres. view.py, run by ParaView, draws
the rods as spherocylinders. Where the box changes, box.pvd names its edges likewise, one file a frame. fixed.vtp holds rods that
nothing moves, walls.vtp lines for the walls of the last frame.
"""

import base64
import re

import numpy as np

MARK = "<!-- made by jostle export -->"
COLLECTION, BOX, VIEW, FIXED, WALLS = "trajectory.pvd", "box.pvd", "view.py", "fixed.vtp", "walls.vtp"
OUR_NAMES = re.compile(r"(trajectory|box)\.pvd|view\.py|(fixed|walls)\.vtp|(frame|box)_\d{6,}\.vtp")
KINDS = {"f4": "Float32", "i8": "Int64"}

VIEW_PROGRAM = '''# Draws the run in ParaView: Tools > Python Shell > Run Script, or paraview --script=view.py here.
import os
from paraview.simple import *

folder = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
rods = PVDReader(registrationName="rods", FileName=os.path.join(folder, "trajectory.pvd"))
view = GetActiveViewOrCreate("RenderView")
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()

def spherocylinders(source, name, colour):
    """Tubes, and balls at their ends: a scaled capsule would have the wrong caps."""
    tubes = Tube(registrationName=name + " cylinders", Input=source, Scalars=["POINTS", "radius"], VaryRadius="By Absolute Scalar",
                 NumberofSides=20, Capping=0)
    balls = Glyph(registrationName=name + " caps", Input=source, GlyphType="Sphere")
    balls.GlyphMode = "All Points"
    balls.OrientationArray = ["POINTS", "No orientation array"]
    balls.ScaleArray = ["POINTS", "radius"]
    balls.ScaleFactor = 1.0  # set last: the others choose it anew
    balls.GlyphType.Radius = 1.0
    balls.GlyphType.ThetaResolution = balls.GlyphType.PhiResolution = 20
    for part in (tubes, balls):
        shown = Show(part, view)
        shown.ColorArrayName = [None, ""]
        shown.DiffuseColor = shown.AmbientColor = colour
        shown.Specular = 0.3


def file_of(name):
    return XMLPolyDataReader(registrationName=name, FileName=[os.path.join(folder, name + ".vtp")])


spherocylinders(rods, "rods", [0.34, 0.55, 0.75])
if os.path.exists(os.path.join(folder, "fixed.vtp")):
    spherocylinders(file_of("fixed"), "fixed", [0.45, 0.45, 0.45])
if os.path.exists(os.path.join(folder, "walls.vtp")):
    walls = Show(file_of("walls"), view)
    walls.ColorArrayName = [None, ""]
    walls.AmbientColor = walls.DiffuseColor = [0.16, 0.2, 0.26]
    walls.LineWidth = 3.0
{box}
outline = Show(box, view)
outline.Representation = "Outline"
outline.AmbientColor = outline.DiffuseColor = [0.4, 0.4, 0.4]
view.Background = [1.0, 1.0, 1.0]
view.UseColorPaletteForBackground = 0
view.OrientationAxesLabelColor = [0.0, 0.0, 0.0]
view.CameraFocalPoint = [0.0, 0.0, 0.0]
view.CameraPosition, view.CameraViewUp = [0.42, -1.0, 0.42], [0.0, 0.0, 1.0]
ResetCamera()
Render()
'''

STEADY_BOX = 'box = Box(registrationName="box", XLength={x!r}, YLength={y!r}, ZLength={z!r}, Center=[{x!r} / 2, {y!r} / 2, {z!r} / 2])'
CHANGING_BOX = f'box = PVDReader(registrationName="box", FileName=os.path.join(folder, "{BOX}"))'


def is_ours(folder):
    """Whether every file in the folder is of this export."""
    collection = folder / COLLECTION
    return (all(path.is_file() and OUR_NAMES.fullmatch(path.name) for path in folder.iterdir())
            and collection.exists() and MARK in collection.read_text(encoding="utf-8", errors="replace"))


def write(folder, trajectory):
    times, edges = [], []
    for number, frame in enumerate(trajectory):
        (folder / name_of("frame", number)).write_text(frame_text(frame), encoding="ascii")
        times.append(frame.time)
        edges.append(tuple(map(float, frame.edges)))
    write_collection(folder / COLLECTION, "frame", times)
    box = STEADY_BOX.format(**dict(zip("xyz", edges[0])))
    if len(set(edges)) > 1:
        for number, of_frame in enumerate(edges):
            (folder / name_of("box", number)).write_text(box_text(of_frame), encoding="ascii")
        write_collection(folder / BOX, "box", times)
        box = CHANGING_BOX
    if trajectory.fixed:
        (folder / FIXED).write_text(frame_text(trajectory.fixed), encoding="ascii")
    lines = trajectory.walls.lines(np.array(edges[-1]))
    if len(lines):
        (folder / WALLS).write_text(lines_text(lines, "", ""), encoding="ascii")
    (folder / VIEW).write_text(VIEW_PROGRAM.format(box=box), encoding="ascii")


def name_of(kind, number):
    return f"{kind}_{number:06d}.vtp"


def write_collection(path, kind, times):
    entries = "".join(f'    <DataSet timestep="{time!r}" part="0" file="{name_of(kind, number)}"/>\n' for number, time in enumerate(times))
    path.write_text(f'<?xml version="1.0"?>\n{MARK}\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
                    f'  <Collection>\n{entries}  </Collection>\n</VTKFile>\n', encoding="ascii")


def box_text(edges):
    """The corners of a box, whose outline is drawn."""
    corners = np.array(list(np.ndindex(2, 2, 2))) * edges
    return poly_text("Verts", corners, np.arange(8), np.arange(1, 9), "", "")


def frame_text(frame):
    return lines_text(frame.ends(), array("radius", np.repeat(0.5 * frame.diameter, 2), "f4"),
                      array("id", frame.id, "i8") + array("length", frame.length, "f4")
                      + array("diameter", frame.diameter, "f4") + array("axis", frame.axis, "f4"))


def lines_text(ends, of_points, of_lines):
    """A file of lines between two points each, (K, 2, 3)."""
    count = len(ends)
    return poly_text("Lines", ends.reshape(-1, 3), np.arange(2 * count), 2 * np.arange(1, count + 1), of_points, of_lines)


def poly_text(kind, points, connectivity, offsets, of_points, of_cells):
    """A file of points, and of "Lines" or "Verts" between them."""
    counts = "".join(f' NumberOf{name}="{len(offsets) if name == kind else 0}"' for name in ("Verts", "Lines", "Strips", "Polys"))
    scalars = ' Scalars="radius"' if of_points else ""
    return "".join((
        f'<?xml version="1.0"?>\n{MARK}\n'
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<PolyData>\n',
        f'<Piece NumberOfPoints="{len(points)}"{counts}>\n',
        "<Points>\n", array("points", points, "f4"), "</Points>\n",
        f"<{kind}>\n", array("connectivity", connectivity, "i8"), array("offsets", offsets, "i8"), f"</{kind}>\n",
        f"<PointData{scalars}>\n", of_points, "</PointData>\n", "<CellData>\n", of_cells, "</CellData>\n",
        "</Piece>\n</PolyData>\n</VTKFile>\n"))


def array(name, values, kind):
    """One array: base64 of its number of bytes (u64) and its little-endian numbers."""
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    content = np.ascontiguousarray(values, dtype="<" + kind).tobytes()
    text = base64.b64encode(len(content).to_bytes(8, "little") + content).decode()
    return f'<DataArray type="{KINDS[kind]}" Name="{name}"{components} format="binary">\n{text}\n</DataArray>\n'
