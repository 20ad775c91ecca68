"""A snapshot's patch of tissue, or body, assembled and solved from the file and docs/formats.md alone (its section "What
the displacements solve"): none of the solver's code is used, and no formula was taken from it."""

import sys

try:
    import h5py
    import numpy as np
    import scipy.sparse as sparse
    from scipy.sparse.linalg import splu
except ImportError as missing:
    print(f"Skipped: {missing}. Debian has python3-numpy, python3-scipy and python3-h5py.")
    sys.exit(77)

TRIANGLE, WEDGE = 5, 13  # VTK's cell types

# Parameters that a file of an older version lacks: what its solver did.
BEFORE_THEY_CAME = {
    "tissue.formulation": "displacement",
    "skin.initial_stress_stiffness": "false",
    "skin.turning_stiffness": 0.0,
    "cut.contact": "false",
    "model": "small",
    "skin.bending_stiffness": 0.0,
    "skin.edges": "free",
    "tissue.prestress_share": 0.0,
}

# Rules on the reference wedge a, b, 1 - a - b >= 0 and -1 <= c <= 1, of volume 1: points (a, b, c) and weights.
AXIS = (-1 / np.sqrt(3), 1 / np.sqrt(3))
RULES = {
    "full": [(a, b, c, 1 / 6) for a, b in ((1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3)) for c in AXIS],
    "centroid": [(1 / 3, 1 / 3, c, 1 / 2) for c in AXIS],
}


class Patch:
    """N points; displacement is (F, N, 3). Of a body, tension is (T, 3), the direction of skin.prestress_u in each triangle
    of the skin, and on_bone says of each face below whether it is grown to bone."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            vtk = file["VTKHDF"]
            self.points = vtk["Points"][:]
            types, offsets, connectivity = vtk["Types"][:], vtk["Offsets"][:], vtk["Connectivity"][:]

            def cells(kind, corners):
                return connectivity[offsets[:-1][types == kind][:, None] + np.arange(corners)]

            self.skin, self.wedges = cells(TRIANGLE, 3), cells(WEDGE, 6)
            self.bottom, self.sides = file["foundation/triangles"][:], file["foundation/quads"][:]
            self.is_body = "body" in file.attrs
            if self.is_body:
                self.tension, self.on_bone = file["skin/tension"][:], file["foundation/support"][:] == 1
            else:
                self.tension = np.tile([1., 0, 0], (len(self.skin), 1))
                self.on_bone = np.zeros(len(self.bottom), dtype=bool)
            self.regions = file["regions/of_wedge"][:] if "regions" in file else None
            self.region_moduli = file["regions/moduli"][:] if "regions" in file else None
            self.pairs, self.released = file["cut/pairs"][:], file["cut/released"][:]
            self.displacement = vtk["PointData/displacement"][:].reshape(len(self.released), -1, 3)
            self.parameters = dict(BEFORE_THEY_CAME)
            for name, value in file["parameters"].attrs.items():
                self.parameters[name] = value.decode() if isinstance(value, bytes) else value
        if self.parameters["cut.contact"] == "true" and self["model"] != "finite":
            raise SystemExit("cut.contact = true: its frames solve no linear system")
        if not self.is_body and np.abs(self.points[self.skin][:, :, 2]).max() > 0:
            raise SystemExit("the skin does not lie at w = 0")
        if self.is_body and self["skin.bending_stiffness"] != 0:
            raise SystemExit("a body whose skin resists bending is not solved here")
        if np.abs(np.linalg.norm(self.tension, axis=1) - 1).max() > 1e-6 or \
                np.abs(np.einsum("ei,ei->e", self.tension, self.normals())).max() > 1e-6:
            raise SystemExit("a direction of the tension is no unit vector in the plane of its triangle")

    def __getitem__(self, name):
        return self.parameters[name]

    def tissue_moduli(self):
        """E and nu of each wedge."""
        if self.regions is not None:
            return self.region_moduli[self.regions].T
        return np.array([[self["tissue.young_modulus"]], [self["tissue.poisson_ratio"]]]) * np.ones(len(self.wedges))

    def prestress(self):
        """2 x 2, MPa."""
        u, v, uv = (self[f"skin.prestress_{axes}"] for axes in ("u", "v", "uv"))
        return np.array([[u, uv], [uv, v]])

    def normals(self):
        """(T, 3): unit, of the skin's triangles."""
        first, second, third = (self.points[self.skin[:, i]] for i in range(3))
        normal = np.cross(second - first, third - first)
        return normal / np.linalg.norm(normal, axis=1)[:, None]

    def skin_axes(self):
        """(T, 2, 3): the unit vectors in each triangle of the skin in which its stresses are: e_u along the tension, and
        e_v = n x e_u."""
        return np.stack([self.tension, np.cross(self.normals(), self.tension)], axis=1)

    def joined(self, frame):
        """For each node the one that stands for it in a frame: closed pairs are one node, over several pairs too."""
        stands = np.arange(len(self.points))
        for left, right in self.pairs[self.released[frame]:]:
            keep, drop = sorted((stands[left], stands[right]))
            stands[stands == drop] = keep
        return stands


def scatter(cells, blocks, nodes):
    """(E, n, 3, n, 3) element matrices to one matrix; unknown 3 i + c is component c of node i."""
    unknowns = (3 * cells[:, :, None] + np.arange(3)).reshape(len(cells), -1)
    size = unknowns.shape[1]
    rows, columns = np.repeat(unknowns, size, axis=1).ravel(), np.tile(unknowns, (1, size)).ravel()
    return sparse.coo_matrix((blocks.ravel(), (rows, columns)), shape=(3 * nodes, 3 * nodes)).tocsc()


def bending_stiffness(patch, frame=None):
    """(N, N), in each direction: edge by edge, D / (areas of its two triangles) times the square of its length times
    the jump of the gradient across it. With a frame, also of the edges across its closed pairs, whose nodes are one."""
    if patch["skin.bending_stiffness"] == 0:
        return sparse.csc_matrix((len(patch.points),) * 2)
    gradient, area = skin_gradients(patch)
    stands = np.arange(len(patch.points)) if frame is None else patch.joined(frame)
    sides = {}
    for triangle, corners in enumerate(stands[patch.skin]):
        for c in range(3):
            edge = tuple(sorted((corners[c], corners[(c + 1) % 3])))
            sides.setdefault(edge, []).append(triangle)
    rows, columns, values = [], [], []
    for (a, b), both in sides.items():
        if len(both) != 2:
            continue
        along = patch.points[b, :2] - patch.points[a, :2]
        across, jump = np.array([along[1], -along[0]]), {}
        for triangle, sign in zip(both, (1, -1)):
            for node, slope in zip(stands[patch.skin[triangle]], gradient[triangle]):
                jump[node] = jump.get(node, 0) + sign * slope @ across
        for i, at_i in jump.items():
            for j, at_j in jump.items():
                rows.append(i), columns.append(j)
                values.append(patch["skin.bending_stiffness"] / area[both].sum() * at_i * at_j)
    return sparse.coo_matrix((values, (rows, columns)), shape=(len(patch.points),) * 2).tocsc()


def wedge_points(patch, rule):
    """Of every point of a rule: gradients (E, 6, 3) of the wedges' shape functions, and volumes (E)."""
    corners = patch.points[patch.wedges]
    for a, b, c, weight in RULES[rule]:
        corner = np.array([1 - a - b, a, b])
        corner_slope = np.array([[-1, -1], [1, 0], [0, 1]])
        slope = np.zeros((6, 3))  # of the shape functions, in (a, b, c)
        for half, sign in ((slice(0, 3), -1), (slice(3, 6), 1)):
            slope[half, :2] = corner_slope * (1 + sign * c) / 2
            slope[half, 2] = corner * sign / 2
        jacobian = np.einsum("eni,nk->eik", corners, slope)  # dx_i / dxi_k
        yield np.einsum("nk,eki->eni", slope, np.linalg.inv(jacobian)), weight * np.abs(np.linalg.det(jacobian))


def tissue_stiffness(patch, rule):
    """Linear wedges, isotropic: lambda tr(e) I + 2 mu e; or, with the mean dilatation, 2 mu dev(e) point by point and
    the bulk modulus on the element's mean of tr(e)."""
    young, poisson = patch.tissue_moduli()
    mu, lam = young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    mean = patch["tissue.formulation"] == "mean-dilatation"
    count = len(patch.wedges)
    blocks = np.zeros((count, 6, 3, 6, 3))
    volume, mean_gradient = np.zeros(count), np.zeros((count, 6, 3))
    for gradient, scale in wedge_points(patch, rule):
        volume += scale
        mean_gradient += scale[:, None, None] * gradient
        dilatation = -2 / 3 * mu if mean else lam
        blocks += np.einsum("e,eai,ebj->eaibj", scale * dilatation, gradient, gradient)
        blocks += np.einsum("e,eaj,ebi->eaibj", scale * mu, gradient, gradient)
        blocks += np.einsum("e,eak,ebk,ij->eaibj", scale * mu, gradient, gradient, np.eye(3))
    if mean:
        blocks += np.einsum("e,eai,ebj->eaibj", (lam + 2 / 3 * mu) / volume, mean_gradient, mean_gradient)
    return scatter(patch.wedges, blocks, len(patch.points))


def skin_gradients(patch):
    """Gradients (E, 3, 2) of the triangles' shape functions along the skin's axes, and areas."""
    first, second, third = (patch.points[patch.skin[:, i]] for i in range(3))
    edges = patch.skin_axes() @ np.stack([second - first, third - first], axis=2)  # dx_i / dxi_k
    slope = np.array([[-1, -1], [1, 0], [0, 1]])
    return np.einsum("nk,eki->eni", slope, np.linalg.inv(edges)), np.abs(np.linalg.det(edges)) / 2


def skin_stiffness(patch):
    """Constant-strain triangles in plane stress; with the prestress's geometric stiffness where the case has it."""
    gradient, area = skin_gradients(patch)
    young, poisson, thickness = (patch[f"skin.{n}"] for n in ("young_modulus", "poisson_ratio", "thickness"))
    mu, lam = young / (2 * (1 + poisson)), young * poisson / (1 - poisson**2)
    blocks = np.zeros((len(area), 3, 3, 3, 3))
    flat = lam * np.einsum("eai,ebj->eaibj", gradient, gradient) + mu * np.einsum("eaj,ebi->eaibj", gradient, gradient)
    flat += mu * np.einsum("eak,ebk,ij->eaibj", gradient, gradient, np.eye(2))
    axes = patch.skin_axes()
    blocks += np.einsum("e,eaibj,eik,ejl->eakbl", area * thickness, flat, axes, axes, optimize=True)
    if patch["skin.initial_stress_stiffness"] == "true" or patch["model"] == "finite":
        tension = np.einsum("eak,kl,ebl->eab", gradient, patch.prestress(), gradient)
        blocks += np.einsum("e,eab,ij->eaibj", area * thickness, tension, np.eye(3))
    if patch["skin.turning_stiffness"] > 0:
        tension = np.einsum("eak,kl,ebl->eab", gradient, patch.prestress(), gradient)
        normal = np.cross(axes[:, 0], axes[:, 1])
        share = patch["skin.turning_stiffness"] * area * thickness
        blocks += np.einsum("e,eab,ei,ej->eaibj", share, tension, normal, normal)
    return scatter(patch.skin, blocks, len(patch.points))


def load(patch, rule="full"):
    """(N, 3): what the prestress does to its nodes: - t A B^T sigma0 of the skin, and of the tissue the same integral
    with its share. Held edges: the surroundings balance it while all is closed, so from every node is taken what all
    nodes at its place feel together, in equal parts."""
    gradient, area = skin_gradients(patch)
    force = np.zeros((len(patch.points), 3))
    parts = -(area * patch["skin.thickness"])[:, None, None] * (gradient @ patch.prestress() @ patch.skin_axes())
    np.add.at(force, patch.skin.ravel(), parts.reshape(-1, 3))
    if patch["tissue.prestress_share"] != 0:
        for gradient, scale in wedge_points(patch, rule):
            parts = -patch["tissue.prestress_share"] * scale[:, None, None] * (gradient[:, :, :2] @ patch.prestress())
            np.add.at(force[:, :2], patch.wedges.ravel(), parts.reshape(-1, 2))
    if patch["skin.edges"] == "held":
        stands = patch.joined(0)
        together = np.zeros_like(force)
        np.add.at(together, stands, force)
        force -= together[stands] / np.bincount(stands)[stands][:, None]
    return force


def foundation(patch):
    """(N, N), N/mm: what the springs under the bottom and at the sides do in each direction. Tissue that is grown to bone
    is held by 1000 times its own stiffness across patch.height."""
    count = len(patch.points)
    first, second, third = (patch.points[patch.bottom[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(second - first, third - first), axis=1) / 2
    firm = 1000 * patch["tissue.young_modulus"] / patch["patch.height"]
    spring = np.where(patch.on_bone, firm, patch["foundation.stiffness"])
    under = (spring * area)[:, None, None] * (np.ones((3, 3)) + np.eye(3)) / 12
    beside = np.zeros((len(patch.sides), 4, 4))
    corners = patch.points[patch.sides]
    for a in AXIS:
        for b in AXIS:
            shape = np.array([(1 - a) * (1 - b), (1 + a) * (1 - b), (1 + a) * (1 + b), (1 - a) * (1 + b)]) / 4
            along = np.einsum("eni,n->ei", corners, np.array([b - 1, 1 - b, 1 + b, -1 - b]) / 4)
            across = np.einsum("eni,n->ei", corners, np.array([a - 1, -1 - a, 1 + a, 1 - a]) / 4)
            scale = np.linalg.norm(np.cross(along, across), axis=1)
            beside += patch["foundation.side_stiffness"] * scale[:, None, None] * np.outer(shape, shape)

    def gather(cells, blocks):
        size = cells.shape[1]
        rows, columns = np.repeat(cells, size, axis=1).ravel(), np.tile(cells, (1, size)).ravel()
        return sparse.coo_matrix((blocks.ravel(), (rows, columns)), shape=(count, count)).tocsc()

    return gather(patch.bottom, under) + gather(patch.sides, beside)


def stiffness(patch, rule="full"):
    springs = sparse.kron(foundation(patch) + bending_stiffness(patch), sparse.eye(3))
    return (tissue_stiffness(patch, rule) + skin_stiffness(patch) + springs).tocsc()


def solve(patch, matrix, frame, force=None):
    """(N, 3): each closed pair is one node; under the load, or another force."""
    force = load(patch) if force is None else force
    stands, renumbered = np.unique(patch.joined(frame), return_inverse=True)
    unknowns = (3 * renumbered[:, None] + np.arange(3)).ravel()
    spread = sparse.csc_matrix((np.ones(len(unknowns)), (np.arange(len(unknowns)), unknowns)))
    merged, force = (spread.T @ matrix @ spread).tocsc(), spread.T @ force.ravel()
    factor = splu(merged, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0, options={"SymmetricMode": True})
    result = factor.solve(force)
    result += factor.solve(force - merged @ result)
    return (spread @ result).reshape(-1, 3)
