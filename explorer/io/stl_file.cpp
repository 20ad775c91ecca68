#include "explorer/io/stl_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "base/error.h"
#include "base/text.h"
#include "explorer/io/binary_text.h"

namespace cleft {

namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;  // the header with the count of triangles

/// The points of triangles, whose corners come one after the other.
class Corners {
 public:
  int at(Vec3 place) {
    for (int k = 0; k < 3; ++k) place[k] += 0.;  // -0 is 0
    const auto [found, is_new] = number_.try_emplace(place, static_cast<int>(points_.size()));
    if (is_new) points_.push_back(place);
    return found->second;
  }
  std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  struct Hash {
    std::size_t operator()(const Vec3& p) const {
      std::uint64_t hash = 0;
      for (int k = 0; k < 3; ++k)
        hash = (std::rotl(hash, 23) ^ std::bit_cast<std::uint64_t>(p[k])) * 0x9E3779B97F4A7C15u;
      return hash ^ (hash >> 32);
    }
  };
  std::vector<Vec3> points_;
  std::unordered_map<Vec3, int, Hash> number_;
};

std::string lower(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

/// Headers of binary files may begin with "solid" too: a text has hardly any other byte than characters.
bool is_text(const std::string& bytes) {
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 256));
  const auto odd = std::count_if(
      bytes.begin(), end, [](char c) { return (c < 32 || c > 126) && c != '\n' && c != '\r' && c != '\t'; });
  std::istringstream in(bytes.substr(0, 4096));
  std::string first;
  in >> first;
  return 20 * odd < end - bytes.begin() && lower(first) == "solid" &&
         lower(bytes.substr(0, 4096)).find("facet") != std::string::npos;
}

MeshPolygons read_text(const std::string& path, const std::string& bytes) {
  MeshPolygons mesh;
  Corners corners;
  std::vector<int> loop;
  std::istringstream in(bytes);
  std::string line, first;
  long number = 0;
  const auto refuse = [&](const std::string& what) {
    throw FileError(path, "line " + std::to_string(number) + " " + what);
  };
  bool in_loop = false, in_solid = false;
  while (std::getline(in, line)) {
    ++number;
    std::istringstream words(line);
    if (!(words >> first)) continue;
    first = lower(first);
    if (first == "vertex") {
      if (!in_loop) refuse("is a vertex outside of a loop");
      Vec3 place;
      for (int k = 0; k < 3; ++k) {
        std::string word;
        if (!(words >> word)) refuse("has fewer than three numbers behind 'vertex'");
        const std::optional<double> value = number_of(word);
        if (!value) refuse("has '" + word + "' for a number");
        place[k] = *value;
      }
      loop.push_back(corners.at(place));
    } else if (first == "outer") {
      in_loop = true;
    } else if (first == "endloop") {
      if (loop.size() < 3) refuse("ends a loop of fewer than three corners");
      mesh.polygons.push_back(std::move(loop));
      loop.clear(), in_loop = false;
    } else if (first == "solid") {
      in_solid = true;
    } else if (first == "endsolid") {
      in_solid = false;
    }
  }
  if (in_solid || in_loop) throw FileError(path, "is no whole .stl file: it ends without 'endsolid'");
  mesh.points = corners.take_points();
  return mesh;
}

MeshPolygons read_binary(const std::string& path, const std::string& bytes) {
  const std::size_t count = bytes.size() < header_bytes ? 0 : little<std::uint32_t>(bytes.data() + 80);
  const std::size_t promised = header_bytes + triangle_bytes * count;
  if (bytes.size() < promised)
    throw FileError(path, "is no whole .stl file: " + std::to_string(bytes.size()) +
                              " bytes, where its header promises " + std::to_string(promised));
  MeshPolygons mesh;
  Corners corners;
  for (std::size_t t = 0; t < count; ++t) {
    const char* const at = bytes.data() + header_bytes + triangle_bytes * t + 12;  // behind the normal
    std::vector<int>& polygon = mesh.polygons.emplace_back();
    for (int i = 0; i < 3; ++i) {
      Vec3 place;
      for (int k = 0; k < 3; ++k) place[k] = little<float>(at + 4 * (3 * i + k));
      polygon.push_back(corners.at(place));
    }
  }
  mesh.points = corners.take_points();
  return mesh;
}

std::array<float, 3> single(const Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// Of single precision are 24 bits: a mesh this many of its diameters away keeps 14 of them.
constexpr double farthest = 1000;

void expect_precision(const SurfaceMesh& mesh, const std::string& path) {
  if (mesh.points.empty()) return;
  Vec3 least = mesh.points.front(), most = least;
  for (const Vec3& p : mesh.points)
    for (int k = 0; k < 3; ++k) least[k] = std::min(least[k], p[k]), most[k] = std::max(most[k], p[k]);
  const double size = norm(most - least), away = norm(0.5 * (least + most));
  if (away > farthest * size)
    throw InputError(path + ": the mesh is " + formatted("%.3g", away) + " from the origin and " +
                     formatted("%.3g", size) +
                     " wide, and the single precision of .stl would move its points; write .ply, .obj or "
                     ".vtp, or move the mesh to the origin");
}

}  // namespace

MeshPolygons read_stl(const std::string& path) {
  const std::string bytes = read_text_file(path);
  return is_text(bytes) ? read_text(path, bytes) : read_binary(path, bytes);
}

std::string stl_of(const SurfaceMesh& mesh, const std::string& path) {
  expect_precision(mesh, path);
  std::string bytes = "binary .stl by " + producer();
  bytes.resize(80, ' ');
  append_little(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const Vec3 normal = cross(b - a, c - a);
    const double length = norm(normal);
    for (const Vec3& p : {length > 0 ? (1 / length) * normal : Vec3{}, a, b, c})
      for (const float x : single(p)) append_little(bytes, x);
    append_little(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace cleft
