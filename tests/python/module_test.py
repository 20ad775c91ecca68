"""The Python module against the commands, h5py, closed forms and differences."""

import ast
import inspect
import itertools
import json
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import h5py
import numpy as np

import cleft
from cleft import _cleft
from small_study import FAMILY, THREE_PRESTRESSES, command, make_study


def places(field, count, seed=1):
    """Random places in the domain, some of them on the lips."""
    rng = np.random.default_rng(seed)
    u, v, w, t = (rng.uniform(*field.domain[name], count) for name in "uvwt")
    v[::5] = 0
    side = np.where(v == 0, rng.choice([-1, 0, 1], count), 0)
    return u, v, w, t, side


class Module(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = cls.temporary.name
        cls.path = make_study(cls.folder)
        cls.packed = os.path.join(cls.path, "study.dffd")
        cls.study = cleft.open(cls.path)
        cls.case = os.path.join(cls.path, "cases", cls.study.cases["hash"][0])

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def refuses(self, text, work, kind=cleft.InputError):
        with self.assertRaises(kind) as caught:
            work()
        self.assertIn(text, str(caught.exception))

    # Studies

    def test_a_study_is_a_table_of_its_cases(self):
        status = json.loads(command("cleft", "status", self.path, "--json"))
        for path in (self.path, self.packed):
            study = cleft.open(path)
            self.assertEqual(len(study), 4)
            told = {row["case"]: (row["skin.prestress_v"], row["tissue.young_modulus"]) for row in status["cases"]}
            table = study.cases
            found = {row["hash"]: (row["skin.prestress_v"], row["tissue.young_modulus"]) for _, row in table.iterrows()}
            self.assertEqual(found, told)
            self.assertEqual(study.varying, {"skin.prestress_v": (0.02, 0.04), "tissue.young_modulus": (0.01, 0.03)})
            for i in range(4):
                report = json.loads(command("cleft", "info", os.path.join(self.path, "cases", table["hash"][i], "case.dffd"),
                                            "--json"))["report"]
                self.assertEqual(table["node_error"][i], report["node_error"])

    def test_a_table_without_pandas_is_a_structured_array(self):
        code = ("import sys; sys.modules['pandas'] = None; import cleft; t = cleft.open(sys.argv[1]).cases; "
                "print(t.dtype.names, len(t), t['skin.prestress_v'][0])")
        told = subprocess.run([sys.executable, "-c", code, self.packed], capture_output=True, text=True)
        self.assertEqual(told.stdout.strip(), "('hash', 'skin.prestress_v', 'tissue.young_modulus', 'largest_displacement', "
                         "'node_error') 4 0.02", told.stderr)

    def test_sel_gives_a_simulated_case_or_one_between(self):
        place = (0.5, 0.7, -0.3, 6.0)
        for keywords in ({"skin_prestress_v": 0.04, "tissue_young_modulus": 0.01},):
            field = self.study.sel(**keywords)
            self.assertFalse(field.interpolated)
            self.assertEqual(field.parameters["skin.prestress_v"], 0.04)
            self.assertEqual(field.parameters["tissue.young_modulus"], 0.01)
        out, ours = (os.path.join(self.folder, name) for name in ("between.dffd", "ours.dffd"))
        command("cleft", "interpolate", self.path, "--set", "tissue.young_modulus=0.02,skin.prestress_v=0.03", "--out", out)
        field = self.study.sel({"tissue.young_modulus": 0.02}, skin_prestress_v=0.03)
        self.assertTrue(field.interpolated)
        field.save(ours)
        with open(out, "rb") as a, open(ours, "rb") as b:
            self.assertEqual(a.read(), b.read())
        written = cleft.open(out)
        self.assertEqual(written.estimated_error, field.estimated_error)
        self.assertGreater(field.estimated_error, 0)
        np.testing.assert_allclose(written(*place), field(*place), atol=field.estimated_error)

    def test_parameters_that_make_no_case_are_refused_as_by_the_command(self):
        for values, text in (({"skin.prestres_v": 1}, "did you mean 'skin.prestress_v'"),
                             ({"skin.prestress_v": 0.03}, "tissue.young_modulus"),
                             ({"skin.prestress_v": 0.04, "tissue.young_modulus": 0.01, "skin.thickness": 3}, "skin.thickness")):
            self.refuses(text, lambda: self.study.sel(values))
            told = command("cleft", "interpolate", self.path, "--set",
                           ",".join(f"{name}={value}" for name, value in values.items()), "--out",
                           os.path.join(self.folder, "no.dffd"), check=False)
            self.assertEqual(told.returncode, 2)
            self.assertIn(text, told.stderr)
        self.refuses("given twice", lambda: self.study.sel({"skin.prestress_v": 1}, skin_prestress_v=1))
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            self.study.sel({"skin.prestress_v": 0.03, "tissue.young_modulus": 0.1})
        self.assertTrue(any("lie outside the study" in str(one.message) for one in told))

    def test_find_is_that_of_the_command(self):
        where = "gape > 0.5 and t < 6"
        told = json.loads(command("cleft", "find", self.path, "--where", where, "--json"))["found"]
        found = self.study.find(where)
        self.assertEqual(len(found), len(told))
        self.assertGreater(len(told), 0)
        for i, row in enumerate(told):
            self.assertEqual((found["case"][i], found["hash"][i]), (row["case"] - 1, row["hash"]))
            self.assertEqual([found["first_t"][i], found["last_t"][i]], row["length_cut_mm"])
            self.assertEqual(found["gape"][i], row["widest_gape_mm"])
            self.assertEqual(found["confirmed"][i], row["confirmed"])
        self.assertEqual(len(cleft.find(self.path, "gape > 1000")), 0)
        self.refuses("gap", lambda: self.study.find("gap > 1"))

    # Fields

    def test_a_field_is_that_of_cleft_eval(self):
        field = self.study[0]
        u, v, w, t, side = places(field, 300)
        rows = "".join(f"{a!r},{b!r},{c!r},{s},{d!r}\n" for a, b, c, s, d in
                       zip(*(x.tolist() for x in (u, v, w, side, t))))
        told = command("cleft", "eval", os.path.join(self.case, "case.dffd"), stdin="u,v,w,side,t\n" + rows)
        expected = np.array([[float(x) for x in line.split(",")] for line in told.split()[1:]])
        np.testing.assert_array_equal(field(u, v, w, t, side), expected)

    def test_arrays_of_any_shape_and_strides_are_taken(self):
        field = self.study[0]
        flat = places(field, 1200)
        expected = field(*flat)
        cube = [x.reshape(10, 12, 10) for x in flat]
        np.testing.assert_array_equal(field(*cube), expected.reshape(10, 12, 10, 3))
        turned = [np.asfortranarray(x) for x in cube]
        np.testing.assert_array_equal(field(*turned, threads=0), expected.reshape(10, 12, 10, 3))
        np.testing.assert_array_equal(field(*(x[::-3] for x in flat)), expected[::-3])
        np.testing.assert_array_equal(field(*(x.transpose(2, 0, 1)[:, ::2] for x in cube)),
                                      expected.reshape(10, 12, 10, 3).transpose(2, 0, 1, 3)[:, ::2])
        u, t = np.linspace(*field.domain["u"], 7)[:, None], np.linspace(0, field.duration, 700)
        grid = field(u, 1.0, 0, t)
        self.assertEqual(grid.shape, (7, 700, 3))
        for i, j in ((0, 0), (3, 511), (3, 512), (6, 699)):
            np.testing.assert_array_equal(grid[i, j], field(u[i, 0], 1.0, 0, t[j]))
        self.assertEqual(field(0, 0, 0, 1).shape, (3,))
        self.assertEqual(field(np.zeros((0, 4)), 0, 0, 1).shape, (0, 4, 3))
        np.testing.assert_array_equal(field(np.float32(0.5), 1, 0, 4), field(0.5, 1.0, 0.0, 4.0))

    def test_places_that_are_none_are_refused_with_their_index(self):
        field = self.study[0]
        u = np.zeros((3, 4))
        u[1, 2] = 99
        self.refuses("place (1, 2): u = 99: the field reaches from -7 to 7 mm", lambda: field(u, 0, 0, 1))
        self.refuses("the place: t = nan", lambda: field(0, 0, 0, np.nan))
        self.refuses("side = 2: must be", lambda: field(0, 0, 0, 1, side=2))
        self.refuses("contradicts v = -1", lambda: field(0, -1, 0, 1, side=1))
        self.refuses("u (3,), v (4,)", lambda: field(np.zeros(3), np.zeros(4), 0, 1))
        self.refuses("outside = 'no'", lambda: field(0, 0, 0, 1, outside="no"))
        self.refuses("threads = -1", lambda: field(0, 0, 0, 1, threads=-1))
        np.testing.assert_array_equal(field(99, 0, 0, 1, outside="clamp"), field(7, 0, 0, 1))
        many = np.zeros(10000)
        many[7000] = np.inf
        self.refuses("place (7000,): w = inf", lambda: field(0, 0, many, 1, threads=4))

    def test_derivatives_are_those_of_differences(self):
        field = self.study[0]
        u, v, w, t, _ = places(field, 200)
        inside = [np.clip(x, least + 0.01, most - 0.01) for x, (least, most) in
                  zip((u, v, w, t), (field.domain[name] for name in "uvwt"))]
        inside[1][np.abs(inside[1]) < 0.01] = 0.5
        d = field.derivatives(*inside)
        np.testing.assert_allclose(d["value"], field(*inside), atol=1e-12)
        step = 1e-5
        for axis, name in enumerate(("by_u", "by_v", "by_w", "by_t")):
            more, less = (list(inside) for _ in range(2))
            more[axis], less[axis] = inside[axis] + step, inside[axis] - step
            difference = (field(*more) - field(*less)) / (2 * step)
            # Second derivatives are at most about 1 / mm here; they jump at knots, between which a few steps lie.
            np.testing.assert_allclose(d[name], difference, atol=1e-4)

    def test_the_interpreter_runs_while_a_field_is_evaluated(self):
        field = self.study[0]
        u = np.linspace(*field.domain["u"], 3_000_000)
        worker = threading.Thread(target=lambda: field(u, 1.0, 0.0, 4.0))
        worker.start()
        turns = 0
        while worker.is_alive():
            time.sleep(0.001)
            turns += 1
        self.assertGreater(turns, 5)  # it takes 150 ms and more

    def test_a_quantity_is_evaluated_by_its_name(self):
        self.refuses("the field has no further quantities", lambda: self.study[0].quantity("stress", 0, 0, 0, 1))

    def test_figures_of_a_field(self):
        field, info = self.study[0], json.loads(command("cleft", "info", os.path.join(self.case, "case.dffd"), "--json"))
        self.assertEqual(field.cut, info["cut"])
        self.assertEqual({name: list(range_) for name, range_ in field.domain.items()}, info["domain_mm"])
        self.assertEqual(list(field.control_points), info["control_points"])
        self.assertEqual(field.parameters, info["parameters"])
        self.assertEqual(field.case, info["case"])
        u = np.linspace(field.cut["start"], field.cut["start"] + field.cut["length"], 2001)
        opening = np.linalg.norm(field(u, 0, 0, 8, side=1) - field(u, 0, 0, 8, side=-1), axis=-1).max()
        self.assertAlmostEqual(float(field.gape(8)), opening, delta=0.01 * opening)
        self.assertEqual(field.gape([[0.0, 8.0]]).shape, (1, 2))

    # Files

    def test_files_are_opened_by_what_they_are(self):
        self.assertIsInstance(cleft.open(os.path.join(self.case, "case.dffd")), cleft.Field)
        self.assertIsInstance(cleft.open(os.path.join(self.case, "case.h5")), cleft.Snapshot)
        self.refuses("no such file or folder", lambda: cleft.open(os.path.join(self.folder, "none")))
        damaged = os.path.join(self.folder, "damaged.dffd")
        with open(self.packed, "rb") as file, open(damaged, "wb") as out:
            out.write(file.read()[:3000])
        self.refuses("damaged.dffd", lambda: cleft.open(damaged), cleft.FileError)
        told = command("cleft", "info", damaged, check=False).stderr
        with self.assertRaises(ValueError) as caught:
            cleft.open(damaged)
        self.assertIn(str(caught.exception), told)
        self.refuses("case 4", lambda: self.study[4], IndexError)
        self.refuses("0 cases", lambda: self.study["zz"])
        self.assertEqual(self.study[-1].parameters, self.study[self.study.cases["hash"][3]].parameters)

    def test_a_snapshot_is_what_h5py_reads(self):
        snapshot = cleft.open(os.path.join(self.case, "case.h5"))
        with h5py.File(os.path.join(self.case, "case.h5")) as file:
            points, frames = file["VTKHDF/Points"][:], len(file["VTKHDF/Steps/Values"])
            np.testing.assert_array_equal(snapshot.points, points)
            np.testing.assert_array_equal(snapshot.times, file["VTKHDF/Steps/Values"][:])
            np.testing.assert_array_equal(snapshot.pairs, file["cut/pairs"][:])
            np.testing.assert_array_equal(snapshot.released, file["cut/released"][:])
            np.testing.assert_array_equal(snapshot.connectivity, file["VTKHDF/Connectivity"][:])
            displacement = file["VTKHDF/PointData/displacement"][:].reshape(frames, len(points), 3)
            self.assertEqual(len(snapshot), frames)
            np.testing.assert_array_equal(snapshot.displacement(-1), displacement[-1])
            np.testing.assert_array_equal(snapshot.array("dent"), file["VTKHDF/PointData/dent"][:])
        self.refuses("frame 99", lambda: snapshot.displacement(99), IndexError)
        self.refuses("compliance", lambda: snapshot.array("none"))
        points = snapshot.points
        del snapshot  # the view keeps what it shows
        self.assertEqual(points.sum(), points.copy().sum())
        with self.assertRaises(ValueError):
            points[0, 0] = 1

    def test_hdf5_of_other_modules_is_no_matter_in_any_order(self):
        code = """
import sys
for name in sys.argv[3].split():
    __import__(name)
import cleft, h5py
u = cleft.open(sys.argv[1])(0.5, 1, 0, 4)
with h5py.File(sys.argv[2]) as file:
    points = file["VTKHDF/Points"][:]
    assert (points == cleft.open(sys.argv[2]).points).all()
print(u.tolist(), sum("libhdf5" in line and "r-xp" in line for line in open("/proc/self/maps")))
"""
        answers = set()
        for order in itertools.permutations(("h5py", "vtk", "cleft")):
            done = subprocess.run([sys.executable, "-c", code, os.path.join(self.case, "case.dffd"),
                                   os.path.join(self.case, "case.h5"), " ".join(order)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, f"{order}: {done.stderr}")
            answers.add(done.stdout)
        self.assertEqual(len(answers), 1, answers)

    def test_encode_keeps_the_tolerance_at_all_nodes(self):
        u, v, w = (x.ravel() for x in np.meshgrid(np.linspace(-10, 10, 21), np.linspace(-6, 6, 13), np.linspace(-4, 0, 5),
                                                  indexing="ij"))
        points = np.stack([u, v, w], axis=1)
        start, depth, times = -5.0, 3.0, np.linspace(0, 10, 11)
        divided = np.flatnonzero((v == 0) & (u > start) & (u < start + 10) & (w > -depth))
        pairs = np.stack([divided, len(points) + np.arange(len(divided))], axis=1)
        points = np.concatenate([points, points[divided]])
        side = np.sign(points[:, 1])
        side[pairs[:, 0]], side[pairs[:, 1]] = -1, 1
        # The opening of a crack that grows: an ellipse over the length cut, less with depth and distance.
        x = points[None, :, 0] - start
        ellipse = np.sqrt(np.clip(x * (times[:, None] - x), 0, None)) * np.clip(1 + points[:, 2] / depth, 0, None)
        displacement = np.zeros((len(times), len(points), 3))
        displacement[..., 1] = 0.2 * side * ellipse * np.exp(-np.abs(points[:, 1]) / 3)
        shuffled = np.random.default_rng(3).permutation(len(pairs))
        out = os.path.join(self.folder, "encoded.dffd")
        field = cleft.encode(points, pairs[shuffled], times, displacement, tolerance=0.05, parameters={"skin.thickness": 2.0},
                             out=out)
        largest = np.linalg.norm(displacement, axis=2).max()
        self.assertAlmostEqual(field.report["largest_displacement"], largest, delta=1e-12)
        lip = np.where(points[:, 1] == 0, side, 0)
        found = np.stack([field(*points.T, t, lip) for t in times])
        error = np.linalg.norm(found - displacement, axis=2).max() / largest
        self.assertLessEqual(field.report["node_error"], 0.05)
        self.assertAlmostEqual(error, field.report["spline_error"], delta=1e-9)
        sorted_ = cleft.encode(points, pairs, times, displacement, tolerance=0.05)
        self.assertEqual(field.report, sorted_.report)
        np.testing.assert_array_equal(sorted_(*points.T, 7.0, lip), field(*points.T, 7.0, lip))
        self.assertEqual(field.parameters["skin.thickness"], 2)
        command("cleft", "check", out)
        np.testing.assert_array_equal(cleft.open(out)(*points.T, 7.0, lip), field(*points.T, 7.0, lip))

        refused = lambda text, *arguments, **options: self.refuses(text, lambda: cleft.encode(*arguments, **options))
        refused("(times, points, 3)", points, pairs, times[:-1], displacement)
        refused("pairs: name point 9999", points, [[0, 9999]], times, displacement)
        refused("tolerance = 2", points, pairs, times, displacement, tolerance=2)
        refused("do not increase", points, pairs, times[::-1], displacement)
        hole = displacement.copy()
        hole[3, 7, 1] = np.nan
        refused("frame 3, node 7", points, pairs, times, hole)
        refused("no/such", points, pairs, times, displacement, out="/no/such/folder.dffd")

    # Cuts

    def head(self):
        """The file of a head, that of a path on it, and the head as a vtkPolyData."""
        head, path = (os.path.join(self.folder, name) for name in ("head.stl", "path.csv"))
        command("make-head", "--out", head, "--path", path)
        from vtkmodules.vtkFiltersCore import vtkCleanPolyData
        from vtkmodules.vtkIOGeometry import vtkSTLReader
        reader, clean = vtkSTLReader(), vtkCleanPolyData()
        reader.SetFileName(head)
        clean.SetInputConnection(reader.GetOutputPort())
        clean.SetToleranceIsAbsolute(True)
        clean.SetAbsoluteTolerance(0)
        clean.Update()
        return head, path, clean.GetOutput()

    @staticmethod
    def written(file):
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(file)
        reader.Update()
        return reader.GetOutput()

    @staticmethod
    def same_points(mine, theirs):
        """In any order; files hold 32-bit coordinates of some 100 mm."""
        mine, theirs = (x[np.lexsort(np.round(x, 4).T)] for x in (mine, theirs))
        np.testing.assert_allclose(mine, theirs, atol=1e-4)

    def test_a_cut_is_that_of_the_command(self):
        head, path, mesh = self.head()
        out = os.path.join(self.folder, "cut.vtp")
        field = os.path.join(self.case, "case.dffd")
        figures = json.loads(command("cleft", "cut", "--mesh", head, "--path", path, "--field", field, "--progress", 40,
                                     "--out", out, "--json"))
        from vtkmodules.util.numpy_support import vtk_to_numpy
        data = self.written(out)
        expected = vtk_to_numpy(data.GetPoints().GetData())
        rows = np.loadtxt(path, delimiter=",", skiprows=1)
        for given in (path, rows, [rows], [path]):
            opened = cleft.cut(mesh, given, cleft.open(field), progress=40)
            self.assertEqual(len(opened.triangles), figures["triangles_after"])
            self.same_points(opened.positions(), expected)
        self.assertAlmostEqual(opened.cuts[0]["expected_opening_error"], figures["cuts"][0]["expected_opening_error"], 4)
        self.assertEqual(opened.progress, 40)
        np.testing.assert_array_equal(opened.positions(0.0), opened.rest)
        made = opened.to_vtk()
        self.assertEqual(made.GetNumberOfPoints(), data.GetNumberOfPoints())
        for name in ("displacement", "depth", "region", "s"):
            mine, theirs = (vtk_to_numpy(one.GetPointData().GetArray(name)) for one in (made, data))
            np.testing.assert_allclose(np.sort(mine, axis=0), np.sort(theirs, axis=0), atol=1e-3)

        points, triangles = cleft._cut.mesh_arrays(mesh)
        bone = np.asarray(points) * 0.95
        skull = os.path.join(self.folder, "skull.obj")
        with open(skull, "w") as file:
            file.writelines("v {:.17g} {:.17g} {:.17g}\n".format(*x) for x in bone)
            file.writelines("f {} {} {}\n".format(*(t + 1)) for t in np.asarray(triangles))
        figures = json.loads(command("cleft", "cut", "--mesh", head, "--path", path, "--field", field, "--progress", 40,
                                     "--bone", skull, "--out", out, "--json"))
        over = cleft.cut(mesh, path, cleft.open(field), progress=40, bone=(bone, triangles))
        self.assertAlmostEqual(over.cuts[0]["expected_opening_error"], figures["cuts"][0]["expected_opening_error"], 4)
        self.assertGreater(over.cuts[0]["expected_opening_error"], opened.cuts[0]["expected_opening_error"] + 1e-4)
        self.refuses("bone: triangles: row 0 names point 9", lambda: cleft.cut(
            mesh, path, cleft.open(field), bone=(bone[:9], [[0, 1, 9]])))
        with_field = lambda **options: cleft.cut((points, triangles), rows, cleft.open(field), **options)
        self.refuses("tension: is for a study", lambda: with_field(tension=((1, 0, 0), (0.03, 0.01))))
        self.refuses("scale = 0", lambda: with_field(scale=0))
        self.refuses("names point 99999999", lambda: cleft.cut((points, [[0, 1, 99999999]]), rows, field))
        self.refuses("(N, 6) or (N, 7)", lambda: cleft.cut((points, triangles), rows[:, :4], field))
        self.refuses("the path never touches the mesh", lambda: cleft.cut((points, triangles), rows + 1000, field))
        self.refuses("a str is none", lambda: cleft.cut("head.stl", rows, field))

    def test_a_cut_follows_the_tension_and_the_shape_as_by_the_command(self):
        head, path, mesh = self.head()
        out = os.path.join(self.folder, "opened.vtp")
        from vtkmodules.util.numpy_support import vtk_to_numpy
        direction, prestress = (0.1, 0.2, 1.0), (0.03, 0.01)
        for name, text in (("three", THREE_PRESTRESSES), ("family", FAMILY)):
            study = cleft.Study(make_study(self.folder, text, name))
            figures = json.loads(command("cleft", "cut", "--mesh", head, "--path", path, "--field", study._file(), "--tension",
                                         ",".join(map(str, direction)), "--prestress", ",".join(map(str, prestress)), "--out",
                                         out, "--json"))
            opened = cleft.cut(mesh, path, study, tension=(direction, prestress))
            self.assertEqual(len(opened.triangles), figures["triangles_after"])
            self.assertAlmostEqual(opened.cuts[0]["expected_opening_error"], figures["cuts"][0]["expected_opening_error"], 6)
            largest = np.linalg.norm(opened.positions() - opened.rest, axis=1).max()
            self.assertAlmostEqual(largest, figures["largest_displacement_mm"], 5)
            self.assertGreater(largest, 0.1)
            self.same_points(opened.positions(), vtk_to_numpy(self.written(out).GetPoints().GetData()))
            again = cleft.cut(mesh, path, study._file(), tension=(direction, prestress))
            np.testing.assert_array_equal(again.positions(), opened.positions())
        values = {"cut.curvature": 0.013, "skin.prestress_u": 0.01, "skin.prestress_v": 0.03, "skin.prestress_uv": 0.002}
        ours, theirs = (os.path.join(self.folder, name) for name in ("curved.dffd", "theirs.dffd"))
        cleft.interpolate(study, values, out=ours)
        command("cleft", "interpolate", study.path, "--out", theirs, "--set",
                ",".join(f"{name}={value}" for name, value in values.items()))
        with open(ours, "rb") as a, open(theirs, "rb") as b:
            self.assertEqual(a.read(), b.read())

    # Other packages

    def test_xarray_reads_a_study_lazily(self):
        import xarray
        data = xarray.open_dataset(self.packed, engine="cleft")
        self.assertEqual(data.displacement.dims, ("skin_prestress_v", "tissue_young_modulus", "t", "point", "component"))
        part = data.displacement.sel(skin_prestress_v=0.04, tissue_young_modulus=0.01).isel(t=[3, -1], point=slice(0, 40, 7))
        field = self.study.sel(skin_prestress_v=0.04, tissue_young_modulus=0.01)
        expected = field(part.u.values, part.v.values, part.w.values, part.t.values[:, None], part.side.values)
        np.testing.assert_array_equal(part.values, expected)
        self.assertEqual(data.displacement.isel(skin_prestress_v=0, tissue_young_modulus=1, t=5, point=9, component=1).values,
                         self.study[1](data.u[9], data.v[9], data.w[9], data.t[5], data.side[9])[1])
        single = xarray.open_dataset(os.path.join(self.case, "case.dffd"), engine="cleft", times=[1.0, 2.0],
                                     points=[[0.0, 1.0, 0.0, 0.0]])
        self.assertEqual(single.displacement.shape, (1, 2, 1, 3))

    def test_a_field_is_a_grid_of_xarray_and_a_surface_of_vtk(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        field = self.study[0]
        grid = field.to_xarray(t=[0.0, 8.0], side=1)
        self.assertEqual(grid.shape, (61, 41, 1, 2, 3))
        np.testing.assert_array_equal(grid.sel(u=0.7, v=0, t=8, method="nearest").values[0],
                                      field(grid.u.sel(u=0.7, method="nearest"), 0, 0, 8, side=1))
        out = os.path.join(self.folder, "series")
        command("cleft", "export", os.path.join(self.case, "case.dffd"), "--paraview", out, "--frames", 5)
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(os.path.join(out, "frame_0002.vtu"))
        reader.Update()
        expected, made = reader.GetOutput(), field.to_vtk(4.0)
        displacements = (vtk_to_numpy(one.GetPointData().GetArray("displacement")) for one in (made, expected))
        np.testing.assert_allclose(*displacements, atol=1e-12)  # the file's are differences of positions
        np.testing.assert_array_equal(*(vtk_to_numpy(one.GetPoints().GetData()) for one in (made, expected)))
        self.assertEqual(made.GetFieldData().GetArray("estimated_error").GetValue(0), field.estimated_error)

    # Help

    def test_every_name_of_the_compiled_part_has_its_type(self):
        with open(os.path.join(os.path.dirname(cleft.__file__), "_cleft.pyi")) as file:
            stub = ast.parse(file.read())
        told = {node.name: {one.name for one in node.body if isinstance(one, ast.FunctionDef)} - {"__init__"}
                for node in stub.body if isinstance(node, ast.ClassDef)}
        for node in stub.body:
            if isinstance(node, ast.FunctionDef):
                told[node.name] = set()
        names = {name for name in dir(_cleft) if not name.startswith("_")}
        self.assertEqual(set(told), names)
        for name, members in told.items():
            if inspect.isclass(getattr(_cleft, name)):
                own = {member for member in vars(getattr(_cleft, name)) if not member.startswith("_")}
                self.assertEqual({member for member in members if not member.startswith("_")}, own, name)

    def test_everything_public_has_help(self):
        for name in cleft.__all__:
            if not issubclass(getattr(cleft, name), Exception) if inspect.isclass(getattr(cleft, name)) else True:
                self.assertTrue(inspect.getdoc(getattr(cleft, name)), name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
