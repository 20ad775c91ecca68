"""formats_test.py CLEFT [FORMAT]: a series in each format gives the snapshot that it gives as .vtu files, and damaged
files are refused or read, without a crash and without leaving anything behind."""

import pathlib
import subprocess
import sys
import tempfile

SKIPPED = 77
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
try:
    import h5py
    import numpy as np

    import written
except ImportError as missing:
    print(f"Skipped: {missing}.")
    sys.exit(SKIPPED)

ALL = "displacement,stress,temperature,full,energy"
# How each names the fields, and to which digits it keeps numbers.
FORMATS = {
    "vtu": (ALL, 1e-12),
    "vtu_in_any_order": (ALL, 1e-12),
    "several_vtu": (ALL, 1e-12),
    "vtm": (ALL, 1e-12),
    "vtm_of_a_body_and_its_boundary": ("energy", 1e-12),  # of cells alone: nodes that part are not welded
    "pvtu": (ALL, 1e-12),
    "legacy": (ALL, 1e-8),
    "two_pvd": ("u/f:displacement,s/f:stress,temperature,full,energy", 1e-12),
    "exodus": ("displacement,temperature,energy", 1e-12),
    "exodus_in_pieces": ("displacement,temperature,energy", 1e-12),
    "ensight": ("displacement,temperature", 1e-5),
    "cgns": ("displacement,stress,temperature", 1e-12),
    "xdmf": (ALL, 1e-12),
    "xdmf_in_text": (ALL, 1e-12),
    "vtkhdf_in_parts": (ALL, 1e-12),
}


def imported(cleft, series, fields, out):
    return subprocess.run([cleft, "import", *map(str, series), "--field", fields, "--out", str(out)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def rows_of(case, names):
    """All of a node in a row, in an order that does not depend on the file's; and what the cut is."""
    with h5py.File(case) as file:
        root = file["VTKHDF"]
        points, frames = root["Points"][:], len(root["Steps/Values"])
        rows = [points] + [root["PointData/" + name][:].reshape(frames, len(points), -1)[j]
                           for name in names for j in range(frames)]
        rows = np.concatenate(rows, 1)
        cut = {name: file["cut/" + name][:] for name in ("released", "position")}
        cut["times"], cut["cells"] = root["Steps/Values"][:], len(root["Types"])
        cut["paired"] = sorted(map(tuple, np.round(points[file["cut/pairs"][:, 0]], 4).tolist()))
    keys = np.round(np.concatenate([points, rows[:, -30:], rows[:, 3:18]], 1), 4) + 0.0
    return rows[np.lexsort(keys.T[::-1])], cut


def check(cleft, name, folder):
    fields, digits = FORMATS[name]
    bar, made, reference = written.Bar(), folder / name, folder / "reference"
    made.mkdir(), reference.mkdir()
    series = getattr(written, name)(bar, made)
    done = imported(cleft, series, fields, folder / "case.h5")
    if done.returncode != 0:
        return [f"{name}: {done.stdout}"]
    own = [field.split(":")[-1] for field in fields.split(",")]
    assert imported(cleft, written.vtu(bar, reference), ",".join(own), folder / "reference.h5").returncode == 0
    rows, cut = rows_of(folder / "case.h5", own)
    expected, expected_cut = rows_of(folder / "reference.h5", own)
    wrong = []
    if rows.shape != expected.shape:
        return [f"{name}: {rows.shape} rather than {expected.shape}"]
    if not np.allclose(rows, expected, rtol=digits, atol=digits * 300):
        wrong.append(f"{name}: numbers are off by {np.abs(rows - expected).max()}")
    for part, value in expected_cut.items():
        if not np.array_equal(cut[part], value):
            wrong.append(f"{name}: {part} is {cut[part]} rather than {value}")
    return wrong


def check_values(folder):
    """The reference itself, against the closed form."""
    bar = written.Bar()
    with h5py.File(folder / "reference.h5") as file:
        root = file["VTKHDF"]
        frames, count = len(written.TIMES), len(bar.points)
        axes, origin = file["import"].attrs["axes"].reshape(3, 3), file["import"].attrs["origin"]
        wrong = []
        if not np.allclose(root["Points"][:], (bar.points - origin) @ axes.T):
            wrong.append("points differ from the closed form")
        for name in ("stress", "full"):
            tensors = root["PointData/" + name][:].reshape(frames, count, 6)
            for j in range(frames):
                s = bar.fields(j)["stress"]
                there = s[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3)
                turned = axes @ there @ axes.T
                if not np.allclose(tensors[j], turned.reshape(-1, 9)[:, [0, 4, 8, 1, 5, 2]]):
                    wrong.append(f"{name} differs from the closed form in frame {j}")
        energy = root["PointData/energy"][:].reshape(frames, count)
        for j in range(frames):
            sums, cells = np.zeros(count), np.zeros(count)
            np.add.at(sums, bar.cells, bar.energy(j)[:, None])
            np.add.at(cells, bar.cells, 1)
            if not np.allclose(energy[j], sums / cells):
                wrong.append(f"the mean of the cells differs in frame {j}")
        released = file["cut/released"][:].tolist()
        # Columns of 3 pairs at x < 1.5 j.
        if released != [3 * min(6, int(np.ceil(1.5 * j))) for j in range(frames)]:
            wrong.append(f"released: {released}")
    return wrong


def damaged(cleft, name, folder):
    """Truncations and flipped bits of each kind of file."""
    bar, made, out = written.Bar(), folder / "damaged", folder / "out"
    made.mkdir(), out.mkdir()
    series = getattr(written, name)(bar, made)
    kinds, wrong = {}, []
    for path in sorted(p for p in made.rglob("*") if p.is_file()):
        kinds[path.suffix] = path  # the last of each
    for path in kinds.values():
        sound, size = path.read_bytes(), path.stat().st_size
        cases = [sound[:int(size * part)] for part in (0, 0.1, 0.5, 0.9, 0.999)]
        for place in np.linspace(0, size - 1, 8, dtype=int):
            flipped = bytearray(sound)
            flipped[place] ^= 1 << int(place % 8)
            cases.append(bytes(flipped))
        for i, bytes_now in enumerate(cases):
            path.write_bytes(bytes_now)
            done = imported(cleft, series, FORMATS[name][0], out / "case.h5")
            if done.returncode not in (0, 2):
                wrong.append(f"{name}, {path.name}, damage {i}: exit code {done.returncode}: {done.stdout[-300:]}")
            elif path.suffix in (".displacement", ".temperature", ".geo") and len(bytes_now) < size and done.returncode == 0:
                wrong.append(f"{name}, {path.name}: {len(bytes_now)} of {size} bytes were taken")
            elif done.returncode == 2 and (len(done.stdout.splitlines()) != 1 or any(out.iterdir())):
                wrong.append(f"{name}, {path.name}, damage {i}: left {list(out.iterdir())}, said {done.stdout[-500:]}")
            for left in out.iterdir():
                left.unlink()
        path.write_bytes(sound)
    return wrong


def main():
    cleft, wrong = sys.argv[1], []
    for name in sys.argv[2:] or FORMATS:
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            wrong += check(cleft, name, folder)
            if name == "vtu" and not wrong:
                wrong += check_values(folder)
            wrong += damaged(cleft, name, folder)
        print(name, flush=True)
    print("\n".join(wrong) or "all as .vtu has it")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
