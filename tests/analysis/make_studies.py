#!/usr/bin/python3
"""make_studies.py FOLDER: writes pairs of study files, NAME.toml and NAME_held_out.toml: README.md."""
import pathlib
import sys

MODULUS = ("tissue.young_modulus", 0.01, 0.04, "log")
STUDIES = {
    "depth": ("", MODULUS, ("cut.depth", 2.5, 5, ""), ("skin.prestress_v", 0.01, 0.05, "")),
    "length": ("", MODULUS, ("skin.young_modulus", 0.06, 0.26, "log"), ("cut.length", 20, 36, "")),
    "base": ("", ("foundation.stiffness", 0.002, 0.02, "log"), ("skin.thickness", 1, 2.5, ""),
             ("patch.height", 6, 12, ""), ("cut.depth", 2, 5, "")),
    "poisson": ("", ("tissue.poisson_ratio", 0.3, 0.48, ""), ("skin.poisson_ratio", 0.2, 0.45, ""), MODULUS),
    "contact": ("cut.contact = true\nskin.prestress_u = 0.03\n", ("skin.prestress_v", 0.002, 0.03, ""),
                ("skin.prestress_uv", -0.007, 0.007, ""), MODULUS),
    "six": ("", MODULUS, ("skin.young_modulus", 0.06, 0.26, "log"), ("cut.depth", 2, 5, ""),
            ("cut.length", 20, 36, ""), ("skin.thickness", 1, 2.5, ""), ("skin.prestress_v", 0.02, 0.05, "")),
    # Coarse meshes: only the sampling is compared.
    "wide": ("", ("tissue.young_modulus", 0.005, 0.2, ""), ("foundation.stiffness", 0.001, 0.05, ""),
             ("skin.young_modulus", 0.05, 1, ""), ("skin.poisson_ratio", 0.2, 0.45, "")),
    "decades": ("", ("tissue.young_modulus", 0.003, 0.3, "log"), ("skin.young_modulus", 0.03, 3, "log"),
                ("foundation.stiffness", 0.0005, 0.05, "log"), ("skin.thickness", 0.8, 2.5, ""),
                ("patch.height", 6, 20, "")),
}
STUDIES["touching"] = STUDIES["contact"]
COARSE = ("wide", "decades", "touching")

folder = pathlib.Path(sys.argv[1])
for name, (case, *ranges) in STUDIES.items():
    for suffix, method, count, seed in (("", "sobol", 32, 1), ("_held_out", "latin-hypercube", 72, 99)):
        size, in_time = (3, 8) if name in COARSE else (2, 12)
        text = f'name = "{name}{suffix}"\nkeep_snapshots = "none"\n[case]\nmesh.element_size = {size}\n{case}'
        text += f"[encode]\ncontrol_points = [16, 12, 7, {in_time}]\n[vary]\n"
        for parameter, least, greatest, scale in ranges:
            scale = f', scale = "{scale}"' if scale else ""
            text += f'"{parameter}" = {{ from = {least}, to = {greatest}{scale} }}\n'
        text += f'[sampling]\nmethod = "{method}"\ncount = {count}\nseed = {seed}\n'
        (folder / f"{name}{suffix}.toml").write_text(text)
