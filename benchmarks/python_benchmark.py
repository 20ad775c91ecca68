"""python_benchmark.py CASE.dffd STUDY.dffd BUILD: what the Python module costs, within one run.

CASE.dffd: a field. STUDY.dffd: of 1,000 cases (cleft-benchmark-study makes one). BUILD: the build tree. Prints medians:
nanoseconds a place over 10^6 places against the C++ call (cleft-benchmark-places, in turns), microseconds for a call with
one place, milliseconds to open the study.
"""

import os
import subprocess
import sys
import time

case, study, build = sys.argv[1:]
sys.path.insert(0, os.path.join(build, "python"))
import numpy as np  # noqa: E402

import cleft  # noqa: E402


def seconds(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


field = cleft.open(case)
u, v = np.linspace(*field.domain["u"], 1000), np.linspace(*field.domain["v"], 1000)[:, None]
U, V = (np.ascontiguousarray(x) for x in np.broadcast_arrays(u, v))
W, T = np.zeros_like(U), np.full_like(U, field.duration / 2)
program = os.path.join(build, "bin", "cleft-benchmark-places")
here, there = [], []
for _ in range(7):
    there.append(float(subprocess.run([program, case, "3"], capture_output=True, text=True, check=True).stdout))
    here.append(1e9 * np.median([seconds(lambda: field(U, V, W, T)) for _ in range(3)]) / U.size)
print(f"a place of 10^6: {np.median(here):.1f} ns, in C++ {np.median(there):.1f} ns, "
      f"ratio {np.median(np.array(here) / there):.3f}")
print(f"a call with one place: {1e6 * np.median([seconds(lambda: [field(0.5, 1.0, 0.0, 4.0) for _ in range(10000)]) for _ in range(5)]) / 1e4:.2f} us")
print(f"opening {len(cleft.open(study))} cases: {1e3 * np.median([seconds(lambda: cleft.open(study)) for _ in range(9)]):.1f} ms")
