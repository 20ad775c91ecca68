#include "tests/fuzz/h5_targets.h"

#include <hdf5.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/h5/h5.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"
#include "encoder/field/unknowns.h"
#include "solver/snapshot/snapshot.h"
#include "tests/io/wedge_row.h"

namespace cleft::fuzz {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

std::string place() {
  const fs::path folder = fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
  return (folder / ("cleft-fuzz-" + std::to_string(getpid()))).string();
}

/// Numbers that are easily taken for something else.
constexpr std::array<double, 14> numbers = {0,
                                            1,
                                            -1,
                                            2,
                                            3,
                                            1e9,
                                            -1e9,
                                            2147483647.,
                                            4294967296.,
                                            1e300,
                                            -0.5,
                                            1e-300,
                                            std::numeric_limits<double>::infinity(),
                                            std::numeric_limits<double>::quiet_NaN()};
constexpr std::array<hsize_t, 8> extents = {0, 1, 2, 1000, 1ULL << 31, 1ULL << 40, 1ULL << 62, ~0ULL - 1};

/// A sound file, made once, that goes with the program.
struct Seed {
  std::string path;
  ~Seed() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

/// Takes bytes as choices; 0 where there are none left.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool left() const { return at_ < size_; }
  unsigned next() { return left() ? data_[at_++] : 0; }
  std::size_t of(std::size_t count) {
    const unsigned high = next();
    return count == 0 ? 0 : (256 * high + next()) % count;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

struct Entry {
  std::string object, attribute;  // a dataset where there is no attribute
};

herr_t list_object(hid_t file, const char* name, const H5O_info_t* info, void* list) {
  auto& entries = *static_cast<std::vector<Entry>*>(list);
  const std::string object = std::string("/") + (std::string(name) == "." ? "" : name);
  if (info->type == H5O_TYPE_DATASET) entries.push_back({object, ""});
  const h5::Handle id(H5Oopen(file, name, H5P_DEFAULT), H5Oclose);
  std::pair<std::vector<Entry>*, const std::string*> both{&entries, &object};
  const auto list_attribute = [](hid_t, const char* attribute, const H5A_info_t*, void* to) -> herr_t {
    auto& [all, owner] = *static_cast<std::pair<std::vector<Entry>*, const std::string*>*>(to);
    all->push_back({*owner, attribute});
    return 0;
  };
  H5Aiterate2(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, list_attribute, &both);
  return 0;
}

/// A dataset in the place of another: of another type, rank and extent, with nothing in it.
void replace_dataset(hid_t file, const std::string& name, Choices& choices) {
  const std::array<hid_t, 5> types = {H5T_NATIVE_DOUBLE, H5T_NATIVE_INT, H5T_NATIVE_UINT8, H5T_C_S1,
                                      H5T_NATIVE_INT64};
  const hid_t type = types[choices.of(types.size())];
  const int rank = static_cast<int>(1 + choices.of(3));
  std::vector<hsize_t> extent, chunk;
  for (int i = 0; i < rank; ++i) {
    extent.push_back(extents[choices.of(extents.size())]);
    chunk.push_back(std::clamp<hsize_t>(extent.back(), 1, 64));
  }
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const h5::Handle space(H5Screate_simple(rank, extent.data(), nullptr), H5Sclose);
  const h5::Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (space < 0) return;
  H5Pset_chunk(creation, rank, chunk.data());
  const h5::Handle made(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                        H5Dclose);
}

void overwrite_element(hid_t file, const std::string& name, Choices& choices) {
  const h5::Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  const h5::Handle space(H5Dget_space(dataset), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  constexpr hssize_t most = 100000;
  if (count <= 0 || count > most) return;
  std::vector<double> values(static_cast<std::size_t>(count));
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  values[choices.of(values.size())] = numbers[choices.of(numbers.size())];
  H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

void replace_attribute(hid_t file, const Entry& entry, Choices& choices) {
  H5Adelete_by_name(file, entry.object.c_str(), entry.attribute.c_str(), H5P_DEFAULT);
  if (choices.of(4) == 0) return;
  const h5::Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const bool text = choices.of(3) == 0;
  const hid_t type = text ? H5T_C_S1 : H5T_NATIVE_DOUBLE;
  const h5::Handle made(H5Acreate_by_name(file, entry.object.c_str(), entry.attribute.c_str(), type, space,
                                          H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
  const double number = numbers[choices.of(numbers.size())];
  H5Awrite(made, type, text ? static_cast<const void*>("x") : &number);
}

void edit(const std::string& path, Choices& choices) {
  const h5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  for (int edits = 0; choices.left() && edits < 4; ++edits) {
    std::vector<Entry> entries;
    H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, list_object, &entries, H5O_INFO_BASIC);
    if (entries.empty()) return;
    const Entry entry = entries[choices.of(entries.size())];
    if (!entry.attribute.empty())
      replace_attribute(file, entry, choices);
    else if (const unsigned kind = choices.next() % 4; kind == 0)
      H5Ldelete(file, entry.object.c_str(), H5P_DEFAULT);
    else if (kind == 1)
      replace_dataset(file, entry.object, choices);
    else
      overwrite_element(file, entry.object, choices);
  }
}

/// Another value in the place of one member of the JSON.
void edit_json(Json& header, Choices& choices) {
  const Json flat = header.flatten();
  auto member = flat.begin();
  std::advance(member, static_cast<std::ptrdiff_t>(choices.of(flat.size())));
  const std::array<Json, 8> others = {Json(),           Json("x"),  Json::array(),
                                      Json::object(),   Json(true), Json(numbers[choices.of(numbers.size())]),
                                      Json(2147483647), Json(-1)};
  header[Json::json_pointer(member.key())] = others[choices.of(others.size())];
}

Field sound_field() {
  const auto u = BSplineBasis::uniform(3, 6, -6, 6), w = BSplineBasis::uniform(3, 5, -4, 0),
             t = BSplineBasis::uniform(3, 5, 0, 6);
  const auto v = BSplineBasis::broken(3, 8, -5, 0, 5);
  std::vector<Vec3> points(static_cast<std::size_t>(u.size() * v.size() * w.size() * t.size()));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {0, 1e-2 * static_cast<double>(i % 7), 0};
  Field field{u, v, w, t, points, CanonicalCut{-3, 6, 2}};
  field.report.largest_displacement = 0.06;
  return field;
}

/// Its path.
std::string write_sound_field() {
  const std::string path = place() + ".seed.dffd";
  write_field(path, sound_field());
  return path;
}

/// Its path.
std::string write_sound_study() {
  const std::string path = place() + ".seed.study.dffd";
  const Field field = quantised(sound_field(), 1e-3, 0.5);
  const FieldRecord own = record_of(field);
  const int slices = field.basis(3).size();
  const FieldRecord sum =
      record_of_sum(own.header, {field.basis(0), field.basis(1), field.basis(2), field.basis(3)}, slices);
  const CodedModes modes{{1e-3}, {own.coefficients}};
  RecordedParameters choices;
  choices.set("cut.contact", "false");
  write_study(path, {{"a", own, choices}, {"b", sum, {}, {0.5}, 0.01}, {"c", sum, {}, {2}, 0.01}}, modes);
  return path;
}

/// The file at `seed` with edits of its JSON header, and other bytes in the datasets named, in `path`.
void copy_edited(const std::string& seed, const std::string& path, const std::vector<std::string>& coded,
                 Choices& choices) {
  h5::File sound = h5::File::open(seed);
  const auto text = sound.read<std::uint8_t>("/header");
  std::vector<std::vector<std::uint8_t>> bytes;
  for (const std::string& name : coded) bytes.push_back(sound.read<std::uint8_t>(name));
  const std::string kind = sound.read_text("/", "format");
  const FileFormat format{kind.c_str(), static_cast<int>(sound.read_number("/", "version")), "", ""};
  sound.close();
  Json header = Json::parse(text.begin(), text.end());
  for (int edits = 0; choices.left() && edits < 3; ++edits)
    if (choices.next() % 4 > 0)
      edit_json(header, choices);
    else {
      auto& some = bytes[choices.of(bytes.size())];
      some.resize(choices.of(2 * some.size() + 1));
    }
  const std::string edited = header.dump(-1, ' ', false, Json::error_handler_t::replace);
  h5::File file = h5::File::create(path);
  write_format(file, format);
  file.write<std::uint8_t>("/header", {reinterpret_cast<const std::uint8_t*>(edited.data()), edited.size()},
                           {edited.size()}, h5::Packing::deflate);
  for (std::size_t n = 0; n < coded.size(); ++n)
    file.write<std::uint8_t>(coded[n], bytes[n], {bytes[n].size()}, h5::Packing::deflate);
  file.close();
}

template <class Reader>
void read_or_refuse(const std::string& path, const Reader& reader) {
  try {
    reader(path);
  } catch (const InputError&) {
  }
  fs::remove(path);
}

}  // namespace

void read_edited_snapshot(const std::uint8_t* data, std::size_t size) {
  static const Seed seed{[] {
    const std::string path = place() + ".seed.h5";
    Snapshot s = wedge_row(3, {0, 1, 2});
    SnapshotWriter writer(path, s, {{"pressure", 1, true}});
    writer.write_frames(0, std::vector<Vec3>(s.points.size() * s.frames(), Vec3{0, 0.1, 0}));
    for (std::size_t j = 0; j < s.frames(); ++j)
      writer.write_array({"pressure", 1, true}, j, std::vector<double>(s.points.size(), 1.));
    writer.finish(s);
    return path;
  }()};
  const std::string path = place() + ".h5";
  fs::copy_file(seed.path, path, fs::copy_options::overwrite_existing);
  Choices choices(data, size);
  edit(path, choices);
  read_or_refuse(path, [](const std::string& file) {
    const SnapshotReader reader(file);
    for (const SnapshotArray& array : reader.point_arrays()) reader.point_array(array, 0);
    check_snapshot(file);
  });
}

void read_edited_field(const std::uint8_t* data, std::size_t size) {
  static const Seed seed{write_sound_field()};
  const std::string path = place() + ".dffd";
  Choices choices(data, size);
  if (choices.next() % 4 == 0) {
    fs::copy_file(seed.path, path, fs::copy_options::overwrite_existing);
    edit(path, choices);
  } else
    copy_edited(seed.path, path, {"/coefficients"}, choices);
  read_or_refuse(path, [](const std::string& file) {
    read_field_parameters(file);
    read_residual(file);
    read_field(file);
  });
}

void read_edited_study(const std::uint8_t* data, std::size_t size) {
  static const Seed seed{write_sound_study()};
  const std::string path = place() + ".study.dffd";
  Choices choices(data, size);
  if (choices.next() % 4 == 0) {
    fs::copy_file(seed.path, path, fs::copy_options::overwrite_existing);
    edit(path, choices);
  } else
    copy_edited(seed.path, path, {"/coefficients", "/modes"}, choices);
  read_or_refuse(path, [](const std::string& file) {
    const StudyFile study(file);
    for (int i = 0; i < study.size(); ++i) {
      study.case_hash(i), study.parameters(i), study.report(i);
      study.field(i);
    }
  });
}

}  // namespace cleft::fuzz
