"""calculix.py SNAPSHOT.h5: writes frames of a snapshot as CalculiX decks, runs ccx, and compares the displacements.

The snapshot must be solved with the wedges integrated as ccx integrates its C3D6: the triangle's centroid times two
points along the axis (a few percent from the full rule on coarse meshes). Its frames are compared with ccx's, and so
are those of tests/solver/independent, solved here with the same rule.

A deck has C3D6 for the tissue; M3D3 for the skin; *INITIAL CONDITIONS, TYPE=STRESS for its prestress, in space; *EQUATION
for closed pairs; *CLOAD for the pull of the surrounding skin at held edges (of a body: for all that the closed one bears);
and the foundation's consistent springs as SPRING1 with the row sums of their matrix M and SPRING2 of stiffness -M_ab
between neighbours a, b: the same quadratic form. ccx makes a solid of a membrane; so that it stays a
membrane, the skin is thin in the deck, and its modulus and prestress are as much higher.

The prestress is scaled in the deck so that the largest displacement is just below 10: ccx prints 7 digits, which is
then 5e-8 of it. The bound is four times that, for the skin's small bending stiffness and ccx's own rounding."""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "independent"))
from patch import Patch, foundation, np, skin_gradients, solve, sparse, stiffness  # noqa: E402

BOUND = 2e-7
FINITE_BOUND = 2e-6  # residuals of 1e-7 on one side, ccx's own convergence on the other
LARGEST_PRINTED = 9.9  # mm
SKIN_THICKNESS = 0.002  # mm, in the deck
SKIPPED = 77


def number(value):
    """At most 12 digits: ccx cuts fields at 20 characters."""
    return f"{value:.11e}"


class Deck:
    """The text of a deck and the elements in it; nodes and elements are numbered from 1."""

    def __init__(self, patch):
        self.patch, self.lines, self.elements = patch, [], 0
        self.lines += ["*NODE, NSET=ALL"]
        self.lines += [f"{i}, " + ", ".join(map(number, x)) for i, x in enumerate(patch.points, 1)]

    def add_elements(self, kind, name, cells):
        self.lines.append(f"*ELEMENT, TYPE={kind}, ELSET={name}")
        for cell in cells:
            self.elements += 1
            self.lines.append(", ".join(str(i) for i in (self.elements, *(cell + 1))))

    def add_material(self, name, young, poisson):
        self.lines += [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{number(young)}, {number(poisson)}"]

    def add_tissue(self):
        wedges, points = self.patch.wedges, self.patch.points
        corners = points[wedges]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        inverted = np.einsum("ei,ei->e", normal, corners[:, 3] - corners[:, 0]) < 0
        wedges = np.where(inverted[:, None], wedges[:, [3, 4, 5, 0, 1, 2]], wedges)  # ccx wants them upright
        moduli = self.patch.tissue_moduli().T
        for number, (young, poisson) in enumerate(np.unique(moduli, axis=0)):
            name = f"TISSUE{number}"
            self.add_elements("C3D6", name, wedges[(moduli == (young, poisson)).all(axis=1)])
            self.add_material(name, young, poisson)
            self.lines.append(f"*SOLID SECTION, ELSET={name}, MATERIAL={name}")

    def add_skin(self, load_scale):
        patch, first = self.patch, self.elements + 1
        thicker = patch["skin.thickness"] / SKIN_THICKNESS
        self.add_elements("M3D3", "SKIN", patch.skin)
        self.add_material("SKIN", patch["skin.young_modulus"] * thicker, patch["skin.poisson_ratio"])
        self.lines += ["*MEMBRANE SECTION, ELSET=SKIN, MATERIAL=SKIN", number(SKIN_THICKNESS)]
        self.lines.append("*INITIAL CONDITIONS, TYPE=STRESS")
        for element, axes in enumerate(patch.skin_axes(), first):
            s = axes.T @ patch.prestress() @ axes * thicker * load_scale
            stress = ", ".join(map(number, (s[0, 0], s[1, 1], s[2, 2], s[0, 1], s[0, 2], s[1, 2])))
            self.lines += [f"{element}, {point}, {stress}" for point in (1, 2)]

    def add_springs(self):
        """An element set for each different stiffness."""
        matrix = foundation(self.patch)
        to_ground = np.asarray(matrix.sum(axis=1)).ravel()
        between = sparse.triu(matrix, k=1).tocoo()
        for kind, cells, constants in (("SPRING1", np.arange(len(to_ground))[:, None], to_ground),
                                       ("SPRING2", np.stack([between.row, between.col], axis=1), -between.data)):
            texts = np.array([number(k) for k in constants])
            for text in np.unique(texts[constants != 0]):
                for dof in (1, 2, 3):
                    name = f"{kind}_{text}_{dof}".replace(".", "P").replace("+", "P").replace("-", "M")
                    self.add_elements(kind, name, cells[texts == text])
                    self.lines += [f"*SPRING, ELSET={name}", f"{dof}" if kind == "SPRING1" else f"{dof}, {dof}", text]

    def add_closed_pairs(self, frame):
        stands = self.patch.joined(frame)
        for node in np.flatnonzero(stands != np.arange(len(stands))):
            for dof in (1, 2, 3):
                self.lines += ["*EQUATION", "2", f"{node + 1}, {dof}, 1., {stands[node] + 1}, {dof}, -1."]

    def add_step(self, load_scale):
        """Under finite strains in one increment."""
        finite = self.patch["model"] == "finite"
        self.lines += ["*STEP, NLGEOM", "*STATIC", "1., 1."] if finite else ["*STEP", "*STATIC"]
        if self.patch["skin.edges"] == "held":
            self.lines.append("*CLOAD")
            pull = (borne if self.patch.is_body else edge_pull)(self.patch) * load_scale
            self.lines += [f"{n + 1}, {axis + 1}, {number(pull[n, axis])}" for n, axis in np.argwhere(pull)]
        self.lines += ["*NODE PRINT, NSET=ALL", "U", "*END STEP"]

    def text(self):
        return "\n".join(self.lines) + "\n"


def edge_pull(patch):
    """(N, 2), N: what the surrounding skin pulls with at the skin's edges on the patch's sides, t sigma0 n for each mm."""
    force = np.zeros((len(patch.points), 2))
    most = np.abs(patch.points[:, :2]).max(axis=0)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        ends = patch.skin[:, [a, b]]
        at = patch.points[ends][:, :, :2]
        outer = (np.abs(np.abs(at) - most) < 1e-9).all(axis=1).any(axis=1)
        along = (at[:, 1] - at[:, 0])[outer]
        outward = np.stack([along[:, 1], -along[:, 0]], axis=1)  # as long as the edge
        for end in (0, 1):
            np.add.at(force, ends[outer, end], patch["skin.thickness"] / 2 * outward @ patch.prestress())
    return force


def borne(patch):
    """(N, 3), N: what the surroundings and the tissue below bear of the tension of a closed body, node by node: against the
    forces of the skin's prestress, the copies at one place in equal parts."""
    gradient, area = skin_gradients(patch)
    force, stands = np.zeros((len(patch.points), 3)), patch.joined(0)
    pulled = area[:, None, None] * (gradient @ patch.prestress() @ patch.skin_axes()) * patch["skin.thickness"]
    np.add.at(force, stands[patch.skin].ravel(), pulled.reshape(-1, 3))
    return force[stands] / np.bincount(stands)[stands][:, None]


def deck_of(patch, frame, load_scale):
    stiffened = patch["skin.initial_stress_stiffness"] == "true" or patch["skin.turning_stiffness"] > 0
    if patch["tissue.formulation"] != "displacement" or stiffened:
        raise SystemExit("ccx has no mean dilatation in C3D6, nor a prestress that stiffens a linear step")
    if patch["tissue.prestress_share"] != 0:
        raise SystemExit("tissue.prestress_share: the decks have no initial stress of the tissue")
    if patch["model"] == "finite" and {patch["tissue.law"], patch["skin.law"]} != {"st-venant-kirchhoff"}:
        raise SystemExit("of the laws of finite strains ccx's *ELASTIC is that of St. Venant and Kirchhoff")
    deck = Deck(patch)
    deck.add_tissue()
    deck.add_skin(load_scale)
    deck.add_springs()
    deck.add_closed_pairs(frame)
    deck.add_step(load_scale)
    return deck.text()


def run_ccx(folder, deck):
    """Seconds, and the displacements as printed."""
    (folder / "deck.inp").write_text(deck)
    threads = {"OMP_NUM_THREADS": os.environ.get("OMP_NUM_THREADS", "1")}
    start = time.perf_counter()
    done = subprocess.run(["ccx", "-i", "deck"], cwd=folder, env=os.environ | threads, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    seconds = time.perf_counter() - start
    if done.returncode != 0 or "*ERROR" in done.stdout or not (folder / "deck.dat").exists():
        raise SystemExit(f"ccx failed with {done.returncode}:\n{done.stdout[-3000:]}")
    return seconds, (folder / "deck.dat").read_text()


def displacements(printed, count):
    """(N, 3) from *NODE PRINT."""
    result = np.full((count, 3), np.nan)
    for line in printed.splitlines():
        fields = line.split()
        if re.fullmatch(r"\d+", fields[0] if fields else ""):
            result[int(fields[0]) - 1] = [float(f) for f in fields[1:4]]
    return result


def compare_finite(patch, frames, folder):
    """The prestress cannot be scaled: 7 digits of the largest displacement itself."""
    worst = 0
    for frame in frames:
        _, printed = run_ccx(folder, deck_of(patch, frame, 1))
        expected, found = displacements(printed, len(patch.points)), patch.displacement[frame]
        largest = np.abs(expected).max()
        error = np.abs(found - expected).max() / (largest if largest > 1e-6 else 1)
        print(f"frame {frame}: largest displacement {largest:.4g} mm, relative error {error:.1e}")
        worst = max(worst, error)
    print(f"worst {worst:.1e}, allowed {FINITE_BOUND:.0e}")
    return 0 if worst <= FINITE_BOUND else 1


def compare(patch, frames, folder):
    if patch["model"] == "finite":
        return compare_finite(patch, frames, folder)
    matrix, worst = stiffness(patch, "centroid"), []
    for frame in frames:
        independent = solve(patch, matrix, frame)
        load_scale = LARGEST_PRINTED / np.abs(independent).max()
        _, printed = run_ccx(folder, deck_of(patch, frame, load_scale))
        expected = displacements(printed, len(patch.points)) / load_scale
        largest = np.abs(expected).max()
        errors = [np.abs(found - expected).max() / largest for found in (patch.displacement[frame], independent)]
        print(f"frame {frame}: {len(patch.pairs) - patch.released[frame]} pairs closed, largest displacement "
              f"{largest:.4g} mm, relative error of the snapshot {errors[0]:.1e}, "
              f"of the independent solver {errors[1]:.1e}")
        worst += errors
    print(f"worst {np.max(worst):.1e}, allowed {BOUND:.0e}")
    return 0 if np.max(worst) <= BOUND else 1  # NaN fails too


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("snapshot")
    parser.add_argument("--frames", type=lambda text: [int(i) for i in text.split(",")],
                        help="for example 0,3,-1; default: the first, the middle one, the last")
    parser.add_argument("--keep", metavar="DIR", help="keep the last deck and what ccx wrote")
    parser.add_argument("--time", action="store_true",
                        help="compare nothing; run the last frame's deck once and print a line of JSON")
    options = parser.parse_args()
    if not shutil.which("ccx"):
        print("Skipped: no ccx. Debian has it in calculix-ccx.")
        return SKIPPED

    patch = Patch(options.snapshot)
    count = len(patch.released)
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(options.keep or temporary)
        folder.mkdir(exist_ok=True)
        if options.time:
            seconds, _ = run_ccx(folder, deck_of(patch, count - 1, 1))
            unknowns = 3 * len(patch.points)
            print(json.dumps({"program": "ccx *STATIC", "unknowns": unknowns, "seconds": round(seconds, 3)}))
            return 0
        first = 1 if patch["skin.edges"] == "held" else 0  # a held patch does not move while it is closed
        return compare(patch, [j % count for j in options.frames or (first, count // 2, count - 1)], folder)


if __name__ == "__main__":
    sys.exit(main())
