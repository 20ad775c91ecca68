#include "base/h5/h5.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "base/error.h"
#include "base/text.h"

namespace cleft::h5 {

namespace {

template <class T>
hid_t native();
template <>
hid_t native<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t native<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t native<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t native<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t native<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

constexpr unsigned most_in_header = 1000;  // links or attributes of a group

hsize_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
}

/// Once, before the first call. Errors are reported through exceptions, not printed; and files are closed
/// here, checked, not at the program's end, where HDF5 1.10 crashes over one that a full disk kept it from
/// closing.
void begin_hdf5() {
  static const bool done = [] {
    H5dont_atexit();
    return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  }();
  (void)done;
}

/// libver LATEST on both ends: version 3 superblock and checksummed metadata.
Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  return access;
}

/// Same type class: an array of integers where numbers are expected is damage or another program's file.
bool same_class(hid_t dataset, hid_t memory_type) {
  const Handle type(H5Dget_type(dataset), H5Tclose);
  return H5Tget_class(type) == H5Tget_class(memory_type);
}

}  // namespace

std::string version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

Handle::~Handle() { close(); }

bool Handle::close() {
  const bool good = id_ < 0 || close_(id_) >= 0;
  id_ = -1;
  return good;
}

File File::create(const std::string& path, Growth growth) {
  begin_hdf5();
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose), access = file_access();
  H5Pset_obj_track_times(creation, false);  // of the root: the same content gives the same bytes
  if (growth == Growth::none) {
    H5Pset_meta_block_size(access, 0);
    H5Pset_small_data_block_size(access, 0);
  }
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  if (file < 0) throw std::runtime_error(path + ": could not be created");
  return {path, std::move(file)};
}

File File::open(const std::string& path) {
  begin_hdf5();
  if (!std::filesystem::is_regular_file(path)) throw FileError(path, "no such file, or not a file");
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, file_access()), H5Fclose);
  if (file < 0)
    throw FileError(path, "is not an HDF5 file, or is cut short or damaged; write or copy it again");
  return {path, std::move(file)};
}

bool File::has(const std::string& name) const {
  // H5Lexists wants every intermediate group to exist.
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const htri_t exists = H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT);
    if (exists < 0) throw FileError(path_, "group above " + name + " is damaged");
    if (exists == 0) return false;
    if (end == std::string::npos) return true;
  }
}

Handle File::open_dataset(const std::string& name) const {
  if (!has(name)) throw FileError(path_, "dataset " + name + " is missing");
  Handle dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset < 0) throw FileError(path_, "dataset " + name + " is damaged");
  return dataset;
}

Shape File::shape(const std::string& name) const {
  const Handle dataset = open_dataset(name);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  Shape shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  if (space < 0 || H5Sget_simple_extent_dims(space, shape.data(), nullptr) < 0)
    throw FileError(path_, "dataset " + name + " is damaged");
  return shape;
}

std::size_t File::element_size(const std::string& name) const {
  const Handle dataset = open_dataset(name), type(H5Dget_type(dataset), H5Tclose);
  return H5Tget_size(type);
}

std::vector<std::string> File::members(const std::string& group) const {
  std::vector<std::string> names;
  if (!has(group)) return names;
  const auto append = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  const Handle id(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (id < 0 || H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &names) < 0)
    throw FileError(path_, "group " + group + " is damaged");
  return names;
}

std::vector<std::string> File::attribute_names(const std::string& object) const {
  std::vector<std::string> names;
  if (object != "/" && !has(object)) return names;
  const auto append = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  const Handle id(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose);
  if (id < 0 || H5Aiterate2(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &names) < 0)
    throw FileError(path_, "attributes of " + object + " are damaged");
  return names;
}

bool File::has_attribute(const std::string& object, const std::string& attribute) const {
  if (object != "/" && !has(object)) return false;
  const htri_t exists = H5Aexists_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT);
  if (exists < 0) throw FileError(path_, "attributes of " + object + " are damaged");
  return exists > 0;
}

namespace {

constexpr double little = 64e6;  // bytes: never worth a question

/// Whether the stored bytes can contain this number of elements, checked before memory is allocated. Deflate
/// makes at most 1032 bytes of one; what was never written is read as zeros, of which no reader needs many.
bool can_be_stored(hid_t dataset, const Shape& shape, double unasked = little) {
  constexpr double most_inflated = 1032;
  const Handle type(H5Dget_type(dataset), H5Tclose);
  double declared = static_cast<double>(H5Tget_size(type));
  for (const hsize_t extent : shape) declared *= static_cast<double>(extent);
  return declared <= unasked || declared <= most_inflated * static_cast<double>(H5Dget_storage_size(dataset));
}

}  // namespace

template <class T>
std::vector<T> File::read(const std::string& name, const Shape& expected) const {
  const Shape actual = shape(name);
  bool fits = expected.empty() || expected.size() == actual.size();
  for (std::size_t i = 0; fits && i < expected.size(); ++i)
    fits = expected[i] == 0 || expected[i] == actual[i];
  if (!fits) {
    const auto text = [](const Shape& s) {
      std::string t;
      for (const hsize_t extent : s)
        t += (t.empty() ? "" : " x ") + (extent == 0 ? std::string("any") : std::to_string(extent));
      return t;
    };
    throw FileError(path_, "dataset " + name + " is " + text(actual) + ", expected " + text(expected));
  }
  const Handle dataset = open_dataset(name);
  if (!same_class(dataset, native<T>()))
    throw FileError(path_, "dataset " + name + " holds another type than its format says");
  if (!can_be_stored(dataset, actual))
    throw FileError(path_, "dataset " + name + " declares more than the file holds");
  std::vector<T> data(product(actual));
  if (!data.empty() && H5Dread(dataset, native<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
    throw FileError(path_, "dataset " + name + " is damaged (its checksum does not match)");
  return data;
}

namespace {

/// The file's selection of whole rows, and a memory space of as many elements.
std::pair<Handle, Handle> row_selection(hid_t dataset, hsize_t first, hsize_t count) {
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

}  // namespace

template <class T>
void File::read_rows(const std::string& name, hsize_t first, hsize_t count, std::span<T> out) const {
  const Handle dataset = open_dataset(name);
  const auto [file_space, memory_space] = row_selection(dataset, first, count);
  CLEFT_CHECK(static_cast<hsize_t>(H5Sget_select_npoints(file_space)), ==, out.size());
  if (!same_class(dataset, native<T>()))
    throw FileError(path_, "dataset " + name + " holds another type than its format says");
  if (H5Dread(dataset, native<T>(), memory_space, file_space, H5P_DEFAULT, out.data()) < 0)
    throw FileError(path_, "dataset " + name + " is damaged (its checksum does not match)");
}

double File::read_number(const std::string& object, const std::string& attribute) const {
  return read_numbers(object, attribute, 1).front();
}

std::vector<double> File::read_numbers(const std::string& object, const std::string& attribute,
                                       std::size_t count) const {
  const Handle id(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                  H5Aclose);
  std::vector<double> values(count);
  if (id < 0) throw FileError(path_, "attribute " + attribute + " of " + object + " is missing");
  const Handle space(H5Aget_space(id), H5Sclose), type(H5Aget_type(id), H5Tclose);
  const auto kind = H5Tget_class(type);
  if (H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(count) ||
      (kind != H5T_FLOAT && kind != H5T_INTEGER) || H5Aread(id, H5T_NATIVE_DOUBLE, values.data()) < 0)
    throw FileError(path_, "attribute " + attribute + " of " + object + " is not " +
                               (count == 1 ? "a number" : std::to_string(count) + " numbers"));
  return values;
}

std::string File::read_text(const std::string& object, const std::string& attribute) const {
  const Handle id(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                  H5Aclose);
  if (id < 0) throw FileError(path_, "attribute " + attribute + " of " + object + " is missing");
  const Handle type(H5Aget_type(id), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw FileError(path_, "attribute " + attribute + " of " + object + " is not a text");
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(id, type, text.data()) < 0)
    throw FileError(path_, "attribute " + attribute + " of " + object + " is damaged");
  return text.substr(0, text.find('\0'));
}

namespace {

/// For H5Ovisit: reads an object's attributes, and its elements where it is a dataset. Negative where it
/// cannot.
herr_t read_object(hid_t root, const char* name, const H5O_info_t* info, void*) {
  const Handle object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
  if (object < 0) return -1;
  std::vector<std::uint8_t> bytes;
  const auto read_attribute = [](hid_t owner, const char* attribute, const H5A_info_t*,
                                 void* buffer) -> herr_t {
    const Handle id(H5Aopen(owner, attribute, H5P_DEFAULT), H5Aclose), type(H5Aget_type(id), H5Tclose);
    auto& content = *static_cast<std::vector<std::uint8_t>*>(buffer);
    content.resize(H5Aget_storage_size(id) + 1);
    return id < 0 || type < 0 ? -1 : H5Aread(id, type, content.data());
  };
  if (H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, read_attribute, &bytes) < 0) return -1;
  if (info->type != H5O_TYPE_DATASET) return 0;
  const Handle space(H5Dget_space(object), H5Sclose), type(H5Dget_type(object), H5Tclose);
  const hssize_t rows = H5Sget_simple_extent_npoints(space);
  if (space < 0 || type < 0 || rows < 0) return -1;
  Shape extent(std::max(1, H5Sget_simple_extent_ndims(space)), 1);
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  constexpr double most_unwritten = 16e9;  // an array of zeros that an import never wrote
  const Shape one_row(extent.begin() + 1, extent.end());
  if (!can_be_stored(object, one_row) || !can_be_stored(object, extent, most_unwritten)) return -1;
  const hsize_t row = rows / std::max<hsize_t>(1, extent[0]),
                block = std::max<hsize_t>(1, (hsize_t{1} << 22) / std::max<hsize_t>(1, row));
  for (hsize_t first = 0; first < extent[0] && rows > 0; first += block) {
    const hsize_t count = std::min(block, extent[0] - first);
    const auto [file_space, memory_space] = row_selection(object, first, count);
    bytes.resize(count * row * H5Tget_size(type));
    if (H5Dread(object, type, memory_space, file_space, H5P_DEFAULT, bytes.data()) < 0) return -1;
  }
  return 0;
}

}  // namespace

void File::read_everything() const {
  if (H5Ovisit2(file_, H5_INDEX_NAME, H5_ITER_INC, read_object, nullptr, H5O_INFO_BASIC) < 0)
    throw FileError(path_,
                    "is damaged: a dataset or attribute cannot be read, or its checksum does not match");
}

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
  H5Pset_obj_track_times(creation, false);  // the same content gives the same bytes
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
  template std::vector<T> File::read<T>(const std::string&, const Shape&) const;               \
  template void File::read_rows<T>(const std::string&, hsize_t, hsize_t, std::span<T>) const;  \
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

namespace cleft {

void write_format(h5::File& file, const FileFormat& format) {
  file.write_text("/", "format", format.name);
  file.write_number("/", "version", format.version);
}

void require_format(const h5::File& file, const FileFormat& format) {
  const std::string noun = format.noun, writer = format.writer;
  if (!file.has_attribute("/", "format") || file.read_text("/", "format") != format.name)
    throw FileError(file.path(), "is not a " + noun + " (no attribute format = \"" + format.name + "\"); " +
                                     writer + " writes one");
  const double found = file.read_number("/", "version");
  if (found != format.version)
    throw FileError(file.path(), noun + " format version " + shortest(found) +
                                     "; this program reads version " + std::to_string(format.version) +
                                     ": run " + writer + " again");
}

std::string format_of(const std::string& path) {
  const h5::File file = h5::File::open(path);
  return file.has_attribute("/", "format") ? file.read_text("/", "format") : "";
}

}  // namespace cleft
