// File::read_everything(): whether all that a file holds can be read, is in the file, and is under checksums.
#include <algorithm>

#include "base/h5/h5_access.h"

namespace cleft::h5 {

namespace {

/// What keeps damage of a dataset's elements from being seen; empty: nothing.
std::string unprotected(hid_t dataset, hssize_t elements) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_external_count(creation) > 0) return "is stored in another file";
  if (H5Pget_layout(creation) == H5D_VIRTUAL) return "is made of other datasets (virtual)";
  if (elements == 0) return "";
  if (H5Pget_layout(creation) == H5D_CHUNKED)
    for (int k = 0; k < H5Pget_nfilters(creation); ++k) {
      unsigned flags = 0, config = 0;
      std::size_t parameters = 0;
      if (H5Pget_filter2(creation, static_cast<unsigned>(k), &flags, &parameters, nullptr, 0, nullptr,
                         &config) == H5Z_FILTER_FLETCHER32)
        return "";
    }
  return "has no checksum (Fletcher-32)";
}

/// For H5Ovisit: reads an object's attributes, and its elements where it is a dataset. Negative where it
/// cannot.
herr_t read_object(hid_t root, const char* name, const H5O_info_t* info, void* problem) {
  const Handle object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
  if (object < 0) return -1;
  const auto found = [&](const std::string& what) {
    const std::string path = name;  // of the root "."
    *static_cast<std::string*>(problem) = (path == "." ? std::string("/") : "/" + path) + " " + what;
    return -1;
  };
  constexpr unsigned first_with_checksum = 2;
  if (info->hdr.version < first_with_checksum) return found("has a header without a checksum");
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
  if (const std::string what = unprotected(object, rows); !what.empty()) return found(what);
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
  constexpr const char* remedy = ": files of Cleft are whole and under checksums; write it again";
  std::string problem;
  const auto is_inside = [](hid_t, const char* name, const H5L_info_t* link, void* told) -> herr_t {
    if (link->type == H5L_TYPE_HARD) return 0;
    *static_cast<std::string*>(told) =
        std::string("/") + name +
        (link->type == H5L_TYPE_EXTERNAL ? " is a link to another file" : " is a symbolic link");
    return -1;
  };
  if (H5Lvisit(file_, H5_INDEX_NAME, H5_ITER_INC, is_inside, &problem) < 0 && !problem.empty())
    throw FileError(path_, problem + remedy);
  if (H5Ovisit2(file_, H5_INDEX_NAME, H5_ITER_INC, read_object, &problem, H5O_INFO_BASIC | H5O_INFO_HDR) >= 0)
    return;
  if (!problem.empty()) throw FileError(path_, problem + remedy);
  throw FileError(path_, "is damaged: a dataset or attribute cannot be read, or its checksum does not match");
}

}  // namespace cleft::h5
