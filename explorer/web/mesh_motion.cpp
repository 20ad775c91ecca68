#include "explorer/web/mesh_motion.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "encoder/field/coefficient_code.h"
#include "encoder/field/file/field_record.h"
#include "explorer/web/little_endian.h"

namespace cleft {

namespace {

constexpr double error_of_modes = 1e-3;  // over the largest displacement
constexpr double steps_in_error = 0.5;
constexpr double still = 1e-6;  // of the largest displacement: such points are at rest
constexpr double most_bytes = 2e9;

/// Displacements of the points that move, at equal steps of the length cut: a column for each case.
struct Samples {
  std::vector<int> active;
  int slices = 0;
  Eigen::MatrixXf columns;

  Eigen::Index points() const { return std::ssize(active); }
  Eigen::Index row(int component, int slice, Eigen::Index point = 0) const {
    return (static_cast<Eigen::Index>(component) * slices + slice) * points() + point;
  }
};

/// One for each mm.
int slices_of(const MeshMotion& motion) {
  return std::clamp(static_cast<int>(std::ceil(motion.duration)), 30, 120);
}

/// Those that any case moves when a quarter, a half, three quarters or all is cut.
std::vector<int> active_points(const MeshMotion& motion) {
  const std::vector<Vec3>& rest = motion.surface.points;
  std::vector<double> farthest(rest.size(), 0);
  std::vector<Vec3> points;
  for (int i = 0; i < motion.cases; ++i)
    for (const int quarter : {1, 2, 3, 4}) {
      motion.positions(i, motion.duration * quarter / 4, points);
      for (std::size_t p = 0; p < rest.size(); ++p)
        farthest[p] = std::max(farthest[p], norm(points[p] - rest[p]));
    }
  const double least = still * *std::max_element(farthest.begin(), farthest.end());
  std::vector<int> active;
  for (std::size_t p = 0; p < rest.size(); ++p)
    if (farthest[p] > least) active.push_back(static_cast<int>(p));
  return active;
}

Samples samples_of(const MeshMotion& motion, const std::function<void(int)>& report) {
  Samples samples{active_points(motion), slices_of(motion), {}};
  const double bytes = 4. * 3 * samples.slices * static_cast<double>(samples.points()) * motion.cases;
  if (bytes > most_bytes)
    throw InputError("a page of this mesh and " + std::to_string(motion.cases) + " cases would need " +
                     std::to_string(static_cast<int>(bytes / 1e9)) +
                     " GB of memory to make: give a coarser mesh, or a study of fewer cases");
  samples.columns.resize(3 * samples.slices * samples.points(), motion.cases);
  std::vector<Vec3> moved;
  for (int i = 0; i < motion.cases; ++i) {
    report(i);
    for (int slice = 0; slice < samples.slices; ++slice) {
      motion.positions(i, motion.duration * (slice + 1) / samples.slices, moved);
      for (Eigen::Index a = 0; a < samples.points(); ++a) {
        const auto p = static_cast<std::size_t>(samples.active[static_cast<std::size_t>(a)]);
        const Vec3 d = moved[p] - motion.surface.points[p];
        for (int c = 0; c < 3; ++c) samples.columns(samples.row(c, slice, a), i) = static_cast<float>(d[c]);
      }
    }
  }
  return samples;
}

/// The largest norm of the points in a column.
double largest_of(const Eigen::VectorXf& column) {
  const Eigen::Map<const Eigen::MatrixXf> components(column.data(), column.size() / 3, 3);
  return components.size() == 0
             ? 0
             : static_cast<double>(std::sqrt(components.rowwise().squaredNorm().maxCoeff()));
}

/// Axes of the explorer's camera: from the front of the cut.
std::array<Vec3, 3> axes_of(const WoundSurface& surface) {
  const Vec3 back = normalized(surface.outward);
  const Vec3 up = std::abs(back.y) < 0.9 ? Vec3{0, 1, 0} : surface.along;
  const Vec3 right = normalized(cross(up, back));
  return {right, cross(back, right), back};
}

/// Where on all paths the lips part at a triangle of a wall: of the nearest pair of lips.
double parts_at(const MeshMotion& motion, const std::array<int, 3>& triangle) {
  const std::vector<Vec3>& points = motion.surface.points;
  Vec3 middle{};
  for (const int p : triangle) middle += (1. / 3) * points[static_cast<std::size_t>(p)];
  double nearest = std::numeric_limits<double>::infinity(), place = 0;
  for (const MeshMotion::Cut& cut : motion.cuts)
    for (std::size_t k = 0; k < cut.left.size(); ++k)
      if (const double away = norm(points[static_cast<std::size_t>(cut.left[k])] - middle); away < nearest)
        nearest = away, place = cut.begin + cut.places[k];
  return place;
}

/// The body at rest, in the camera's axes: skin, then walls in the order in which they open.
void add_body(const MeshMotion& motion, const std::array<Vec3, 3>& axes, MeshMotionData& data, Json& json) {
  const WoundSurface& surface = motion.surface;
  std::vector<std::uint8_t> points, depths, triangles, places;
  for (const Vec3& p : surface.points)
    for (const Vec3& axis : axes) append(points, static_cast<float>(dot(axis, p - surface.middle)));
  for (const double depth : surface.depth_fraction) append(depths, static_cast<float>(depth));
  std::vector<std::pair<double, std::size_t>> walls;
  std::size_t skin = 0;
  const auto add = [&](std::size_t t) {
    for (const int p : surface.triangles[t]) append(triangles, static_cast<std::uint32_t>(p));
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.regions[t] == Region::skin)
      add(t), ++skin;
    else
      walls.emplace_back(parts_at(motion, surface.triangles[t]), t);
  std::sort(walls.begin(), walls.end());
  for (const auto& [place, t] : walls) add(t), append(places, static_cast<float>(place));
  json["points"] = surface.points.size(), json["skin"] = skin, json["walls"] = walls.size();
  data.pieces = {std::move(points), std::move(depths), std::move(triangles), std::move(places)};
}

void add_modes(const Samples& samples, MeshMotionData& data, Json& json) {
  const Eigen::Index cases = samples.columns.cols();
  const int points = static_cast<int>(samples.points());
  Eigen::VectorXd sizes(cases);
  for (Eigen::Index i = 0; i < cases; ++i) {
    data.largest.push_back(largest_of(samples.columns.col(i)));
    sizes[i] = data.largest.back() > 0 ? data.largest.back() : 1;
  }
  // Cases over their largest displacement, and their singular vectors.
  const Eigen::MatrixXd gram = sizes.cwiseInverse().asDiagonal() *
                               (samples.columns.transpose() * samples.columns).cast<double>() *
                               sizes.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  const Eigen::MatrixXd vectors = solver.eigenvectors().rowwise().reverse();
  const Eigen::VectorXd values = solver.eigenvalues().reverse().cwiseMax(0.);
  Eigen::VectorXd left = gram.diagonal();
  const Eigen::VectorXd allowed = error_of_modes * error_of_modes * left;
  Eigen::Index kept = 0;
  while (kept < cases && ((left - allowed).array() > 0).any())
    left -= values[kept] * vectors.col(kept).cwiseAbs2(), ++kept;

  const double quantum =
      steps_in_error * error_of_modes * std::sqrt(12. / static_cast<double>(std::max<Eigen::Index>(1, kept)));
  CoefficientGrid grid{points, 1, 1, {}, points};
  grid.unknown.resize(static_cast<std::size_t>(points));
  std::iota(grid.unknown.begin(), grid.unknown.end(), 0);
  std::vector<std::uint8_t> shares;
  Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(samples.columns.rows(), cases);
  for (Eigen::Index k = 0; k < kept; ++k) {
    // A mode is as large as it is in the case that has most of it.
    const double size = vectors.col(k).cwiseAbs().maxCoeff();
    const Eigen::VectorXf mode = samples.columns * (size * vectors.col(k).cwiseQuotient(sizes)).cast<float>();
    std::vector<std::int64_t> integers;
    for (const float value : mode) integers.push_back(std::llround(static_cast<double>(value) / quantum));
    data.pieces.push_back(encode_coefficients(grid, samples.slices, integers));
    const Eigen::VectorXd share = vectors.col(k).cwiseProduct(sizes) / size;
    for (const double one : share) append(shares, static_cast<float>(one));
    const Eigen::Map<const Eigen::Matrix<std::int64_t, Eigen::Dynamic, 1>> coded(integers.data(),
                                                                                 std::ssize(integers));
    sums += (quantum * coded.cast<double>()).cast<float>() * share.cast<float>().transpose();
  }
  for (Eigen::Index i = 0; i < cases; ++i)
    data.error = std::max(data.error, largest_of(samples.columns.col(i) - sums.col(i)) / sizes[i]);
  data.modes = static_cast<int>(kept);
  data.pieces.insert(data.pieces.end() - kept, shares);
  json["quantum"] = quantum, json["modes"] = kept, json["error"] = data.error;
}

double widest(const MeshMotion& motion, int i) {
  std::vector<Vec3> points;
  motion.positions(i, motion.duration, points);
  double widest = 0;
  for (const MeshMotion::Cut& cut : motion.cuts)
    for (std::size_t k = 0; k < cut.left.size(); ++k)
      widest = std::max(widest, norm(points[static_cast<std::size_t>(cut.right[k])] -
                                     points[static_cast<std::size_t>(cut.left[k])]));
  return widest;
}

}  // namespace

MeshMotionData mesh_motion_data(const MeshMotion& motion, const std::function<void(int)>& report) {
  MeshMotionData data;
  Samples samples = samples_of(motion, report);
  Json json{{"duration", motion.duration}, {"slices", samples.slices}, {"note", motion.note}};
  const std::array<Vec3, 3> axes = axes_of(motion.surface);
  add_body(motion, axes, data, json);
  std::vector<std::uint8_t> active;
  for (const int p : samples.active) append(active, static_cast<std::uint32_t>(p));
  data.pieces.push_back(std::move(active));
  json["active"] = samples.active.size();
  for (int slice = 0; slice < samples.slices; ++slice) {  // into the camera's axes
    const auto block = [&](int c) {
      return samples.columns.middleRows(samples.row(c, slice), samples.points());
    };
    const Eigen::MatrixXf x = block(0), y = block(1), z = block(2);
    for (int c = 0; c < 3; ++c)
      block(c) = static_cast<float>(axes[c].x) * x + static_cast<float>(axes[c].y) * y +
                 static_cast<float>(axes[c].z) * z;
  }
  add_modes(samples, data, json);
  for (int i = 0; i < motion.cases; ++i) data.gapes.push_back(widest(motion, i));
  Json cuts = Json::array();
  for (const MeshMotion::Cut& cut : motion.cuts)
    cuts.push_back({{"begin", cut.begin}, {"left", cut.left}, {"right", cut.right}, {"places", cut.places}});
  Json bytes = Json::array();
  for (const auto& piece : data.pieces) bytes.push_back(piece.size());
  json["cuts"] = cuts, json["bytes"] = bytes;
  data.json = json.dump();
  return data;
}

}  // namespace cleft
