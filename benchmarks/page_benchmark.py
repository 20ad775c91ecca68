"""page_benchmark.py CASE.dffd STUDY.dffd BUILD: what a page of a study costs (cleft export --web), in a headless Chromium.

CASE.dffd: a field. STUDY.dffd: of 1,000 cases (cleft-benchmark-study makes one). BUILD: the build tree. Prints megabytes, seconds to make the page
and to its first picture, and of a slider's move to the picture the median milliseconds: of the program alone, with the
drawing as the page does it, and, in turns with that, as WebGL2 does it (which is software where there is no graphics
card: then the page has its own way). Of the patch of the study, and of a head with a cut of some 32,000 vertices that the
field opens.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

case, study, build = sys.argv[1:]
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tests", "web"))
from browser import Browser  # noqa: E402

MOVES, TURNS = 20, 3


def run(*words):
    subprocess.run([os.path.join(build, "bin", words[0]), *words[1:]], check=True, capture_output=True)


def divided(source, out):
    """Each triangle of a binary STL becomes four."""
    triangle = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    old = np.fromfile(source, triangle, offset=84)
    corners = old["corners"]
    middles = 0.5 * (corners + np.roll(corners, -1, axis=1))
    new = np.zeros(4 * len(old), triangle)
    new["normal"] = np.tile(old["normal"], (4, 1))
    new["corners"] = np.concatenate([np.stack([corners[:, k], middles[:, k], middles[:, k - 1]], 1) for k in range(3)] + [middles])
    with open(out, "wb") as file:
        file.write(bytes(80) + np.uint32(len(new)).tobytes() + new.tobytes())


def moves(browser, slider, way, turn):
    """Milliseconds of each of some moves of a slider: of the program, or until all is drawn by the painter, or by WebGL2."""
    return browser.run(f"""(() => {{
      const input = document.querySelector('{slider}'), times = [], {{view}} = cleft;
      const finish = {{program: () => {{}}, painter: () => view.painter.context.getImageData(0, 0, 1, 1), webgl: () => view.webgl.finish()}};
      view.slow = '{way}' !== 'webgl';
      view.webgl.finish();
      for (let n = 0; n < {MOVES}; ++n) {{
        input.value = String(Number(input.min) + (0.1 + 0.8 * ((({turn * MOVES} + n) * 0.618) % 1)) * (Number(input.max) - Number(input.min)));
        const begin = performance.now();
        input.dispatchEvent(new Event('input'));
        cleft.refresh(true);
        finish['{way}']();
        times.push(performance.now() - begin);
      }}
      return times;
    }})()""")


def report(name, page, made):
    print(f"{name}: {os.path.getsize(page) / 1e6:.2f} MB, made in {made:.1f} s")
    browser = Browser(1280, 720)
    first = []
    for _ in range(5):
        browser.open("file://" + page)
        first.append(browser.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now()))))") / 1e3)
    print(f"  first picture after {statistics.median(first):.2f} s; {browser.run('cleft.scene.count')} vertices")
    fast = not browser.run("cleft.view.measure(), cleft.view.slow")
    browser.run("cleft.between && (() => { while (!cleft.between.prepare()); })()")
    for what, slider in (("length cut", "#time"), ("parameter", "#parameters input")):
        if browser.run(f"document.querySelector('{slider}')") is None:
            continue
        # A small picture costs nothing: what is left is the program.
        browser.run("document.getElementById('picture').style.cssText = 'width: 16px; height: 16px; min-height: 0', cleft.refresh()")
        program = statistics.median(moves(browser, slider, "program", 0))
        browser.run("document.getElementById('picture').style.cssText = '', cleft.refresh()")
        times = {"painter": [], "webgl": []}
        for turn in range(TURNS):
            for way, found in times.items():
                found += moves(browser, slider, way, turn)
        page, webgl = (statistics.median(times[way]) for way in ("webgl" if fast else "painter", "webgl"))
        print(f"  {what}: {program:.1f} ms, with the drawing {page:.1f} ms; by WebGL2 {webgl:.1f} ms")
    browser.close()


with tempfile.TemporaryDirectory() as folder:
    page, head, fine, path = (os.path.join(folder, name) for name in ("page.html", "head.stl", "fine.stl", "path.csv"))
    begin = time.perf_counter()
    run("cleft", "export", study, "--web", page)
    report("study", page, time.perf_counter() - begin)
    run("make-head", "--triangles", "16000", "--out", head, "--path", path)
    divided(head, fine)
    begin = time.perf_counter()
    run("cleft", "export", case, "--web", page, "--mesh", fine, "--path", path)
    report("head", page, time.perf_counter() - begin)
