"""Studies that take seconds, made by the commands, for the tests of the Python module and of pages.

small_study.py FOLDER: makes anew there those that several tests ask for; where CLEFT_STUDIES names that folder, a test
gets a copy.
"""

import os
import shutil
import subprocess
import sys

BIN, MADE = os.environ["CLEFT_BIN"], os.environ.get("CLEFT_STUDIES")
PATCH = """
[case]
patch.length = {length}
patch.width = {width}
patch.height = 4
cut.length = 8
cut.depth = 2
mesh.element_size = 1.5
[encode]
tolerance = 0.05
"""
FOUR_CASES = PATCH.format(length=14, width=8) + """
[vary]
"tissue.young_modulus" = [0.01, 0.03]
"skin.prestress_v" = [0.02, 0.04]
"""
THREE_PRESTRESSES = PATCH.format(length=14, width=8) + """
[vary]
"skin.prestress_u" = [0.01, 0, 0.01]
"skin.prestress_v" = [0, 0.01, 0.01]
"skin.prestress_uv" = [0, 0, 0.005]
[sampling]
method = "list"
"""
FAMILY = PATCH.format(length=20, width=16) + """
[vary]
"cut.curvature" = { from = -0.02, to = 0.02 }
[sampling]
method = "sparse-grid"
level = 1
unit_tensions = true
"""


def command(*words, check=True, stdin=None):
    """Runs a command of Cleft; its standard output, or the whole result where it may fail."""
    done = subprocess.run([os.path.join(BIN, words[0]), *map(str, words[1:])], input=stdin, capture_output=True, text=True)
    if not check:
        return done
    if done.returncode != 0:
        raise AssertionError(f"{words} ended with {done.returncode}: {done.stderr}")
    return done.stdout


SHARED = {"four": FOUR_CASES, "three": THREE_PRESTRESSES, "family": FAMILY}


def make_study(folder, text=FOUR_CASES, name="study"):
    path = os.path.join(folder, name)
    with open(path + ".toml", "w") as out:
        out.write(text)
    shared = [os.path.join(MADE, one) for one in SHARED if SHARED[one] == text] if MADE else []
    if shared and os.path.exists(shared[0]):
        shutil.copytree(shared[0], path)
    else:
        command("cleft", "run", path + ".toml", "--out", path)
    return path


if __name__ == "__main__":
    MADE = None
    shutil.rmtree(sys.argv[1], ignore_errors=True)
    os.makedirs(sys.argv[1])
    for one, text in SHARED.items():
        make_study(sys.argv[1], text, one)
