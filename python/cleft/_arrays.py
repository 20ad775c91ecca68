"""Tables, and meshes of other packages as arrays."""

import numpy as np

from ._cleft import InputError


def table_of(columns):
    """A pandas DataFrame where pandas is installed, else a structured array; `columns`: lists of one length by name."""
    try:
        import pandas
    except ImportError:
        arrays = {name: np.asarray(values) for name, values in columns.items()}
        rows = len(next(iter(arrays.values())))
        table = np.empty(rows, dtype=[(name, array.dtype) for name, array in arrays.items()])
        for name, array in arrays.items():
            table[name] = array
        return table
    return pandas.DataFrame(columns)


def mesh_arrays(mesh):
    """(points, triangles) of a pair of arrays, a meshio mesh or a vtkPolyData."""
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return np.asarray(mesh[0], dtype=float), np.asarray(mesh[1])
    if hasattr(mesh, "cells_dict"):  # meshio
        triangles = mesh.cells_dict.get("triangle")
        if triangles is None:
            raise InputError("mesh: the meshio mesh has no triangles")
        return np.asarray(mesh.points, dtype=float), np.asarray(triangles)
    if hasattr(mesh, "GetPolys"):  # VTK
        from vtkmodules.util.numpy_support import vtk_to_numpy
        polygons = mesh.GetPolys()
        if polygons.GetNumberOfCells() == 0 or polygons.GetMaxCellSize() != 3:
            raise InputError("mesh: the vtkPolyData must consist of triangles (vtkTriangleFilter makes them)")
        triangles = vtk_to_numpy(polygons.GetConnectivityArray()).reshape(-1, 3)
        return np.asarray(vtk_to_numpy(mesh.GetPoints().GetData()), dtype=float), triangles
    raise InputError(f"mesh: a {type(mesh).__name__} is none; give (points, triangles), a meshio mesh or a vtkPolyData")
