"""Fields of data that never was a file."""

import os
from typing import Mapping, Optional, Union

import numpy as np

from . import _cleft
from ._cleft import Field, InputError

_JUMP = 1e-9  # over the largest displacement: a pair that is further apart is open


def _first_open(pairs: np.ndarray, displacement: np.ndarray) -> np.ndarray:
    """The first frame in which each pair has parted; the number of frames for one that never does."""
    size = np.linalg.norm(displacement, axis=2).max(initial=0)
    apart = np.linalg.norm(displacement[:, pairs[:, 1]] - displacement[:, pairs[:, 0]], axis=2) > _JUMP * size
    apart[0] = False  # frame 0 counts as closed
    return np.where(apart.any(axis=0), apart.argmax(axis=0), len(displacement))


def encode(points: np.ndarray, pairs: np.ndarray, times: np.ndarray, displacement: np.ndarray, *, tolerance: float = 0.01,
           parametrization: str = "front", parameters: Optional[Mapping] = None,
           out: Union[str, os.PathLike, None] = None) -> Field:
    """Fits a field to a time series with a cut, as `cleft encode` does with an imported one.

    points: (N, 3), mm: positions while closed in canonical coordinates (u, v, w); the cut is in v = 0, the skin at w = 0.
    pairs: (P, 2): left (v < 0) and right node of each doubled node on v = 0, in any order; (0, 2): there is no cut.
    times: (F,), increasing. displacement: (F, N, 3), mm, from points; frame 0 is closed.
    tolerance: largest error at any node and frame over the largest displacement, from 1e-9 to less than 1.
    parametrization: "front", "tip" or "fixed" (without a cut always that). parameters: of the case, by dotted name.
    out: a case.dffd to write, with the residuals at the nodes where the spline alone does not keep the tolerance.

    A pair opens in the first frame in which its displacement jumps by more than 1e-9 of the largest one. Raises InputError.
    """
    points, displacement = np.asarray(points, dtype=float), np.asarray(displacement, dtype=float)
    times, pairs = np.asarray(times, dtype=float), np.asarray(pairs, dtype=np.int32).reshape(-1, 2)
    if points.ndim != 2 or points.shape[1] != 3 or len(points) == 0:
        raise InputError(f"points: an array of shape (N, 3) is needed, not {points.shape}")
    if times.ndim != 1 or displacement.shape != (len(times), len(points), 3):
        raise InputError(f"displacement: an array of shape (times, points, 3) = {(times.size, len(points), 3)} is needed, "
                         f"not {displacement.shape}")
    if pairs.size and not (0 <= pairs.min() and pairs.max() < len(points)):
        raise InputError(f"pairs: name point {pairs.max() if pairs.max() >= len(points) else pairs.min()}, and there are "
                         f"{len(points)}")
    released = np.zeros(len(times), dtype=np.int32)
    position = np.zeros(len(times))
    extent = (0.0, 0.0, 0.0)
    if len(pairs):
        first = _first_open(pairs, displacement)
        u, w = points[pairs[:, 0], 0], points[pairs[:, 0], 2]
        order = np.lexsort((-w, u, first))
        pairs, first, u, w = pairs[order], first[order], u[order], w[order]
        released[:] = [np.count_nonzero(first <= j) for j in range(len(times))]
        position = _position(points, u, w, first, len(times))
        extent = (u.min(), u.max() - u.min(), w.max() - w.min())
    return _cleft.encoded(points, pairs, times, displacement, released, position, extent, tolerance,
                          parametrization if len(pairs) else "fixed", dict(parameters or {}),
                          "" if out is None else os.fspath(out))


def _position(points, u, w, first, frames):
    """u of the first node in the plane of the cut, at the pairs' heights, ahead of all that are open (docs/formats.md)."""
    rounding = 2e-5 * np.linalg.norm(np.ptp(points, axis=0))
    if len(np.unique(first[first < frames])) == 1:  # all at once
        return np.full(frames, u.max())
    at_height = (points[:, 2] >= w.min() - rounding) & (points[:, 2] <= w.max() + rounding)
    plane = points[(np.abs(points[:, 1]) <= rounding) & at_height, 0]
    position = np.empty(frames)
    for j in range(frames):
        opened = u[first <= j]
        ahead = plane[plane > opened.max() + rounding] if len(opened) else u[:1]
        position[j] = ahead.min() if len(ahead) else u.max()
    return position
