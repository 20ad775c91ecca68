// What reading and writing share: element types, selections of rows, and what a dataset may declare. Private
// to this folder.
#pragma once

#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/h5/h5.h"

namespace cleft::h5 {

/// HDF5's name of an element type.
template <class T>
hid_t native();
template <>
inline hid_t native<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t native<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t native<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
inline hid_t native<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
inline hid_t native<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

inline hsize_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
}

/// Same type class: an array of integers where numbers are expected is damage or another program's file.
inline bool same_class(hid_t dataset, hid_t memory_type) {
  const Handle type(H5Dget_type(dataset), H5Tclose);
  return H5Tget_class(type) == H5Tget_class(memory_type);
}

inline constexpr double little = 64e6;  // bytes: never worth a question

/// Whether the stored bytes can contain this number of elements, checked before memory is allocated. Deflate
/// makes at most 1032 bytes of one; what was never written is read as zeros, of which no reader needs many.
inline bool can_be_stored(hid_t dataset, const Shape& shape, double unasked = little) {
  constexpr double most_inflated = 1032;
  const Handle type(H5Dget_type(dataset), H5Tclose);
  double declared = static_cast<double>(H5Tget_size(type));
  for (const hsize_t extent : shape) declared *= static_cast<double>(extent);
  return declared <= unasked || declared <= most_inflated * static_cast<double>(H5Dget_storage_size(dataset));
}

/// The file's selection of whole rows, and a memory space of as many elements.
inline std::pair<Handle, Handle> row_selection(hid_t dataset, hsize_t first, hsize_t count) {
  Handle file_space(H5Dget_space(dataset), H5Sclose);
  Shape extent(static_cast<std::size_t>(H5Sget_simple_extent_ndims(file_space)));
  H5Sget_simple_extent_dims(file_space, extent.data(), nullptr);
  CLEFT_CHECK(first + count, <=, extent[0]);
  Shape start(extent.size(), 0);
  start[0] = first, extent[0] = count;
  H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
  const hsize_t total = product(extent);
  return {std::move(file_space), Handle(H5Screate_simple(1, &total, nullptr), H5Sclose)};
}

}  // namespace cleft::h5
