"""results_test.py CLEFT: CalculiX's .frd, in text and binary, with every kind of solid cell, imported as it is."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"Skipped: {missing}.")
    sys.exit(SKIPPED)

# Nodes of CalculiX's elements in the order of its manual: corners of a unit cell, then middles of edges: of the lower
# face, of the upper one, upright.
CUBE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
WEDGE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
CUBE_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
WEDGE_EDGES = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
TETRAHEDRON_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
KINDS = {"C3D8": (CUBE, []), "C3D6": (WEDGE, []), "C3D4": (TETRAHEDRON, []), "C3D20": (CUBE, CUBE_EDGES),
         "C3D15": (WEDGE, WEDGE_EDGES), "C3D10": (TETRAHEDRON, TETRAHEDRON_EDGES)}
# VTK's types, and the edges whose middles its further nodes are, in its order.
VTK = {"C3D8": (12, []), "C3D6": (13, []), "C3D4": (10, []), "C3D20": (25, CUBE_EDGES), "C3D15": (26, WEDGE_EDGES),
       "C3D10": (24, TETRAHEDRON_EDGES)}
LOADS = [1, 3, 2]


def cells_in_a_row():
    """Each with its own nodes, 2 apart, and numbers of nodes with gaps."""
    nodes, elements = {}, []
    for e, (kind, (corners, edges)) in enumerate(KINDS.items()):
        places = [np.array(c, dtype=float) for c in corners]
        places += [(places[a] + places[b]) / 2 for a, b in edges]
        numbers = [100 * (e + 1) + 3 * i for i in range(len(places))]
        nodes.update({n: p + [2 * e, 0, 0] for n, p in zip(numbers, places)})
        elements.append((kind, numbers))
    return nodes, elements


def deck(nodes, elements, words):
    lines = ["*NODE, NSET=ALL"] + [f"{n}, " + ", ".join(map(str, p)) for n, p in nodes.items()]
    for e, (kind, numbers) in enumerate(elements, 1):
        text = [str(n) for n in (e, *numbers)]
        lines += [f"*ELEMENT, TYPE={kind}, ELSET=E{e}", ", ".join(text[:11]) + ("," if len(text) > 11 else "")]
        if len(text) > 11:
            lines.append(", ".join(text[11:]))
        lines += [f"*SOLID SECTION, ELSET=E{e}, MATERIAL=M"]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", "1000, 0.3", "*BOUNDARY"]
    lines += [f"{n}, 1, 3" for n, p in nodes.items() if p[2] == 0]
    for load in LOADS:
        lines += ["*STEP", "*STATIC", "*CLOAD"]
        lines += [f"{n}, {dof}, {load * 0.1 * dof}" for n, p in nodes.items() if p[2] == 1 for dof in (1, 2, 3)]
        lines += [f"*NODE {words}", "U", f"*ELEMENT {words}".replace("ELEMENT FILE", "EL FILE"), "S", "*END STEP"]
    return "\n".join(lines) + "\n"


def run(*command, **options):
    return subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)


def results_in(path):
    """Of the text, by name: a table a step; numbers of the nodes first. Independent of the reader under test."""
    results, rows, number_of_result = {}, None, {}
    for line in path.read_text().splitlines():
        key = line[:3].strip()
        if key == "-4":
            name = line[5:13].strip()
            rows = []
            results.setdefault(name, []).append(rows)
            number_of_result[name] = len(results[name])
        elif key == "-1" and rows is not None:
            rows.append([float(line[3:13])] + [float(line[i:i + 12]) for i in range(13, len(line) - 11, 12)])
        elif key == "-3":
            rows = None
    return {name: [np.array(table) for table in tables] for name, tables in results.items()}


def check(case, nodes, elements, results, digits):
    wrong = []
    with h5py.File(case) as file:
        root = file["VTKHDF"]
        axes, origin = file["import"].attrs["axes"].reshape(3, 3), file["import"].attrs["origin"]
        points = root["Points"][:] @ axes + origin
        if not np.allclose(points, np.array(list(nodes.values())), atol=1e-5):
            wrong.append("points differ")
        if not np.array_equal(root["Steps/Values"][:], np.arange(len(LOADS))):
            wrong.append(f"times are {root['Steps/Values'][:]}")
        offsets, corners = root["Offsets"][:], root["Connectivity"][:]
        for e, (kind, numbers) in enumerate(elements):
            type_of, edges = VTK[kind]
            of_cell = points[corners[offsets[e]:offsets[e + 1]]]
            count = len(numbers) - len(edges)
            expected = [of_cell[:count]] + [of_cell[[a, b]].mean(0, keepdims=True) for a, b in edges]
            if root["Types"][e] != type_of or not np.allclose(of_cell, np.concatenate(expected), atol=1e-5):
                wrong.append(f"{kind}: type {root['Types'][e]}, or nodes in another order")
            if not np.allclose(of_cell[:count], [nodes[n] for n in numbers[:count]], atol=1e-5):
                wrong.append(f"{kind}: its corners are in another order")
        displacement = root["PointData/displacement"][:].reshape(len(LOADS), -1, 3) @ axes
        six = root["PointData/STRESS"][:].reshape(len(LOADS), -1, 6)[:, :, [0, 3, 5, 3, 1, 4, 5, 4, 2]]
        stress = (axes.T @ six.reshape(len(LOADS), -1, 3, 3) @ axes).reshape(len(LOADS), -1, 9)
        for j in range(len(LOADS)):
            for name, found, columns in (("DISP", displacement[j], slice(None)),
                                         ("STRESS", stress[j], [0, 4, 8, 1, 5, 2])):
                table = results[name][j]
                order = [list(nodes).index(int(n)) for n in table[:, 0]]
                expected = table[:, 1:]
                if not np.allclose(found[order][:, columns], expected, rtol=digits,
                                   atol=digits * np.abs(expected).max()):
                    wrong.append(f"{name} differs in step {j}")
        if not np.abs(displacement[1]).max() > 2 * np.abs(displacement[0]).max():
            wrong.append("a load three times as large moves no more than the first")
    return wrong


def damaged(cleft, path, out):
    """Every damage is refused, or the file is read; nothing is left, and one line is said."""
    sound, wrong = path.read_bytes(), []
    cases = [sound[:int(len(sound) * part / 20)] for part in range(20)]
    for place in np.linspace(0, len(sound) - 1, 60, dtype=int):
        flipped = bytearray(sound)
        flipped[place] ^= 1 << int(place % 7)
        cases.append(bytes(flipped))
    for i, now in enumerate(cases):
        path.write_bytes(now)
        done = run(cleft, "import", str(path), "--field", "DISP:displacement,STRESS", "--out", str(out / "case.h5"))
        if done.returncode not in (0, 2) or (i < 20 and done.returncode == 0):
            wrong.append(f"damage {i}: exit code {done.returncode}: {done.stdout[-300:]}")
        if done.returncode == 2 and (done.stdout.count("\n") != 1 or any(out.iterdir())):
            wrong.append(f"damage {i}: left {list(out.iterdir())}, said {done.stdout}")
        for left in out.iterdir():
            left.unlink()
    return wrong


def main():
    cleft = sys.argv[1]
    if not shutil.which("ccx"):
        print("Skipped: no ccx. Debian has it in calculix-ccx.")
        return SKIPPED
    nodes, elements = cells_in_a_row()
    wrong = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        (folder / "out").mkdir()
        results = None
        for form, words in (("text", "FILE"), ("binary", "OUTPUT")):
            (folder / f"{form}.inp").write_text(deck(nodes, elements, words))
            done = run("ccx", "-i", form, cwd=folder)
            frd, case = folder / f"{form}.frd", folder / f"{form}.h5"
            if "*ERROR" in done.stdout or not frd.exists():
                raise SystemExit(done.stdout[-3000:])
            results = results or results_in(frd)
            done = run(cleft, "import", str(frd), "--field", "DISP:displacement,STRESS", "--box", "aligned", "--out",
                       str(case))
            if done.returncode != 0:
                wrong.append(f"{form}: {done.stdout}")
                continue
            wrong += [f"{form}: {what}" for what in check(case, nodes, elements, results, 2e-5)]
            wrong += [f"{form}: {what}" for what in damaged(cleft, frd, folder / "out")]
    print("\n".join(wrong) or "as CalculiX has it")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
