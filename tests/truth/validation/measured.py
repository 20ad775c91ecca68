"""The rows of docs/validation.md that compare with measured skin. What is fitted stands in the row."""

from answers import Skin, free_stretches, np, root

from page import number, percent

LAWS = {"st-venant-kirchhoff": "St. Venant-Kirchhoff", "neo-hookean": "neo-Hookean", "fung": "Fung"}


def tension_for(law, along, across):
    """The prestress, MPa, under which a piece retracts to these stretches, with all else at its default: the law is the
    same at every state but for the prestress, so that a search is all it takes."""

    def miss(tension):
        return free_stretches(Skin(law, prestress_u=tension[0], prestress_v=tension[1])) - [along, across]

    found = root(miss, 0.13 * (1 - np.array([along, across])), tol=1e-10)
    if not found.success or np.abs(found.fun).max() > 1e-8:
        raise SystemExit(f"no tension makes a {law} skin retract to {along} x {across}: {found.message}")
    return [float(f"{x:.4g}") for x in found.x]


def rows(tool, page):
    from validation import PIECE, changes, skin_case, stretches_of

    def piece(law, u, v):
        case = tool.case(**PIECE, tissue__young_modulus=1e-7, **skin_case(law, prestress_u=u, prestress_v=v))
        along, across, _ = stretches_of(tool.solve(case))
        return along, across

    for law, name in LAWS.items():
        u, v = tension_for(law, 0.83, 0.83)
        along, across = piece(law, u, v)
        page.row(f"pig, square, {name}", f"tension {number(1000 * u)} kPa",
                 f"{along:.2f} x {across:.2f}", "0.83 x 0.83", None)
    for law, name in LAWS.items():
        along, across = piece(law, 0.01, 0.03)
        page.row(f"pig, default tension, {name}", "nothing", f"{along:.2f} x {across:.2f}, area "
                 f"{along * across:.2f}", "0.83 x 0.83, area 0.69", None)
    for law, name in LAWS.items():
        v, u = tension_for(law, 0.77, 0.90)  # v: along the tension lines
        across, along = piece(law, u, v)
        page.row(f"dog, piece, {name}",
                 f"tension {number(1000 * v)}, {number(1000 * u)} kPa",
                 f"{percent(along - 1)}, {percent(across - 1)}", "-23 %, -10 %", None)
        for text, sheet, depth in (("on the default tissue", {"patch__height": 8, "mesh__element_size": 2}, 2),
                                   ("without tissue", {"patch__height": 1e-4, "foundation__stiffness": 1e-5}, 1e-4)):
            case = tool.case(**{"model": "finite", "patch__length": 240, "patch__width": 240, "mesh__grading": 1.2,
                                "cut__length": 10, "cut__depth": depth / 2, "foundation__side_stiffness": 0,
                                "skin__bending_stiffness": 0.01, **sheet, **skin_case(law, prestress_u=u, prestress_v=v)})
            edge = tool.excision(case, 20, depth, 8)["hole_edge"]
            over_u, over_v, area = changes(edge)
            page.row(f"its hole, {text}", "as the piece", f"{percent(over_v)}, {percent(over_u)}, area {percent(area)}", "+16 %, -10 %, area +9 %", None)
    slope(tool, page, skin_case)


def slope(tool, page, skin_case):
    """Nominal stress over strain of a strip that is pulled from its state without stress, at its start: by the law's
    tangent in the direction of the pull, with no stress across."""
    for law, name, more in (("st-venant-kirchhoff", "St. Venant-Kirchhoff", {}), ("neo-hookean", "neo-Hookean", {}),
                            ("fung", "Fung, tension 4 : 10 kPa", {"prestress_u": 0.004, "prestress_v": 0.01})):
        skin = Skin(law, **more)
        free = free_stretches(skin)

        def strip(stretch, skin=skin, free=free):
            side = root(lambda x: skin.principal(stretch * free[0], x[0])[1], [free[1]], tol=1e-14).x[0]
            return "skin", stretch * free[0], 0, 0, side, 1

        step = 1e-4
        stress = tool.stresses(tool.case(**skin_case(law, **more)), [strip(1 - step), strip(1 + step)])
        # The force for each area of the free strip, whose width is free[1] of the reference's.
        nominal = stress[:, 0] / free[1]
        page.row(f"human back, strip, {name}", "nothing",
                 f"{(nominal[1] - nominal[0]) / (2 * step):.3f} MPa", "1.18 +- 0.88 MPa", None)
