// HDF5 with every call checked. Files use the latest format, whose metadata carry checksums, and every
// dataset is chunked with Fletcher-32, so that damage is detected when it is read.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cleft::h5 {

/// Owns an HDF5 identifier.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  ~Handle();
  operator hid_t() const { return id_; }  // NOLINT: meant to be passed to HDF5 calls
  /// Closes now and returns whether that succeeded, which a destructor cannot.
  bool close();

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Version of the library: "1.10.8".
std::string version();

/// For a process in which others use this library too: files are read by its driver for C's streams from now
/// on. Files that others have opened by the usual driver, with settings of theirs, are then other files to
/// the library, which would refuse them otherwise, and closes no object of theirs.
void read_apart();

using Shape = std::vector<hsize_t>;

/// How a dataset is stored, besides its checksums.
enum class Packing { plain, deflate };

/// Whether a new file reserves space for further objects; small files that are written once need none.
enum class Growth { usual, none };

/// Supported element types: double, float, std::int32_t, std::int64_t, std::uint8_t.
/// Reading throws FileError (what is missing or damaged); writing throws std::runtime_error (disk full, ...).
class File {
 public:
  static File create(const std::string& path, Growth growth = Growth::usual);
  static File open(const std::string& path);

  const std::string& path() const { return path_; }
  bool is_open() const { return file_ >= 0; }
  bool has(const std::string& name) const;
  Shape shape(const std::string& name) const;
  /// Bytes of an element as stored.
  std::size_t element_size(const std::string& name) const;
  std::vector<std::string> attribute_names(const std::string& object) const;
  std::vector<std::string> members(const std::string& group) const;

  /// The whole dataset, which must have `shape` if one is given (0 = any extent).
  template <class T>
  std::vector<T> read(const std::string& name, const Shape& expected = {}) const;
  /// Rows first .. first + count - 1, slowest index first; out holds count times the product of the other
  /// extents.
  template <class T>
  void read_rows(const std::string& name, hsize_t first, hsize_t count, std::span<T> out) const;
  double read_number(const std::string& object, const std::string& attribute) const;
  /// A list of numbers, which must have `count` of them.
  std::vector<double> read_numbers(const std::string& object, const std::string& attribute,
                                   std::size_t count) const;
  std::string read_text(const std::string& object, const std::string& attribute) const;
  bool has_attribute(const std::string& object, const std::string& attribute) const;

  /// Reads every dataset and attribute, known or not; throws FileError at the first that is damaged.
  void read_everything() const;

  void create_group(const std::string& name);
  template <class T>
  void write(const std::string& name, std::span<const T> data, const Shape& shape,
             Packing packing = Packing::plain);
  /// An empty dataset to be filled with write_rows; a chunk holds `chunk_rows` rows.
  template <class T>
  void create_dataset(const std::string& name, const Shape& shape, hsize_t chunk_rows,
                      Packing packing = Packing::plain);
  template <class T>
  void write_rows(const std::string& name, hsize_t first, hsize_t count, std::span<const T> data);
  void write_number(const std::string& object, const std::string& attribute, double value);
  void write_numbers(const std::string& object, const std::string& attribute, std::span<const double> values);
  void write_integers(const std::string& object, const std::string& attribute,
                      std::span<const std::int64_t> values);
  void write_text(const std::string& object, const std::string& attribute, const std::string& text);

  /// Flushes and closes; a full disk is detected here.
  void close();

 private:
  File(std::string path, Handle file) : path_(std::move(path)), file_(std::move(file)) {}
  Handle open_dataset(const std::string& name) const;
  void create_groups_above(const std::string& name);
  hid_t check_write(hid_t result, const std::string& what) const;
  void write_attribute(const std::string& object, const std::string& name, hid_t type, hid_t space,
                       const void* data);

  std::string path_;
  Handle file_;
};

}  // namespace cleft::h5

namespace cleft {

/// Format and version of a file of this project, in its root attributes "format" and "version".
struct FileFormat {
  const char* name;
  int version;
  const char *noun, *writer;        ///< its name in messages, and the command that writes it
  std::array<int, 2> further = {};  ///< other versions that are read; 0: none
};
void write_format(h5::File& file, const FileFormat& format);
/// Throws FileError if the file has another format or version.
void require_format(const h5::File& file, const FileFormat& format);

/// The root attribute "format"; empty if there is none. Throws FileError if it is not an HDF5 file.
std::string format_of(const std::string& path);

}  // namespace cleft
