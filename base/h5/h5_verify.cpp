// File::read_everything(): whether all that a file holds can be read.
#include <algorithm>

#include "base/h5/h5_access.h"

namespace cleft::h5 {

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

}  // namespace cleft::h5
