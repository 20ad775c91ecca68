"""Fields and opened meshes as objects of xarray, VTK and meshio, which are imported when they are asked for."""

import numpy as np

from ._cleft import PatchSurface


def field_to_xarray(field, u=None, v=None, w=0.0, t=None, side=0):
    """The displacement on a grid: an xarray.DataArray over u, v, w, t and component (du, dv, dw), mm.

    u, v, w, t: coordinates, mm; by default 61 and 41 evenly spaced places over the domain, the skin, 21 lengths cut.
    side: of places on v = 0: -1 left, 1 right, 0 the mean of both.
    """
    import xarray
    even = {"u": 61, "v": 41, "t": 21}
    axes = {name: np.atleast_1d(np.linspace(*field.domain[name], even[name]) if values is None else
                                np.asarray(values, dtype=float))
            for name, values in (("u", u), ("v", v), ("w", w), ("t", t))}
    U, V, W, T = np.meshgrid(*axes.values(), indexing="ij", sparse=True)
    coordinates = {name: (name, values, {"units": "mm"}) for name, values in axes.items()}
    coordinates["component"] = ["du", "dv", "dw"]
    return xarray.DataArray(field(U, V, W, T, np.where(V == 0, side, 0), threads=0), dims=(*axes, "component"),
                            coords=coordinates, name="displacement",
                            attrs={"units": "mm", "case": field.case, "estimated_error": field.estimated_error})


def add_arrays(attributes, arrays):
    """To the point or cell data of a vtkDataSet: arrays by name."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    for name, values in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        attributes.AddArray(array)


def add_field_data(data, numbers):
    """To a vtkDataSet: numbers by name."""
    from vtkmodules.vtkCommonCore import vtkDoubleArray
    for name, value in numbers.items():
        array = vtkDoubleArray()
        array.SetName(name)
        array.InsertNextValue(value)
        data.GetFieldData().AddArray(array)


def _poly_data(points, triangles, point_arrays, cell_arrays):
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    data, places, polygons = vtkPolyData(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    data.SetPoints(places)
    polygons.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int64), deep=True),
                     numpy_to_vtkIdTypeArray(np.ascontiguousarray(triangles, dtype=np.int64).ravel(), deep=True))
    data.SetPolys(polygons)
    add_arrays(data.GetPointData(), point_arrays)
    add_arrays(data.GetCellData(), cell_arrays)
    return data


def field_to_vtk(field, t=None):
    """The skin and the walls of the cut when t mm are cut (None: all) as a vtkPolyData, at rest: points arrays displacement
    (mm; warp by it), cell array part (0 skin, 1 left wall, 2 right wall), field data TimeValue and estimated_error."""
    surface = PatchSurface(field)
    t = surface.duration if t is None else t
    data = _poly_data(surface.points, surface.triangles, {"displacement": surface.displacement(t)}, {"part": surface.parts})
    add_field_data(data, {"TimeValue": t, "estimated_error": field.estimated_error})
    return data


def field_to_meshio(field, t=None):
    """The same as a meshio.Mesh, without field data."""
    import meshio
    surface = PatchSurface(field)
    displacement = surface.displacement(surface.duration if t is None else t)
    return meshio.Mesh(surface.points, [("triangle", surface.triangles)], point_data={"displacement": displacement},
                       cell_data={"part": [surface.parts]})


def _opened_arrays(opened, t):
    positions, rest = opened.positions(t), opened.rest
    return positions, {"displacement": positions - rest, "depth": opened.depth, "region": opened.region, "s": opened.s}


def opened_to_vtk(opened, t=None):
    """The mesh when t mm of all paths are cut (None: as far as it is cut) as a vtkPolyData, displaced; point arrays
    displacement (mesh units, from rest), depth, region and s as in the files of `cleft cut`, cell array part."""
    positions, arrays = _opened_arrays(opened, t)
    return _poly_data(positions, opened.triangles, arrays, {"part": opened.parts})


def opened_to_meshio(opened, t=None):
    """The same as a meshio.Mesh."""
    import meshio
    positions, arrays = _opened_arrays(opened, t)
    return meshio.Mesh(positions, [("triangle", opened.triangles)], point_data=arrays, cell_data={"part": [opened.parts]})
