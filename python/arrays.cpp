#include "python/arrays.h"

#include <algorithm>
#include <cstring>

#include "base/text.h"

namespace cleft::python {

std::string text_of(const Shape& shape) {
  std::string text;
  for (const py::ssize_t extent : shape) text += (text.empty() ? "" : ", ") + std::to_string(extent);
  return "(" + text + (shape.size() == 1 ? ",)" : ")");
}

BroadcastPlaces::BroadcastPlaces(const Numbers& u, const Numbers& v, const Numbers& w, const Numbers& t,
                                 const Numbers& side, Sides sides)
    : sides_(sides) {
  const std::array<const Numbers*, 5> arrays = {&u, &v, &w, &t, &side};
  py::ssize_t axes = 0;
  for (const Numbers* a : arrays) axes = std::max(axes, a->ndim());
  shape_.assign(static_cast<std::size_t>(axes), 1);
  for (const Numbers* a : arrays)
    for (py::ssize_t i = 0; i < a->ndim(); ++i) {
      py::ssize_t& extent = shape_[axes - a->ndim() + i];
      if (a->shape(i) != 1 && extent != 1 && extent != a->shape(i)) {
        std::string shapes;
        for (int k = 0; k < 5; ++k)
          shapes += std::string(k ? ", " : "") + (k < 4 ? std::string(1, "uvwt"[k]) : "side") + " " +
                    text_of({arrays[k]->shape(), arrays[k]->shape() + arrays[k]->ndim()});
        throw InputError("the arrays' shapes do not fit together: " + shapes);
      }
      if (a->shape(i) != 1) extent = a->shape(i);
    }
  for (const py::ssize_t extent : shape_) size_ *= static_cast<std::size_t>(extent);
  for (int k = 0; k < 5; ++k) {
    const Numbers& a = *arrays[k];
    sources_[k] = {reinterpret_cast<const char*>(a.data()), Shape(shape_.size(), 0)};
    for (py::ssize_t i = 0; i < a.ndim(); ++i)
      if (a.shape(i) != 1) sources_[k].strides[axes - a.ndim() + i] = a.strides(i);
  }
}

void BroadcastPlaces::places(std::size_t first, std::span<Place> out, const Field* field) const {
  std::array<Interval, 4> allowed{};
  if (field)
    for (int axis = 0; axis < 4; ++axis) {
      const auto [front, back] = field->domain(axis);
      const double slack = 1e-9 * (back - front);
      allowed[axis] = {front - slack, back + slack};
    }
  const std::size_t axes = shape_.size();
  std::array<const char*, 5> at;
  for (std::size_t done = 0; done < out.size();) {
    // The row of the last axis that holds the next place.
    std::size_t rest = first + done, column = 0, extent = 1;
    if (axes > 0) {
      extent = static_cast<std::size_t>(shape_.back());
      column = rest % extent, rest /= extent;
    }
    for (int k = 0; k < 5; ++k) {
      at[k] = sources_[k].data;
      if (axes > 0) at[k] += static_cast<py::ssize_t>(column) * sources_[k].strides.back();
    }
    for (std::size_t axis = axes; axis-- > 1;) {
      const auto n = static_cast<std::size_t>(shape_[axis - 1]);
      for (int k = 0; k < 5; ++k) at[k] += static_cast<py::ssize_t>(rest % n) * sources_[k].strides[axis - 1];
      rest /= n;
    }
    const std::size_t count = std::min(extent - column, out.size() - done);
    std::array<py::ssize_t, 5> step{};
    if (axes > 0)
      for (int k = 0; k < 5; ++k) step[k] = sources_[k].strides.back();
    for (std::size_t i = 0; i < count; ++i) {
      std::array<double, 5> x;
      for (int k = 0; k < 5; ++k) std::memcpy(&x[k], at[k], sizeof(double)), at[k] += step[k];
      const double side = x[4];
      Place& place = out[done + i];
      place = {{x[0], x[1], x[2]}, static_cast<Side>(side > 0 ? 1 : side < 0 ? -1 : 0), x[3]};
      bool good = (side == 0 || side == 1 || side == -1) && (sides_ == Sides::any || !(x[1] * side < 0));
      for (int axis = 0; field && axis < 4; ++axis)
        good &= x[axis] >= allowed[axis].front && x[axis] <= allowed[axis].back;
      if (!good) refuse(first + done + i, place, side, field);
    }
    done += count;
  }
}

void BroadcastPlaces::refuse(std::size_t index, const Place& place, double side, const Field* field) const {
  Shape at(shape_.size());
  std::size_t rest = index;
  for (std::size_t axis = shape_.size(); axis-- > 0;) {
    const auto n = static_cast<std::size_t>(shape_[axis]);
    at[axis] = static_cast<py::ssize_t>(rest % n), rest /= n;
  }
  const std::string where = shape_.empty() ? "the place" : "place " + text_of(at);
  if (side != -1 && side != 0 && side != 1)
    throw InputError(where + ": side = " + shortest(side) +
                     ": must be -1 (left), 1 (right) or 0 (by the sign of v)");
  for (int axis = 0; field && axis < 4; ++axis) {
    const double value = axis == 3 ? place.t : place.uvw[axis];
    const auto [front, back] = field->domain(axis);
    const double slack = 1e-9 * (back - front);
    if (!(value >= front - slack && value <= back + slack))
      throw InputError(where + ": " + "uvwt"[axis] + " = " + shortest(value) + ": the field reaches from " +
                       shortest(front) + " to " + shortest(back) + " mm");
  }
  throw InputError(where + ": side = " + shortest(side) + " contradicts v = " + shortest(place.uvw.y));
}

py::array_t<double> new_array(Shape shape, py::ssize_t components) {
  if (components > 0) shape.push_back(components);
  return py::array_t<double>(shape);
}

py::dict dict_of(const RecordedParameters& parameters) {
  py::dict dict;
  for (const auto& [name, value] : parameters.all())
    std::visit([&, &key = name](const auto& v) { dict[py::str(key)] = v; }, value);
  return dict;
}

py::dict units_of(const Field& field) {
  py::dict units;
  for (const Quantity& quantity : field.quantities)
    if (const std::string unit = field.source ? unit_of(*field.source, quantity.name) : ""; !unit.empty())
      units[quantity.name.c_str()] = unit;
  return units;
}

py::dict dict_of(const FitReport& r) {
  py::dict dict;
  const std::pair<const char*, double> rows[] = {{"relative_l2", r.relative_l2},
                                                 {"node_error", r.node_error},
                                                 {"spline_error", r.spline_error},
                                                 {"between_nodes", r.between_nodes},
                                                 {"gape_error", r.gape_error},
                                                 {"false_gap", r.false_gap},
                                                 {"largest_displacement", r.largest_displacement},
                                                 {"frame_error", r.frame_error},
                                                 {"regularisation", r.regularisation},
                                                 {"crease", r.crease},
                                                 {"overlap", r.overlap},
                                                 {"least_volume", r.least_volume},
                                                 {"nodes", r.nodes},
                                                 {"frames", r.frames}};
  for (const auto& [name, value] : rows) dict[name] = value;
  return dict;
}

}  // namespace cleft::python
