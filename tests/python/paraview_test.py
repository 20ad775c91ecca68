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
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

import cleft
from small_study import command, make_study

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


def image(path):
    """Rows from the top of red, green, blue and opacity, 0 to 1."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    width, height, _ = data.GetDimensions()
    return vtk_to_numpy(data.GetPointData().GetScalars()).reshape(height, width, 4)[::-1] / 255


def covered(source, view, path):
    """Where ParaView draws a source."""
    pv.Show(source, view)
    pv.SaveScreenshot(path, view, ImageResolution=PIXELS, TransparentBackground=1)
    pv.Hide(source, view)
    return image(path)[..., 3] > 0.5


def in_common(a, b):
    """The part of either that both cover."""
    return np.count_nonzero(a & b) / np.count_nonzero(a | b)


PIXELS = [640, 360]
SEEN = np.s_[50:330, 150:490]  # the body without captions, axes and scale

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
    # The picture is the explorer's: the body, and the wound in it. A pixel of their outlines may be either's.
    reader.TissueYoungModulus, reader.SkinPrestressV = 0.01, 0.04
    script, picture = os.path.join(folder, "explorer.txt"), os.path.join(folder, "explorer.png")
    with open(script, "w") as out:
        wanted = (np.asarray(study.cases["tissue.young_modulus"]) == 0.01) & (np.asarray(study.cases["skin.prestress_v"]) == 0.04)
        number = np.flatnonzero(wanted)[0] + 1
        out.write(f"open '{path}'\ncase {number}\ncolor tissue\ncamera 0 0 0.6\nscreenshot '{picture}' {PIXELS[0]} {PIXELS[1]} transparent\n")
    command("cleft", "explore", "--script", script)
    explorer = image(picture)
    red, green, blue = (np.maximum(explorer[..., c], 1e-3) for c in range(3))
    body = explorer[..., 3] > 0.5
    wound = body & ((np.abs(green / red - 0.77) > 0.09) | (np.abs(blue / green - 0.86) > 0.09))  # not of the skin's colour
    view = pv.CreateView("RenderView")
    view.ViewSize, view.OrientationAxesVisibility = PIXELS, 0
    middle, high = np.array([0.0, 0.0, 0.0]), np.tan(np.radians(12))
    away = np.abs(surface.points - middle)
    distance = (1.35 * np.maximum(away[:, 1] / high, away[:, 0] / (high * PIXELS[0] / PIXELS[1])) + surface.points[:, 2]).max()
    view.CameraFocalPoint, view.CameraViewUp, view.CameraViewAngle = list(middle), [0, 1, 0], 24 / 0.6
    view.CameraPosition = [0, 0, distance]
    view.ViewTime = 8.0
    reader.UpdatePipeline(8.0)
    skin = pv.Threshold(Input=reader, Scalars=["CELLS", "part"])
    skin.UpdatePipeline(8.0)
    skin.LowerThreshold, skin.UpperThreshold = -0.5, 0.5
    whole, of_skin = (covered(source, view, picture)[SEEN] for source in (reader, skin))
    assert in_common(whole, body[SEEN]) > 0.98, in_common(whole, body[SEEN])
    assert in_common(whole & ~of_skin, wound[SEEN]) > 0.95, in_common(whole & ~of_skin, wound[SEEN])

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
