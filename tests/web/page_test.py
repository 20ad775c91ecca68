"""The page that `cleft export --web` makes, in a headless Chromium: its values against `cleft eval`, its picture against
the explorer's, hostile texts, damage."""

import base64
import csv
import io
import json
import math
import os
import random
import shutil
import sys
import tempfile
import unittest

import h5py
import matplotlib.image
import numpy as np
import vtk
from browser import Browser, chromium
import cleft
from small_study import FAMILY, FOUR_CASES, PATCH, THREE_PRESTRESSES, command, make_study
from vtk.util.numpy_support import vtk_to_numpy

CUTS = PATCH.format(length=20, width=8).replace("cut.length = 8\n", "") + """
[vary]
"cut.length" = [6, 7, 9, 10]
"tissue.young_modulus" = [0.01, 0.02, 0.03]
"""
# So few that their estimated error is large, and their weights have either sign.
FEW = CUTS.replace("[6, 7, 9, 10]", "[6, 8, 10]").replace("[0.01, 0.02, 0.03]", "[0.01, 0.03]")
SCRATCH = tempfile.TemporaryDirectory()
STUDY = PAGE = BROWSER = None


def setUpModule():
    global STUDY, PAGE, BROWSER
    STUDY = make_study(SCRATCH.name)
    PAGE = os.path.join(SCRATCH.name, "page.html")
    command("cleft", "export", STUDY, "--web", PAGE)
    BROWSER = Browser()


def tearDownModule():
    BROWSER.close()
    SCRATCH.cleanup()


def evaluated(field, places):
    """Displacements by cleft eval at rows of u, v, w, side, t."""
    text = "u,v,w,side,t\n" + "".join(",".join(map(repr, place)) + "\n" for place in places)
    rows = list(csv.DictReader(io.StringIO(command("cleft", "eval", field, stdin=text))))
    return np.array([[float(row[name]) for name in ("du", "dv", "dw")] for row in rows])


def random_places(random_number, count, duration=8):
    """Places of the small patch and times of its cut; every third is on the plane of the cut, on either side."""
    places = []
    for n in range(count):
        v = 0.0 if n % 3 == 0 else random_number.uniform(-4, 4)
        places.append([random_number.uniform(-7, 7), v, random_number.uniform(-4, 0), random_number.choice([-1, 0, 1]) if v == 0 else 0,
                       random_number.uniform(0, duration)])
    return places


def domain_of(field):
    with h5py.File(field) as file:
        header = json.loads(bytes(file["header"][:]))
    return [header["domain"][axis] for axis in "uvwt"]


def shown(field, places):
    return np.array(BROWSER.run(f"(field => {json.dumps(places)}.map(p => [...field.displacement(...p)]))({field})"))


def opened(path=None, fragment=""):
    BROWSER.open("file://" + (path or PAGE) + fragment)


def surface_of(path):
    """A .vtp."""
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def displacements_of(path):
    """The point array `displacement` of a .vtp."""
    return vtk_to_numpy(surface_of(path).GetPointData().GetArray("displacement"))


def points_of(path):
    return vtk_to_numpy(surface_of(path).GetPoints().GetData())


def pictures(script, page, fragment):
    """The page's pictures, by WebGL2 and by the painter, which draws where that is software, and the explorer's after a script."""
    picture, lines = os.path.join(SCRATCH.name, "explorer.png"), os.path.join(SCRATCH.name, "explorer.txt")
    with open(lines, "w") as out:
        out.write(script)
    command("cleft", "explore", "--script", lines, "--screenshot", picture)
    opened(page, fragment)
    texts = BROWSER.run("""(() => { const place = document.getElementById('picture').style, {view} = cleft;
      place.position = 'fixed'; place.width = '1280px'; place.height = '720px';
      view.measure(), cleft.refresh();
      const texts = [view.canvas.toDataURL()], hidden = [view.painted.hidden];
      view.slow = true, cleft.refresh(true);
      return [...texts, view.painted.toDataURL(), ...hidden, view.painted.hidden]; })()""")
    assert texts[2:] == [True, False], "the painter draws moving pictures, and only these"
    own = [matplotlib.image.imread(io.BytesIO(base64.b64decode(text.split(",")[1])), format="png")[..., :3] for text in texts[:2]]
    return own, matplotlib.image.imread(picture)[..., :3]


def different(own, expected):
    """The part of the pixels of the body that differ: outlines and rims, a pixel wide. Backgrounds and captions are left out."""
    inner = np.s_[110:610, 440:840]
    if own.shape != expected.shape or np.std(own[inner]) < 0.03:
        return 1
    return np.mean(np.abs(own[inner] - expected[inner]).max(axis=2) > 0.06)


class Page(unittest.TestCase):
    def test_values_of_cases_are_those_of_eval(self):
        opened()
        cases = BROWSER.run("cleft.data.cases")
        self.assertEqual(len(cases), 4)
        for i, one in enumerate(cases):
            field = os.path.join(STUDY, "cases", one["hash"], "case.dffd")
            places = random_places(random.Random(i), 300)
            expected = evaluated(field, places)
            largest = BROWSER.run(f"cleft.headers[{i}].report.largest_displacement")
            self.assertGreater(np.abs(expected).max(), 0.1 * largest)
            self.assertLess(np.abs(shown(f"cleft.fieldOf({i})", places) - expected).max(), 1e-5 * largest)

    def test_values_of_sums_of_modes_are_those_of_eval(self):
        study, page = os.path.join(SCRATCH.name, "modes"), os.path.join(SCRATCH.name, "modes.html")
        shutil.copytree(STUDY, study)
        self.assertGreater(json.loads(command("cleft", "pack", study, "--modes", "0.02", "--json"))["modes"], 0)
        packed = os.path.join(study, "study.dffd")
        command("cleft", "export", packed, "--web", page)
        opened(page)
        self.assertEqual(BROWSER.run("cleft.headers.some(header => header.modes)"), True)
        data = cleft.open(packed)
        for i in range(4):
            places = random_places(random.Random(i), 300)
            side = np.array([place[3] for place in places])
            u, v, w, _, t = np.array(places).T
            expected = data[i](u, v, w, t, side=side)
            self.assertEqual(BROWSER.run(f"cleft.data.cases[{i}].hash"), data.cases["hash"][i])
            self.assertLess(np.abs(shown(f"cleft.fieldOf({i})", places) - expected).max(), 1e-5 * np.abs(expected).max())

    def test_values_of_one_field_are_those_of_eval(self):
        for parametrization in ("fixed", "tip"):
            snapshot = next(os.path.join(root, "case.h5") for root, _, files in os.walk(STUDY) if "case.h5" in files)
            field, page = (os.path.join(SCRATCH.name, parametrization + ending) for ending in (".dffd", ".html"))
            command("cleft", "encode", snapshot, "--out", field, "--tolerance", "0.1", "--parametrization", parametrization)
            command("cleft", "export", field, "--web", page)
            opened(page)
            places = random_places(random.Random(7), 300)
            expected = evaluated(field, places)
            self.assertLess(np.abs(shown("cleft.fieldOf(0)", places) - expected).max(), 1e-5 * np.abs(expected).max())

    def test_fields_between_the_cases_are_those_of_interpolate(self):
        for name, text in (("four", FOUR_CASES), ("cuts", CUTS), ("few", FEW), ("prestresses", THREE_PRESTRESSES), ("family", FAMILY)):
            study = STUDY if text == FOUR_CASES else make_study(SCRATCH.name, text, name)
            page, field = os.path.join(SCRATCH.name, name + ".html"), os.path.join(SCRATCH.name, "between.dffd")
            modes = json.loads(command("cleft", "export", study, "--web", page, "--json"))
            self.assertLess(modes["modes_error"], 0.02)
            opened(page)
            names, ranges = BROWSER.run("[cleft.names, cleft.ranges]")
            random_number = random.Random(5)
            for part in (0.3, 0.8):
                # Shear, the third of the prestresses, is small beside the others: no skin can push.
                values = [least + part * (greatest - least) * (0.2 if "uv" in one else 1) for one, (least, greatest) in zip(names, ranges)]
                settings = ",".join(f"{one}={value!r}" for one, value in zip(names, values))
                told = json.loads(command("cleft", "interpolate", study, "--set", settings, "--out", field, "--json"))
                BROWSER.run(f"cleft.choose({json.dumps(values)}), cleft.refresh()")
                self.assertEqual(BROWSER.run("cleft.state.values"), values)
                domain = BROWSER.run("cleft.field.domain")
                self.assertLess(np.abs(np.array(domain) - np.array(domain_of(field))).max(), 1e-9)
                places = random_places(random_number, 200, domain[3][1])
                expected = evaluated(field, places)
                # The page's modes leave so much of a case at its nodes; between nodes, and between the cases, where weights
                # of either sign add up to more than 1, it is more.
                apart = np.abs(shown("cleft.field", places) - expected).max() / told["largest_displacement_mm"]
                self.assertLess(apart, 5 * modes["modes_error"], name)
                # Where the error is a distance of two models, the page has a hundred points of it: those that move most.
                expected_error = np.hypot(told["estimated_error"], modes["modes_error"])
                error = BROWSER.run(f"""cleft.between.at(Object.fromEntries(cleft.names.map((name, c) => [name, cleft.state.values[c]])))
                    .errorOf({told["largest_displacement_mm"]})""")
                self.assertAlmostEqual(error / expected_error, 1, delta=0.03, msg=name)
                self.assertIn("estimated error", BROWSER.run("document.getElementById('error').textContent"))
            if name == "prestresses":  # u, uv, v
                BROWSER.run("cleft.choose([0.002, 0.004, 0.003]), cleft.refresh()")
                self.assertIn("compressed", BROWSER.run("document.getElementById('error').textContent"))
        self.assertEqual(BROWSER.mistakes(), [])

    def test_where_nothing_lies_between_the_page_says_why(self):
        text = PATCH.format(length=14, width=8) + """
[vary]
"tissue.young_modulus" = [0.01, 0.03]
"cut.contact" = [false, true]
"""
        study, page = make_study(SCRATCH.name, text, "choices"), os.path.join(SCRATCH.name, "choices.html")
        self.assertIn("cut.contact", json.loads(command("cleft", "export", study, "--web", page, "--json"))["not_between"])
        opened(page)
        BROWSER.run("cleft.choose([0.021]), cleft.refresh()")
        self.assertEqual(BROWSER.run("cleft.rows[cleft.state.case][0]"), 0.03)
        self.assertIn("cut.contact", BROWSER.run("document.getElementById('error').textContent"))
        self.assertEqual(BROWSER.mistakes(), [])

    def test_the_picture_is_the_explorers(self):
        for color, azimuth, elevation in (("displacement", 0, 0), ("gape", 30, -35), ("tissue", 0, 0)):
            own, expected = pictures(f"open '{STUDY}'\ncolor {color}\ncamera {azimuth} {elevation} 1\n", PAGE,
                                     f"#case=1&color={color}&az={azimuth}&el={elevation}&dark=0")
            for drawn, way in zip(own, ("WebGL2", "painter")):
                self.assertLess(different(drawn, expected), 0.02, (color, way))

    def test_a_mesh_opens_as_cut_opens_it(self):
        head, path, page, cut = (os.path.join(SCRATCH.name, name) for name in ("head.stl", "path.csv", "mesh.html", "cut.vtp"))
        command("make-head", "--out", head, "--path", path)
        figures = json.loads(command("cleft", "export", STUDY, "--web", page, "--mesh", head, "--path", path, "--json"))
        self.assertLess(figures["modes_error"], 0.005)
        opened(page)

        def own_at(case, time):
            BROWSER.run(f"cleft.set({{case: {case}, values: null, t: {time}}}), cleft.refresh()")
            return np.linalg.norm(np.reshape(BROWSER.run("[...cleft.scene.displacement]"), (-1, 3)), axis=1)

        # The page turns the axes to the camera. The whole cut is that of `cleft cut`.
        duration = BROWSER.run("cleft.mesh.duration")
        field = os.path.join(STUDY, "cases", BROWSER.run("cleft.data.cases[0].hash"), "case.dffd")
        command("cleft", "cut", "--mesh", head, "--path", path, "--field", field, "--out", cut)
        expected, own = np.linalg.norm(displacements_of(cut), axis=1), own_at(0, duration)
        self.assertGreater(np.count_nonzero(own), 100)
        self.assertLess(np.abs(own - expected).max(), 2 * figures["modes_error"] * expected.max())
        # On its way it is the explorer's, which has the same points: at one of the page's lengths, a mm apart.
        half = math.floor(math.ceil(duration) / 2) / math.ceil(duration) * duration
        script, shut, moved = (os.path.join(SCRATCH.name, name) for name in ("half.txt", "shut.vtp", "moved.vtp"))
        with open(script, "w") as out:
            out.write(f"open '{STUDY}'\nmesh '{head}'\ncut-file '{path}'\ncase 4\ntime 0\nexport '{shut}'\n"
                      f"time {half!r}\nexport '{moved}'\n")
        command("cleft", "explore", "--script", script)
        expected, own = np.linalg.norm(points_of(moved) - points_of(shut), axis=1), own_at(3, half)
        self.assertGreater(np.count_nonzero(own), 100)
        self.assertLess(np.abs(own - expected).max(), 2 * figures["modes_error"] * expected.max())
        # Between the cases the displacement is the sum of theirs.
        BROWSER.run("cleft.choose(cleft.ranges.map(([least, greatest]) => 0.5 * (least + greatest))), cleft.refresh()")
        least, greatest = (BROWSER.run(f"cleft.data.cases[{i}].displacement") for i in (1, 2))
        self.assertTrue(least < BROWSER.run("cleft.largest.displacement") < greatest)
        self.assertEqual(BROWSER.mistakes(), [])
        own, expected = pictures(f"open '{STUDY}'\nmesh '{head}'\ncut-file '{path}'\ncolor displacement\n", page, "#case=1&color=displacement&az=0&el=0&dark=0")
        for drawn in own:
            self.assertLess(different(drawn, expected), 0.02)

    def test_a_family_opens_a_mesh_as_in_the_explorer(self):
        # One motion, of all cases together: each place has the field of its own shape.
        study = make_study(SCRATCH.name, FAMILY, "family_of_mesh")
        head, path, page, shut, moved, script = (os.path.join(SCRATCH.name, "family_" + name)
                                                 for name in ("head.stl", "path.csv", "mesh.html", "shut.vtp", "moved.vtp", "script.txt"))
        command("make-head", "--out", head, "--path", path)
        figures = json.loads(command("cleft", "export", study, "--web", page, "--mesh", head, "--path", path, "--json"))
        self.assertEqual(figures["cases"], 1)
        with open(script, "w") as out:
            out.write(f"open '{study}'\nmesh '{head}'\ncut-file '{path}'\ntime 1000\nexport '{moved}'\n")
        command("cleft", "explore", "--script", script)
        command("cleft", "cut", "--mesh", head, "--path", path, "--rest", "--depth", "2", "--out", shut)
        expected = np.linalg.norm(points_of(moved) - points_of(shut), axis=1)
        opened(page)
        BROWSER.run("cleft.set({t: cleft.mesh.duration}), cleft.refresh()")
        own = np.linalg.norm(np.reshape(BROWSER.run("[...cleft.scene.displacement]"), (-1, 3)), axis=1)
        self.assertGreater(np.count_nonzero(expected > 0.1 * expected.max()), 100)
        self.assertLess(np.abs(own - expected).max(), 2 * figures["modes_error"] * expected.max())
        self.assertIn("family of", BROWSER.run("document.getElementById('error').textContent"))
        self.assertEqual(BROWSER.mistakes(), [])

    def test_a_page_is_drawn_where_there_is_no_webgl(self):
        opened()
        shown = BROWSER.run("""(() => { const {view} = cleft, {canvas} = view;
          canvas.getContext = () => null, view.webgl = null, view.measure(), cleft.refresh();
          const {data} = view.painter.context.getImageData(0, 0, view.painted.width, view.painted.height);
          let drawn = 0;
          for (let n = 0; n < data.length; n += 4) if (data[n] > data[n + 2] + 10) ++drawn;
          return [view.webgl, view.painted.hidden, view.painted.width / canvas.clientWidth, 4 * drawn / data.length]; })()""")
        self.assertEqual(shown[:3], [None, False, 2])
        self.assertGreater(shown[3], 0.2)  # skin, on a blue background
        self.assertEqual(BROWSER.mistakes(), [])

    def test_curves_and_table_hold_the_figures(self):
        opened()
        for i in range(4):
            ends = BROWSER.run(f"[cleft.data.cases[{i}].gape, widestGape(cleft.fieldOf({i}), cleft.duration({i}))]")
            self.assertAlmostEqual(ends[0], ends[1], delta=1e-9)
        self.assertEqual(BROWSER.run("cleft.refreshSlow(), document.querySelectorAll('#table tbody tr').length"), 4)

    def test_a_thousand_positions_of_the_sliders_leave_no_mistake(self):
        opened()
        done = BROWSER.run("""(async () => {
          let seed = 1;
          const random = () => (seed = seed * 48271 % 2147483647) / 2147483647;
          // A small picture, and every fiftieth by WebGL2: software draws it.
          document.getElementById('picture').style.cssText = 'height: 64px; width: 64px; min-height: 0';
          cleft.view.measure(), cleft.view.slow = true;
          const inputs = [...document.querySelectorAll('#parameters input, #time')];
          const colors = [...document.getElementById('color').options].map(one => one.value);
          for (let n = 0; n < 1000; ++n) {
            const input = inputs[Math.floor(random() * inputs.length)];
            input.value = String(Number(input.min) + random() * (Number(input.max) - Number(input.min)));
            input.dispatchEvent(new Event('input'));
            if (n % 10 === 0) cleft.set({color: colors[n / 10 % colors.length]});
            cleft.refresh(n % 50 > 0);
            if (!cleft.scene.displacement.every(Number.isFinite)) return 'not a number at ' + n;
          }
          cleft.refreshSlow();
          return 'done';
        })()""")
        self.assertEqual(done, "done")
        self.assertEqual(BROWSER.mistakes(), [])

    def test_nothing_else_is_requested(self):
        opened()
        BROWSER.run("cleft.refreshSlow()")
        self.assertEqual([address for address in BROWSER.requests() if not address.startswith(("file://" + PAGE, "about:"))], [])

    def test_the_address_restores_the_view(self):
        opened()
        BROWSER.run("cleft.set({case: 2, t: 3, color: 'gape', dark: true, where: 'gape > 0.1'}), cleft.turn(20, -30, 2), cleft.refresh(), cleft.refreshSlow()")
        address = BROWSER.run("location.href")
        drawn = "(cleft.view.measure(), cleft.refresh(), document.getElementById('view').toDataURL())"
        picture = BROWSER.run(drawn)
        opened(fragment="#" + address.split("#", 1)[1])
        self.assertEqual(BROWSER.run(drawn), picture)
        self.assertEqual(BROWSER.run("document.getElementById('where').value"), "gape > 0.1")
        opened(fragment="#case=99999999&t=NaN&color=<b>&az=1e99&zoom=-5&values=1,x&where=%3Cimg%3E")
        self.assertEqual(BROWSER.run("cleft.state.case"), 3)
        self.assertEqual(BROWSER.mistakes(), [])

    def test_find_and_brushes_choose_cases(self):
        opened()
        gapes = sorted(one["gape"] for one in BROWSER.run("cleft.data.cases"))
        middle = (gapes[1] + gapes[2]) / 2
        count = "(cleft.filter(), cleft.chosen.filter(Boolean).length)"
        BROWSER.run(f"cleft.state.where = 'gape > {middle} and not tissue.young_modulus > 1'")
        self.assertEqual(BROWSER.run(count), 2)
        BROWSER.run("cleft.state.where = 'gap > 1'")
        self.assertEqual(BROWSER.run(count), 4)
        self.assertIn("not understood", BROWSER.run("document.getElementById('found').textContent"))
        BROWSER.run("cleft.state.where = ''; cleft.parallel.brushes = {'skin.prestress_v': [0.035, 0.05]}")
        self.assertEqual(BROWSER.run(count), 2)

    def test_no_text_of_a_study_becomes_html_or_script(self):
        hostile = "</script><script>window.hacked = 1</script><img src=x onerror='window.hacked = 1'>\"'&amp;<!--"
        study = os.path.join(SCRATCH.name, "<img src=x onerror=hacked=1>.dffd")
        with open(os.path.join(STUDY, "study.dffd"), "rb") as source, open(study, "wb") as out:
            out.write(source.read())
        def call_first_case(name):
            with h5py.File(study, "r+") as file:
                header = json.loads(bytes(file["header"][:]))
                header["names"][0] = name
                columns = header["columns"]
                first = next(key for key in (f"parameters/{hostile}", "parameters/tissue.young_modulus") if key in columns)
                columns["parameters/" + hostile] = columns.pop(first)
                text = np.frombuffer(json.dumps(header).encode(), np.uint8)
                del file["header"]
                file.create_dataset("header", data=text, compression="gzip")

        call_first_case(hostile)
        refused = command("cleft", "export", study, "--web", os.path.join(SCRATCH.name, "refused.html"), check=False)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("no name of a folder", refused.stderr)
        call_first_case(hostile.replace("/", "|"))
        page = os.path.join(SCRATCH.name, "hostile.html")
        command("cleft", "export", study, "--web", page)
        opened(page, "#where=" + "%3Cscript%3Ehacked%3D1%3C/script%3E")
        BROWSER.run("cleft.refreshSlow()")
        self.assertEqual(BROWSER.run("typeof window.hacked"), "undefined")
        self.assertEqual(BROWSER.run("document.querySelectorAll('img').length"), 0)
        self.assertIn("</script>", BROWSER.run("document.getElementById('parameters').textContent"))
        self.assertIn("<img", BROWSER.run("document.getElementById('title').textContent"))
        self.assertEqual(BROWSER.mistakes(), [])
        # A script that had got in would not run: the policy names the page's own by its hash.
        refused = "(() => { const s = document.createElement('script'); s.textContent = 'window.hacked = 1'; document.body.append(s); return typeof window.hacked; })()"
        self.assertEqual(BROWSER.run(refused), "undefined")

    def test_a_damaged_page_is_refused_with_a_sentence(self):
        with open(PAGE) as source:
            text = source.read()
        def changed(part):
            middle = text.index(f'id="{part}"') + 200
            return text[:middle] + ("B" if text[middle] == "A" else "A") + text[middle + 1:]

        damaged = {"cut": text[:text.index('id="coefficients"') + 200], "changed": changed("coefficients"), "changed mode": changed("modes"),
                   "without an end": text[:text.index('<i id="end">')],
                   "other numbers": text.replace('"cases":[', '"cases":[ ', 1)}
        for name, broken in damaged.items():
            page = os.path.join(SCRATCH.name, "damaged.html")
            with open(page, "w") as out:
                out.write(broken)
            opened(page)
            self.assertIn("This page is damaged", BROWSER.run("document.getElementById('message').textContent"), name)
            self.assertTrue(BROWSER.run("document.getElementById('main').hidden"), name)

    def test_fingers_mouse_and_keys_turn_the_picture(self):
        opened()
        pose = "(cleft.refresh(), [cleft.view.azimuth, cleft.view.elevation, cleft.view.zoom])"
        x, y = BROWSER.run("(() => { const r = document.getElementById('view').getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()")

        def touch(kind, *points):
            BROWSER.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x + dx, "y": y + dy, "id": n} for n, (dx, dy) in enumerate(points)])

        BROWSER.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        try:
            touch("touchStart", (0, 0)), touch("touchMove", (60, 30)), touch("touchEnd")
            azimuth, elevation, zoom = BROWSER.run(pose)
            self.assertTrue(azimuth < -5 and elevation > 2 and zoom == 1, (azimuth, elevation, zoom))
            touch("touchStart", (-30, 0), (30, 0)), touch("touchMove", (-60, 0), (60, 0)), touch("touchEnd")
            self.assertAlmostEqual(BROWSER.run(pose)[2], 2, delta=0.1)
        finally:
            BROWSER.call("Emulation.setTouchEmulationEnabled", enabled=False)
        BROWSER.run("cleft.turn(0, 0, 1)")
        for kind, dx in (("mousePressed", 0), ("mouseMoved", 60), ("mouseReleased", 60)):
            BROWSER.call("Input.dispatchMouseEvent", type=kind, x=x + dx, y=y, button="left", buttons=1, clickCount=1)
        self.assertLess(BROWSER.run(pose)[0], -5)
        BROWSER.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=-200)
        BROWSER.run("new Promise(done => setTimeout(done, 200))")
        self.assertGreater(BROWSER.run(pose)[2], 1.1)
        for key in ("r", "ArrowRight", "n", "d", "["):
            BROWSER.call("Input.dispatchKeyEvent", type="keyDown", key=key)
            BROWSER.call("Input.dispatchKeyEvent", type="keyUp", key=key)
        self.assertEqual(BROWSER.run(pose), [5, 0, 1])
        self.assertEqual(BROWSER.run("cleft.state.case"), 1)
        self.assertLess(BROWSER.run("cleft.state.t"), BROWSER.run("cleft.field.duration"))
        self.assertEqual(BROWSER.run("document.documentElement.classList.contains('dark')"), BROWSER.run("cleft.state.dark"))
        self.assertEqual(BROWSER.mistakes(), [])

    def test_it_fits_a_telephone(self):
        BROWSER.call("Emulation.setDeviceMetricsOverride", width=390, height=800, deviceScaleFactor=2, mobile=True)
        try:
            opened()
            self.assertLessEqual(BROWSER.run("document.documentElement.scrollWidth"), 390)
        finally:
            BROWSER.call("Emulation.setDeviceMetricsOverride", width=1200, height=800, deviceScaleFactor=1, mobile=False)


class Command(unittest.TestCase):
    def refused(self, *words):
        done = command("cleft", "export", *words, check=False)
        self.assertEqual(done.returncode, 2)
        return done.stderr

    def test_bad_input_is_told_and_nothing_is_written(self):
        out = os.path.join(SCRATCH.name, "out.html")
        self.assertIn("out.txt", self.refused(STUDY, "--web", os.path.join(SCRATCH.name, "out.txt")))
        self.assertIn("simulation", self.refused(next(os.path.join(r, "case.h5") for r, _, f in os.walk(STUDY) if "case.h5" in f), "--web", out))
        self.assertIn("no such", self.refused(os.path.join(SCRATCH.name, "none"), "--web", out))
        self.assertIn("--web", self.refused(STUDY, "--web", out, "--paraview", "out.pvd"))
        self.assertIn("--path", self.refused(STUDY, "--web", out, "--mesh", "head.stl"))
        self.assertIn("none.stl", self.refused(STUDY, "--web", out, "--mesh", "none.stl", "--path", "none.csv"))
        broken = os.path.join(SCRATCH.name, "broken.dffd")
        with open(os.path.join(STUDY, "study.dffd"), "rb") as source, open(broken, "wb") as copy:
            copy.write(source.read()[:2000])
        self.assertNotEqual(command("cleft", "export", broken, "--web", out, check=False).returncode, 0)
        self.assertFalse(os.path.exists(out))


if __name__ == "__main__":
    if not chromium():
        print("skipped: chromium is not installed (setup/install.sh tests installs it; CLEFT_CHROMIUM names another)")
        sys.exit(77)
    unittest.main()
