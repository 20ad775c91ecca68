#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "base/error.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

namespace {

const std::string displacements = point_data_group + "/displacement";

std::vector<Vec3> as_vectors(const std::vector<double>& numbers) {
  std::vector<Vec3> vectors(numbers.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i)
    vectors[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  return vectors;
}

template <std::size_t K>
std::vector<std::array<std::int32_t, K>> read_table(const h5::File& file, const std::string& name) {
  if (!file.has(name)) return {};
  const auto numbers = file.read<std::int32_t>(name, {0, K});
  std::vector<std::array<std::int32_t, K>> rows(numbers.size() / K);
  for (std::size_t i = 0; i < numbers.size(); ++i) rows[i / K][i % K] = numbers[i];
  return rows;
}

/// The checks that make the rest of the program safe: sizes agree and indices are in range.
class SnapshotCheck {
 public:
  SnapshotCheck(const std::string& path, const Snapshot& snapshot) : path_(path), s_(snapshot) {}

  void run() const {
    require(!s_.points.empty(), "holds no points");
    require(s_.frames() > 0, "holds no frames");
    require(std::all_of(s_.points.begin(), s_.points.end(),
                        [](const Vec3& p) { return std::isfinite(squared_norm(p)); }),
            "a point is not finite");
    check_cells();
    check_table("/foundation/triangles", s_.foundation_triangles);
    check_table("/foundation/quads", s_.foundation_quads);
    check_table("/cut/pairs", s_.pairs);
    check_pairs();
    check_cut();
    if (s_.source) check_source(*s_.source);
    for (std::size_t p = 0; p < s_.pieces.size(); ++p) check_piece(piece_group(p), s_.pieces[p]);
  }

 private:
  void require(bool good, const std::string& what) const {
    if (!good) throw FileError(path_, what);
  }

  void check_cells() const {
    const auto& offsets = s_.cell_offsets;
    require(offsets.size() == s_.cell_types.size() + 1 && offsets.front() == 0 &&
                std::is_sorted(offsets.begin(), offsets.end()) &&
                offsets.back() == static_cast<std::int64_t>(s_.connectivity.size()),
            "/VTKHDF/Offsets does not agree with Types and Connectivity");
    const auto points = static_cast<std::int64_t>(s_.points.size());
    for (std::size_t c = 0; c < s_.cell_types.size(); ++c) {
      const std::int64_t corners = offsets[c + 1] - offsets[c];
      const bool fits = s_.cell_types[c] == Snapshot::triangle ? corners == 3
                        : s_.cell_types[c] == Snapshot::wedge  ? corners == 6
                                                               : corners > 0;
      require(fits, "cell " + std::to_string(c) + " of /VTKHDF/Types " + std::to_string(s_.cell_types[c]) +
                        " has " + std::to_string(corners) + " corners");
    }
    require(std::all_of(s_.connectivity.begin(), s_.connectivity.end(),
                        [=](std::int64_t i) { return 0 <= i && i < points; }),
            "/VTKHDF/Connectivity names a point that does not exist");
  }

  template <std::size_t K>
  void check_table(const std::string& name, const std::vector<std::array<std::int32_t, K>>& rows) const {
    const auto points = static_cast<std::int64_t>(s_.points.size());
    for (const auto& row : rows)
      require(std::all_of(row.begin(), row.end(), [=](std::int32_t i) { return 0 <= i && i < points; }),
              name + " names a point that does not exist");
  }

  /// A pair of nodes that earlier pairs join already, or of one node, would close nothing, and leave some
  /// other node without its side.
  void check_pairs() const {
    std::vector<std::int32_t> joined(s_.points.size());  // toward the representative of all joined nodes
    std::iota(joined.begin(), joined.end(), 0);
    const auto find = [&](std::int32_t node) {
      const auto next = [&](std::int32_t n) -> std::int32_t& { return joined[n]; };
      while (next(node) != node) node = next(node) = next(next(node));
      return node;
    };
    for (std::size_t p = 0; p < s_.pairs.size(); ++p) {
      const auto [left, right] = s_.pairs[p];
      const std::int32_t a = find(left), b = find(right);
      require(a != b, "/cut/pairs: row " + std::to_string(p) + ", nodes " + std::to_string(left) + " and " +
                          std::to_string(right) +
                          (left == right ? ": a node is no pair" : ": earlier rows join them already") +
                          "; leave the row out");
      joined[b] = a;
    }
  }

  void check_cut() const {
    const auto increasing = [](const auto& list) {
      return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
    };
    require(std::all_of(s_.times.begin(), s_.times.end(), [](double t) { return std::isfinite(t); }) &&
                increasing(s_.times),
            "/VTKHDF/Steps/Values do not increase");
    require(s_.released.size() == s_.frames() && s_.position.size() == s_.frames(),
            "/cut/released and position must have a value a frame");
    require(std::all_of(s_.position.begin(), s_.position.end(), [](double u) { return std::isfinite(u); }),
            "/cut/position is not finite");
    const auto extends = [this](double extent) {  // imported data may have no cut, or one along a line
      return std::isfinite(extent) && (s_.source ? extent >= 0 : extent > 0);
    };
    require(std::isfinite(s_.cut_start) && extends(s_.cut_length) && extends(s_.cut_depth),
            s_.source ? "/cut: length and depth must not be negative"
                      : "/cut: length and depth must be positive");
    require(s_.released.front() == 0, "/cut/released: frame 0 must be closed");
    require(std::is_sorted(s_.released.begin(), s_.released.end()) &&
                s_.released.back() <= static_cast<std::int64_t>(s_.pairs.size()),
            "/cut/released must not decrease, nor exceed the number of pairs");
  }

  void check_source(const SnapshotSource& source) const {
    check_axes("/import", source.origin, source.axes);
    require(std::isfinite(source.time_start), "/import: origin or time_start is not finite");
  }

  void check_axes(const std::string& where, const Vec3& origin, const AxesInSpace& axes) const {
    const auto& [u, v, w] = axes;
    double error = norm(cross(u, v) - w);  // 0 for unit vectors that are right-handed, with the next three
    for (const double product : {dot(u, v), squared_norm(u) - 1, squared_norm(v) - 1})
      error = std::max(error, std::abs(product));
    require(error < 1e-9, where + ": axes are not a right-handed frame of unit vectors");
    require(std::isfinite(squared_norm(origin)), where + ": origin or time_start is not finite");
  }

  /// What its reader needs to take it out; the snapshot of it is checked as others are.
  void check_piece(const std::string& where, const SnapshotPiece& piece) const {
    require(s_.source.has_value(), where + " is a piece of no imported data");
    check_axes(where, piece.origin, piece.axes);
    require(!piece.nodes.empty() && piece.places.size() == piece.nodes.size(),
            where + " must have a place a node");
    const auto points = static_cast<std::int64_t>(s_.points.size());
    require(piece.counting > 0 && static_cast<std::size_t>(piece.counting) <= piece.nodes.size(),
            where + ": attribute counting is no number of its nodes");
    std::vector<std::int32_t> sorted = piece.nodes;
    std::sort(sorted.begin(), sorted.end());
    require(sorted.front() >= 0 && sorted.back() < points &&
                std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end(),
            where + "/nodes are not different points of the snapshot");
    require(std::all_of(piece.places.begin(), piece.places.end(),
                        [](const Vec3& p) { return std::isfinite(squared_norm(p)); }),
            where + ": a place is not finite");
  }

  const std::string& path_;
  const Snapshot& s_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::optional<SnapshotSource> read_source(const h5::File& file) {
  if (!file.has("/import")) return {};
  const std::vector<Vec3> axes = as_vectors(file.read_numbers("/import", "axes", 9));
  return SnapshotSource{
      file.read_text("/import", "source"),
      as_vectors(file.read_numbers("/import", "origin", 3)).front(),
      {axes[0], axes[1], axes[2]},
      file.read_number("/import", "time_start"),
      file.read_text("/import", "break"),
      file.has("/import/break_map") ? file.read<double>("/import/break_map", {0}) : std::vector<double>(),
      file.has_attribute("/import", "fields") ? lines_of(file.read_text("/import", "fields"))
                                              : std::vector<std::string>(),
      {},
      file.has_attribute("/import", "rules") ? static_cast<int>(file.read_number("/import", "rules")) : 1};
}

SnapshotPiece read_piece(const h5::File& file, const std::string& group) {
  SnapshotPiece piece;
  piece.nodes = file.read<std::int32_t>(group + "/nodes", {0});
  piece.counting = static_cast<std::int32_t>(file.read_number(group, "counting"));
  piece.places = as_vectors(file.read<double>(group + "/places", {0, 3}));
  piece.pairs = read_table<2>(file, group + "/pairs");
  piece.released = file.read<std::int32_t>(group + "/released", {0});
  piece.position = file.read<double>(group + "/position", {0});
  piece.cut_start = file.read_number(group, "start");
  piece.cut_length = file.read_number(group, "length");
  piece.cut_depth = file.read_number(group, "depth");
  piece.origin = as_vectors(file.read_numbers(group, "origin", 3)).front();
  const std::vector<Vec3> axes = as_vectors(file.read_numbers(group, "axes", 9));
  piece.axes = {axes[0], axes[1], axes[2]};
  piece.break_plane = file.read_text(group, "break");
  if (file.has(group + "/break_map")) piece.break_map = file.read<double>(group + "/break_map", {0});
  piece.break_extent = file.read<double>(group + "/break_extent", {0});
  return piece;
}

Snapshot read_all_but_displacements(const h5::File& file) {
  require_format(file, snapshot_format);
  Snapshot s;
  s.points = as_vectors(file.read<double>("/VTKHDF/Points", {0, 3}));
  s.cell_types = file.read<std::uint8_t>("/VTKHDF/Types", {0});
  s.cell_offsets = file.read<std::int64_t>("/VTKHDF/Offsets", {0});
  s.connectivity = file.read<std::int64_t>("/VTKHDF/Connectivity", {0});
  s.times = file.read<double>("/VTKHDF/Steps/Values", {0});
  s.foundation_triangles = read_table<3>(file, "/foundation/triangles");
  s.foundation_quads = read_table<4>(file, "/foundation/quads");
  s.pairs = read_table<2>(file, "/cut/pairs");
  s.released = file.read<std::int32_t>("/cut/released", {0});
  s.position = file.read<double>("/cut/position", {0});
  s.cut_start = file.read_number("/cut", "start");
  s.cut_length = file.read_number("/cut", "length");
  s.cut_depth = file.read_number("/cut", "depth");
  s.smallest_gap = file.read<double>("/frames/smallest_gap", {s.frames()});
  s.source = read_source(file);
  if (!s.source) {
    s.residual_equilibrium = file.read<double>("/frames/residual_equilibrium", {s.frames()});
    s.residual_closure = file.read<double>("/frames/residual_closure", {s.frames()});
  }
  s.case_hash = file.read_text("/", "case");
  if (file.has_attribute("/", "body")) s.body = file.read_text("/", "body");
  s.coordinates = file.has_attribute("/", "coordinates");
  if (!s.body.empty() || file.has("/skin/tension"))
    s.tension = as_vectors(file.read<double>("/skin/tension", {0, 3}));
  if (!s.body.empty() || file.has("/foundation/support"))
    s.support = file.read<std::uint8_t>("/foundation/support", {s.foundation_triangles.size()});
  if (file.has("/regions/of_wedge")) {
    s.region = file.read<std::uint8_t>("/regions/of_wedge", {0});
    const auto moduli = file.read<double>("/regions/moduli", {0, 2});
    for (std::size_t r = 0; r + 1 < moduli.size(); r += 2)
      s.region_moduli.push_back({moduli[r], moduli[r + 1]});
    for (const std::uint8_t region : s.region)
      if (region >= s.region_moduli.size())
        throw FileError(file.path(),
                        "/regions/of_wedge: there are no moduli of region " + std::to_string(region));
  }
  for (const std::string& name : file.attribute_names("/parameters")) {
    try {
      s.parameters.set(name, file.read_number("/parameters", name));
    } catch (const FileError&) {
      s.parameters.set(name, file.read_text("/parameters", name));
    }
  }
  while (file.has(piece_group(s.pieces.size())))
    s.pieces.push_back(read_piece(file, piece_group(s.pieces.size())));
  const h5::Shape shape = file.shape(displacements);
  if (shape != h5::Shape{s.frames() * s.points.size(), 3})
    throw FileError(file.path(), displacements + " must have a row a frame and point");
  SnapshotCheck(file.path(), s).run();
  return s;
}

}  // namespace

std::vector<std::array<int, 3>> Snapshot::skin() const {
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t c = 0; c < cell_types.size(); ++c)
    if (cell_types[c] == triangle) {
      const auto* corner = &connectivity[cell_offsets[c]];
      triangles.push_back(
          {static_cast<int>(corner[0]), static_cast<int>(corner[1]), static_cast<int>(corner[2])});
    }
  return triangles;
}

std::vector<Vec3> Snapshot::points_in_source() const {
  std::vector<Vec3> list = points;
  if (!source) return list;
  const auto& [u, v, w] = source->axes;
  for (Vec3& p : list) p = source->origin + p.x * u + p.y * v + p.z * w;
  return list;
}

SnapshotReader::SnapshotReader(const std::string& path) : SnapshotReader(h5::File::open(path)) {}

SnapshotReader::SnapshotReader(h5::File file)
    : snapshot_(read_all_but_displacements(file)), values_(std::move(file), snapshot_.points.size()) {}

SnapshotReader::SnapshotReader(const std::string& path, std::size_t number) : SnapshotReader(path) {
  Snapshot whole = std::move(snapshot_);
  CLEFT_CHECK(number, <, whole.pieces.size());
  SnapshotPiece piece = std::move(whole.pieces[number]);
  const std::vector<std::int32_t> nodes = std::move(piece.nodes);
  const std::string file_name = whole.source->file;
  Snapshot& s = snapshot_ = Snapshot();
  std::vector<std::int64_t> local(whole.points.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) local[nodes[i]] = static_cast<std::int64_t>(i);
  s.cell_offsets = {0};
  for (std::size_t c = 0; c < whole.cell_types.size(); ++c) {
    const auto first = whole.connectivity.begin() + whole.cell_offsets[c],
               last = whole.connectivity.begin() + whole.cell_offsets[c + 1];
    if (std::any_of(first, last, [&](std::int64_t n) { return local[n] < 0; })) continue;
    std::transform(first, last, std::back_inserter(s.connectivity), [&](std::int64_t n) { return local[n]; });
    s.cell_types.push_back(whole.cell_types[c]);
    s.cell_offsets.push_back(static_cast<std::int64_t>(s.connectivity.size()));
  }
  s.counting = static_cast<std::size_t>(piece.counting);
  s.coordinates = !piece.break_map.empty();
  if (s.coordinates) {
    for (const Vec3& p : piece.places) canonical_.insert(canonical_.end(), {p.x, p.y, p.z});
    const std::vector<Vec3> in_source = whole.points_in_source();
    for (const std::int32_t n : nodes) s.points.push_back(turned(in_source[n] - piece.origin, piece.axes));
  } else {
    s.points = std::move(piece.places);
  }
  s.pairs = std::move(piece.pairs), s.released = std::move(piece.released);
  s.position = std::move(piece.position);
  s.cut_start = piece.cut_start, s.cut_length = piece.cut_length, s.cut_depth = piece.cut_depth;
  s.times = std::move(whole.times), s.smallest_gap = std::move(whole.smallest_gap);
  s.parameters = std::move(whole.parameters), s.case_hash = std::move(whole.case_hash);
  s.source = SnapshotSource{file_name,
                            piece.origin,
                            piece.axes,
                            whole.source->time_start,
                            std::move(piece.break_plane),
                            std::move(piece.break_map),
                            std::move(whole.source->fields),
                            std::move(piece.break_extent),
                            whole.source->rules};
  values_.take({nodes, axes_between(whole.source->axes, piece.axes)});
  SnapshotCheck(values_.file().path(), s).run();
}

std::vector<Vec3> SnapshotReader::displacement(std::size_t frame) const {
  return displacement(frame, 0, snapshot_.points.size());
}

std::vector<Vec3> SnapshotReader::displacement(std::size_t frame, std::size_t first,
                                               std::size_t count) const {
  CLEFT_CHECK(frame, <, snapshot_.frames());
  return values_.displacement(frame, first, count);
}

std::vector<SnapshotArray> SnapshotReader::point_arrays() const {
  const h5::File& file = values_.file();
  const hsize_t points = values_.points(), frames = snapshot_.frames();
  std::vector<SnapshotArray> arrays;
  for (const std::string& name : file.members(point_data_group)) {
    if (name == "displacement") continue;
    const std::string dataset = std::string(point_data_group).append("/").append(name);
    const h5::Shape shape = file.shape(dataset);
    constexpr hsize_t most_components = 1000;
    const bool table =
        shape.size() == 1 || (shape.size() == 2 && shape[1] > 0 && shape[1] <= most_components);
    if (!table || (shape[0] != points && shape[0] != frames * points))
      throw FileError(file.path(), dataset + " must have a row a point (" + std::to_string(points) +
                                       "), or a row a frame and point (" + std::to_string(frames * points) +
                                       ")");
    arrays.push_back({name, shape.size() == 1 ? 1 : shape[1], shape[0] != points});
  }
  return arrays;
}

std::vector<Vec3> SnapshotReader::coordinates() const {
  if (!snapshot_.has_own_coordinates()) return snapshot_.points;
  const std::vector<double> numbers = point_array(canonical_array, 0);
  std::vector<Vec3> places(snapshot_.points.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) places[i / 3][static_cast<int>(i % 3)] = numbers[i];
  return places;
}

std::vector<double> SnapshotReader::point_array(const SnapshotArray& array, std::size_t frame) const {
  return point_array(array, frame, 0, snapshot_.points.size());
}

std::vector<double> SnapshotReader::point_array(const SnapshotArray& array, std::size_t frame,
                                                std::size_t first, std::size_t count) const {
  CLEFT_CHECK(frame, <, snapshot_.frames());
  if (!canonical_.empty() && array.name == canonical_array.name) {
    const auto begin = canonical_.begin() + static_cast<std::ptrdiff_t>(3 * first);
    return {begin, begin + static_cast<std::ptrdiff_t>(3 * count)};
  }
  if (!canonical_.empty() && array.name == frame_array.name) {
    std::vector<double> numbers;
    for (std::size_t n = 0; n < count; ++n) numbers.insert(numbers.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
    return numbers;
  }
  return values_.array(array, frame, first, count);
}

void check_snapshot(const std::string& path) {
  h5::File::open(path).read_everything();
  const SnapshotReader reader(path);
  for (std::size_t j = 0; j < reader.snapshot().frames(); ++j) reader.displacement(j);
  reader.point_arrays();
  for (std::size_t p = 0; p < reader.snapshot().pieces.size(); ++p) SnapshotReader(path, p);
}

}  // namespace cleft
