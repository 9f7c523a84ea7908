"""VTK XML for ParaView: trajectory.pvd names one .vtp file a frame with its time; each rod is a line of two points.

Arrays of lines: id, length, diameter, axis. Of points: radius, for tubes and spheres. view.py, run by ParaView, draws
the rods as spherocylinders.
"""

import base64
import re

import numpy as np

MARK = "<!-- made by jostle export -->"
COLLECTION, VIEW = "trajectory.pvd", "view.py"
OUR_NAMES = re.compile(r"trajectory\.pvd|view\.py|frame_\d{6,}\.vtp")
KINDS = {"f4": "Float32", "i8": "Int64"}

VIEW_PROGRAM = '''# Draws the run in ParaView: Tools > Python Shell > Run Script, or paraview --script=view.py here.
import os
from paraview.simple import *

folder = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
rods = PVDReader(registrationName="rods", FileName=os.path.join(folder, "trajectory.pvd"))
view = GetActiveViewOrCreate("RenderView")
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()

# Tubes, and balls at their ends: a scaled capsule would have the wrong caps.
tubes = Tube(registrationName="cylinders", Input=rods, Scalars=["POINTS", "radius"], VaryRadius="By Absolute Scalar",
             NumberofSides=20, Capping=0)
balls = Glyph(registrationName="caps", Input=rods, GlyphType="Sphere")
balls.GlyphMode = "All Points"
balls.OrientationArray = ["POINTS", "No orientation array"]
balls.ScaleArray = ["POINTS", "radius"]
balls.ScaleFactor = 1.0  # set last: the others choose it anew
balls.GlyphType.Radius = 1.0
balls.GlyphType.ThetaResolution = balls.GlyphType.PhiResolution = 20
for part in (tubes, balls):
    shown = Show(part, view)
    shown.ColorArrayName = [None, ""]
    shown.DiffuseColor = shown.AmbientColor = [0.34, 0.55, 0.75]
    shown.Specular = 0.3
box = Box(registrationName="box", XLength={x!r}, YLength={y!r}, ZLength={z!r}, Center=[{x!r} / 2, {y!r} / 2, {z!r} / 2])
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


def is_ours(folder):
    """Whether every file in the folder is of this export."""
    collection = folder / COLLECTION
    return (all(path.is_file() and OUR_NAMES.fullmatch(path.name) for path in folder.iterdir())
            and collection.exists() and MARK in collection.read_text(encoding="utf-8", errors="replace"))


def write(folder, trajectory):
    entries = []
    for number, frame in enumerate(trajectory):
        name = f"frame_{number:06d}.vtp"
        (folder / name).write_text(frame_text(frame), encoding="ascii")
        entries.append(f'    <DataSet timestep="{frame.time!r}" part="0" file="{name}"/>\n')
    (folder / COLLECTION).write_text(
        f'<?xml version="1.0"?>\n{MARK}\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
        f'  <Collection>\n{"".join(entries)}  </Collection>\n</VTKFile>\n', encoding="ascii")
    x, y, z = map(float, trajectory.frame(0).edges)
    (folder / VIEW).write_text(VIEW_PROGRAM.format(x=x, y=y, z=z), encoding="ascii")


def frame_text(frame):
    count = len(frame)
    points = frame.ends().reshape(-1, 3)
    return "".join((
        f'<?xml version="1.0"?>\n{MARK}\n'
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<PolyData>\n',
        f'<Piece NumberOfPoints="{2 * count}" NumberOfVerts="0" NumberOfLines="{count}" NumberOfStrips="0" '
        'NumberOfPolys="0">\n',
        "<Points>\n", array("points", points, "f4"), "</Points>\n",
        "<Lines>\n", array("connectivity", np.arange(2 * count), "i8"),
        array("offsets", 2 * np.arange(1, count + 1), "i8"), "</Lines>\n",
        '<PointData Scalars="radius">\n', array("radius", np.repeat(0.5 * frame.diameter, 2), "f4"), "</PointData>\n",
        "<CellData>\n", array("id", frame.id, "i8"), array("length", frame.length, "f4"),
        array("diameter", frame.diameter, "f4"), array("axis", frame.axis, "f4"), "</CellData>\n",
        "</Piece>\n</PolyData>\n</VTKFile>\n"))


def array(name, values, kind):
    """One array: base64 of its number of bytes (u64) and its little-endian numbers."""
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    content = np.ascontiguousarray(values, dtype="<" + kind).tobytes()
    text = base64.b64encode(len(content).to_bytes(8, "little") + content).decode()
    return f'<DataArray type="{KINDS[kind]}" Name="{name}"{components} format="binary">\n{text}\n</DataArray>\n'
