"""A study of four cases that takes seconds, made by the commands, for the tests of the Python module."""

import os
import subprocess

BIN = os.environ["CLEFT_BIN"]
STUDY = """
name = "small"
[case]
patch.length = 14
patch.width = 8
patch.height = 4
cut.length = 8
cut.depth = 2
mesh.element_size = 1.5
[vary]
"tissue.young_modulus" = [0.01, 0.03]
"skin.prestress_v" = [0.02, 0.04]
[encode]
tolerance = 0.05
"""


def command(*words, check=True, stdin=None):
    """Runs a command of Cleft; its standard output, or the whole result where it may fail."""
    done = subprocess.run([os.path.join(BIN, words[0]), *map(str, words[1:])], input=stdin, capture_output=True, text=True)
    if not check:
        return done
    if done.returncode != 0:
        raise AssertionError(f"{words} ended with {done.returncode}: {done.stderr}")
    return done.stdout


def make_study(folder):
    file = os.path.join(folder, "study.toml")
    with open(file, "w") as out:
        out.write(STUDY)
    command("cleft", "run", file, "--out", os.path.join(folder, "study"))
    return os.path.join(folder, "study")
