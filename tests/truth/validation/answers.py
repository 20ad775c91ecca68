"""Answers that need no finite elements: the energies of docs/formats.md ("Finite strains") and their derivatives, states
without stress, a round hole in a sheet under small and finite strains, a slit."""

import sys

try:
    import numpy as np
    from scipy.integrate import solve_bvp
    from scipy.optimize import root
except ImportError as missing:
    print(f"Skipped: {missing}. Debian has python3-numpy and python3-scipy.")
    sys.exit(77)

COMPLEX_STEP = 1e-30


def zero_of(increasing, low, high):
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (low, middle) if increasing(middle) > 0 else (middle, high)
    return (low + high) / 2


def plane_stress(young, nu):
    return young / (1 - nu**2) * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])


class Exponential:
    """w(s, D; e) of docs/formats.md."""

    def __init__(self, stress, tangent, stiffening):
        self.stress, self.tangent = np.atleast_1d(stress), np.atleast_2d(tangent)
        work = self.stress @ np.linalg.solve(self.tangent, self.stress)
        x = zero_of(lambda x: 1 / stiffening - (1 - x) * np.exp(-x / (2 * (1 - x))), 0., 1 - 1e-16)
        self.b = x / work if work > 0 and stiffening > 1 else 0
        self.a = self.tangent - self.b * np.outer(self.stress, self.stress)
        self.start = np.linalg.solve(self.a, self.stress)

    def __call__(self, strain):
        """Of strains (n, ...)."""
        if self.b == 0:
            return np.einsum("i,i...->...", self.stress, strain) + self.twice(strain, self.tangent) / 2
        e = strain + self.start.reshape((-1,) + (1,) * (np.ndim(strain) - 1))
        return (np.exp(self.b / 2 * (self.twice(e, self.a) - self.start @ self.a @ self.start)) - 1) / self.b

    @staticmethod
    def twice(e, matrix):
        return np.einsum("i...,ij,j...->...", e, matrix, e)


class Skin:
    """The energy of a law of the skin. Its parameters are those of a case, by the names that stand after "skin."."""

    def __init__(self, law, young_modulus=0.13, poisson_ratio=0.4, prestress_u=0.01, prestress_v=0.03, prestress_uv=0.,
                 stiffening=5., fibre_share=0., fibre_angle=0., fibre_dispersion=0.):
        self.law, self.mu, self.nu = law, young_modulus / (2 * (1 + poisson_ratio)), poisson_ratio
        self.prestress = np.array([prestress_u, prestress_v, prestress_uv])
        self.elasticity = plane_stress(young_modulus, poisson_ratio)
        angle, kappa = np.radians(fibre_angle), fibre_dispersion
        m = np.array([np.cos(angle), np.sin(angle)])
        h = kappa * np.eye(2) + (1 - 2 * kappa) * np.outer(m, m)
        self.h = np.array([h[0, 0], h[1, 1], h[0, 1]])
        k = fibre_share / (self.h @ np.linalg.solve(self.elasticity, self.h))
        s = k * max(0, self.h @ np.linalg.solve(self.elasticity, self.prestress))
        self.matrix = Exponential(self.prestress - s * self.h, self.elasticity - k * np.outer(self.h, self.h), stiffening)
        self.fibres = Exponential(s, k, stiffening) if k > 0 else None

    def energy(self, uu, vv, uv):
        """Of the components of C, numbers or arrays, which may be complex."""
        e = np.stack([(uu - 1) / 2, (vv - 1) / 2, uv])
        if self.law == "st-venant-kirchhoff":
            return np.einsum("i,i...->...", self.prestress, e) + Exponential.twice(e, self.elasticity) / 2
        if self.law == "neo-hookean":
            return np.einsum("i,i...->...", self.prestress, e) + self.neo_hookean(uu + vv, uu * vv - uv**2)
        energy = self.matrix(e)
        if self.fibres is not None:
            stretch = np.einsum("i,i...->...", self.h, e)
            slack = -np.inf if self.fibres.stress[0] == 0 else -self.fibres.start[0]
            energy = energy + np.where(stretch.real > slack, self.fibres(stretch[None]), 0)
        return energy

    def neo_hookean(self, trace, determinant):
        mu, nu, x = self.mu, self.nu, 0 * determinant
        for _ in range(60):  # x = ln c: (1 - 2 nu) / nu times mu (c - 1) + lambda ln J is 0 across the sheet
            c = np.exp(x)
            x = x - ((1 - 2 * nu) * (c - 1) + nu * (x + np.log(determinant))) / ((1 - 2 * nu) * c + nu)
        c, log_j = np.exp(x), (x + np.log(determinant)) / 2
        # lambda (ln J)^2 = -mu (c - 1) ln J, which also holds where lambda is infinite.
        return mu / 2 * (trace + c - 3) - mu * log_j - mu / 2 * (c - 1) * log_j

    def stress(self, f):
        """First Piola-Kirchhoff, (2, 2), of a deformation gradient in the plane: derivatives of the energy by complex
        steps, exact to rounding."""
        stress = np.zeros((2, 2))
        for i in range(2):
            for j in range(2):
                moved = np.array(f, dtype=complex)
                moved[i, j] += 1j * COMPLEX_STEP
                right = moved.T @ moved
                stress[i, j] = self.energy(right[0, 0], right[1, 1], right[0, 1]).imag / COMPLEX_STEP
        return stress

    def principal(self, along, across):
        """P_1 and P_2 of stretches along u and v, numbers or arrays."""
        step = 1j * COMPLEX_STEP
        along, across = np.asarray(along, complex), np.asarray(across, complex)
        energies = (self.energy((along + step) ** 2, across**2, 0 * along),
                    self.energy(along**2, (across + step) ** 2, 0 * along))
        return np.array([energy.imag / COMPLEX_STEP for energy in energies])


class Tissue:
    def __init__(self, law, young_modulus=0.02, poisson_ratio=0.4):
        self.law, self.mu = law, young_modulus / (2 * (1 + poisson_ratio))
        self.lam = young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))
        self.kappa = young_modulus / (3 * (1 - 2 * poisson_ratio))

    def principal(self, stretches, initial=(0, 0, 0)):
        """P_i of three principal stretches, in closed form; with an initial stress."""
        a = np.asarray(stretches, float)
        if self.law == "neo-hookean":
            j, trace = a.prod(), (a**2).sum()
            p = self.mu * j ** (-2 / 3) * (a - trace / (3 * a)) + self.kappa * (j - 1) * j / a
        else:
            e = (a**2 - 1) / 2
            p = a * (self.lam * e.sum() + 2 * self.mu * e)
        return p + a * np.asarray(initial)


def across_when_pulled_along(law, along):
    """The stretch across u at which there is no stress across it, under a stretch along u."""
    return root(lambda x: law.principal(along, x[0])[1], [1 / np.sqrt(along)], tol=1e-13).x[0]


def free_stretches(law):
    """Principal stretches without stress, of a skin whose prestress has no shear."""
    found = root(lambda x: law.principal(*x), [0.95, 0.95], tol=1e-14)
    return found.x


def free_stretches_of_tissue(tissue, initial):
    return root(lambda x: tissue.principal(x, initial), [0.95, 0.95, 1.05], tol=1e-14).x


def circular_hole(law, tension, thickness, springs, radius, outer):
    """Displacement, mm, of the edge of a hole of `radius` that is cut in a round sheet of radius `outer` under equal
    tension, which is a dead load at the outer edge: r(R) with (R P_1)' = P_2 + k R (r - R) / t."""

    def stretch_for(nominal, around):
        """lambda_1 at which P_1 is `nominal`: Newton's method."""
        found = np.ones_like(nominal)
        for _ in range(100):
            over, under = (law.principal(found + step, around)[0] for step in (1e-6, -1e-6))
            change = (law.principal(found, around)[0] - nominal) / ((over - under) / 2e-6)
            found = np.clip(found - change, 0.5 * found, 2 * found)
            if np.abs(change).max() < 1e-12:
                break
        return found

    def slopes(x, y):
        place = radius * np.exp(x)  # x = ln(R / radius)
        r, pulled = y
        along = stretch_for(pulled / place, r / place)
        around = law.principal(along, r / place)[1]
        return np.stack([along * place, place * (around + springs * place * (r - place) / thickness)])

    def ends(inner_end, outer_end):
        return np.array([inner_end[1], outer_end[1] - outer * tension])

    x = np.linspace(0, np.log(outer / radius), 60)
    place = radius * np.exp(x)
    start = np.stack([place * (1 + 0.1 * (radius / place) ** 2), tension * place * (1 - (radius / place) ** 2)])
    found = solve_bvp(slopes, ends, x, start, tol=1e-7, max_nodes=2000)
    if not found.success:
        raise SystemExit(f"the boundary value problem of the hole: {found.message}")
    return found.sol(0)[0] - radius


def hole_in_a_disc(young, nu, tension_u, tension_v, radius, outer):
    """Displacement over radius, along u and along v, of the edge of a hole cut in a round sheet that keeps its pull: the
    stresses of Airy's function A0 ln r + B0 r^2 + (A r^2 + B r^4 + C / r^2 + D) cos 2 phi (Michell 1899), small strains.
    For `outer` without bound this is Kirsch's (1898), less the uniform strain that the tension had before."""
    mean, half = (tension_u + tension_v) / 2, (tension_u - tension_v) / 2

    def radial(r):
        return np.array([-2., 0, -6 / r**4, -4 / r**2])

    def shear(r):
        return np.array([2, 6 * r**2, -6 / r**4, -2 / r**2])

    # Released at the edge: the radial stress mean + half cos 2 phi and the shear stress -half sin 2 phi.
    waves = np.linalg.solve([radial(radius), shear(radius), radial(outer), shear(outer)], [-half, half, 0, 0])
    even = np.linalg.solve([[1 / radius**2, 2], [1 / outer**2, 2]], [-mean, 0])
    r = radius
    of_even = np.array([-(1 + nu) / r, 2 * (1 - nu) * r]) @ even
    of_waves = np.array([-2 * (1 + nu) * r, -4 * nu * r**3, 2 * (1 + nu) / r**3, 4 / r]) @ waves
    return (of_even + of_waves) / (young * r), (of_even - of_waves) / (young * r)


def kirsch(young, nu, tension_u, tension_v):
    return (2 * tension_u - (1 - nu) * tension_v) / young, (2 * tension_v - (1 - nu) * tension_u) / young
