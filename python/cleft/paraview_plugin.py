"""ParaView plug-in: case.dffd and study.dffd as data that change in time (Tools > Manage Plugins > Load New: this file).

The reader shows the skin and the walls of a wound, or the nodes of a simulation, as the field moves them; the parameters in
which the cases of a study differ are sliders. The filter "Cleft: deform" moves any mesh in canonical coordinates. It is Python,
because ParaView's interface for Python plug-ins changes less from version to version than the C++ interface, against whose
headers a plug-in would be compiled anew for each.
"""

import os
import sys
from xml.sax.saxutils import escape

import numpy as np
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smhint, smproperty, smproxy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

try:
    import cleft
except ImportError:  # the plug-in stands in the module's own folder
    sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    import cleft
from cleft import _cleft
from cleft._others import add_arrays, add_field_data

NOT_CHOSEN = -1e300  # of a slider


def refuse(error):
    """Tells ParaView's messages what is wrong; a request that failed returns 0."""
    vtkOutputWindow.GetInstance().DisplayErrorText(f"cleft: {error}\n")
    return 0


def requested_time(out_info, duration):
    info = out_info.GetInformationObject(0)
    key = Pipeline.UPDATE_TIME_STEP()
    return min(max(info.Get(key), 0.0), duration) if info.Has(key) else duration


def tell_times(out_info, duration, frames):
    info = out_info.GetInformationObject(0)
    info.Remove(Pipeline.TIME_STEPS())
    for t in np.linspace(0, duration, frames):
        info.Append(Pipeline.TIME_STEPS(), float(t))
    info.Set(Pipeline.TIME_RANGE(), [0.0, float(duration)], 2)


def vtk_points(values):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True))
    return points


class Body:
    """Points of a case's patch, with the cells between them: N points, their places in the field, their axes in space."""

    def __init__(self, points, places, side, axes, offsets, connectivity, types, parts):
        self.points, self.places, self.side, self.axes = points, places, side, axes
        self.offsets, self.connectivity, self.types, self.parts = offsets, connectivity, types, parts

    @classmethod
    def of_surface(cls, field):
        surface = cleft.PatchSurface(field)
        points, triangles, parts = surface.points, surface.triangles, surface.parts
        middle = points[triangles, 1].mean(axis=1)
        of_triangles = np.where(parts == 0, np.sign(middle), np.where(parts == 1, -1, 1))
        left, right = (np.isin(np.arange(len(points)), triangles[of_triangles == side]) for side in (-1, 1))
        side = np.where(points[:, 1] == 0, right.astype(int) - left, 0)
        return cls(points, points, side, None, np.arange(0, 3 * len(triangles) + 1, 3), triangles.ravel(),
                   np.full(len(triangles), 5, dtype=np.uint8), parts)

    @classmethod
    def of_snapshot(cls, file):
        snapshot = cleft.Snapshot(file)
        shaped = "canonical" in snapshot.arrays
        places = np.array(snapshot.array("canonical") if shaped else snapshot.points)
        axes = snapshot.array("frame").reshape(-1, 3, 3) if shaped else None
        side = np.zeros(len(places), dtype=int)
        side[snapshot.pairs[:, 0]], side[snapshot.pairs[:, 1]] = -1, 1
        places[side != 0, 1] = 0
        return cls(snapshot.points, places, side, axes, snapshot.cell_offsets, snapshot.connectivity, snapshot.cell_types,
                   (snapshot.cell_types != 5).astype(int))

    def sides_at(self, field, t):
        """Skin that is not cut yet is closed, whatever the fit is."""
        return np.where(self.places[:, 0] >= field.cut["start"] + t, 0, self.side)

    def grid(self, field, t, deform):
        u, v, w = self.places.T
        at = (u, v, w, t, self.sides_at(field, t))
        displacement = field(*at, threads=0, outside="clamp")
        if self.axes is not None:
            displacement = np.einsum("ni,nij->nj", displacement, self.axes)
        grid, cells = vtkUnstructuredGrid(), vtkCellArray()
        grid.SetPoints(vtk_points(self.points + displacement if deform else self.points))
        cells.SetData(numpy_to_vtkIdTypeArray(np.ascontiguousarray(self.offsets, dtype=np.int64), deep=True),
                      numpy_to_vtkIdTypeArray(np.ascontiguousarray(self.connectivity, dtype=np.int64), deep=True))
        grid.SetCells(numpy_to_vtk(np.ascontiguousarray(self.types), deep=True), cells)
        add_arrays(grid.GetPointData(), {"displacement": displacement, **{
            name: field.quantity(name, *at, threads=0, outside="clamp") for name in field.quantities}})
        add_arrays(grid.GetCellData(), {"part": self.parts})
        return grid


def with_sliders(cls):
    """Adds to the reader a slider for each number of the table of parameters, shown where the cases of the study differ in
    it, with the range that they have."""
    for row in _cleft.parameter_numbers():
        name = row["name"]
        title = " ".join(part.capitalize() for part in name.replace(".", "_").split("_"))  # Skin Prestress V
        word = title.replace(" ", "")

        def range_of(self, name=name):
            return self.range_of(name)

        def varies(self, name=name):
            return int(self.varies(name))

        def choose(self, value, name=name):
            self.choose(name, value)

        smproperty.xml(f"""<DoubleVectorProperty name="{word}Range" command="{word}Range" number_of_elements="0"
            default_values="none" information_only="1" />""")(range_of)
        smproperty.xml(f"""<IntVectorProperty name="{word}Varies" command="{word}Varies" number_of_elements="0"
            default_values="none" information_only="1" />""")(varies)
        unit = f" ({row['unit']})" if row["unit"] else ""
        smproperty.xml(f"""<DoubleVectorProperty name="{word}" label="{title}" command="Set{word}" number_of_elements="1"
            default_values="{NOT_CHOSEN:g}">
            <Documentation>{name}{unit}: {escape(row["help"])}</Documentation>
            <DoubleRangeDomain name="range" default_mode="min">
              <RequiredProperties><Property name="{word}Range" function="RangeInfo" /></RequiredProperties>
            </DoubleRangeDomain>
            <Hints><PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="{word}Varies" value="1" /></Hints>
          </DoubleVectorProperty>""")(choose)
        for method, function in ((f"{word}Range", range_of), (f"{word}Varies", varies), (f"Set{word}", choose)):
            function.__name__ = method
            setattr(cls, method, function)
    return cls


@smproxy.reader(name="CleftReader", label="Cleft Reader", extensions="dffd",
                file_description="Cleft fields and studies")
@with_sliders
class CleftReader(VTKPythonAlgorithmBase):
    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkUnstructuredGrid")
        self._file = self._mesh = ""
        self._frames, self._deform = 61, True
        self._study, self._known, self._chosen = None, None, {}
        self._body = None  # of the last request, with what it was made for

    @smproperty.stringvector(name="FileName", panel_visibility="never")
    @smdomain.filelist()
    @smhint.filechooser(extensions="dffd", file_description="Cleft fields and studies")
    def SetFileName(self, file):
        if file != self._file:
            self._file = file or ""
            self._study = self._body = None
            self.Modified()

    @smproperty.stringvector(name="Snapshot", default_values="", panel_visibility="advanced")
    @smdomain.filelist()
    @smhint.filechooser(extensions="h5", file_description="Simulations of Cleft")
    def SetSnapshot(self, file):
        """A case.h5, on whose nodes the field is shown instead of on the skin and the walls of the wound."""
        if (file or "") != self._mesh:
            self._mesh, self._body = file or "", None
            self.Modified()

    @smproperty.intvector(name="Frames", default_values=61)
    @smdomain.intrange(min=2, max=1001)
    def SetFrames(self, frames):
        if frames != self._frames:
            self._frames = frames
            self.Modified()

    @smproperty.intvector(name="Deform", default_values=1)
    @smdomain.xml('<BooleanDomain name="bool" />')
    def SetDeform(self, deform):
        if bool(deform) != self._deform:
            self._deform = bool(deform)
            self.Modified()

    @smproperty.doublevector(name="TimestepValues", information_only="1", si_class="vtkSITimeStepsProperty")
    def GetTimestepValues(self):
        try:
            return np.linspace(0, self.field().duration, self._frames).tolist()
        except (cleft.InputError, OSError):
            return None

    def study(self):
        stamp = (self._file, os.stat(self._file).st_mtime_ns) if os.path.exists(self._file) else None
        if self._study is None or stamp != self._known:
            self._study, self._known = cleft.Study(self._file), stamp
        return self._study

    def varies(self, name):
        try:
            return name in self.study().varying
        except (cleft.InputError, OSError):
            return False

    def range_of(self, name):
        return tuple(float(x) for x in self.study().varying[name]) if self.varies(name) else (0.0, 1.0)

    def choose(self, name, value):
        if self._chosen.get(name) != value:
            self._chosen[name] = value
            self.Modified()

    def field(self):
        """For the sliders; a parameter that was not chosen is the least of its range."""
        study = self.study()
        values = {}
        for name, (least, _) in study.varying.items():
            value = self._chosen.get(name, NOT_CHOSEN)
            values[name] = float(least) if value <= NOT_CHOSEN / 2 else value
        return study.sel(values)

    def body(self, field):
        key = (self._mesh, tuple(field.domain.items()), tuple(field.cut.items()))
        if self._body is None or self._body[0] != key:
            self._body = (key, Body.of_snapshot(self._mesh) if self._mesh else Body.of_surface(field))
        return self._body[1]

    def RequestInformation(self, request, in_info, out_info):
        try:
            tell_times(out_info, self.field().duration, self._frames)
        except (cleft.InputError, OSError) as error:
            return refuse(error)
        return 1

    def RequestData(self, request, in_info, out_info):
        try:
            field = self.field()
            t = requested_time(out_info, field.duration)
            grid = self.body(field).grid(field, t, self._deform)
        except (cleft.InputError, OSError) as error:
            return refuse(error)
        add_field_data(grid, {"TimeValue": t, "estimated_error": field.estimated_error,
                              **{name: field.parameters[name] for name in self.study().varying}})
        output = vtkUnstructuredGrid.GetData(out_info, 0)
        output.ShallowCopy(grid)
        output.GetInformation().Set(output.DATA_TIME_STEP(), t)
        return 1


@smproxy.filter(name="CleftDeform", label="Cleft: deform")
@smproperty.input(name="Input", port_index=0)
@smdomain.datatype(dataTypes=["vtkPointSet"], composite_data_supported=False)
class CleftDeform(VTKPythonAlgorithmBase):
    """Moves a mesh in the canonical coordinates (u, v, w), mm, of a case. A point array `side` (-1, 0, 1) chooses the lip of
    points on v = 0; without one they take the mean of both."""

    def __init__(self):
        super().__init__(nInputPorts=1, nOutputPorts=1, inputType="vtkPointSet", outputType="vtkPointSet")
        self._file, self._frames, self._deform, self._field = "", 61, True, None

    @smproperty.stringvector(name="FieldFile", default_values="")
    @smdomain.filelist()
    @smhint.filechooser(extensions="dffd", file_description="Cleft fields")
    def SetFieldFile(self, file):
        """A case.dffd."""
        if (file or "") != self._file:
            self._file, self._field = file or "", None
            self.Modified()

    @smproperty.intvector(name="Frames", default_values=61)
    @smdomain.intrange(min=2, max=1001)
    def SetFrames(self, frames):
        if frames != self._frames:
            self._frames = frames
            self.Modified()

    @smproperty.intvector(name="Deform", default_values=1)
    @smdomain.xml('<BooleanDomain name="bool" />')
    def SetDeform(self, deform):
        if bool(deform) != self._deform:
            self._deform = bool(deform)
            self.Modified()

    def field(self):
        if self._field is None:
            opened = cleft.open(self._file)
            if not isinstance(opened, cleft.Field):
                raise cleft.InputError(f"{self._file}: is no field of one case; give a case.dffd")
            self._field = opened
        return self._field

    def FillInputPortInformation(self, port, info):
        info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet")
        return 1

    def RequestDataObject(self, request, in_info, out_info):
        given, made = self.GetInputData(in_info, 0, 0), self.GetOutputData(out_info, 0)
        if made is None or made.GetClassName() != given.GetClassName():
            made = given.NewInstance()
            out_info.GetInformationObject(0).Set(made.DATA_OBJECT(), made)
        return 1

    def RequestInformation(self, request, in_info, out_info):
        if not self._file:
            return 1
        try:
            tell_times(out_info, self.field().duration, self._frames)
        except (cleft.InputError, OSError) as error:
            return refuse(error)
        return 1

    def RequestData(self, request, in_info, out_info):
        given, made = self.GetInputData(in_info, 0, 0), self.GetOutputData(out_info, 0)
        try:
            if not self._file:
                raise cleft.InputError("Cleft: deform: choose a field, case.dffd")
            field = self.field()
            t = requested_time(out_info, field.duration)
            places = np.asarray(vtk_to_numpy(given.GetPoints().GetData()), dtype=float)
            side = given.GetPointData().GetArray("side")
            side = np.zeros(len(places)) if side is None else vtk_to_numpy(side)
            at = (*places.T, t, np.where(places[:, 1] == 0, side, 0))
            displacement = field(*at, threads=0, outside="clamp")
            quantities = {name: field.quantity(name, *at, threads=0, outside="clamp") for name in field.quantities}
        except (cleft.InputError, OSError) as error:
            return refuse(error)
        made.ShallowCopy(given)
        if self._deform:
            made.SetPoints(vtk_points(places + displacement))
        add_arrays(made.GetPointData(), {"displacement": displacement, **quantities})
        add_field_data(made, {"TimeValue": t, "estimated_error": field.estimated_error})
        return 1
