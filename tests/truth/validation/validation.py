#!/usr/bin/env python3
"""validation.py BIN [--page FILE | --check FILE]: solves what docs/validation.md lists, compares it with answers that
are not of the project's code, and writes the page, or checks that the page is what it measures.

BIN: the folder of cleft and of the programs cleft-truth-...; solve_with_rule, for CalculiX, is in BIN/../tests.
Exit code 1: a row is further from its answer than its bound, or the page is another one. 77: a program or module is
missing."""

import argparse
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile
import textwrap

from answers import (Skin, Tissue, across_when_pulled_along, circular_hole, free_stretches, free_stretches_of_tissue,
                     hole_in_a_disc, np, root)

import measured
from page import Page, below, number, percent

HERE = pathlib.Path(__file__).resolve().parent
LAWS = {"st-venant-kirchhoff": "St. Venant-Kirchhoff", "neo-hookean": "neo-Hookean", "fung": "Fung"}
FIBRES = {"fibre_share": 0.6, "fibre_angle": 25, "fibre_dispersion": 0.1, "stiffening": 8}


class Tool:
    """The project's programs, run in a folder."""

    def __init__(self, programs, folder):
        self.programs, self.folder = pathlib.Path(programs), pathlib.Path(folder)

    def case(self, **values):
        lines = ["[case]"]
        for name, value in values.items():
            name = name.replace("__", ".")
            lines.append(f'{name} = "{value}"' if isinstance(value, str) else f"{name} = {value:.12g}")
        path = self.folder / "case.toml"
        path.write_text("\n".join(lines) + "\n")
        return path

    def run(self, program, *arguments, text=None):
        done = subprocess.run([self.programs / program, *map(str, arguments)], input=text, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE)
        if done.returncode != 0:
            raise SystemExit(f"{program} failed with {done.returncode}: {done.stderr[-1000:]}")
        return done.stdout

    def stresses(self, case, states):
        """(n, 6) of (kind, F_uu, F_uv, F_vu, F_vv, F_ww): see law.cpp."""
        lines = "\n".join(",".join([kind, *(f"{x:.17g}" for x in f)]) for kind, *f in states)
        printed = self.run("cleft-truth-law", case, text=lines)
        return np.array([[float(x) for x in line.split(",")] for line in printed.splitlines()])

    def solve(self, case):
        """The snapshot, as the independent reader of tests/solver reads it."""
        from patch import Patch
        out = self.folder / "case.h5"
        self.run("cleft", "solve", case, "--out", out, "--no-estimate")
        return Patch(out)

    def excision(self, case, radius, depth, rings):
        """By part: rows x, y, dx, dy."""
        out = self.folder / "excision.csv"
        self.run("cleft-truth-excision", case, radius, depth, rings, out)
        parts = {}
        with open(out) as file:
            for row in csv.DictReader(file):
                parts.setdefault(row["part"], []).append([float(row[name]) for name in ("x", "y", "dx", "dy")])
        return {part: np.array(rows) for part, rows in parts.items()}


def described(more):
    return ", ".join(f"{name.replace('_', ' ')} {value:g}" for name, value in more.items())


def skin_case(law, **more):
    return {f"skin__{name}": value for name, value in {"law": law, **more}.items()}


def changes(edge):
    """Relative changes of the extents along u and v, and of the area, of a closed row of nodes."""
    order = np.argsort(np.arctan2(edge[:, 1], edge[:, 0]))
    before, after = edge[order, :2], edge[order, :2] + edge[order, 2:]

    def area(places):
        x, y = places.T
        return np.abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2

    extents = np.ptp(after, axis=0) / np.ptp(before, axis=0) - 1
    return extents[0], extents[1], area(after) / area(before) - 1


def laws(tool, page):
    """Stress under stretches: uniaxial (no stress across), biaxial, and with shear."""
    stretches = (0.85, 0.95, 1.05, 1.1, 1.15)
    sheared = ((1.1, 0.08, -0.05, 0.95), (0.93, -0.1, 0.02, 1.2))
    for name, law, more in [(text, law, {}) for law, text in LAWS.items()] + [("Fung with fibres", "fung", FIBRES)]:
        skin = Skin(law, **more)
        across = [across_when_pulled_along(skin, x) for x in stretches]
        planes = [(x, 0, 0, y) for x, y in zip(stretches, across)] + [(x, 0, 0, x) for x in stretches] + list(sheared)
        found = tool.stresses(tool.case(**skin_case(law, **more)), [("skin", *f, 1) for f in planes])[:, :4]
        expected = np.array([skin.stress([[a, b], [c, d]]).ravel() for a, b, c, d in planes])
        add_law(page, "skin, " + name, found, expected, len(stretches))
    for law in ("neo-hookean", "st-venant-kirchhoff"):
        tissue = Tissue(law)
        uniaxial = []
        for x in stretches:
            side = root(lambda y: tissue.principal([x, y[0], y[0]])[1], [1 / np.sqrt(x)], tol=1e-14).x[0]
            uniaxial.append((x, 0, 0, side, side))
        biaxial = []
        for x in stretches:
            height = root(lambda y: tissue.principal([x, x, y[0]])[2], [1 / x**2], tol=1e-14).x[0]
            biaxial.append((x, 0, 0, x, height))
        found = tool.stresses(tool.case(tissue__law=law), [("tissue", *f) for f in uniaxial + biaxial])
        expected = np.array([tissue.principal([f[0], f[3], f[4]]) for f in uniaxial + biaxial])
        add_law(page, "tissue, " + LAWS[law], found[:, [0, 3, 4]], expected, len(stretches))
    # The textbook's incompressible sheet.
    mu, a = 0.05, 1.3
    found = tool.stresses(tool.case(**skin_case("neo-hookean", young_modulus=3 * mu, poisson_ratio=0.5, prestress_u=0,
                                                prestress_v=0)),
                          [("skin", a, 0, 0, a**-0.5, 1), ("skin", a, 0, 0, a, 1)])
    expected = np.array([mu * (a - a**-2), mu * (a - a**-5)])
    error = np.abs(found[:, 0] / expected - 1).max()
    page.row("skin, neo-Hookean, nu = 1/2, no tension, a = 1.3",
             f"{number(found[0, 0])}, {number(found[1, 0])}", "mu (a - a^-2), mu (a - a^-5)", below(error), error < 1e-12)


def add_law(page, name, found, expected, count):
    error = (np.abs(found - expected).max(axis=1) / np.abs(expected).max(axis=1)).max()
    page.row(name, f"{number(found[count - 1, 0])}, {number(found[2 * count - 1, 0])}",
             f"{number(expected[count - 1, 0])}, {number(expected[2 * count - 1, 0])}", below(error), error < 1e-10)


def stretches_of(patch):
    """Of frame 0: the linear map of the skin's nodes that fits best, and what it leaves, over the displacement."""
    skin = patch.points[:, 2] == 0
    before, moved = patch.points[skin][:, :2], patch.displacement[0][skin][:, :2]
    design = np.c_[np.ones(len(before)), before]
    gradient = np.linalg.lstsq(design, before + moved, rcond=None)[0]
    left = np.abs(design @ gradient - before - moved).max() / np.abs(moved).max()
    return gradient[1, 0], gradient[2, 1], left


PIECE = {"model": "finite", "patch__length": 12, "patch__width": 10, "patch__height": 1, "cut__length": 4, "cut__depth": 0.5,
         "mesh__grading": 1, "mesh__front": "nodes", "skin__edges": "free", "skin__bending_stiffness": 0.01,
         "foundation__stiffness": 1e-8, "foundation__side_stiffness": 0}


def pieces(tool, page):
    """What a free piece retracts to, by cleft solve."""
    for law, more in [("st-venant-kirchhoff", {}), ("neo-hookean", {}), ("fung", {"stiffening": 1.5}),
                      ("fung", {"stiffening": 5, "prestress_u": 0.004, "prestress_v": 0.01})]:
        expected = free_stretches(Skin(law, **more))
        case = tool.case(**PIECE, tissue__young_modulus=1e-7, **skin_case(law, **more))
        along, across, left = stretches_of(tool.solve(case))
        error = max(abs(along / expected[0] - 1), abs(across / expected[1] - 1))
        text = described(more)
        page.row(f"skin, {LAWS[law]}{', ' + text if text else ''}", f"{along:.4f} x {across:.4f}",
                 f"{expected[0]:.4f} x {expected[1]:.4f}", below(max(error, left), 1e-5), max(error, left) < 1e-4)
    for law in ("neo-hookean", "st-venant-kirchhoff"):
        tissue, initial = Tissue(law), (0.002, 0.004, 0)
        expected = free_stretches_of_tissue(tissue, initial)
        case = tool.case(**PIECE, tissue__law=law, tissue__prestress_share=1, skin__thickness=1e-6,
                         skin__prestress_u=initial[0], skin__prestress_v=initial[1])
        along, across, left = stretches_of(tool.solve(case))
        error = max(abs(along / expected[0] - 1), abs(across / expected[1] - 1))
        page.row(f"tissue, {LAWS[law]}", f"{along:.4f} x {across:.4f}", f"{expected[0]:.4f} x {expected[1]:.4f}",
                 below(max(error, left), 1e-5), max(error, left) < 1e-4)


SHEET = {"patch__length": 120, "patch__width": 120, "patch__height": 1e-4, "cut__length": 10, "cut__depth": 5e-5,
         "foundation__side_stiffness": 0}
RADIUS, OUTER = 10, 60


def converging(errors, rings):
    """At most half an element over the radius, and half of what it is with elements twice as long."""
    return errors[-1] < 0.5 / rings and (len(errors) == 1 or errors[-1] < errors[-2] / 2)


def holes_small(tool, page):
    tension_u, tension_v = 0.01, 0.03
    expected = hole_in_a_disc(0.13, 0.4, tension_u, tension_v, RADIUS, OUTER)
    errors = []
    for rings in (8, 16, 32):
        case = tool.case(**SHEET, mesh__grading=1.2 ** (8 / rings), foundation__stiffness=1e-8)
        along, across, _ = changes(tool.excision(case, RADIUS, 1e-4, rings)["hole_edge"])
        errors.append(max(abs(along - expected[0]), abs(across - expected[1])) / max(map(abs, expected)))
        page.row(f"small strains, {tension_u} : {tension_v} MPa, elements of a/{rings}",
                 f"{percent(along)}, {percent(across)}", f"{percent(expected[0])}, {percent(expected[1])}",
                 percent(errors[-1], sign=False), converging(errors, rings))


def holes_finite(tool, page):
    tension, springs = 0.03, 5e-4
    for law, more in (("st-venant-kirchhoff", {}), ("neo-hookean", {}), ("fung", {"stiffening": 2.})):
        skin = Skin(law, prestress_u=tension, prestress_v=tension, **more)
        expected = circular_hole(skin, tension, 1.5, springs, RADIUS, OUTER) / RADIUS
        errors = []
        for rings in (8, 16):
            case = tool.case(**SHEET, model="finite", mesh__grading=1.2 ** (8 / rings), foundation__stiffness=springs,
                             **skin_case(law, prestress_u=tension, prestress_v=tension, **more))
            along, across, _ = changes(tool.excision(case, RADIUS, 1e-4, rings)["hole_edge"])
            errors.append(max(abs(along - expected), abs(across - expected)) / expected)
            text = described(more)
            page.row(f"{LAWS[law]}{', ' + text if text else ''}, {tension} MPa, elements of a/{rings}",
                     f"{percent(along)}, {percent(across)}", percent(expected), percent(errors[-1], sign=False), converging(errors, rings))


def slit(tool, page):
    half = 8
    # The tension of the finite model is so small that its strains are; without bending its skin would have wrinkles.
    for model, size, tension, bending in (("small", 2, 0.01, 0), ("small", 1, 0.01, 0), ("small", 0.5, 0.01, 0),
                                          ("finite", 2, 1e-4, 1e-4), ("small", 1, 0.01, 0.01)):
        case = tool.case(model=model, patch__length=40 * half, patch__width=40 * half, patch__height=2, cut__length=2 * half,
                         cut__depth=1, mesh__element_size=size, mesh__grading=1.15, skin__prestress_u=tension,
                         skin__prestress_v=tension, skin__bending_stiffness=bending, tissue__young_modulus=1e-6,
                         foundation__stiffness=1e-9, foundation__side_stiffness=100)
        patch = tool.solve(case)
        at = patch.points[patch.pairs[:, 0]]
        middle = np.argmin(np.abs(at[:, 0]) - 1e3 * at[:, 2])
        left, right = patch.pairs[middle]
        found = patch.displacement[-1][right, 1] - patch.displacement[-1][left, 1]
        expected = 4 * tension / 0.13 * np.sqrt(half**2 - at[middle, 0] ** 2)
        error = abs(found / expected - 1)
        holds = error < 0.03 or bending > 1e-3  # docs/architecture.md, 2.2
        page.row(f"{model} strains, {tension:g} MPa, elements of a/{half / size:g}, bending {bending:g} N mm",
                 f"{number(found)} mm", f"{number(expected)} mm", percent(error, sign=False), holds)


def calculix(tool, page):
    """Frame by frame, as long as the lips are not wrinkled: where they are, it hangs on rounding which balance is found."""
    import calculix as program
    from finite import out_of_balance
    from patch import Patch, load
    if not shutil.which("ccx"):
        print("Skipped: no ccx. Debian has it in calculix-ccx.")
        sys.exit(77)
    for name, u, v, last in (("pulled 3 : 2", 0.03, 0.02, 9), ("pulled 1 : 3", 0.01, 0.03, 5)):
        case = tool.case(model="finite", patch__length=24, patch__width=20, patch__height=4, cut__length=10, cut__depth=2,
                         mesh__front="nodes", skin__law="st-venant-kirchhoff", tissue__law="st-venant-kirchhoff",
                         skin__prestress_u=u, skin__prestress_v=v)
        out = tool.folder / "calculix.h5"
        tool.run("../tests/solve_with_rule", case, out)
        patch = Patch(out)
        for frame in range(1, last + 1):
            found = patch.displacement[frame]
            stands, unbalanced = patch.joined(frame), out_of_balance(patch, frame, "centroid", found)
            together = np.zeros_like(unbalanced)
            np.add.at(together, stands, unbalanced)
            residual = np.abs(together).max() / np.abs(load(patch)).max()
            _, printed = program.run_ccx(tool.folder, program.deck_of(patch, frame, 1))
            expected = program.displacements(printed, len(patch.points))
            error = np.abs(found - expected).max() / np.abs(expected).max()
            page.row(f"{name}, frame {frame}", f"{np.abs(found).max():.3f} mm", f"{np.abs(expected).max():.3f} mm",
                     below(error, 1e-6), below(residual, 1e-7), error < 1e-4 and residual < 1e-6)


BODIES = {"around": "cut around a cylinder of 60 mm", "bent": "cut around a cylinder of 30 mm",
          "axial": "cut along a cylinder of 60 mm", "sphere": "cut on a sphere of 80 mm",
          "plate": "two cuts that cross, on a plate", "cross": "two cuts that cross, on a sphere, above bone"}


def bodies(tool, page):
    """The last frame of small bodies: by ccx, with its rule; by the independent solver, with the rule of cleft solve."""
    import calculix as program
    from patch import Patch, solve, stiffness
    if not shutil.which("ccx"):
        print("Skipped: no ccx. Debian has it in calculix-ccx.")
        sys.exit(77)
    case = tool.case(mesh__element_size=1.5, mesh__grading=1.6, patch__height=4.5, skin__prestress_uv=0.004)
    for subject, name in BODIES.items():
        options = tool.run("../tests/write_subject", subject, tool.folder).split()
        body, as_ccx, out = (tool.folder / file for file in ("body.h5", "as_ccx.h5", "case.h5"))
        tool.run("cleft", "body", *options, "--case", case, "--reach", 8, "--direction", "1,0.3,0.1", "--out", body)
        tool.run("../tests/solve_with_rule", case, as_ccx, body)
        tool.run("cleft", "solve", case, "--mesh", body, "--out", out, "--no-estimate")
        patch, frame = Patch(as_ccx), len(Patch(as_ccx).released) - 1
        found = patch.displacement[frame]
        scale = program.LARGEST_PRINTED / np.abs(found).max()
        _, printed = program.run_ccx(tool.folder, program.deck_of(patch, frame, scale))
        expected = program.displacements(printed, len(patch.points)) / scale
        error = np.abs(found - expected).max() / np.abs(expected).max()
        patch = Patch(out)
        again = solve(patch, stiffness(patch), frame)
        off = np.abs(patch.displacement[frame] - again).max() / np.abs(again).max()
        page.row(name, f"{np.abs(found).max():.3f} mm", f"{np.abs(expected).max():.3f} mm", below(error, 1e-7),
                 below(off, 1e-9), error < program.BOUND and off < 1e-8)


SECTIONS = {
    "calculix": [("case, frame", "largest displacement", "CalculiX", "difference", "forces out of balance"), calculix],
    "bodies": [("body", "largest displacement", "CalculiX", "difference", "difference of the independent solver"), bodies],
    "laws": [("law", "stress along, MPa: uniaxial, biaxial", "answer", "largest difference over all states"), laws],
    "pieces": [("piece", "stretches along u and v", "answer", "difference"), pieces],
    "holes": [("sheet", "change of the hole's diameter", "answer", "difference"), holes_small, holes_finite],
    "slit": [("sheet", "opening next to the middle", "answer", "difference"), slit],
    "measured": [("skin", "fitted", "Cleft", "measured"), measured.rows],
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", metavar="BIN")
    parser.add_argument("--sections", nargs="+", choices=SECTIONS, default=list(SECTIONS), help="these only (default: all)")
    chosen = parser.add_mutually_exclusive_group()
    chosen.add_argument("--page", metavar="FILE", help="write the page")
    chosen.add_argument("--check", metavar="FILE", help="compare the page's sections")
    options = parser.parse_args()
    if options.page and len(options.sections) < len(SECTIONS):
        parser.error("--page: the page has all sections; leave --sections out")
    page = Page(HERE / "texts.txt")
    with tempfile.TemporaryDirectory() as folder:
        tool = Tool(options.programs, folder)
        for name in options.sections:
            heads, *tables = SECTIONS[name]
            page.begin(name, heads)
            for table in tables:
                table(tool, page)
    if options.page and not page.failed:
        pathlib.Path(options.page).write_text(page.written())
    elif options.check:
        page.compare(pathlib.Path(options.check).read_text(), options.check)
    elif not options.page:
        print(page.written(), end="")
    for row in page.failed:
        print(f"further from its answer than its bound: {row}")
    return 1 if page.failed or page.differs else 0


if __name__ == "__main__":
    sys.path[:0] = [str(HERE.parent.parent / "solver/independent"), str(HERE.parent.parent / "solver/calculix")]
    sys.exit(main())
