// The writing half of File.
#include <algorithm>

#include "base/h5/h5_access.h"

namespace cleft::h5 {

namespace {

constexpr unsigned most_in_header = 1000;  // links or attributes of a group

}  // namespace

hid_t File::check_write(hid_t result, const std::string& what) const {
  if (result < 0) throw std::runtime_error(path_ + ": " + what + " could not be written: is the disk full?");
  return result;
}

void File::create_group(const std::string& name) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);  // the same content gives the same bytes
  // Links and attributes stay in the group's own header, small and under one checksum: HDF5 1.10 frees memory
  // that it never set when the heap of a larger table is damaged.
  H5Pset_link_phase_change(creation, most_in_header, 0);
  H5Pset_attr_phase_change(creation, most_in_header, 0);
  const Handle group(check_write(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), name),
                     H5Gclose);
}

void File::create_groups_above(const std::string& name) {
  for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
    if (!has(name.substr(0, end))) create_group(name.substr(0, end));
}

template <class T>
void File::create_dataset(const std::string& name, const Shape& shape, hsize_t chunk_rows, Packing packing) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);    // the same content gives the same bytes
  H5Pset_dset_no_attrs_hint(creation, true);  // no room is kept for attributes
  if (product(shape) > 0) {
    Shape chunk = shape;
    chunk[0] = std::clamp<hsize_t>(chunk_rows, 1, shape[0]);
    H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
    if (packing == Packing::deflate) H5Pset_shuffle(creation), H5Pset_deflate(creation, 6);
    H5Pset_fletcher32(creation);
  }
  create_groups_above(name);
  const Handle dataset(
      check_write(H5Dcreate2(file_, name.c_str(), native<T>(), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                  name),
      H5Dclose);
}

template <class T>
void File::write_rows(const std::string& name, hsize_t first, hsize_t count, std::span<const T> data) {
  Handle dataset(check_write(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), name), H5Dclose);
  const auto [file_space, memory_space] = row_selection(dataset, first, count);
  CLEFT_CHECK(static_cast<hsize_t>(H5Sget_select_npoints(file_space)), ==, data.size());
  if (count > 0)
    check_write(H5Dwrite(dataset, native<T>(), memory_space, file_space, H5P_DEFAULT, data.data()), name);
  check_write(dataset.close() ? 0 : -1, name);
}

template <class T>
void File::write(const std::string& name, std::span<const T> data, const Shape& shape, Packing packing) {
  const hsize_t row =
      shape.empty() ? 1 : std::max<hsize_t>(1, product(shape) / std::max<hsize_t>(1, shape[0]));
  create_dataset<T>(name, shape, std::max<hsize_t>(1, (hsize_t{1} << 20) / (row * sizeof(T))), packing);
  write_rows<T>(name, 0, shape[0], data);
}

void File::write_attribute(const std::string& object, const std::string& name, hid_t type, hid_t space,
                           const void* data) {
  const std::string what = "attribute " + name + " of " + object;
  Handle id(check_write(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                          H5P_DEFAULT, H5P_DEFAULT),
                        what),
            H5Aclose);
  check_write(H5Awrite(id, type, data), what);
  check_write(id.close() ? 0 : -1, what);
}

void File::write_number(const std::string& object, const std::string& attribute, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  write_attribute(object, attribute, H5T_NATIVE_DOUBLE, space, &value);
}

void File::write_numbers(const std::string& object, const std::string& attribute,
                         std::span<const double> values) {
  const hsize_t count = values.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  write_attribute(object, attribute, H5T_NATIVE_DOUBLE, space, values.data());
}

void File::write_integers(const std::string& object, const std::string& attribute,
                          std::span<const std::int64_t> values) {
  const hsize_t count = values.size();
  const Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose);
  write_attribute(object, attribute, H5T_NATIVE_INT64, space, values.data());
}

void File::write_text(const std::string& object, const std::string& attribute, const std::string& text) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose), type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(1, text.size()));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  write_attribute(object, attribute, type, space, text.c_str());
}

void File::close() {
  const bool flushed = file_ < 0 || H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  const bool closed = file_.close();
  check_write(flushed && closed ? 0 : -1, "the last part");
}

#define CLEFT_INSTANTIATE(T)                                                                   \
  template void File::write<T>(const std::string&, std::span<const T>, const Shape&, Packing); \
  template void File::create_dataset<T>(const std::string&, const Shape&, hsize_t, Packing);   \
  template void File::write_rows<T>(const std::string&, hsize_t, hsize_t, std::span<const T>);
CLEFT_INSTANTIATE(double)
CLEFT_INSTANTIATE(float)
CLEFT_INSTANTIATE(std::int32_t)
CLEFT_INSTANTIATE(std::int64_t)
CLEFT_INSTANTIATE(std::uint8_t)
#undef CLEFT_INSTANTIATE

}  // namespace cleft::h5
