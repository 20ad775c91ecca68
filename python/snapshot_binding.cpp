#include <pybind11/stl.h>

#include "python/arrays.h"
#include "solver/snapshot/snapshot.h"

namespace cleft::python {

namespace {

std::size_t frame_of(const SnapshotReader& self, py::ssize_t frame) {
  const auto frames = static_cast<py::ssize_t>(self.snapshot().frames());
  const py::ssize_t j = frame < 0 ? frame + frames : frame;
  if (j < 0 || j >= frames)
    throw py::index_error("frame " + std::to_string(frame) + ": the snapshot holds frames 0 to " +
                          std::to_string(frames - 1));
  return static_cast<std::size_t>(j);
}

py::array_t<double> point_array(const SnapshotReader& self, const std::string& name, py::ssize_t frame) {
  std::string names;
  for (const SnapshotArray& array : self.point_arrays()) {
    names += ", " + array.name;
    if (array.name != name) continue;
    py::array_t<double> all = array_of<double, double>(self.point_array(array, frame_of(self, frame)));
    const auto points = static_cast<py::ssize_t>(self.snapshot().points.size());
    if (array.components > 1) return all.reshape({points, static_cast<py::ssize_t>(array.components)});
    return all;
  }
  throw InputError("array '" + name + "': the snapshot has displacement" + names);
}

}  // namespace

void bind_snapshot(py::module_& module) {
  using py::arg;
  using Row2 = std::array<std::int32_t, 2>;
  using Row3 = std::array<int, 3>;
  py::class_<SnapshotReader>(module, "Snapshot",
                             "A simulation with a growing cut, case.h5: N points, F frames, P pairs; mm.")
      .def(py::init<std::string>(), arg("path"))
      .def_property_readonly(
          "points",
          [](const py::object& self) {
            return view_of<Vec3, double>(self.cast<const SnapshotReader&>().snapshot().points, self);
          },
          "(N, 3): stress-free positions.")
      .def_property_readonly(
          "times",
          [](const py::object& self) {
            return view_of<double, double>(self.cast<const SnapshotReader&>().snapshot().times, self);
          },
          "(F,): t, the length cut.")
      .def_property_readonly(
          "pairs",
          [](const py::object& self) {
            return view_of<Row2, std::int32_t>(self.cast<const SnapshotReader&>().snapshot().pairs, self);
          },
          "(P, 2): left and right node, in the order in which they part.")
      .def_property_readonly(
          "released",
          [](const py::object& self) {
            return view_of<std::int32_t, std::int32_t>(self.cast<const SnapshotReader&>().snapshot().released,
                                                       self);
          },
          "(F,): number of open pairs in each frame.")
      .def_property_readonly(
          "cell_types",
          [](const py::object& self) {
            return view_of<std::uint8_t, std::uint8_t>(
                self.cast<const SnapshotReader&>().snapshot().cell_types, self);
          },
          "(C,): VTK's cell types; 5 triangles of skin, 13 wedges of tissue.")
      .def_property_readonly(
          "cell_offsets",
          [](const py::object& self) {
            return view_of<std::int64_t, std::int64_t>(
                self.cast<const SnapshotReader&>().snapshot().cell_offsets, self);
          },
          "(C + 1,): where each cell begins in connectivity.")
      .def_property_readonly(
          "connectivity",
          [](const py::object& self) {
            return view_of<std::int64_t, std::int64_t>(
                self.cast<const SnapshotReader&>().snapshot().connectivity, self);
          },
          "Nodes of one cell after another.")
      .def_property_readonly(
          "skin", [](const SnapshotReader& self) { return array_of<Row3, int>(self.snapshot().skin()); },
          "(T, 3): the triangles of the skin.")
      .def_property_readonly(
          "parameters", [](const SnapshotReader& self) { return dict_of(self.snapshot().parameters); },
          "The case's parameters by dotted name.")
      .def_property_readonly(
          "case", [](const SnapshotReader& self) { return self.snapshot().case_hash; },
          "Identity of the solver's input; '' of imported data.")
      .def_property_readonly(
          "arrays",
          [](const SnapshotReader& self) {
            std::vector<std::string> names;
            for (const SnapshotArray& array : self.point_arrays()) names.push_back(array.name);
            return names;
          },
          "Names of the further arrays of the points.")
      .def("__len__", [](const SnapshotReader& self) { return self.snapshot().frames(); })
      .def(
          "displacement",
          [](const SnapshotReader& self, py::ssize_t frame) {
            return array_of<Vec3, double>(self.displacement(frame_of(self, frame)));
          },
          arg("frame"),
          "(N, 3), mm, from points; read from the file when it is asked for. -1: the last frame.")
      .def("array", &point_array, arg("name"), arg("frame") = 0,
           "(N,) or (N, components): a further array of the points, in a frame if it changes.");
}

}  // namespace cleft::python
