"""notebook_test.py NOTEBOOK: executes the notebook beside a small study; fails if a cell does, or if it draws nothing."""

import json
import os
import shutil
import subprocess
import sys
import tempfile

from small_study import make_study

with tempfile.TemporaryDirectory() as folder:
    make_study(folder)
    shutil.copy(sys.argv[1], folder)
    done = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output", "executed.ipynb",
                           os.path.join(folder, os.path.basename(sys.argv[1]))], capture_output=True, text=True,
                          env={**os.environ, "HOME": folder, "IPYTHONDIR": folder})
    if done.returncode != 0:
        sys.exit(done.stderr[-4000:])
    with open(os.path.join(folder, "executed.ipynb")) as file:
        cells = json.load(file)["cells"]
    outputs = [output for cell in cells for output in cell.get("outputs", [])]
    pictures = sum("image/png" in output.get("data", {}) for output in outputs)
    print(f"{len(cells)} cells, {len(outputs)} outputs, {pictures} pictures")
    sys.exit(0 if pictures >= 2 else "the notebook drew too few pictures")
