// CalculiX's results (.frd), in text or binary.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "base/error.h"
#include "encoder/import/frame_files.h"

namespace cleft {

namespace {

/// How numbers are stored, by the last column of a block's header.
enum class Form { short_text = 0, long_text = 1, single_binary = 2, double_binary = 3 };

/// Rows of numbers, each of a node.
struct Block {
  Form form = Form::long_text;
  std::streamoff begin = 0;
  std::size_t count = 0, columns = 3;
};

struct Result {
  std::string name;
  Block rows;
};

struct ResultFrame {
  double time = 0;
  std::vector<Result> results;
};

/// VTK's type and the file's order of VTK's nodes, of types 1 to 12. The file has the nodes in the middle of
/// upright edges before those of the upper face's.
struct CellKind {
  std::uint8_t type;
  std::vector<int> order;
};

std::vector<int> in_order(int nodes) {
  std::vector<int> order(static_cast<std::size_t>(nodes));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

const CellKind* cell_kind(std::int64_t type) {
  static const std::vector<CellKind> kinds = {
      {12, in_order(8)},
      {13, in_order(6)},
      {10, in_order(4)},
      {25, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15}},
      {26, {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11}},
      {24, in_order(10)},
      {5, in_order(3)},
      {22, in_order(6)},
      {9, in_order(4)},
      {23, in_order(8)},
      {3, in_order(2)},
      {21, in_order(3)}};
  return type >= 1 && type <= static_cast<std::int64_t>(kinds.size())
             ? &kinds[static_cast<std::size_t>(type - 1)]
             : nullptr;
}

class FrdFile : public FrameFiles {
 public:
  explicit FrdFile(const std::string& path) : path_(path) {
    std::ifstream file = opened();
    std::error_code error;
    bytes_ = static_cast<std::streamoff>(std::filesystem::file_size(path, error));
    find_blocks(file);
    if (nodes_.count == 0 || cell_types_.empty())
      throw FileError(path_, "holds no nodes, or no elements, of CalculiX's results");
    for (const ResultFrame& frame : frames_) times_.push_back(frame.time);
  }

  std::vector<std::string> files() const override { return {path_}; }
  const std::vector<double>& times() const override { return times_; }
  const std::string& file(std::size_t) const override { return path_; }
  std::vector<std::string> point_arrays(std::size_t frame) const override {
    std::vector<std::string> names;
    for (const Result& result : frames_[frame].results) names.push_back(result.name);
    return names;
  }
  std::vector<std::string> cell_arrays(std::size_t) const override { return {}; }

  SourceFrame read(std::size_t frame, const WantedArrays& wanted) const override {
    std::ifstream file = opened();
    SourceFrame result;
    SourceMesh& mesh = result.mesh;
    std::unordered_map<std::int64_t, std::int64_t> index;
    for_each_row(file, nodes_, [&](std::int64_t number, const double* place) {
      if (!index.emplace(number, static_cast<std::int64_t>(mesh.points.size())).second)
        refuse("node " + std::to_string(number) + " is there twice");
      mesh.points.push_back({place[0], place[1], place[2]});
    });
    mesh.cell_types = cell_types_, mesh.cell_offsets = cell_offsets_;
    for (const std::int64_t number : corners_) mesh.connectivity.push_back(index_of(index, number));
    for (const std::string& name : wanted.points) {
      const auto& results = frames_[frame].results;
      const Block& rows =
          std::find_if(results.begin(), results.end(), [&](const Result& r) { return r.name == name; })->rows;
      SourceArray& array = result.arrays.emplace_back();
      array.components = static_cast<int>(rows.columns), array.single = true;
      array.values.assign(mesh.points.size() * rows.columns, std::numeric_limits<double>::quiet_NaN());
      for_each_row(file, rows, [&](std::int64_t number, const double* values) {
        std::copy_n(values, rows.columns,
                    &array.values[static_cast<std::size_t>(index_of(index, number)) * rows.columns]);
      });
    }
    return result;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw FileError(path_, what + "; is it complete, and written by CalculiX?");
  }

  std::ifstream opened() const {
    std::ifstream file(path_, std::ios::binary);
    if (!file) throw FileError(path_, "cannot be opened: does it exist?");
    return file;
  }

  std::int64_t index_of(const std::unordered_map<std::int64_t, std::int64_t>& index,
                        std::int64_t number) const {
    const auto found = index.find(number);
    if (found == index.end()) refuse("names node " + std::to_string(number) + ", which is not there");
    return found->second;
  }

  static std::string_view columns(const std::string& line, std::size_t first, std::size_t count) {
    std::string_view text(line);
    text = first < text.size() ? text.substr(first, count) : std::string_view();
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
    return text;
  }

  template <class T>
  T number(const std::string& line, std::size_t first, std::size_t count) const {
    const std::string_view text = columns(line, first, count);
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      refuse("'" + std::string(text) + "' is no number in the line '" + line.substr(0, 60) + "'");
    return value;
  }

  static bool is_key(const std::string& line, const char* key) { return columns(line, 0, 3) == key; }
  static bool is_binary(Form form) { return form == Form::single_binary || form == Form::double_binary; }
  static std::size_t width(Form form) { return form == Form::short_text ? 5 : 10; }
  static std::size_t bytes_of_row(const Block& rows) {
    return 4 + rows.columns * (rows.form == Form::double_binary ? 8 : 4);
  }

  Form form_of(std::int64_t number) const {
    if (number < 0 || number > 3) refuse("numbers are of the unknown form " + std::to_string(number));
    return static_cast<Form>(number);
  }

  std::string line_of(std::ifstream& file) const {
    std::string line;
    if (!std::getline(file, line)) refuse("ends within a block");
    return line;
  }

  /// Rows of numbers from where they begin: action(node, numbers).
  template <class Action>
  void for_each_row(std::ifstream& file, const Block& rows, const Action& action) const {
    file.clear(), file.seekg(rows.begin);
    std::vector<double> values(rows.columns);
    if (is_binary(rows.form)) {
      std::vector<char> row(bytes_of_row(rows));
      for (std::size_t i = 0; i < rows.count; ++i) {
        if (!file.read(row.data(), static_cast<std::streamsize>(row.size()))) refuse("ends within a block");
        std::int32_t node;
        std::memcpy(&node, row.data(), 4);
        for (std::size_t c = 0; c < rows.columns; ++c)
          if (rows.form == Form::double_binary) {
            std::memcpy(&values[c], &row[4 + 8 * c], 8);
          } else {
            float value;
            std::memcpy(&value, &row[4 + 4 * c], 4);
            values[c] = value;
          }
        action(node, values.data());
      }
      return;
    }
    constexpr std::size_t most = 6, wide = 12;  // numbers of a line, and their characters
    const std::size_t first = 3 + width(rows.form);
    for (std::size_t i = 0; i < rows.count; ++i) {
      std::string line = line_of(file);
      if (!is_key(line, "-1")) refuse("a block has fewer rows than it tells");
      const auto node = number<std::int64_t>(line, 3, width(rows.form));
      for (std::size_t c = 0; c < rows.columns; ++c) {
        if (c > 0 && c % most == 0) line = line_of(file);
        values[c] = number<double>(line, first + wide * (c % most), wide);
      }
      action(node, values.data());
    }
  }

  /// Where the next block begins, behind rows that are not read.
  void skip(std::ifstream& file, const Block& rows) const {
    if (is_binary(rows.form)) {
      const auto left = static_cast<std::size_t>(std::max<std::streamoff>(0, bytes_ - rows.begin));
      if (rows.count > left / bytes_of_row(rows)) refuse("ends within a block");
      file.seekg(rows.begin + static_cast<std::streamoff>(rows.count * bytes_of_row(rows)));
      return;
    }
    std::size_t found = 0;
    for (std::string line = line_of(file); !is_key(line, "-3"); line = line_of(file))
      found += is_key(line, "-1");
    if (found != rows.count)
      refuse("a block tells of " + std::to_string(rows.count) + " rows, and has " + std::to_string(found));
  }

  std::size_t count_in(const std::string& line, std::size_t first) const {
    const auto count = number<std::int64_t>(line, first, 12);
    if (count < 0) refuse("a block of " + std::to_string(count) + " rows");
    return static_cast<std::size_t>(count);
  }

  void find_blocks(std::ifstream& file) {
    std::string line;
    bool ended = false;
    while (!ended && std::getline(file, line)) {
      const std::string_view key = columns(line, 0, 6);
      if (key == "2C") {
        nodes_.form = form_of(number<std::int64_t>(line, 72, 3));
        nodes_.count = count_in(line, 24), nodes_.begin = file.tellg();
        skip(file, nodes_);
      } else if (key == "3C") {
        read_cells(file, line);
      } else if (columns(line, 0, 5) == "100" && line.size() > 5 && line[5] == 'C') {
        find_result(file, line);
      } else {
        ended = key == "9999";
      }
    }
    if (!ended) refuse("lacks its last line, 9999");
  }

  void read_cells(std::ifstream& file, const std::string& header) {
    const Form form = form_of(number<std::int64_t>(header, 72, 3));
    const std::size_t count = count_in(header, 24);
    cell_types_.clear(), corners_.clear(), cell_offsets_ = {0};
    for (std::size_t e = 0; e < count; ++e) {
      std::int64_t type;
      std::string line;
      if (is_binary(form)) {
        file.ignore(4);  // its number
        type = integer(file);
        file.ignore(8);  // group and material
      } else {
        line = line_of(file);
        if (!is_key(line, "-1")) refuse("has fewer elements than it tells");
        type = number<std::int64_t>(line, 3 + width(form), 5);
      }
      const CellKind* kind = cell_kind(type);
      if (!kind) refuse("an element is of the unknown type " + std::to_string(type));
      std::vector<std::int64_t> nodes;
      const std::size_t in_line = form == Form::short_text ? 15 : 10;
      for (std::size_t i = 0; i < kind->order.size(); ++i) {
        if (is_binary(form)) {
          nodes.push_back(integer(file));
          continue;
        }
        if (i % in_line == 0) line = line_of(file);
        nodes.push_back(number<std::int64_t>(line, 3 + width(form) * (i % in_line), width(form)));
      }
      cell_types_.push_back(kind->type);
      for (const int i : kind->order) corners_.push_back(nodes[static_cast<std::size_t>(i)]);
      cell_offsets_.push_back(static_cast<std::int64_t>(corners_.size()));
    }
    if (!is_binary(form) && !is_key(line_of(file), "-3")) refuse("has more elements than it tells");
  }

  std::int64_t integer(std::ifstream& file) const {
    std::int32_t value = 0;
    if (!file.read(reinterpret_cast<char*>(&value), 4)) refuse("ends within a block");
    return value;
  }

  void find_result(std::ifstream& file, const std::string& header) {
    Result result;
    result.rows.form = form_of(number<std::int64_t>(header, 73, 2));
    result.rows.count = count_in(header, 24);
    const auto time = number<double>(header, 12, 12);
    const std::string named = line_of(file);
    if (!is_key(named, "-4")) refuse("a result lacks its name");
    result.name = columns(named, 5, 8);
    const auto listed = number<std::int64_t>(named, 13, 5);
    result.rows.columns = 0;
    for (std::int64_t i = 0; i < listed; ++i) {
      const std::string component = line_of(file);
      if (!is_key(component, "-5")) refuse("result '" + result.name + "' lacks a component");
      // Those that a program computes from the others, such as a vector's length, have no numbers here.
      result.rows.columns += columns(component, 33, 5) != "1";
    }
    result.rows.begin = file.tellg();
    skip(file, result.rows);
    if (result.rows.columns == 0) return;
    const bool again =
        !frames_.empty() && std::any_of(frames_.back().results.begin(), frames_.back().results.end(),
                                        [&](const Result& r) { return r.name == result.name; });
    if (frames_.empty() || frames_.back().time != time || again) frames_.push_back({time, {}});
    frames_.back().results.push_back(std::move(result));
  }

  std::string path_;
  std::streamoff bytes_ = 0;
  Block nodes_;
  std::vector<std::uint8_t> cell_types_;
  std::vector<std::int64_t> cell_offsets_, corners_;  ///< numbers of nodes as in the file
  std::vector<ResultFrame> frames_;
  std::vector<double> times_;
};

}  // namespace

std::unique_ptr<FrameFiles> open_frd(const std::string& path) { return std::make_unique<FrdFile>(path); }

}  // namespace cleft
