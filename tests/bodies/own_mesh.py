"""own_mesh.py export BODY.h5 OWN.vtu MATERIALS.toml MAP.npy: writes a body as the mesh of an engineer would be: only points,
wedges, triangles of skin and of bone, and numbers of regions, all in random order, with wedges and triangles turned at
random. own_mesh.py compare FIRST.h5 SECOND.h5 MAP.npy: whether two snapshots are the same series, node for node."""

import sys

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"Skipped: {missing}. Debian has python3-numpy and python3-h5py.")
    sys.exit(77)

SKIN, BONE, FIRST_REGION = 10, 11, 100
BOUND = 1e-9


def array(name, kind, numbers, components=1):
    numbers = np.asarray(numbers)
    text = " ".join("%.17g" % x if kind == "Float64" else str(x) for x in numbers.ravel())
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">{text}</DataArray>\n'


def export(body, out, materials, numbers):
    random = np.random.default_rng(3)
    with h5py.File(body, "r") as file:
        vtk = file["VTKHDF"]
        points, types, offsets = vtk["Points"][:], vtk["Types"][:], vtk["Offsets"][:]
        cells = [list(nodes) for nodes in np.split(vtk["Connectivity"][:], offsets[1:-1])]
        bone = file["foundation/triangles"][:][file["foundation/support"][:] == 1]
        regions = iter(file["regions/of_wedge"][:])
        names = file["regions"].attrs["names"]
        names = (names.decode() if isinstance(names, bytes) else names).split("\n")
        moduli = [file["regions"][name][:] for name in ("young_modulus", "poisson_ratio")]
    tags = [SKIN if kind == 5 else FIRST_REGION + next(regions) for kind in types] + [BONE] * len(bone)
    cells, types = cells + [list(nodes) for nodes in bone], list(types) + [5] * len(bone)
    place = random.permutation(len(points))  # by node: its new number
    moved = np.empty_like(points)
    moved[place] = points
    order = random.permutation(len(cells))
    turned = []
    for c in order:
        nodes = place[cells[c]]
        if types[c] == 13:
            turn = random.integers(3)
            nodes = np.concatenate([np.roll(nodes[:3], turn), np.roll(nodes[3:], turn)])
            nodes = nodes[[3, 4, 5, 0, 1, 2]] if random.integers(2) else nodes
        turned.append(nodes[[0, 2, 1]] if types[c] == 5 and random.integers(2) else nodes)
    with open(out, "w", encoding="utf-8") as file:
        file.write('<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid>\n')
        file.write(f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<Points>\n')
        file.write(array("Points", "Float64", moved, 3) + "</Points>\n<Cells>\n")
        file.write(array("connectivity", "Int64", np.concatenate(turned)))
        file.write(array("offsets", "Int64", np.cumsum([len(nodes) for nodes in turned])))
        file.write(array("types", "UInt8", np.array(types)[order]) + "</Cells>\n<CellData>\n")
        file.write(array("gmsh:physical", "Int32", np.array(tags)[order]) + "</CellData>\n")
        file.write("</Piece></UnstructuredGrid></VTKFile>\n")
    with open(materials, "w", encoding="utf-8") as file:
        file.write(f"[faces]\nskin = {SKIN}\n" + (f"bone = [{BONE}]\n" if len(bone) else ""))
        for number, name in reversed(list(enumerate(names))):
            file.write(f"[{name}]\nregion = {FIRST_REGION + number}\n")
            for key, values in zip(("young_modulus", "poisson_ratio"), moduli):
                file.write("" if np.isnan(values[number]) else f"{key} = {float(values[number])!r}\n")
    np.save(numbers, place)
    return 0


def compare(first, second, numbers):
    place = np.load(numbers)
    with h5py.File(first, "r") as a, h5py.File(second, "r") as b:
        frames = len(a["cut/released"])
        u, v = (f["VTKHDF/PointData/displacement"][:].reshape(frames, -1, 3) for f in (a, b))
        largest = np.abs(u).max()
        errors = {"displacement": np.abs(v[:, place] - u).max() / largest,
                  "points": np.abs(b["VTKHDF/Points"][:][place] - a["VTKHDF/Points"][:]).max(),
                  "canonical": np.abs(b["VTKHDF/PointData/canonical"][:][place] - a["VTKHDF/PointData/canonical"][:]).max(),
                  "frame": np.abs(b["VTKHDF/PointData/frame"][:][place] - a["VTKHDF/PointData/frame"][:]).max(),
                  "times": np.abs(b["VTKHDF/Steps/Values"][:] - a["VTKHDF/Steps/Values"][:]).max()}
        released = a["cut/released"][:]
        alike = (released == b["cut/released"][:]).all()
        for begin, end in zip(released[:-1], released[1:]):  # of a frame; where cuts cross their order is free
            alike = alike and sorted(map(tuple, place[a["cut/pairs"][begin:end]])) == \
                sorted(map(tuple, b["cut/pairs"][begin:end]))
    print(", ".join(f"{name} {error:.1e}" for name, error in errors.items()), "; pairs", "alike" if alike else "differ")
    return 0 if largest > 0 and alike and errors["displacement"] <= BOUND and errors["points"] <= BOUND else 1


if __name__ == "__main__":
    sys.exit(export(*sys.argv[2:]) if sys.argv[1] == "export" else compare(*sys.argv[2:]))
