"""A cracked bar with closed-form fields, written in formats of series by the programs that own them: VTK's writers, the
CGNS library, and h5py for .xdmf and .vtkhdf."""

import ctypes
import json

import h5py
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

TIMES = [0.0, 1.0, 2.5, 3.0, 4.0]
COLUMNS, ROWS, LAYERS = 8, 4, 2
NAMES = {"displacement": 3, "stress": 6, "temperature": 1, "full": 9}


class Bar:
    """[0, 8] x [-2, 2] x [0, 2] of unit cubes, doubled on y = 0 up to x = 5; in frame j it is open up to x = 1.5 j."""

    def __init__(self):
        self.numbers, nodes, self.cells = {}, [], []
        for k in range(LAYERS):
            for j in range(-ROWS // 2, ROWS // 2):
                for i in range(COLUMNS):
                    corners = []
                    for c in (0, 1):
                        for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                            side = (1 if j >= 0 else -1) if j + b == 0 and i + a <= 5 else 0
                            key = i + a, j + b, k + c, side
                            if key not in self.numbers:
                                self.numbers[key] = len(nodes)
                                nodes.append(key)
                            corners.append(self.numbers[key])
                    self.cells.append(corners)
        self.cells = np.array(self.cells)
        self.points = np.array([key[:3] for key in nodes], dtype=float)
        self.side = np.array([key[3] for key in nodes])

    def fields(self, frame):
        """Of the nodes: rows by name; temperature and energy of the cells too."""
        x, y, z = self.points.T
        opening = np.where(x < 1.5 * frame, np.sqrt(np.maximum(0, 1.5 * frame - x)), 0)
        up = 0.1 * self.side * opening
        u = np.stack([0.01 * frame * y, up + 0.02 * frame * x * z, 0.005 * frame * x], 1)
        stress = np.stack([u[:, 1], x + frame, y, z * frame, x * y, 1 + u[:, 0]], 1)
        full = stress[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]]
        return {"displacement": u, "stress": stress, "temperature": 300 + frame * x + u[:, 1:2].ravel(), "full": full}

    def energy(self, frame):
        return self.points[self.cells].mean(1) @ [1, 10, 100] + frame

    def parts(self):
        """Two halves, as lists of cells."""
        middle = self.points[self.cells].mean(1)[:, 0] < COLUMNS / 2
        return [np.flatnonzero(middle), np.flatnonzero(~middle)]


def grid_of(bar, frame, cells=None, names=("displacement", "stress", "temperature", "full"), energy=True):
    cells = np.arange(len(bar.cells)) if cells is None else cells
    used, corners = np.unique(bar.cells[cells], return_inverse=True)
    grid, points = vtk.vtkUnstructuredGrid(), vtk.vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(bar.points[used].copy(), deep=1))
    grid.SetPoints(points)
    for row in corners.reshape(-1, 8):
        grid.InsertNextCell(vtk.VTK_HEXAHEDRON, 8, [int(i) for i in row])
    for name in names:
        array = numpy_to_vtk(np.ascontiguousarray(bar.fields(frame)[name][used]), deep=1)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    if energy:
        array = numpy_to_vtk(bar.energy(frame)[cells].copy(), deep=1)
        array.SetName("energy")
        grid.GetCellData().AddArray(array)
    return grid


def blocks_of(bar, frame, **options):
    blocks = vtk.vtkMultiBlockDataSet()
    for i, cells in enumerate(bar.parts()):
        blocks.SetBlock(i, grid_of(bar, frame, cells, **options))
    return blocks


def write(writer, data, path):
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    assert writer.Write() == 1


def list_in(folder, name, files, parts=None):
    entries = "".join(f'<DataSet timestep="{t}" part="{p}" file="{f}"/>'
                      for f, t, p in zip(files, np.repeat(TIMES, len(files) // len(TIMES)), parts or [0] * len(files)))
    (folder / name).write_text(f'<VTKFile type="Collection"><Collection>{entries}</Collection></VTKFile>')
    return [folder / name]


def each(folder, ending, write_frame):
    files = []
    for frame in range(len(TIMES)):
        files.append(f"bar_{frame}{ending}")
        write_frame(frame, folder / files[-1])
    return files


def vtu(bar, folder):
    return list_in(folder, "bar.pvd",
                   each(folder, ".vtu", lambda j, path: write(vtk.vtkXMLUnstructuredGridWriter(), grid_of(bar, j), path)))


def vtu_in_any_order(bar, folder):
    """The same nodes and cells, but the cells in another order in all but the first and last frame."""
    def one(j, path):
        order = np.random.default_rng(j % (len(TIMES) - 1)).permutation(len(bar.cells))
        write(vtk.vtkXMLUnstructuredGridWriter(), grid_of(bar, j, order), path)
    return list_in(folder, "bar.pvd", each(folder, ".vtu", one))


def several_vtu(bar, folder):
    """Each frame in two files."""
    files = []
    for j in range(len(TIMES)):
        for p, cells in enumerate(bar.parts()):
            files.append(f"bar_{j}_{p}.vtu")
            write(vtk.vtkXMLUnstructuredGridWriter(), grid_of(bar, j, cells), folder / files[-1])
    return list_in(folder, "bar.pvd", files, [0, 1] * len(TIMES))


def vtm(bar, folder):
    def one(j, path):
        writer = vtk.vtkXMLMultiBlockDataWriter()
        blocks = blocks_of(bar, j)
        surface = vtk.vtkDataSetSurfaceFilter()  # OpenFOAM's files have the boundary beside the body
        surface.SetInputData(grid_of(bar, j, bar.parts()[0]))
        surface.Update()
        blocks.SetBlock(2, surface.GetOutput())
        write(writer, blocks, path)
    return list_in(folder, "bar.pvd", each(folder, ".vtm", one))


def vtm_of_a_body_and_its_boundary(bar, folder):
    def one(j, path):
        body, blocks, surface = grid_of(bar, j), vtk.vtkMultiBlockDataSet(), vtk.vtkDataSetSurfaceFilter()
        surface.SetInputData(body)
        surface.Update()
        blocks.SetBlock(0, body)
        blocks.SetBlock(1, surface.GetOutput())
        write(vtk.vtkXMLMultiBlockDataWriter(), blocks, path)
    return list_in(folder, "bar.pvd", each(folder, ".vtm", one))


def pvtu(bar, folder):
    def one(j, path):
        for p, cells in enumerate(bar.parts()):
            write(vtk.vtkXMLUnstructuredGridWriter(), grid_of(bar, j, cells), path.with_name(f"p{p}_{j}.vtu"))
        arrays = "".join(f'<PDataArray type="Float64" Name="{n}" NumberOfComponents="{c}"/>' for n, c in NAMES.items())
        path.write_text(
            '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid GhostLevel="0"><PPointData>' + arrays
            + '</PPointData><PCellData><PDataArray type="Float64" Name="energy"/></PCellData>'
            '<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints>'
            + "".join(f'<Piece Source="p{p}_{j}.vtu"/>' for p in (0, 1)) + "</PUnstructuredGrid></VTKFile>")
    return list_in(folder, "bar.pvd", each(folder, ".pvtu", one))


def legacy(bar, folder):
    files = each(folder, ".vtk", lambda j, path: write(vtk.vtkUnstructuredGridWriter(), grid_of(bar, j), path))
    (folder / "bar.vtk.series").write_text(json.dumps(
        {"file-series-version": "1.0", "files": [{"name": f, "time": t} for f, t in zip(files, TIMES)]}))
    return [folder / "bar.vtk.series"]


def two_pvd(bar, folder):
    """Fields in two series, where `f` is in both, and whose cells are in another order."""
    def half(name, fields):
        order = np.random.default_rng(len(name + fields[0])).permutation(len(bar.cells))

        def one(j, path):
            grid = grid_of(bar, j, order, names=fields, energy="temperature" in fields)
            grid.GetPointData().GetArray(fields[0]).SetName("f")
            write(vtk.vtkXMLUnstructuredGridWriter(), grid, path)
        (folder / name).mkdir()
        files = each(folder / name, ".vtu", one)
        return list_in(folder, name + ".pvd", [f"{name}/{f}" for f in files])
    return half("u", ["displacement"]) + half("s", ["stress", "temperature", "full"])


def exodus_file(path, frames):
    """`frames`: data of each time."""
    from vtk.util.vtkAlgorithm import VTKPythonAlgorithmBase

    class Source(VTKPythonAlgorithmBase):
        def __init__(self):
            VTKPythonAlgorithmBase.__init__(self, nInputPorts=0, nOutputPorts=1, outputType="vtkMultiBlockDataSet")

        def RequestInformation(self, _request, _inputs, outputs):
            information = outputs.GetInformationObject(0)
            keys = vtk.vtkStreamingDemandDrivenPipeline
            information.Set(keys.TIME_STEPS(), TIMES, len(TIMES))
            information.Set(keys.TIME_RANGE(), [TIMES[0], TIMES[-1]], 2)
            return 1

        def RequestData(self, _request, _inputs, outputs):
            information = outputs.GetInformationObject(0)
            time = information.Get(vtk.vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
            output = vtk.vtkMultiBlockDataSet.GetData(outputs, 0)
            frame = TIMES.index(time) if time in TIMES else 0
            output.ShallowCopy(frames[frame])
            output.GetInformation().Set(vtk.vtkDataObject.DATA_TIME_STEP(), TIMES[frame])
            return 1

    source, writer = Source(), vtk.vtkExodusIIWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(str(path))
    writer.WriteAllTimeStepsOn()
    assert writer.Write() == 1


def exodus(bar, folder):
    exodus_file(folder / "bar.e", [blocks_of(bar, j) for j in range(len(TIMES))])
    return [folder / "bar.e"]


def exodus_in_pieces(bar, folder):
    for p, cells in enumerate(bar.parts()):
        frames = []
        for j in range(len(TIMES)):
            frames.append(vtk.vtkMultiBlockDataSet())
            frames[-1].SetBlock(0, grid_of(bar, j, cells))
        exodus_file(folder / f"bar.e.2.{p}", frames)
    return [folder / "bar.e.2.0"]


def ensight(bar, folder):
    for j in range(len(TIMES)):
        grid = grid_of(bar, j, energy=False)
        ids = numpy_to_vtk(np.ones(len(bar.cells), dtype=np.int32), deep=1)
        ids.SetName("BlockId")
        grid.GetCellData().AddArray(ids)
        writer = vtk.vtkEnSightWriter()
        writer.SetPath(str(folder))
        writer.SetBaseName("bar")
        writer.SetTimeStep(j)
        writer.SetInputData(grid)
        writer.Write()
    # VTK's writer of the .case itself knows no times but 0, 1, 2, ..., and closes it only when the program ends.
    (folder / "bar.case").write_text(
        "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: bar.0.00000.geo\nVARIABLE\n"
        "vector per node: 1 displacement bar.0.*****_n.displacement\n"
        "scalar per node: 1 temperature bar.0.*****_n.temperature\n"
        f"TIME\ntime set: 1\nnumber of steps: {len(TIMES)}\nfilename start number: 0\nfilename increment: 1\n"
        "time values: " + " ".join(map(str, TIMES)) + "\n")
    return [folder / "bar.case"]


def cgns(bar, folder):
    library = ctypes.CDLL("libvtkcgns-9.1.so.1")
    real_double, vertex, hexa_8 = 4, 2, 17
    path, i32 = str(folder / "bar.cgns"), ctypes.c_int

    def call(name, *arguments):
        assert getattr(library, "vtkcgns_" + name)(*arguments) == 0, name

    def text(word):
        return word.encode()

    def doubles(values):
        return np.ascontiguousarray(values, dtype=np.float64).ctypes.data_as(ctypes.c_void_p)

    file, base, zone, number = i32(), i32(), i32(), i32()
    call("cg_open", text(path), 1, ctypes.byref(file))
    call("cg_base_write", file, text("Base"), 3, 3, ctypes.byref(base))
    sizes = np.array([len(bar.points), len(bar.cells), 0], dtype=np.int64)
    width = np.int64 if cgsize_is_long() else np.int32
    sizes = sizes.astype(width)
    call("cg_zone_write", file, base, text("Zone"), sizes.ctypes.data_as(ctypes.c_void_p), 3, ctypes.byref(zone))
    for axis, name in enumerate("XYZ"):
        call("cg_coord_write", file, base, zone, real_double, text("Coordinate" + name),
             doubles(bar.points[:, axis].copy()), ctypes.byref(number))
    corners = np.ascontiguousarray(bar.cells + 1, dtype=width)
    size = ctypes.c_int64 if width == np.int64 else ctypes.c_int
    call("cg_section_write", file, base, zone, text("Cells"), hexa_8, size(1), size(len(bar.cells)), 0,
         corners.ctypes.data_as(ctypes.c_void_p), ctypes.byref(number))
    pointers = b""
    for j in range(len(TIMES)):
        solution = i32()
        call("cg_sol_write", file, base, zone, text(f"At{j}"), vertex, ctypes.byref(solution))
        pointers += text(f"At{j}".ljust(32))
        fields = bar.fields(j)
        columns = {"displacement" + a: fields["displacement"][:, i] for i, a in enumerate("XYZ")}
        columns["temperature"] = fields["temperature"]
        columns |= {"stress" + c: fields["stress"][:, i] for i, c in enumerate(("XX", "YY", "ZZ", "XY", "YZ", "XZ"))}
        for name, values in columns.items():
            call("cg_field_write", file, base, zone, solution, real_double, text(name), doubles(values.copy()),
                 ctypes.byref(number))
    call("cg_biter_write", file, base, text("Iterations"), len(TIMES))
    call("cg_goto", file, base, text("BaseIterativeData_t"), 1, text("end"))
    count = np.array([len(TIMES)], dtype=width)
    call("cg_array_write", text("TimeValues"), real_double, 1, count.ctypes.data_as(ctypes.c_void_p), doubles(TIMES))
    call("cg_ziter_write", file, base, zone, text("OfZone"))
    call("cg_goto", file, base, text("Zone_t"), zone, text("ZoneIterativeData_t"), 1, text("end"))
    extent = np.array([32, len(TIMES)], dtype=width)
    call("cg_array_write", text("FlowSolutionPointers"), 5, 2, extent.ctypes.data_as(ctypes.c_void_p), pointers)
    call("cg_close", file)
    return [folder / "bar.cgns"]


def cgsize_is_long():
    return ctypes.sizeof(ctypes.c_void_p) == 8


def xdmf(bar, folder):
    """As FEniCSx writes it: a mesh, and a collection for each function that includes it."""
    include = ('<xi:include xpointer="xpointer(/Xdmf/Domain/Grid[@GridType=\'Uniform\'][1]/*[self::Topology or '
               'self::Geometry])"/>')
    collections = ""
    with h5py.File(folder / "bar.h5", "w") as file:
        file["/Mesh/mesh/topology"], file["/Mesh/mesh/geometry"] = bar.cells, bar.points
        for name, columns in {**NAMES, "energy": 1}.items():
            center, count = ("Cell", len(bar.cells)) if name == "energy" else ("Node", len(bar.points))
            grids = ""
            for j, t in enumerate(TIMES):
                values = bar.energy(j) if name == "energy" else bar.fields(j)[name]
                dataset = f"/Function/{name}/{str(t).replace('.', '_')}"
                file[dataset] = values.reshape(count, columns)
                grids += (f'<Grid Name="{name}" GridType="Uniform">{include}<Time Value="{t}"/><Attribute Name="{name}" '
                          f'Center="{center}"><DataItem Dimensions="{count} {columns}" Format="HDF" Precision="8">'
                          f"bar.h5:{dataset}</DataItem></Attribute></Grid>")
            collections += f'<Grid Name="{name}" GridType="Collection" CollectionType="Temporal">{grids}</Grid>'
    (folder / "bar.xdmf").write_text(
        '<?xml version="1.0"?><!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []>'
        '<Xdmf Version="3.0" xmlns:xi="https://www.w3.org/2001/XInclude"><Domain><Grid Name="mesh" GridType="Uniform">'
        f'<Topology TopologyType="hexahedron" NumberOfElements="{len(bar.cells)}" NodesPerElement="8">'
        f'<DataItem Dimensions="{len(bar.cells)} 8" NumberType="Int" Format="HDF">bar.h5:/Mesh/mesh/topology</DataItem>'
        f'</Topology><Geometry GeometryType="XYZ"><DataItem Dimensions="{len(bar.points)} 3" Format="HDF">'
        "bar.h5:/Mesh/mesh/geometry</DataItem></Geometry></Grid>" + collections + "</Domain></Xdmf>")
    return [folder / "bar.xdmf"]


def xdmf_in_text(bar, folder):
    """Numbers in the text, mixed cells, and a mesh in each grid."""
    def item(values):
        return (f'<DataItem Dimensions="{" ".join(map(str, values.shape))}" Format="XML">'
                + " ".join(repr(v) for v in values.ravel().tolist()) + "</DataItem>")

    hexahedron = 9
    mixed = np.concatenate([np.full((len(bar.cells), 1), hexahedron), bar.cells], 1).ravel()
    grids = ""
    for j, t in enumerate(TIMES):
        arrays = "".join(f'<Attribute Name="{n}" Center="Node">{item(v)}</Attribute>' for n, v in bar.fields(j).items())
        arrays += f'<Attribute Name="energy" Center="Cell">{item(bar.energy(j))}</Attribute>'
        grids += (f'<Grid><Time Value="{t}"/><Topology TopologyType="Mixed">{item(mixed)}</Topology>'
                  f'<Geometry GeometryType="XYZ">{item(bar.points)}</Geometry>{arrays}</Grid>')
    (folder / "bar.xmf").write_text('<Xdmf><Domain><Grid GridType="Collection" CollectionType="Temporal">' + grids
                                    + "</Grid></Domain></Xdmf>")
    return [folder / "bar.xmf"]


def vtkhdf_in_parts(bar, folder):
    """Two parts in each step; the mesh is there once."""
    with h5py.File(folder / "bar.vtkhdf", "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = [2, 0]
        root.attrs["Type"] = np.bytes_("UnstructuredGrid")
        used = [np.unique(bar.cells[part], return_inverse=True) for part in bar.parts()]
        root["NumberOfPoints"] = [len(nodes) for nodes, _ in used]
        root["NumberOfCells"] = [len(part) for part in bar.parts()]
        root["NumberOfConnectivityIds"] = [len(corners.ravel()) for _, corners in used]
        root["Points"] = np.concatenate([bar.points[nodes] for nodes, _ in used])
        root["Connectivity"] = np.concatenate([corners.ravel() for _, corners in used])
        root["Offsets"] = np.concatenate([np.arange(len(part) + 1) * 8 for part in bar.parts()])
        root["Types"] = np.full(len(bar.cells), vtk.VTK_HEXAHEDRON, dtype=np.uint8)
        nodes, frames = np.concatenate([nodes for nodes, _ in used]), range(len(TIMES))
        for name in NAMES:
            root[f"PointData/{name}"] = np.concatenate([bar.fields(j)[name][nodes] for j in frames])
            root[f"Steps/PointDataOffsets/{name}"] = np.arange(len(TIMES)) * len(nodes)
        cells = np.concatenate(bar.parts())
        root["CellData/energy"] = np.concatenate([bar.energy(j)[cells] for j in frames])
        root["Steps/CellDataOffsets/energy"] = np.arange(len(TIMES)) * len(cells)
        root["Steps/Values"] = TIMES
        root["Steps/NumberOfParts"] = [2] * len(TIMES)
        for name in ("PartOffsets", "PointOffsets"):
            root["Steps/" + name] = [0] * len(TIMES)
        for name in ("CellOffsets", "ConnectivityIdOffsets"):
            root["Steps/" + name] = np.zeros((len(TIMES), 1), dtype=int)
    return [folder / "bar.vtkhdf"]
