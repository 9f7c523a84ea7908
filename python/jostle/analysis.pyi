"""Types of jostle.analysis."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]

__all__: list[str]

@dataclass(frozen=True)
class Displacements:
    time: _Array
    total: _Array
    along: _Array
    across: _Array
    total_error: _Array
    along_error: _Array
    across_error: _Array

@dataclass(frozen=True)
class Memory:
    time: _Array
    first: _Array
    second: _Array
    first_error: _Array
    second_error: _Array

@dataclass(frozen=True)
class PairCorrelation:
    distance: _Array
    g: _Array
    g2: _Array
    g_error: _Array
    g2_error: _Array
    pairs: NDArray[np.int64]

@dataclass(frozen=True)
class StructureFactor:
    wave_number: _Array
    S: _Array
    error: _Array
    vectors: NDArray[np.int64]

@dataclass(frozen=True)
class Clusters:
    label: list[NDArray[np.int64]]
    size: list[NDArray[np.int64]]
    number: NDArray[np.int64]
    largest: NDArray[np.int64]
    mean_size: _Array

def mean_square_displacements(rods: Any) -> Displacements: ...
def orientation_memory(rods: Any) -> Memory: ...
def pair_correlation(rods: Any, largest: float | None = ..., bins: int = ...) -> PairCorrelation: ...
def structure_factor(rods: Any, largest: float | None = ...) -> StructureFactor: ...
def clusters(rods: Any, gap: float) -> Clusters: ...
def frames_of(rods: Any) -> Sequence[Any]: ...
