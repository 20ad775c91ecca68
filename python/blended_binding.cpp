// Fields of bodies with several breaks.
#include <pybind11/stl.h>

#include "encoder/field/file/pieces_at_nodes.h"
#include "python/arrays.h"

namespace cleft::python {

namespace {

struct SharedBlend {
  std::shared_ptr<const BlendedField> field;
};

/// Calls work(number, place) for all places, without the interpreter. Outside of the body is an InputError.
template <class Work>
void for_each_place(const BroadcastPlaces& all, const BlendedField& field, const Work& work) {
  const py::gil_scoped_release unlocked;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Place place;
    all.places(i, {&place, 1}, nullptr);
    const auto [front, back] = field.first().domain(3);
    if (!field.is_inside(place.uvw) || !(place.t >= front && place.t <= back))
      throw InputError("place " + std::to_string(i) + " of " + std::to_string(all.size()) +
                       " is outside of the body, or of the times, that the field was fitted to");
    work(i, place);
  }
}

py::array_t<double> blended_displacement(const SharedBlend& self, const Numbers& u, const Numbers& v,
                                         const Numbers& w, const Numbers& t, const Numbers& side) {
  const BroadcastPlaces places(u, v, w, t, side, BroadcastPlaces::Sides::any);
  py::array_t<double> result = new_array(places.shape(), 3);
  const std::span<Vec3> out = as_vectors(result);
  for_each_place(places, *self.field, [&](std::size_t i, const Place& at) {
    out[i] = self.field->displacement(at.uvw, at.side, at.t);
  });
  return result;
}

py::array_t<double> blended_quantity(const SharedBlend& self, const std::string& name, const Numbers& u,
                                     const Numbers& v, const Numbers& w, const Numbers& t,
                                     const Numbers& side) {
  const auto& all = self.field->first().quantities;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.name == name; });
  if (found == all.end()) throw InputError("quantity '" + name + "': the field has none of this name");
  const BroadcastPlaces places(u, v, w, t, side, BroadcastPlaces::Sides::any);
  const auto components = static_cast<std::size_t>(found->components);
  py::array_t<double> result =
      new_array(places.shape(), components > 1 ? static_cast<py::ssize_t>(components) : 0);
  const std::span<double> out(result.mutable_data(), static_cast<std::size_t>(result.size()));
  for_each_place(places, *self.field, [&](std::size_t i, const Place& at) {
    self.field->quantity(static_cast<std::size_t>(found - all.begin()), at.uvw, at.side, at.t,
                         out.subspan(i * components, components));
  });
  return result;
}

}  // namespace

void bind_blended(py::module_& module) {
  using py::arg;
  py::class_<SharedBlend>(module, "BlendedField",
                          "The displacement of a body with several breaks: a field for the piece of the body "
                          "around each, blended.")
      .def("__call__", &blended_displacement, arg("u"), arg("v"), arg("w"), arg("t"), arg("side") = 0.,
           "Displacement from frame 0, mm, over arrays that numpy broadcasts. u, v, w: places of the body "
           "along "
           "the axes of the first piece, mm; side: on a break, -1 left or 1 right of that break.")
      .def("quantity", &blended_quantity, arg("name"), arg("u"), arg("v"), arg("w"), arg("t"),
           arg("side") = 0., "A further quantity, in the source's units, likewise.")
      .def_property_readonly(
          "pieces",
          [](const SharedBlend& self) {
            std::vector<SharedField> pieces;
            for (const Field& piece : self.field->pieces())
              pieces.push_back({std::shared_ptr<const Field>(self.field, &piece)});
            return pieces;
          },
          "A Field for each break, in its own coordinates.")
      .def_property_readonly(
          "quantities",
          [](const SharedBlend& self) {
            std::vector<std::string> names;
            for (const Quantity& q : self.field->first().quantities) names.push_back(q.name);
            return names;
          },
          "Names of the further quantities.")
      .def_property_readonly(
          "units", [](const SharedBlend& self) { return units_of(self.field->first()); },
          "The units of the further quantities by name, where `cleft import` was told them.")
      .def_property_readonly(
          "duration", [](const SharedBlend& self) { return self.field->first().duration(); },
          "t of the last frame.")
      .def_property_readonly(
          "report", [](const SharedBlend& self) { return dict_of(report_of(self.field->pieces())); },
          "Errors of the fit: the largest of the pieces'.");
  module.def(
      "read_blended",
      [](const std::string& path) {
        return SharedBlend{std::make_shared<const BlendedField>(read_blended(path))};
      },
      arg("path"));
  module.def("pieces_in", &pieces_in, arg("path"));
}

}  // namespace cleft::python
