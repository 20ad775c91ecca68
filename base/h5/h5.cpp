#include "base/h5/h5.h"

#include <filesystem>

#include "base/h5/h5_access.h"

namespace cleft::h5 {

namespace {

bool apart = false;  // see read_apart()

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

}  // namespace

void read_apart() { apart = true; }

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
  const Handle access = file_access();
  if (apart) H5Pset_fapl_stdio(access);
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
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

#define CLEFT_INSTANTIATE(T)                                                     \
  template std::vector<T> File::read<T>(const std::string&, const Shape&) const; \
  template void File::read_rows<T>(const std::string&, hsize_t, hsize_t, std::span<T>) const;
CLEFT_INSTANTIATE(double)
CLEFT_INSTANTIATE(float)
CLEFT_INSTANTIATE(std::int32_t)
CLEFT_INSTANTIATE(std::int64_t)
CLEFT_INSTANTIATE(std::uint8_t)
#undef CLEFT_INSTANTIATE

}  // namespace cleft::h5
