#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "solver/body/body.h"

namespace cleft {

namespace {

template <std::size_t K>
std::vector<std::array<int, K>> read_table(const h5::File& file, const std::string& name) {
  const auto numbers = file.read<std::int32_t>(name, {0, K});
  std::vector<std::array<int, K>> rows(numbers.size() / K);
  for (std::size_t i = 0; i < numbers.size(); ++i) rows[i / K][i % K] = numbers[i];
  return rows;
}

std::vector<Vec3> read_vectors(const h5::File& file, const std::string& name) {
  const auto numbers = file.read<double>(name, {0, 3});
  std::vector<Vec3> vectors(numbers.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    vectors[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  return vectors;
}

void read_cells(const h5::File& file, Body& b) {
  const auto types = file.read<std::uint8_t>("/VTKHDF/Types", {0});
  const auto offsets = file.read<std::int64_t>("/VTKHDF/Offsets", {types.size() + 1});
  const auto nodes = file.read<std::int64_t>("/VTKHDF/Connectivity", {0});
  for (std::size_t c = 0; c < types.size(); ++c) {
    const std::int64_t corners = types[c] == 5 ? 3 : types[c] == 13 ? 6 : -1;
    if (offsets[c] < 0 || offsets[c + 1] - offsets[c] != corners ||
        offsets[c + 1] > static_cast<std::int64_t>(nodes.size()))
      throw FileError(file.path(), "cell " + std::to_string(c) +
                                       " of /VTKHDF is neither a triangle (5) with 3 nodes nor a wedge (13) "
                                       "with 6");
    const auto n = [&](int i) { return static_cast<int>(nodes[offsets[c] + i]); };
    if (corners == 3)
      b.skin.push_back({n(0), n(1), n(2)});
    else
      b.wedges.push_back({n(3), n(4), n(5), n(0), n(1), n(2)});
  }
}

void read_cuts(const h5::File& file, Body& b) {
  const auto nodes = read_table<3>(file, "/cut/pairs");
  const auto normals = read_vectors(file, "/cut/normal");
  const auto along = file.read<double>("/cut/along", {nodes.size()});
  const auto depth = file.read<double>("/cut/depth", {nodes.size()});
  if (normals.size() != nodes.size()) throw FileError(file.path(), "/cut/normal: one row a pair is needed");
  for (std::size_t p = 0; p < nodes.size(); ++p)
    b.pairs.push_back({nodes[p][0], nodes[p][1], nodes[p][2], along[p], depth[p], normals[p]});
  b.released = file.read<std::int32_t>("/cut/released", {0});
  b.position = file.read<double>("/cut/position", {b.released.size()});
  b.times = file.read<double>("/cut/times", {b.released.size()});
  b.length = file.read_number("/cut", "length");
  b.depth = file.read_number("/cut", "depth_of_cut");
}

void read_regions(const h5::File& file, Body& b) {
  b.region = file.read<std::uint8_t>("/regions/of_wedge", {b.wedges.size()});
  const auto young = file.read<double>("/regions/young_modulus", {0});
  const auto poisson = file.read<double>("/regions/poisson_ratio", {young.size()});
  std::istringstream names(file.read_text("/regions", "names"));
  for (std::size_t r = 0; r < young.size(); ++r) {
    RegionMaterial& m = b.materials.emplace_back();
    if (!std::getline(names, m.name))
      throw FileError(file.path(), "/regions, names: one line a region is needed");
    if (!std::isnan(young[r])) m.young_modulus = young[r];
    if (!std::isnan(poisson[r])) m.poisson_ratio = poisson[r];
  }
}

class BodyCheck {
 public:
  BodyCheck(const Body& body, const std::string& name) : b_(body), name_(name) {}

  void run() const {
    require(!b_.points.empty() && !b_.wedges.empty() && !b_.skin.empty(), "holds no nodes, wedges or skin");
    for (std::size_t n = 0; n < b_.points.size(); ++n)
      require(std::isfinite(squared_norm(b_.points[n])), "node " + std::to_string(n) + " is not finite");
    check_nodes("/VTKHDF, wedges", b_.wedges);
    check_nodes("/VTKHDF, triangles", b_.skin);
    check_nodes("/foundation/triangles", b_.bottom);
    check_nodes("/foundation/quads", b_.sides);
    require(b_.skin.size() <= b_.wedges.size(), "has more triangles of skin than wedges");
    for (std::size_t t = 0; t < b_.skin.size(); ++t)
      require(std::equal(b_.skin[t].begin(), b_.skin[t].end(), b_.wedges[t].begin() + 3),
              "triangle " + std::to_string(t) + " of the skin must be the upper one of wedge " +
                  std::to_string(t));
    require(b_.tension.size() == b_.skin.size(), "/skin/tension: one row a triangle of skin is needed");
    require(b_.support.size() == b_.bottom.size(), "/foundation/support: one number a triangle is needed");
    for (const Support s : b_.support)
      require(s == Support::springs || s == Support::bone,
              "/foundation/support: " + std::to_string(static_cast<int>(s)) +
                  " is neither 0 (springs) nor 1 (bone)");
    for (const auto& [list, size] : {std::pair{"canonical", b_.canonical.size()},
                                     {"frame", b_.frames.size()},
                                     {"skin_above", b_.skin_above.size()}})
      require(size == b_.points.size(),
              std::string("/VTKHDF/PointData/") + list + ": one row a node is needed");
    for (std::size_t n = 0; n < b_.points.size(); ++n) {
      double sum = squared_norm(b_.canonical[n]);
      for (const Vec3& axis : b_.frames[n]) sum += squared_norm(axis);
      require(std::isfinite(sum),
              "/VTKHDF/PointData, canonical or frame of node " + std::to_string(n) + " is not finite");
    }
    for (const int n : b_.skin_above)
      require(0 <= n && n < static_cast<int>(b_.points.size()),
              "skin_above names a node that does not exist");
    check_wedges();
    check_regions();
    check_tension();
    check_pairs();
    check_frames();
  }

 private:
  void require(bool good, const std::string& what) const {
    if (!good) throw FileError(name_, what);
  }

  template <std::size_t K>
  void check_nodes(const std::string& name, const std::vector<std::array<int, K>>& rows) const {
    const int points = static_cast<int>(b_.points.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (const int n : rows[r])
        require(0 <= n && n < points,
                name + ", row " + std::to_string(r) + ": node " + std::to_string(n) + " does not exist");
  }

  /// The corners' Jacobians, whose signs decide whether a wedge is turned inside out.
  void check_wedges() const {
    for (std::size_t w = 0; w < b_.wedges.size(); ++w)
      for (int c = 0; c < 6; ++c) {
        const int layer = 3 * (c / 3);
        const auto p = [&](int i) { return b_.points[b_.wedges[w][i]]; };
        const Vec3 here = p(c), next = p(layer + (c + 1) % 3), last = p(layer + (c + 2) % 3);
        const Vec3 up = p(3 + c % 3) - p(c % 3);
        const double volume = dot(cross(next - here, last - here), up);
        require(volume > 0, "wedge " + std::to_string(w) + " at (" + place(here) +
                                ") mm is flat or turned inside out; make the tissue thinner there");
      }
  }

  void check_regions() const {
    require(b_.region.size() == (b_.materials.empty() ? 0 : b_.wedges.size()),
            "/regions/of_wedge: one number a wedge is needed");
    for (std::size_t w = 0; w < b_.region.size(); ++w)
      require(b_.region[w] < b_.materials.size(), "/regions/of_wedge, row " + std::to_string(w) +
                                                      ": there is no region " + std::to_string(b_.region[w]));
    for (const RegionMaterial& m : b_.materials) check_material(m, "region " + m.name);
  }

  void check_material(const RegionMaterial& m, const std::string& of) const {
    require(!m.young_modulus || (*m.young_modulus > 0 && std::isfinite(*m.young_modulus)),
            of + ": young_modulus must be positive");
    require(!m.poisson_ratio || (*m.poisson_ratio >= 0 && *m.poisson_ratio <= 0.4999),
            of + ": poisson_ratio must be from 0 to 0.4999");
  }

  void check_tension() const {
    for (std::size_t t = 0; t < b_.tension.size(); ++t) {
      const auto& [a, b, c] = b_.skin[t];
      const Vec3 normal = cross(b_.points[b] - b_.points[a], b_.points[c] - b_.points[a]);
      require(std::abs(norm(b_.tension[t]) - 1) < 1e-6 &&
                  std::abs(dot(b_.tension[t], normal)) < 1e-6 * norm(normal),
              "/skin/tension, row " + std::to_string(t) + ": is no unit vector in the plane of its triangle");
    }
  }

  static std::string place(const Vec3& p) {
    return std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z);
  }

  void check_pairs() const {
    const int points = static_cast<int>(b_.points.size());
    std::vector<bool> is_right(b_.points.size(), false);
    for (std::size_t n = 0; n < b_.pairs.size(); ++n) {
      const BodyPair& p = b_.pairs[n];
      const std::string row = "/cut/pairs, row " + std::to_string(n) + ": ";
      require(0 <= p.left && p.left < points && 0 <= p.right && p.right < points && p.left != p.right,
              row + "nodes " + std::to_string(p.left) + " and " + std::to_string(p.right) + " are no pair");
      require(!is_right[p.right], row + "node " + std::to_string(p.right) + " is the right one of two pairs");
      require(std::abs(norm(p.normal) - 1) < 1e-6, row + "its normal is no unit vector");
      require(norm(b_.points[p.left] - b_.points[p.right]) == 0, row + "its nodes are at different places");
      require(std::isfinite(p.along) && std::isfinite(p.depth), row + "along or depth is not finite");
      is_right[p.right] = true;
    }
    std::vector<bool> was_left(b_.points.size(), false);
    for (std::size_t n = 0; n < b_.pairs.size(); ++n) {
      require(!was_left[b_.pairs[n].right],
              "/cut/pairs, row " + std::to_string(n) + ": its right node is the left one of an earlier row");
      was_left[b_.pairs[n].left] = true;
    }
  }

  void check_frames() const {
    const std::size_t frames = b_.released.size();
    require(frames > 1 && b_.released.front() == 0 &&
                std::is_sorted(b_.released.begin(), b_.released.end()) &&
                b_.released.back() == static_cast<int>(b_.pairs.size()),
            "/cut/released must begin with 0, not decrease, and end with the number of pairs");
    for (std::size_t f = 0; f + 1 < frames; ++f)
      require(b_.times[f] < b_.times[f + 1], "/cut/times must increase");
    require(std::isfinite(b_.times.front()) && std::isfinite(b_.times.back()), "/cut/times are not finite");
    require(b_.length > 0 && b_.depth > 0 && std::isfinite(b_.length * b_.depth),
            "/cut: length and depth must be positive");
  }

  const Body& b_;
  const std::string& name_;
};

}  // namespace

void check_body(const Body& body, const std::string& name) { BodyCheck(body, name).run(); }

Body read_body(const std::string& path) {
  const h5::File file = h5::File::open(path);
  require_format(file, body_format);
  Body b;
  b.points = read_vectors(file, "/VTKHDF/Points");
  read_cells(file, b);
  b.canonical = read_vectors(file, "/VTKHDF/PointData/canonical");
  const auto frames = file.read<double>("/VTKHDF/PointData/frame", {b.points.size(), 9});
  b.frames.resize(b.points.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    b.frames[i / 9][i % 9 / 3][static_cast<int>(i % 3)] = frames[i];
  b.skin_above = file.read<std::int32_t>("/VTKHDF/PointData/skin_above", {b.points.size()});
  b.tension = read_vectors(file, "/skin/tension");
  b.bottom = read_table<3>(file, "/foundation/triangles");
  for (const std::uint8_t s : file.read<std::uint8_t>("/foundation/support", {0}))
    b.support.push_back(static_cast<Support>(s));
  b.sides = read_table<4>(file, "/foundation/quads");
  if (file.has("/regions/of_wedge")) read_regions(file, b);
  read_cuts(file, b);
  check_body(b, path);
  b.hash = hash_of(b);
  return b;
}

}  // namespace cleft
