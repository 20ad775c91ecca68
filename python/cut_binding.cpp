#include <pybind11/stl.h>

#include <memory>

#include "explorer/body/surface_index.h"
#include "explorer/incision/local_coordinates.h"
#include "explorer/incision/mesh_repair.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/mesh_cuts.h"
#include "explorer/wound/path_file.h"
#include "explorer/wound/replayed_wounds.h"
#include "python/arrays.h"

namespace cleft::python {

namespace {

/// A path as a table, with the name that stands for it in messages.
using PathTable = std::pair<std::string, NumberTable>;

PathTable path_table(const std::string& name, const std::vector<std::string>& columns,
                     const Dense<double>& rows) {
  if (rows.ndim() != 2 || rows.shape(1) != static_cast<py::ssize_t>(columns.size()))
    throw InputError(name + ": an array of shape (N, " + std::to_string(columns.size()) + ") is needed");
  NumberTable table{columns, {}};
  for (py::ssize_t r = 0; r < rows.shape(0); ++r)
    table.rows.emplace_back(rows.data(r), rows.data(r) + rows.shape(1));
  return {name, table};
}

struct CutOptions {
  double scale = 1, depth = 0;
  std::optional<double> progress, max_edge;
  std::optional<SurfaceMesh> bone;  // mesh units
};

/// A mesh with its cuts, and the fields that open them.
class OpenedMesh {
 public:
  OpenedMesh(SurfaceMesh mesh, const std::vector<PathTable>& tables, std::shared_ptr<const CutFields> fields,
             CutOptions options)
      : fields_(std::move(fields)), scale_(options.scale) {
    std::vector<ScalpelPath> paths;
    for (const auto& [name, table] : tables)
      paths.push_back(path_of(table, name, options.depth, options.scale, fields_->shape().cut().depth));
    MeshReport report;
    mesh = repaired(mesh, report);
    cuts_ = std::make_unique<MeshCuts>(mesh, local_origin(mesh, paths.front()), paths, &fields_->shape(),
                                       MeshCutsOptions{options.scale, options.progress, options.max_edge});
    if (options.bone) {
      for (Vec3& x : options.bone->points) x = scale_ * (x - cuts_->origin());
      fields_ = std::make_shared<const CutFields>(
          fields_->above_bone(distance_to(std::make_shared<const SurfaceIndex>(std::move(*options.bone)))));
    }
    std::vector<Wound> wounds;
    for (std::size_t k = 0; k < paths.size(); ++k)
      told_of_file(tables[k].first, [&] {
        const auto own = prestress_of(tables[k].second, paths[k], scale_);
        wounds.push_back(fields_->wound(*cuts_->cuts()[k], scale_, own));
      });
    wounds_ = std::make_unique<ReplayedWounds>(std::move(wounds));
    validity_ = wounds_->validity(fields_->turning());
    for (const CutMesh::Triangle& t : cuts_->mesh().triangles()) parts_.push_back(static_cast<int>(t.region));
  }

  const MeshCuts& cuts() const { return *cuts_; }
  double duration() const { return wounds_->duration(); }
  double progress() const { return cuts_->progress(); }
  const std::vector<Validity>& validity() const { return validity_; }
  const std::vector<int>& parts() const { return parts_; }
  std::vector<Vec3> positions(std::optional<double> t) const {
    std::vector<Vec3> moved(wounds_->vertex_count());
    wounds_->positions(t.value_or(progress()), moved);
    for (Vec3& x : moved) x += cuts_->origin();
    return moved;
  }
  std::vector<Vec3> rest() const {
    std::vector<Vec3> points = cuts_->mesh().surface().points;
    for (Vec3& x : points) x += cuts_->origin();
    return points;
  }

 private:
  std::shared_ptr<const CutFields> fields_;
  double scale_;
  std::unique_ptr<MeshCuts> cuts_;
  std::unique_ptr<ReplayedWounds> wounds_;
  std::vector<Validity> validity_;
  std::vector<int> parts_;
};

/// The name stands for it in messages.
SurfaceMesh surface_of(const Dense<double>& points, const Dense<int>& triangles, const std::string& name) {
  SurfaceMesh mesh{rows_of<Vec3>(points, name + "points"),
                   rows_of<std::array<int, 3>>(triangles, name + "triangles")};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int corner : mesh.triangles[t])
      if (corner < 0 || static_cast<std::size_t>(corner) >= mesh.points.size())
        throw InputError(name + "triangles: row " + std::to_string(t) + " names point " +
                         std::to_string(corner) + ", and there are " + std::to_string(mesh.points.size()));
  return mesh;
}

std::unique_ptr<OpenedMesh> cut(const Dense<double>& points, const Dense<int>& triangles,
                                const std::vector<PathTable>& paths, std::shared_ptr<CutFields> fields,
                                double scale, double depth, std::optional<double> progress,
                                std::optional<double> max_edge,
                                const std::optional<std::pair<Dense<double>, Dense<int>>>& bone) {
  const auto need = [](bool good, const char* name, double value, const char* what) {
    if (!good) throw InputError(std::string(name) + " = " + shortest(value) + ": must be " + what);
  };
  need(scale > 0, "scale", scale, "above 0");
  need(depth >= 0, "depth", depth, "above 0, or 0 for that of the path or the field");
  if (progress) need(*progress >= 0, "progress", *progress, "at least 0");
  if (max_edge) need(*max_edge >= 0, "max_edge", *max_edge, "at least 0");
  if (paths.empty()) throw InputError("path: at least one is needed");
  SurfaceMesh mesh = surface_of(points, triangles, "");
  CutOptions options{scale, depth, progress, max_edge, {}};
  if (bone) {
    options.bone = surface_of(bone->first, bone->second, "bone: ");
    if (options.bone->triangles.empty()) throw InputError("bone: it has no triangles");
  }
  const py::gil_scoped_release unlocked;
  return std::make_unique<OpenedMesh>(std::move(mesh), paths, std::move(fields), std::move(options));
}

py::dict dict_of(const Validity& v) {
  py::dict dict;
  dict["expected_opening_error"] = v.expected_error.largest;
  dict["expected_opening_error_at_mm"] = v.expected_error.at;
  dict["expected_opening_error_because"] = v.expected_error.cause;
  dict["smallest_radius_mm"] = v.smallest_radius;
  dict["largest_tilt_degrees"] = v.largest_tilt;
  dict["nearest_cut_mm"] = v.nearest_cut;
  dict["held_back_mm"] = v.held_back;
  dict["guarded_vertices"] = v.guarded_vertices;
  dict["guarded_mm"] = v.guarded;
  dict["unsound_triangles"] = v.unsound.size();
  dict["warnings"] = v.warnings;
  return dict;
}

}  // namespace

void bind_cut(py::module_& module) {
  using py::arg;
  py::class_<CutFields, std::shared_ptr<CutFields>>(module, "CutFields")
      .def(py::init([](const SharedField& one) { return std::make_shared<CutFields>(one.field); }))
      .def(py::init([](const std::string& file, const std::vector<double>& direction,
                       const std::vector<double>& prestresses) {
             return std::make_shared<CutFields>(read_cut_fields(file, skin_tension(direction, prestresses)));
           }),
           arg("file"), arg("direction"), arg("prestresses"));
  py::class_<NumberTable>(module, "PathTable");
  module.def("path_table", &path_table, arg("name"), arg("columns"), arg("rows"));
  module.def(
      "path_file", [](const std::string& file) { return PathTable(file, read_csv(file)); }, arg("file"));
  py::class_<OpenedMesh>(module, "OpenedMesh",
                         "A surface mesh with its cuts, opened by fields: N points, T triangles, mesh units.")
      .def_property_readonly(
          "rest", [](const OpenedMesh& self) { return array_of<Vec3, double>(self.rest()); },
          "(N, 3): the points with the cuts closed.")
      .def_property_readonly(
          "triangles",
          [](const OpenedMesh& self) {
            return array_of<std::array<int, 3>, int>(self.cuts().mesh().surface().triangles);
          },
          "(T, 3), counter-clockwise seen from outside.")
      .def_property_readonly(
          "parts",
          [](const py::object& self) {
            return view_of<int, int>(self.cast<const OpenedMesh&>().parts(), self);
          },
          "(T,): 0 skin, 1 left wall, 2 right wall.")
      .def_property_readonly(
          "depth", [](const OpenedMesh& self) { return array_of<double, double>(self.cuts().depths()); },
          "(N,): mm below the skin.")
      .def_property_readonly(
          "region", [](const OpenedMesh& self) { return array_of<double, double>(self.cuts().regions()); },
          "(N,): 0 skin and lips, 1 left wall, 2 right wall.")
      .def_property_readonly(
          "s", [](const OpenedMesh& self) { return array_of<double, double>(self.cuts().along()); },
          "(N,): mm along the path; of a point on no cut along the last one.")
      .def_property_readonly("duration", &OpenedMesh::duration, "Length of all paths, mm.")
      .def_property_readonly("progress", &OpenedMesh::progress, "Where the blade is, mm of all paths.")
      .def_property_readonly(
          "cuts",
          [](const OpenedMesh& self) {
            py::list list;
            for (const Validity& v : self.validity()) list.append(dict_of(v));
            return list;
          },
          "Of each cut a dict: the expected error of its opening, what it is mostly because of, warnings.")
      .def(
          "positions",
          [](const OpenedMesh& self, std::optional<double> t) {
            std::vector<Vec3> moved;
            {
              const py::gil_scoped_release unlocked;
              moved = self.positions(t);
            }
            return array_of<Vec3, double>(std::move(moved));
          },
          arg("t") = py::none(),
          "(N, 3): the points when t mm of all paths are cut; None: as far as it is cut.");
  module.def("cut", &cut, arg("points"), arg("triangles"), arg("paths"), arg("fields"), arg("scale"),
             arg("depth"), arg("progress"), arg("max_edge"), arg("bone"));
}

}  // namespace cleft::python
