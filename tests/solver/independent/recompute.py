"""recompute.py CASE.h5: solves frames of a snapshot again from its mesh, pairs and parameters, with scipy's sparse
direct solver, and compares the displacements; sums the forces on the foundation, which must balance.

The bound is 1e-8 of the largest displacement. Both programs solve the same equations in double precision by stable
eliminations, so they may differ by the rounding of 1e-16 times the condition number of the stiffness: 2e3 for the
default materials, 3e5 at nu = 0.4999, 2e6 on bottom springs of 1e-5 N/mm^3 alone; 1e8 leaves room. Every parameter,
face and pair counts for more: one part in a million of any modulus, or of the prestress, changes 1e-7 or more."""

import argparse
import shutil
import sys

from finite import out_of_balance, without_contact
from patch import Patch, RULES, foundation, h5py, load, np, solve, stiffness

BOUND = 1e-8
# Of the finite model, whose iterations end at residuals of 1e-7 of the largest load; here the forces of both nodes of a
# pair are added, and the tangent is another than that of the frame.
FINITE_BOUND = 1e-6


def spread_evenly(count, most):
    return sorted({round(i) for i in np.linspace(0, count - 1, min(count, most))})


def balance(patch, springs, displacement):
    """What the springs' forces and moments add up to, over the sum of their sizes. The load has no sum and no moment.
    (A geometric stiffness, linearised, does not see rotations: then only forces balance.)"""
    forces = springs @ displacement
    size = np.abs(forces).sum()
    left_over = np.abs(forces.sum(axis=0)).max() / size
    if patch["skin.initial_stress_stiffness"] == "true" or patch["skin.turning_stiffness"] > 0:
        return left_over
    reach = np.ptp(patch.points, axis=0).max()
    return max(left_over, np.abs(np.cross(patch.points, forces).sum(axis=0)).max() / (size * reach))


def finite_errors(patch, matrix, frame, rule):
    """Of a frame of the finite model: the largest force that is out of balance over the largest load, and by how much
    such forces would move the patch, with the tangent at the reference state, over the largest displacement."""
    stands, displacement = patch.joined(frame), patch.displacement[frame]
    left_over, touching = out_of_balance(patch, frame, rule), 0
    if patch["cut.contact"] == "true":
        left_over, touching = without_contact(patch, frame, left_over)
    together = np.zeros_like(left_over)
    np.add.at(together, stands, left_over)
    unbalanced = np.abs(together).max() / np.abs(load(patch)).max()
    moved = np.abs(solve(patch, matrix, frame, left_over)).max()
    largest = np.abs(displacement).max()
    print(f"frame {frame}: {len(patch.pairs) - patch.released[frame]} pairs closed, {touching} pressed, forces out of "
          f"balance {unbalanced:.1e}, which would move the patch by {moved / largest if largest > 0 else moved:.1e}")
    return unbalanced, moved / largest if largest > 0 else moved


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("snapshot")
    parser.add_argument("--frames", type=lambda text: [int(i) for i in text.split(",")],
                        help="for example 0,3,-1; default: six, spread evenly")
    parser.add_argument("--rule", choices=RULES, default="full",
                        help="integration of the wedges (default: %(default)s)")
    parser.add_argument("--out", help="compare nothing; write a copy of the snapshot with all its frames solved here")
    options = parser.parse_args()

    patch = Patch(options.snapshot)
    matrix, springs, count = stiffness(patch, options.rule), foundation(patch), len(patch.released)
    print(f"{3 * len(patch.points)} unknowns, {len(patch.pairs)} pairs, {count} frames, rule {options.rule}")
    if options.out:
        shutil.copyfile(options.snapshot, options.out)
        with h5py.File(options.out, "r+") as copy:
            copy["VTKHDF/PointData/displacement"][:] = np.concatenate([solve(patch, matrix, j) for j in range(count)])
        return 0

    print(f"load: sum {np.abs(load(patch).sum(axis=0)).max():.1e} N, largest {np.abs(load(patch)).max():.3g} N")
    errors = []
    for frame in options.frames or spread_evenly(count, 6):
        frame %= count
        if patch["model"] == "finite":
            errors += [error * BOUND / FINITE_BOUND for error in finite_errors(patch, matrix, frame, options.rule)]
            continue
        expected, found = solve(patch, matrix, frame), patch.displacement[frame]
        if frame == 0 and patch["skin.edges"] == "held":
            print(f"frame 0: largest displacement {np.abs(found).max():.1e}, must be 0")
            errors.append(0 if not found.any() else np.inf)
            continue
        error = np.abs(found - expected).max() / np.abs(expected).max()
        unbalanced = balance(patch, springs, found)
        print(f"frame {frame}: {len(patch.pairs) - patch.released[frame]} pairs closed, "
              f"relative error {error:.1e}, forces out of balance {unbalanced:.1e}")
        errors += [error, unbalanced]
    worst = np.max(errors)
    print(f"worst {worst:.1e}, allowed {BOUND:.0e}")
    return 0 if worst <= BOUND else 1  # NaN fails too


if __name__ == "__main__":
    sys.exit(main())
