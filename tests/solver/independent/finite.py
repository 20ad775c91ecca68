"""The forces of a patch under finite strains, from the file and docs/formats.md alone (its section "Finite strains")."""

from patch import bending_stiffness, foundation, load, np, skin_gradients, wedge_points


def pull(patch, rule):
    """(N, 3): the dead loads: what holds the closed patch."""
    released, edges = load(patch, rule), patch["skin.edges"]
    patch.parameters["skin.edges"] = "free"
    everything = load(patch, rule)
    patch.parameters["skin.edges"] = edges
    return released - everything


def tissue_forces(patch, u, rule):
    young, poisson = patch.tissue_moduli()
    mu, lam, kappa = young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson)), \
        young / (3 * (1 - 2 * poisson))
    moved = u[patch.wedges]
    initial = np.zeros((3, 3))
    initial[:2, :2] = patch["tissue.prestress_share"] * patch.prestress()
    points = [(gradient, volume, np.eye(3) + np.einsum("eni,enj->eij", moved, gradient))
              for gradient, volume in wedge_points(patch, rule)]
    mean = sum(volume * np.linalg.det(f) for _, volume, f in points) / sum(volume for _, volume, _ in points)
    forces = np.zeros_like(u)
    for gradient, volume, f in points:
        right, determinant = np.swapaxes(f, 1, 2) @ f, np.linalg.det(f)
        if patch["tissue.law"] == "neo-hookean":
            inverse, trace = np.linalg.inv(right), np.trace(right, axis1=1, axis2=2)
            change = mean if patch["tissue.formulation"] == "mean-dilatation" else determinant
            stress = (mu * determinant ** (-2 / 3))[:, None, None] * (np.eye(3) - trace[:, None, None] / 3 * inverse)
            stress += (kappa * (change - 1) * determinant)[:, None, None] * inverse
        else:
            strain = (right - np.eye(3)) / 2
            stress = (lam * np.trace(strain, axis1=1, axis2=2))[:, None, None] * np.eye(3) + 2 * mu[:, None, None] * strain
        parts = volume[:, None, None] * np.einsum("eij,ejk,enk->eni", f, stress + initial, gradient)
        np.add.at(forces, patch.wedges.ravel(), parts.reshape(-1, 3))
    return forces


def bisect(function, low, high):
    """The zero of an increasing function, by elements."""
    for _ in range(200):
        middle = (low + high) / 2
        above = function(middle) > 0
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return (low + high) / 2


def exponential(stress, tangent, stiffening, strain):
    """The derivative of w(stress, tangent; strain), and the strain e0; vectors and matrices in Voigt's notation."""
    work = stress @ np.linalg.solve(tangent, stress)
    x = float(bisect(lambda x: 1 / stiffening - (1 - x) * np.exp(-x / (2 * (1 - x))), np.array(0.), np.array(1.)))
    if work == 0 or stiffening == 1:
        return stress + strain @ tangent, None
    b = x / work
    a = tangent - b * np.outer(stress, stress)
    start = np.linalg.solve(a, stress)
    e = strain + start
    exponent = b / 2 * (np.einsum("ei,ij,ej->e", e, a, e) - start @ a @ start)
    return np.exp(exponent)[:, None] * (e @ a), start


def fung(patch, prestress, elasticity, strain):
    angle, kappa = np.radians(patch["skin.fibre_angle"]), patch["skin.fibre_dispersion"]
    m = np.array([np.cos(angle), np.sin(angle)])
    h = kappa * np.eye(2) + (1 - 2 * kappa) * np.outer(m, m)
    h = np.array([h[0, 0], h[1, 1], h[0, 1]])
    k = patch["skin.fibre_share"] / (h @ np.linalg.solve(elasticity, h))
    s = k * max(0, h @ np.linalg.solve(elasticity, prestress))
    stress, _ = exponential(prestress - s * h, elasticity - k * np.outer(h, h), patch["skin.stiffening"], strain)
    if k > 0:
        stretch = strain @ h
        of_fibres, start = exponential(np.array([s]), np.array([[k]]), patch["skin.stiffening"], stretch[:, None])
        slack = -np.inf if s == 0 else -s / k if start is None else -start[0]
        stress = stress + np.where(stretch > slack, of_fibres[:, 0], 0)[:, None] * h
    return stress


def skin_forces(patch, u):
    gradient, area = skin_gradients(patch)
    young, nu = patch["skin.young_modulus"], patch["skin.poisson_ratio"]
    f = np.swapaxes(patch.skin_axes(), 1, 2) + np.einsum("eni,enj->eij", u[patch.skin], gradient)
    right = np.swapaxes(f, 1, 2) @ f
    strain = (right - np.eye(2)) / 2
    if patch["skin.law"] == "neo-hookean":
        mu, determinant = young / (2 * (1 + nu)), np.linalg.det(right)
        c = bisect(lambda c: (1 - 2 * nu) * (c - 1) + nu * np.log(c * determinant), 1e-3 + 0 * determinant,
                   1e3 + 0 * determinant)
        stress = patch.prestress() + mu * (np.eye(2) - c[:, None, None] * np.linalg.inv(right))
    else:
        elasticity = young / (1 - nu**2) * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])
        (uu, uv), (_, vv) = patch.prestress()
        prestress, e = np.array([uu, vv, uv]), np.stack([strain[:, 0, 0], strain[:, 1, 1], 2 * strain[:, 0, 1]], axis=1)
        s = prestress + e @ elasticity if patch["skin.law"] != "fung" else fung(patch, prestress, elasticity, e)
        stress = np.stack([s[:, [0, 2]], s[:, [2, 1]]], axis=1)
    forces = np.zeros_like(u)
    parts = (area * patch["skin.thickness"])[:, None, None] * np.einsum("eij,ejk,enk->eni", f, stress, gradient)
    np.add.at(forces, patch.skin.ravel(), parts.reshape(-1, 3))
    return forces


def out_of_balance(patch, frame, rule="full", u=None):
    """(N, 3): the loads less the forces of tissue, skin and springs, at the displacement of a frame or another one."""
    u = patch.displacement[frame] if u is None else u
    return pull(patch, rule) - tissue_forces(patch, u, rule) - skin_forces(patch, u) - \
        (foundation(patch) + bending_stiffness(patch, frame)) @ u


def normals(patch):
    """(P, 3): of the pairs of straight cuts, from left to right: v of the first cut, u of a branch, which leaves it
    toward +v, and whose nodes on the first cut have three copies."""
    right = set()
    result = np.zeros((len(patch.pairs), 3))
    for number, (left, right_node) in enumerate(patch.pairs):
        of_branch = abs(patch.points[left, 1]) > 1e-9 or left in right
        result[number, 0 if of_branch else 1] = 1
        right.add(right_node)
    return result


def without_contact(patch, frame, left_over, closed=1e-6):
    """left_over without what the lips of open pairs may do: press on each other along the normal, where they touch to
    `closed` of the largest displacement. Fails where they overlap by more. From the last pair back, because a closed
    pair hands on what its right node bears to its left one, which may be the right one of an earlier pair."""
    forces, u = left_over.copy(), patch.displacement[frame]
    largest, touching = np.abs(u).max(), 0
    for number in reversed(range(len(patch.pairs))):
        left, right = patch.pairs[number]
        shared = forces[right].copy()
        if number < patch.released[frame]:
            normal = normals(patch)[number]
            gap, pressed = normal @ (u[right] - u[left]), -normal @ shared
            if gap < -closed * largest:
                raise SystemExit(f"frame {frame}: lips overlap by {-gap:.2e} mm")
            presses = pressed > 0 and gap < closed * largest
            touching += presses
            shared = -pressed * normal if presses else np.zeros(3)
        forces[right] -= shared
        forces[left] += shared
    return forces, touching
