#include <limits>

#include "base/output_file.h"
#include "base/text.h"
#include "params/hash.h"
#include "solver/body/body.h"

namespace cleft {

namespace {

std::span<const double> as_numbers(const std::vector<Vec3>& vectors) {
  return {vectors.empty() ? nullptr : &vectors.front().x, 3 * vectors.size()};
}

template <std::size_t K>
void write_table(h5::File& file, const std::string& name, const std::vector<std::array<int, K>>& rows) {
  file.write<std::int32_t>(name, {rows.empty() ? nullptr : rows.front().data(), K * rows.size()},
                           {rows.size(), K});
}

template <class T>
void write_list(h5::File& file, const std::string& name, const std::vector<T>& values) {
  file.write<T>(name, values, {values.size()});
}

/// Skin triangles, then wedges, as in a snapshot.
void write_vtk_mesh(h5::File& file, const Body& b) {
  constexpr std::uint8_t triangle = 5, wedge = 13;
  std::vector<std::uint8_t> types(b.skin.size(), triangle);
  types.insert(types.end(), b.wedges.size(), wedge);
  std::vector<std::int64_t> offsets = {0}, connectivity;
  for (const auto& t : b.skin) {
    connectivity.insert(connectivity.end(), t.begin(), t.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  for (const auto& w : b.wedges) {  // VTK's wedge begins with the face whose normal points outward
    connectivity.insert(connectivity.end(), w.begin() + 3, w.end());
    connectivity.insert(connectivity.end(), w.begin(), w.begin() + 3);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  file.create_group("/VTKHDF");
  file.write_integers("/VTKHDF", "Version", std::array<std::int64_t, 2>{2, 0});
  file.write_text("/VTKHDF", "Type", "UnstructuredGrid");
  const auto write_count = [&file](const std::string& name, std::size_t count) {
    const auto number = static_cast<std::int64_t>(count);
    file.write<std::int64_t>(name, {&number, 1}, {1});
  };
  write_count("/VTKHDF/NumberOfPoints", b.points.size());
  write_count("/VTKHDF/NumberOfCells", types.size());
  write_count("/VTKHDF/NumberOfConnectivityIds", connectivity.size());
  file.write<double>("/VTKHDF/Points", as_numbers(b.points), {b.points.size(), 3});
  write_list(file, "/VTKHDF/Types", types);
  write_list(file, "/VTKHDF/Offsets", offsets);
  write_list(file, "/VTKHDF/Connectivity", connectivity);
}

void write_cuts(h5::File& file, const Body& b) {
  std::vector<std::array<int, 3>> nodes;
  std::vector<Vec3> normals;
  std::vector<double> along, depth;
  for (const BodyPair& p : b.pairs) {
    nodes.push_back({p.left, p.right, p.cut});
    normals.push_back(p.normal), along.push_back(p.along), depth.push_back(p.depth);
  }
  write_table(file, "/cut/pairs", nodes);
  file.write<double>("/cut/normal", as_numbers(normals), {normals.size(), 3});
  write_list(file, "/cut/along", along);
  write_list(file, "/cut/depth", depth);
  write_list(file, "/cut/released", b.released);
  write_list(file, "/cut/position", b.position);
  write_list(file, "/cut/times", b.times);
  file.write_number("/cut", "length", b.length);
  file.write_number("/cut", "depth_of_cut", b.depth);
}

/// Moduli that are those of the case are NaN.
void write_regions(h5::File& file, const Body& b) {
  std::vector<double> young, poisson;
  std::string names;
  for (const RegionMaterial& m : b.materials) {
    constexpr double of_case = std::numeric_limits<double>::quiet_NaN();
    young.push_back(m.young_modulus.value_or(of_case)), poisson.push_back(m.poisson_ratio.value_or(of_case));
    names += (names.empty() ? "" : "\n") + m.name;
  }
  write_list(file, "/regions/of_wedge", b.region);
  write_list(file, "/regions/young_modulus", young);
  write_list(file, "/regions/poisson_ratio", poisson);
  file.write_text("/regions", "names", names);
}

template <class T>
void add(std::string& bytes, const std::vector<T>& list) {
  bytes += std::to_string(list.size()) + ";";
  bytes.append(reinterpret_cast<const char*>(list.data()), sizeof(T) * list.size());
}

}  // namespace

std::string hash_of(const Body& b) {
  std::string bytes = "cleft body 1\n";
  add(bytes, b.points), add(bytes, b.wedges), add(bytes, b.skin), add(bytes, b.tension), add(bytes, b.bottom);
  add(bytes, b.support), add(bytes, b.sides), add(bytes, b.released), add(bytes, b.position);
  add(bytes, b.times), add(bytes, b.canonical), add(bytes, b.frames), add(bytes, b.skin_above);
  bytes += shortest(b.length) + "," + shortest(b.depth) + ";";
  for (const BodyPair& p : b.pairs)
    bytes += std::to_string(p.left) + "," + std::to_string(p.right) + "," + std::to_string(p.cut) + "," +
             shortest(p.along) + "," + shortest(p.depth) + "," + shortest(p.normal.x) + "," +
             shortest(p.normal.y) + "," + shortest(p.normal.z) + ";";
  for (const RegionMaterial& m : b.materials)
    bytes += m.name + "," + (m.young_modulus ? shortest(*m.young_modulus) : "") + "," +
             (m.poisson_ratio ? shortest(*m.poisson_ratio) : "") + ";";
  if (!b.materials.empty()) add(bytes, b.region);
  return sha256(bytes).substr(0, 16);
}

void write_body(const std::string& path, Body& b) {
  b.hash = hash_of(b);
  OutputFile out(path);
  h5::File file = h5::File::create(out.path());
  FileFormat format = body_format;
  if (!b.materials.empty()) format.version = body_format.further[0];
  write_format(file, format);
  file.write_text("/", "units", "mm");
  file.write_text("/", "body", b.hash);
  file.write_text("/", "producer", producer());
  write_vtk_mesh(file, b);
  file.write<double>("/VTKHDF/PointData/canonical", as_numbers(b.canonical), {b.canonical.size(), 3});
  const std::span<const double> frames(b.frames.empty() ? nullptr : &b.frames.front()[0].x,
                                       9 * b.frames.size());
  file.write<double>("/VTKHDF/PointData/frame", frames, {b.frames.size(), 9});
  write_list(file, "/VTKHDF/PointData/skin_above", b.skin_above);
  file.write<double>("/skin/tension", as_numbers(b.tension), {b.tension.size(), 3});
  write_table(file, "/foundation/triangles", b.bottom);
  std::vector<std::uint8_t> support;
  for (const Support s : b.support) support.push_back(static_cast<std::uint8_t>(s));
  write_list(file, "/foundation/support", support);
  write_table(file, "/foundation/quads", b.sides);
  if (!b.materials.empty()) write_regions(file, b);
  write_cuts(file, b);
  file.close();
  out.commit();
}

}  // namespace cleft
