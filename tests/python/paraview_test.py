"""paraview_test.py PLUGIN, by pvpython: the plug-in against the module, in ParaView's process."""

import inspect
import os
import sys
import tempfile

if not hasattr(inspect, "getargspec"):  # ParaView 5.11.0, which Debian has, asks for it; Python 3.11 has it no more
    inspect.getargspec = inspect.getfullargspec

import numpy as np
import paraview.simple as pv
from paraview import servermanager
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

import cleft
from small_study import make_study

loaded = {line.split()[-1] for line in open("/proc/self/maps") if "libhdf5" in line}
pv.LoadPlugin(sys.argv[1], remote=False, ns=globals())


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def array_of(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def number_of(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def at(source, t):
    source.UpdatePipeline(t)
    return servermanager.Fetch(source)


with tempfile.TemporaryDirectory() as folder:
    path = make_study(folder)
    study = cleft.open(path)
    reader = CleftReader(FileName=os.path.join(path, "study.dffd"))  # noqa: F821

    # The sliders are those of the study, and choose a simulated case or one between.
    for name, word in (("tissue.young_modulus", "TissueYoungModulus"), ("skin.prestress_v", "SkinPrestressV")):
        domain = reader.SMProxy.GetProperty(word).GetDomain("range")
        assert (domain.GetMinimum(0), domain.GetMaximum(0)) == study.varying[name], name
        assert reader.SMProxy.GetProperty(word + "Varies").GetElement(0) == 1
    assert reader.SMProxy.GetProperty("SkinThicknessVaries").GetElement(0) == 0
    assert len(reader.TimestepValues) == 61 and abs(reader.TimestepValues[-1] - 8) < 1e-9, reader.TimestepValues
    for values in ({"tissue.young_modulus": 0.03, "skin.prestress_v": 0.02}, {"tissue.young_modulus": 0.02, "skin.prestress_v": 0.03}):
        reader.TissueYoungModulus, reader.SkinPrestressV = values["tissue.young_modulus"], values["skin.prestress_v"]
        field = study.sel(values)
        surface = cleft.PatchSurface(field)
        for t in (0.0, 3.3, 8.0):
            data = at(reader, t)
            np.testing.assert_allclose(array_of(data, "displacement"), surface.displacement(t), atol=1e-12)
            np.testing.assert_allclose(points_of(data), surface.points + surface.displacement(t), atol=1e-12)
            assert number_of(data, "estimated_error") == field.estimated_error
            assert abs(number_of(data, "TimeValue") - t) < 1e-9
            assert number_of(data, "skin.prestress_v") == values["skin.prestress_v"]
    reader.Deform = 0
    np.testing.assert_array_equal(points_of(at(reader, 8.0)), surface.points)

    # On the nodes of the simulation the field is within its error.
    first = os.path.join(path, "cases", study.cases["hash"][0])
    reader.TissueYoungModulus, reader.SkinPrestressV = 0.01, 0.02
    reader.Snapshot = os.path.join(first, "case.h5")
    snapshot, field = cleft.Snapshot(os.path.join(first, "case.h5")), study[0]
    data = at(reader, float(snapshot.times[-1]))
    assert data.GetNumberOfCells() == len(snapshot.cell_types)
    error = np.linalg.norm(array_of(data, "displacement") - snapshot.displacement(-1), axis=1).max()
    assert error <= field.report["spline_error"] * field.report["largest_displacement"] * (1 + 1e-9), error

    # Any mesh in the coordinates of the case.
    ball = pv.Sphere(Radius=2.0, Center=[0.0, 0.0, -2.0])
    deformed = Cleftdeform(Input=ball, FieldFile=os.path.join(first, "case.dffd"))  # noqa: F821
    rest, data = points_of(at(ball, 0.0)), at(deformed, 6.0)
    assert data.GetClassName() == "vtkPolyData"
    expected = field(*rest.T.astype(float), 6.0, outside="clamp")
    np.testing.assert_allclose(array_of(data, "displacement"), expected, atol=1e-12)
    np.testing.assert_allclose(points_of(data), rest + expected, atol=1e-6)

    # What is wrong is told, and nothing is shown.
    told, usual = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(told)
    damaged = os.path.join(folder, "damaged.dffd")
    with open(os.path.join(path, "study.dffd"), "rb") as file, open(damaged, "wb") as out:
        out.write(file.read()[:3000])
    broken = CleftReader(FileName=damaged)  # noqa: F821
    broken.UpdatePipeline(0.0)
    vtkOutputWindow.SetInstance(usual)
    assert "damaged.dffd" in told.GetOutput(), told.GetOutput()

# The module has brought no HDF5 that the process did not have.
assert {line.split()[-1] for line in open("/proc/self/maps") if "libhdf5" in line} == loaded
print("the plug-in shows what the module evaluates")
