"""Simulations of a growing cut as discontinuous free-form deformations: fields, studies and cuts of Cleft.

    import cleft
    study = cleft.open("study")                    # a folder or a study.dffd; a case.dffd gives a Field, a case.h5 a Snapshot
    study.cases                                    # a table: a row for each case
    field = study.sel(skin_prestress_v=0.03, tissue_young_modulus=0.02)   # simulated, or between the cases
    field(u, v, w, t, side=1)                      # displacement, mm, over arrays of any shape
    opened = cleft.cut((points, triangles), path, field)

Lengths in mm, stresses in MPa. (u, v, w): along the cut, across it (left < 0 < right), height (skin 0); t: length cut.
Wrong input raises InputError, a ValueError, with the texts of the commands; a file that cannot be read FileError.
"""

from ._cleft import BlendedField, Field, FileError, InputError, OpenedMesh, PatchSurface, Snapshot, __version__
from ._cut import cut
from ._encode import encode
from ._others import field_to_meshio, field_to_vtk, field_to_xarray, opened_to_meshio, opened_to_vtk
from ._study import Study, find, interpolate, open

Field.to_xarray = field_to_xarray
Field.to_vtk = field_to_vtk
Field.to_meshio = field_to_meshio
OpenedMesh.to_vtk = opened_to_vtk
OpenedMesh.to_meshio = opened_to_meshio

__all__ = ["BlendedField", "Field", "FileError", "InputError", "OpenedMesh", "PatchSurface", "Snapshot", "Study", "cut",
           "encode", "find", "interpolate", "open"]
