"""Cuts in surface meshes."""

import os
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _cleft
from ._arrays import mesh_arrays
from ._cleft import Field, InputError, OpenedMesh
from ._study import Study

_COLUMNS = ["x", "y", "z", "nx", "ny", "nz", "depth"]


def _path_of(path: Any, name: str):
    if isinstance(path, (str, os.PathLike)):
        return _cleft.path_file(os.fspath(path))
    if hasattr(path, "columns") and hasattr(path, "to_numpy"):  # pandas: with names, among them prestresses
        return _cleft.path_table(name, [str(column) for column in path.columns], path.to_numpy(dtype=float))
    rows = np.asarray(path, dtype=float)
    if rows.ndim != 2 or rows.shape[1] not in (6, 7):
        raise InputError(f"{name}: an array of shape (N, 6) or (N, 7) is needed, x,y,z,nx,ny,nz[,depth], not {rows.shape}")
    return _cleft.path_table(name, _COLUMNS[:rows.shape[1]], rows)


def _fields_of(field: Any, direction: Sequence[float], prestress: Sequence[float]):
    if isinstance(field, Field):
        if direction:
            raise InputError("tension: is for a study of three prestresses, or of a family; this is the field of one case")
        return _cleft.CutFields(field)
    if not isinstance(field, Study):
        return _cleft.CutFields(os.fspath(field), direction, prestress)
    key = (tuple(direction), tuple(prestress))
    if key not in field._opening:  # a family takes seconds to read
        field._opening[key] = _cleft.CutFields(field._file(), direction, prestress)
    return field._opening[key]


def cut(mesh: Any, path: Any, field: Union[Field, Study, str, os.PathLike], *,
        tension: Optional[tuple] = None, scale: float = 1.0, depth: float = 0.0, progress: Optional[float] = None,
        max_edge: Optional[float] = None, bone: Any = None) -> OpenedMesh:
    """Cuts a surface mesh along one path or several, one after the other, and opens the cuts, as `cleft cut` does.

    mesh: (points (N, 3), triangles (T, 3)), a meshio mesh or a vtkPolyData.
    path: an array (M, 6 or 7) of x,y,z,nx,ny,nz[,depth] in mesh units: points of the blade's tip on the surface, its outward
        direction, its depth; a DataFrame with these columns; the name of such a CSV file; or a list of any of these.
    field: a Field for all directions; a Study (or its study.dffd) of three cases of other prestress, for a tension that turns
        against the path; or one of a family, for the shape of skin and blade too.
    tension: ((x, y, z), (larger, smaller)): direction of the skin's larger tension in space, principal prestresses in MPa.
    scale: mm per unit of the mesh. depth: of the cut, mm; 0: the path's, else the field's. progress: how far the blade of the
        last cut has come, mm; None: the whole path. max_edge: edges near the path that are longer are split, mm; 0: none.
    bone: the surface of the bone below, as mesh; a family with cases on bone opens the cut by it.

    Raises InputError; where a path cannot be cut the message says at which place, and why.
    """
    several = isinstance(path, (list, tuple)) and len(path) > 0 and (
        isinstance(path[0], (str, os.PathLike)) or hasattr(path[0], "columns") or np.ndim(path[0]) == 2)
    paths = [_path_of(one, f"path {k + 1}") for k, one in enumerate(path if several else [path])]
    direction, prestress = ([float(x) for x in part] for part in tension) if tension is not None else ([], [])
    if tension is not None and (len(direction) != 3 or len(prestress) != 2):
        raise InputError("tension: expected ((x, y, z), (larger, smaller))")
    points, triangles = mesh_arrays(mesh)
    return _cleft.cut(points, triangles, paths, _fields_of(field, direction, prestress), scale, depth, progress, max_edge,
                      None if bone is None else mesh_arrays(bone))
