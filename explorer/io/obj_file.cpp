#include "explorer/io/obj_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "base/error.h"
#include "base/text.h"
#include "explorer/io/obj_texture.h"

namespace cleft {

namespace {

class ObjReader {
 public:
  explicit ObjReader(const std::string& path) : path_(path), text_(read_text_file(path)) {}

  MeshPolygons read() {
    while (next_line()) {
      const std::string_view first = words_.empty() ? "" : words_[0];
      if (first == "v")
        points_.push_back({number(1), number(2), number(3)});
      else if (first == "vt")
        places_.push_back({number(1), words_.size() > 2 ? number(2) : 0});
      else if (first == "vn")
        ++normals_;
      else if (first == "f")
        add_face();
    }
    expect_what_is_named();
    if (places_.empty()) return {std::move(points_), std::move(faces_)};
    return textured();
  }

 private:
  enum Kind { point, place, normal };

  [[noreturn]] void refuse(const std::string& what) const {
    throw FileError(path_, "line " + std::to_string(line_number_) + " " + what);
  }

  /// Splits the next line into words, with those that it continues in after a '\' at its end.
  bool next_line() {
    if (at_ >= text_.size()) return false;
    line_.clear(), line_number_ = next_number_;
    for (bool more = true; more && at_ < text_.size(); ++next_number_) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      line_.append(text_, at_, end - at_);
      at_ = end + 1;
      if (!line_.empty() && line_.back() == '\r') line_.pop_back();
      more = !line_.empty() && line_.back() == '\\';
      if (more) line_.back() = ' ';
    }
    words_.clear();
    const std::string_view line = line_;
    constexpr std::string_view blank = " \t\v\f\r";
    for (std::size_t begin = line.find_first_not_of(blank); begin != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(blank, begin), line.size());
      if (line[begin] == '#') break;
      words_.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(blank, end);
    }
    return true;
  }

  double number(std::size_t word) const {
    if (word >= words_.size())
      refuse("has " + std::to_string(words_.size() - 1) + " numbers behind '" + std::string(words_[0]) + "'");
    const std::optional<double> value = number_of(words_[word]);
    if (!value) refuse("has '" + std::string(words_[word]) + "' for a number");
    return *value;
  }

  void add_face() {
    if (words_.size() < 4) refuse("is a face of fewer than three corners");
    std::vector<int>& face = faces_.emplace_back();
    for (std::size_t w = 1; w < words_.size(); ++w) {
      const std::string_view corner = words_[w];
      std::array<int, 3> named{-1, -1, -1};
      const char *at = corner.data(), *const end = at + corner.size();
      for (int kind = point; kind <= normal && at <= end; ++kind) {
        if (at < end && *at != '/') at = take(static_cast<Kind>(kind), corner, at, named[kind]);
        if (at < end && *at != '/') refuse("has the corner '" + std::string(corner) + "'");
        ++at;  // past the '/', or past the end
      }
      if (at <= end || named[point] < 0) refuse("has the corner '" + std::string(corner) + "'");
      face.push_back(named[point]);
      corner_places_.push_back(named[place]);
    }
  }

  /// A number from 1 on, or back from the last that came: -1. From 1 on it may name what comes later.
  const char* take(Kind kind, std::string_view corner, const char* at, int& named) {
    const std::size_t so_far = count(kind);
    long value = 0;
    const auto [next, error] = std::from_chars(at, corner.data() + corner.size(), value);
    if (error == std::errc::invalid_argument) refuse("has the corner '" + std::string(corner) + "'");
    const bool known = error == std::errc() && value != 0 && value <= std::numeric_limits<int>::max() &&
                       value >= -static_cast<long>(so_far);
    if (!known) refuse_name(kind, std::string(at, next), std::string(corner), so_far);
    named = static_cast<int>(value > 0 ? value - 1 : static_cast<long>(so_far) + value);
    Largest& largest = largest_[kind];
    if (named >= largest.number) largest = {named + 1, line_number_, std::string(corner)};
    return next;
  }

  std::size_t count(int kind) const {
    return kind == point ? points_.size() : kind == place ? places_.size() : normals_;
  }

  [[noreturn]] void refuse_name(int kind, const std::string& name, const std::string& corner,
                                std::size_t has) const {
    static constexpr const char* what[] = {"point", "texture coordinate", "normal"};
    refuse(std::string("names ") + what[kind] + " " + name + " in '" + corner + "'; the file has " +
           std::to_string(has));
  }

  void expect_what_is_named() {
    for (int kind = point; kind <= normal; ++kind) {
      const Largest& largest = largest_[kind];
      if (static_cast<std::size_t>(largest.number) <= count(kind)) continue;
      line_number_ = largest.line;
      refuse_name(kind, std::to_string(largest.number), largest.corner, count(kind));
    }
  }

  /// A point for each pair of a point and a place in the texture.
  MeshPolygons textured() {
    MeshPolygons mesh;
    std::vector<Uv> places;
    std::unordered_map<std::uint64_t, int> of_pair;
    std::size_t corner = 0;
    for (std::vector<int>& face : faces_)
      for (int& v : face) {
        const int at = corner_places_[corner++];
        const auto pair =
            static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) << 32 | static_cast<std::uint32_t>(at);
        const auto [found, is_new] = of_pair.try_emplace(pair, static_cast<int>(mesh.points.size()));
        if (is_new) {
          mesh.points.push_back(points_[v]);
          places.push_back(at < 0 ? no_place : places_[at]);
        }
        v = found->second;
      }
    mesh.polygons = std::move(faces_);
    mesh.note = add_texture_colors(path_, places, mesh);
    return mesh;
  }

  const std::string path_, text_;
  std::size_t at_ = 0;
  long line_number_ = 0, next_number_ = 1;
  std::string line_;
  std::vector<std::string_view> words_;  // of line_

  std::vector<Vec3> points_;
  std::vector<Uv> places_;
  std::size_t normals_ = 0;
  std::vector<std::vector<int>> faces_;
  std::vector<int> corner_places_;  // of all corners of faces_, one after the other; -1: none
  struct Largest {
    int number = 0;  // from 1
    long line = 0;
    std::string corner = {};
  };
  std::array<Largest, 3> largest_;  // by kind, that a face names
};

}  // namespace

MeshPolygons read_obj(const std::string& path) { return ObjReader(path).read(); }

std::string obj_of(const SurfaceMesh& mesh) {
  std::string text;
  for (const Vec3& p : mesh.points)
    text += "v " + shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
  for (const auto& t : mesh.triangles)
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
            std::to_string(t[2] + 1) + "\n";
  return text;
}

}  // namespace cleft
