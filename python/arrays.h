// Arrays of numpy as the library's values. Private to this folder.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vec3.h"
#include "encoder/field/field.h"

namespace cleft::python {

namespace py = pybind11;

/// Numbers in whatever strides they have: an array of doubles is taken as it is, others are converted.
using Numbers = py::array_t<double, py::array::forcecast>;
using Shape = std::vector<py::ssize_t>;

/// "(3, 5)", for messages.
std::string text_of(const Shape& shape);

/// The places (u, v, w), side and t of five arrays of any shapes that numpy would broadcast, without a copy.
/// The arrays must outlive it; places() needs no interpreter.
class BroadcastPlaces {
 public:
  /// Whether a side must agree with the sign of v, or may be of a break that is elsewhere.
  enum class Sides { by_v, any };
  /// Throws InputError that names the shapes if these do not fit together.
  BroadcastPlaces(const Numbers& u, const Numbers& v, const Numbers& w, const Numbers& t, const Numbers& side,
                  Sides sides = Sides::by_v);

  const Shape& shape() const { return shape_; }
  std::size_t size() const { return size_; }
  /// The places from number `first` on in C order, as many as `out` has. With `field`, throws InputError that
  /// names the index of the first that is outside of its domain, as `cleft eval` does; a side that is none,
  /// or contradicts v, is always refused.
  void places(std::size_t first, std::span<Place> out, const Field* field) const;

 private:
  [[noreturn]] void refuse(std::size_t index, const Place& place, double side, const Field* field) const;

  struct Source {
    const char* data;
    std::vector<py::ssize_t> strides;  // bytes; 0 along axes that are repeated
  };
  std::array<Source, 5> sources_;  // u, v, w, t, side
  Shape shape_;
  std::size_t size_ = 1;
  Sides sides_;
};

/// A new array of the shape and `components` more, if these are not 0.
py::array_t<double> new_array(Shape shape, py::ssize_t components);
inline std::span<Vec3> as_vectors(py::array_t<double>& array) {
  return {reinterpret_cast<Vec3*>(array.mutable_data()), static_cast<std::size_t>(array.size()) / 3};
}

/// (N, 3) and the like: a view of memory that `owner` keeps. Read-only.
template <class Element, class Number>
py::array_t<Number> view_of(const std::vector<Element>& values, const py::handle& owner) {
  constexpr py::ssize_t each = sizeof(Element) / sizeof(Number);
  Shape shape{static_cast<py::ssize_t>(values.size())};
  if (each > 1) shape.push_back(each);
  py::array_t<Number> view(shape, reinterpret_cast<const Number*>(values.data()), owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}
/// The same of values that the array shall own: no copy.
template <class Element, class Number>
py::array_t<Number> array_of(std::vector<Element> values) {
  constexpr py::ssize_t each = sizeof(Element) / sizeof(Number);
  auto* kept = new std::vector<Element>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Element>*>(p); });
  Shape shape{static_cast<py::ssize_t>(kept->size())};
  if (each > 1) shape.push_back(each);
  return py::array_t<Number>(shape, reinterpret_cast<const Number*>(kept->data()), owner);
}

/// The rows of an (N, `columns`) array; throws InputError that names `name` and the shape otherwise.
template <class Element, class Number>
std::vector<Element> rows_of(const py::array_t<Number, py::array::c_style | py::array::forcecast>& array,
                             const std::string& name) {
  constexpr py::ssize_t columns = sizeof(Element) / sizeof(Number);
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw InputError(name + ": an array of shape (N, " + std::to_string(columns) + ") is needed, not " +
                     text_of({array.shape(), array.shape() + array.ndim()}));
  const auto* begin = reinterpret_cast<const Element*>(array.data());
  return {begin, begin + array.shape(0)};
}
template <class Number>
using Dense = py::array_t<Number, py::array::c_style | py::array::forcecast>;

/// Numbers and texts by name.
py::dict dict_of(const RecordedParameters& parameters);
py::dict dict_of(const FitReport& report);
/// Of the further quantities, by name: those that are known.
py::dict units_of(const Field& field);

/// A field as Python holds it.
struct SharedField {
  std::shared_ptr<const Field> field;
};

void bind_field(py::module_& module);
void bind_blended(py::module_& module);
void bind_study(py::module_& module);
void bind_snapshot(py::module_& module);
void bind_encode(py::module_& module);
void bind_cut(py::module_& module);

}  // namespace cleft::python
