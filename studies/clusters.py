"""How rods crowd together, from a frame of a trajectory in a periodic cube."""

import numpy

from runs import RunFailed


def trajectory(run):
    """The rods of a run's trajectory.h5, open."""
    try:
        import h5py  # here: what needs no trajectory runs without it
    except ImportError:
        raise RunFailed("this study reads trajectories: apt-get install python3-h5py") from None
    return h5py.File(run.folder / "trajectory.h5")


def rods_of_frame(run, time):
    """{"centre", "axis", "length", "id"} of the frame at a time."""
    with trajectory(run) as file:
        rods = file["particles/rods"]
        frame = int(numpy.abs(rods["position/time"][...] - time).argmin())
        there = rods["id/value"][frame] >= 0
        return {"centre": rods["position/value"][frame][there].astype(float), "axis": rods["orientation/value"][frame][there],
                "length": rods["length/value"][frame][there], "id": rods["id/value"][frame][there]}


def counts_in_cells(frame, edge, cell):
    """Variance over mean of the numbers of centres in cubes of edge `cell`: 1 for centres strewn at random."""
    number = round(edge / cell)
    place = numpy.floor(frame["centre"] / edge * number).astype(int) % number
    counts = numpy.bincount((place[:, 0] * number + place[:, 1]) * number + place[:, 2], minlength=number**3)
    return counts.var() / counts.mean()


def clusters_of(frame, edge, gap=0.1, spacing=0.25):
    """Sizes of the clusters of rods of diameter 1 that come within `gap`: each as points `spacing` apart along it."""
    try:
        from scipy.sparse import coo_matrix
        from scipy.sparse.csgraph import connected_components
        from scipy.spatial import cKDTree
    except ImportError:
        raise RunFailed("this study finds clusters: apt-get install python3-scipy") from None
    number = numpy.ceil(frame["length"] / spacing).astype(int) + 1
    rod = numpy.repeat(numpy.arange(len(number)), number)
    along = numpy.arange(number.sum()) - numpy.repeat(numpy.cumsum(number) - number, number)
    share = along / numpy.maximum(number[rod] - 1, 1) - 0.5
    points = (frame["centre"][rod] + (share * frame["length"][rod])[:, None] * frame["axis"][rod]) % edge
    pairs = cKDTree(points, boxsize=edge).query_pairs(1.0 + gap, output_type="ndarray")
    i, j = rod[pairs[:, 0]], rod[pairs[:, 1]]
    graph = coo_matrix((numpy.ones(len(i), dtype=bool), (i, j)), shape=(len(number), len(number)))
    _, label = connected_components(graph, directed=False)
    return numpy.bincount(label)
