#include <pybind11/stl.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "encoder/field/file/field_file.h"
#include "encoder/field/quantity_fields.h"
#include "encoder/interpolate/compact.h"
#include "explorer/scene/patch_scene.h"
#include "explorer/study/case_figures.h"
#include "python/arrays.h"

namespace cleft::python {

namespace {

constexpr std::size_t chunk = 512;  // places: they and their values stay in the first cache

/// Calls work(first, places) for all places in chunks, without the interpreter, on so many threads (0: all
/// cores). The first exception is rethrown.
template <class Work>
void for_all(const BroadcastPlaces& all, const Field* checked, int threads, const Work& work) {
  if (threads < 0)
    throw InputError("threads = " + std::to_string(threads) + ": must be 0 (all cores) or more");
  const py::gil_scoped_release unlocked;
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex guard;
  const auto run = [&] {
    try {
      std::array<Place, chunk> places;
      for (std::size_t first = chunk * next++; first < all.size(); first = chunk * next++) {
        const std::span part(places.data(), std::min(chunk, all.size() - first));
        all.places(first, part, checked);
        work(first, part);
      }
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!failure) failure = std::current_exception();
      next = all.size() / chunk + 1;
    }
  };
  const std::size_t cores = threads == 0 ? std::max(1U, std::thread::hardware_concurrency()) : threads;
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < std::min(cores, all.size() / chunk + 1); ++i) others.emplace_back(run);
  run();
  others.clear();
  if (failure) std::rethrow_exception(failure);
}

/// Whether places outside of the domain are refused.
const Field* checked(const Field& field, const std::string& outside) {
  if (outside != "error" && outside != "clamp")
    throw InputError("outside = '" + outside + "': must be 'error' or 'clamp'");
  return outside == "error" ? &field : nullptr;
}

py::array_t<double> displacement(const SharedField& self, const Numbers& u, const Numbers& v,
                                 const Numbers& w, const Numbers& t, const Numbers& side, int threads,
                                 const std::string& outside) {
  const BroadcastPlaces places(u, v, w, t, side);
  py::array_t<double> result = new_array(places.shape(), 3);
  const std::span<Vec3> out = as_vectors(result);
  for_all(places, checked(*self.field, outside), threads, [&](std::size_t first, std::span<Place> part) {
    self.field->displacements(part, out.subspan(first, part.size()));
  });
  return result;
}

py::dict derivatives(const SharedField& self, const Numbers& u, const Numbers& v, const Numbers& w,
                     const Numbers& t, const Numbers& side, int threads, const std::string& outside) {
  const BroadcastPlaces places(u, v, w, t, side);
  py::dict result;
  std::vector<py::array_t<double>> arrays;
  std::vector<std::span<Vec3>> out;
  for (const char* name : {"value", "by_u", "by_v", "by_w", "by_t"}) {
    result[name] = arrays.emplace_back(new_array(places.shape(), 3));
    out.push_back(as_vectors(arrays.back()));
  }
  for_all(places, checked(*self.field, outside), threads, [&](std::size_t first, std::span<Place> part) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Derivatives d = self.field->derivatives(part[i].uvw, part[i].side, part[i].t);
      const Vec3* values[] = {&d.value, &d.by_u, &d.by_v, &d.by_w, &d.by_t};
      for (std::size_t k = 0; k < 5; ++k) out[k][first + i] = *values[k];
    }
  });
  return result;
}

py::array_t<double> quantity(const SharedField& self, const std::string& name, const Numbers& u,
                             const Numbers& v, const Numbers& w, const Numbers& t, const Numbers& side,
                             int threads, const std::string& outside) {
  const auto& all = self.field->quantities;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.name == name; });
  if (found == all.end()) {
    std::string names;
    for (const Quantity& q : all) names += (names.empty() ? "" : ", ") + q.name;
    throw InputError("quantity '" + name + "': the field has " +
                     (names.empty() ? "no further quantities" : "only " + names));
  }
  const BroadcastPlaces places(u, v, w, t, side);
  const QuantityFields fields(*self.field, static_cast<std::size_t>(found - all.begin()));
  const std::size_t components = fields.components();
  py::array_t<double> result =
      new_array(places.shape(), components > 1 ? static_cast<py::ssize_t>(components) : 0);
  const std::span<double> out(result.mutable_data(), static_cast<std::size_t>(result.size()));
  for_all(places, checked(*self.field, outside), threads, [&](std::size_t first, std::span<Place> part) {
    fields.at(part, out.subspan(first * components, part.size() * components));
  });
  return result;
}

py::dict domain_of(const Field& field) {
  py::dict domain;
  for (int axis = 0; axis < 4; ++axis)
    domain[py::str(std::string(1, "uvwt"[axis]))] =
        py::make_tuple(field.domain(axis).front, field.domain(axis).back);
  return domain;
}

py::object estimated_error(const SharedField& self) {
  const double error =
      self.field->interpolation ? self.field->interpolation->estimated_error : self.field->report.node_error;
  return py::float_(error);
}

/// What the explorer shows of a case: the skin and the walls of its cut.
class PatchSurface {
 public:
  explicit PatchSurface(const SharedField& field) : scene_(field.field) {}

  const WoundSurface& surface() const { return scene_.surface(); }
  double duration() const { return scene_.duration(); }
  std::vector<int> parts() const {
    std::vector<int> parts;
    for (const Region region : surface().regions) parts.push_back(static_cast<int>(region));
    return parts;
  }
  py::array_t<double> displacement(double t) const {
    std::vector<Vec3> moved;
    scene_.positions(t, moved);
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= surface().points[i];
    return array_of<Vec3, double>(std::move(moved));
  }

 private:
  PatchScene scene_;
};

constexpr const char* evaluation_help = R"(

u, v, w: stress-free positions, mm (u along the cut, v across it: left < 0 < right, w height: skin 0).
t: length cut, mm. side: -1 left, 1 right, 0 by the sign of v; it selects the lip on v = 0.
Arrays of any shapes that numpy broadcasts, or numbers; float64 arrays are not copied, whatever their strides.
threads: 1, or 0 for all cores; the interpreter is free meanwhile.
outside: "error" raises InputError for a place outside of field.domain; "clamp" takes the nearest inside.)";

}  // namespace

void bind_field(py::module_& module) {
  const std::string at = evaluation_help;
  using py::arg;
  py::class_<SharedField>(module, "Field",
                          "The displacement of one case: a discontinuous spline over (u, v, w, t).")
      .def("__call__", &displacement, arg("u"), arg("v"), arg("w"), arg("t"), arg("side") = 0., py::kw_only(),
           arg("threads") = 1, arg("outside") = "error",
           ("Displacement from the closed frame, mm: the arrays' common shape and 3 (du, dv, dw)." + at)
               .c_str())
      .def("derivatives", &derivatives, arg("u"), arg("v"), arg("w"), arg("t"), arg("side") = 0.,
           py::kw_only(), arg("threads") = 1, arg("outside") = "error",
           ("A dict of value (mm) and the first derivatives by_u, by_v, by_w, by_t (mm per mm), each of the "
            "arrays' common shape and 3." +
            at)
               .c_str())
      .def("quantity", &quantity, arg("name"), arg("u"), arg("v"), arg("w"), arg("t"), arg("side") = 0.,
           py::kw_only(), arg("threads") = 1, arg("outside") = "error",
           ("A further quantity of imported data, in the source's units: the arrays' common shape, and the "
            "number of components if there are several." +
            at)
               .c_str())
      .def_property_readonly(
          "quantities",
          [](const SharedField& self) {
            std::vector<std::string> names;
            for (const Quantity& q : self.field->quantities) names.push_back(q.name);
            return names;
          },
          "Names of the further quantities.")
      .def_property_readonly(
          "units", [](const SharedField& self) { return units_of(*self.field); },
          "The units of the further quantities by name, where `cleft import` was told them.")
      .def_property_readonly(
          "domain", [](const SharedField& self) { return domain_of(*self.field); },
          "(least, greatest) of u, v, w and t, mm, by name.")
      .def_property_readonly(
          "duration", [](const SharedField& self) { return self.field->duration(); },
          "t of the last frame, mm.")
      .def_property_readonly(
          "cut",
          [](const SharedField& self) {
            const CanonicalCut& cut = self.field->cut();
            py::dict dict;
            dict["start"] = cut.start, dict["length"] = cut.length, dict["depth"] = cut.depth;
            return dict;
          },
          "start (u), length and depth of the canonical cut, mm; length 0: there is none.")
      .def_property_readonly(
          "parameters", [](const SharedField& self) { return dict_of(self.field->parameters); },
          "The case's parameters by dotted name.")
      .def_property_readonly(
          "report", [](const SharedField& self) { return dict_of(self.field->report); },
          "Errors of the fit, relative to largest_displacement (mm); NaN where unknown.")
      .def_property_readonly(
          "case", [](const SharedField& self) { return self.field->case_hash; },
          "Identity of the simulation that it was fitted to; '' if there is none.")
      .def_property_readonly(
          "interpolated", [](const SharedField& self) { return self.field->interpolation.has_value(); },
          "Whether it was interpolated between the cases of a study.")
      .def_property_readonly(
          "outside",
          [](const SharedField& self) {
            return self.field->interpolation ? self.field->interpolation->outside : 0.;
          },
          "Of an interpolated field: how far its parameters are from the cases, over their spread.")
      .def_property_readonly("estimated_error", &estimated_error,
                             "Expected largest error at any node and frame over the largest displacement: of "
                             "the fit, and of the interpolation if it was interpolated.")
      .def_property_readonly(
          "control_points",
          [](const SharedField& self) {
            return py::make_tuple(self.field->basis(0).size(), self.field->basis(1).size(),
                                  self.field->basis(2).size(), self.field->basis(3).size());
          },
          "Numbers of control points along u, v, w and t.")
      .def(
          "gape",
          [](const SharedField& self, const Numbers& t) {
            py::array_t<double> result(Shape(t.shape(), t.shape() + t.ndim()));
            const Dense<double> times(t);
            for (py::ssize_t i = 0; i < times.size(); ++i)
              result.mutable_data()[i] = widest_gape(*self.field, times.data()[i]);
            return result;
          },
          arg("t"), "Widest opening of the lips when t is cut, mm; t: a number or an array, mm.")
      .def(
          "save",
          [](const SharedField& self, const std::string& path) {
            const Field& field = *self.field;
            write_field(path, field.interpolation ? compact_interpolated(field) : field);
          },
          arg("path"), "Writes a case.dffd, completely or not at all. Residuals at nodes are not in it.");
  py::class_<PatchSurface>(module, "PatchSurface",
                           "The skin and the walls of a case's cut, as the explorer shows them.")
      .def(py::init<const SharedField&>(), arg("field"))
      .def_property_readonly(
          "points",
          [](const py::object& self) {
            return view_of<Vec3, double>(self.cast<const PatchSurface&>().surface().points, self);
          },
          "(N, 3), mm, at rest.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            return view_of<std::array<int, 3>, int>(self.cast<const PatchSurface&>().surface().triangles,
                                                    self);
          },
          "(T, 3), counter-clockwise seen from outside.")
      .def_property_readonly(
          "parts", [](const PatchSurface& self) { return array_of<int, int>(self.parts()); },
          "(T,): 0 skin, 1 left wall, 2 right wall.")
      .def_property_readonly("duration", &PatchSurface::duration, "Length cut at the end, mm.")
      .def("displacement", &PatchSurface::displacement, arg("t"),
           "(N, 3), mm, when t mm are cut. Skin that is not cut yet is closed.");
  module.def(
      "read_field",
      [](const std::string& path) { return SharedField{std::make_shared<const Field>(read_field(path))}; },
      arg("path"));
}

}  // namespace cleft::python
