#include "encoder/import/both_ends.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "encoder/field/parametrization.h"
#include "encoder/import/source_mesh.h"

namespace cleft {

namespace {

constexpr std::size_t most_bins = 24, fewest_in_arm = 2;
constexpr double most_within = 0.15,  // of the variance of frames: within bins, where the front is straight
    same_frame = 0.6,                 // frames: means of bins that count as equal
    least_growth = 1.5;               // frames, at either end

struct Opened {
  std::size_t group;
  double u, frame;  ///< along the way of the front; in which it opens first
};

/// The direction in which frames grow with the distance from the middle, whatever the shape of the break.
Vec3 way_of_fronts(const std::vector<Vec3>& places, const std::vector<double>& frames) {
  const auto count = static_cast<double>(places.size());
  const double mean = std::accumulate(frames.begin(), frames.end(), 0.) / count;
  Vec3 centre;
  for (const Vec3& p : places) centre += (1 / count) * p;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 x = places[i] - centre;
    const Eigen::Vector3d place(x.x, x.y, x.z);
    moments += (frames[i] - mean) * place * place.transpose();
  }
  const Eigen::Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(2);
  return {axis(0), axis(1), axis(2)};
}

/// Where the groups that open first are, if those at smaller and at larger u open later and later. `list` is
/// sorted by u.
std::optional<Interval> opened_first(const std::vector<Opened>& list, double rounding) {
  std::size_t columns = 1;
  for (std::size_t i = 1; i < list.size(); ++i) columns += list[i].u - list[i - 1].u > rounding ? 1 : 0;
  const double low = list.front().u, length = list.back().u - low;
  const std::size_t bins = std::min(columns, most_bins);
  if (bins < 3 || !(length > 0)) return {};
  std::map<std::size_t, std::vector<double>> frames;  // of bins that are not empty
  for (const Opened& one : list)
    frames[static_cast<std::size_t>(std::lround((one.u - low) / length * static_cast<double>(bins - 1)))]
        .push_back(one.frame);
  std::vector<double> means;
  double within = 0, all = 0, mean = 0;
  for (const Opened& one : list) mean += one.frame / static_cast<double>(list.size());
  for (const auto& [bin, some] : frames) {
    means.push_back(std::accumulate(some.begin(), some.end(), 0.) / static_cast<double>(some.size()));
    for (const double f : some)
      within += (f - means.back()) * (f - means.back()), all += (f - mean) * (f - mean);
  }
  if (within > most_within * all) return {};
  const auto first = std::min_element(means.begin(), means.end());
  if (means.front() - *first < least_growth || means.back() - *first < least_growth) return {};
  for (auto i = means.begin(); i + 1 != means.end(); ++i)
    if (i < first ? *i < *(i + 1) - same_frame : *(i + 1) < *i - same_frame) return {};
  double earliest = list.front().frame;
  for (const Opened& one : list) earliest = std::min(earliest, one.frame);
  Interval there{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Opened& one : list)
    if (one.frame == earliest) there = {std::min(there.front, one.u), std::max(there.back, one.u)};
  return there;
}

/// How far from `middle` the groups must be shared for no cell to have groups of one arm alone and of the
/// other.
double width_of_middle(const SourceMesh& mesh, const Groups& groups, const std::vector<Opened>& list,
                       double middle, double rounding) {
  std::vector<double> u(mesh.points.size(), std::numeric_limits<double>::quiet_NaN());
  for (const Opened& one : list)
    for (const std::int32_t node : groups[one.group]) u[node] = one.u;
  double width = rounding;
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    double before = 0, beyond = 0;
    for (auto i = mesh.cell_offsets[c]; i < mesh.cell_offsets[c + 1]; ++i) {
      const double at = u[mesh.connectivity[i]] - middle;
      if (at < 0) before = std::max(before, -at);
      if (at > 0) beyond = std::max(beyond, at);
    }
    width = std::max(width, std::min(before, beyond));
  }
  return width;
}

std::optional<std::array<BreakComponent, 2>> arms_of(const SourceMesh& mesh, const Groups& groups,
                                                     const std::vector<std::int32_t>& first_frame,
                                                     const BreakComponent& found) {
  if (!found.junctions.empty() || found.groups.size() < 3) return {};
  std::vector<Vec3> places;
  std::vector<double> frames;
  for (const std::size_t g : found.groups) {
    places.push_back(mesh.points[groups[g].front()]);
    frames.push_back(first_frame[g]);
  }
  const Vec3 way = way_of_fronts(places, frames);
  std::vector<Opened> list;
  for (std::size_t i = 0; i < places.size(); ++i)
    list.push_back({found.groups[i], dot(way, places[i]), frames[i]});
  std::sort(list.begin(), list.end(), [](const Opened& a, const Opened& b) { return a.u < b.u; });
  const double rounding = in_plane(mesh);
  const std::optional<Interval> first = opened_first(list, rounding);
  if (!first) return {};
  const double between = (first->front + first->back) / 2;
  const double middle = std::min_element(list.begin(), list.end(), [&](const Opened& a, const Opened& b) {
                          return std::abs(a.u - between) < std::abs(b.u - between);
                        })->u;
  const double width = width_of_middle(mesh, groups, list, middle, rounding);
  std::array<BreakComponent, 2> arms;
  for (const Opened& one : list) {
    const bool shared = std::abs(one.u - middle) <= width;
    for (BreakComponent& arm : arms)
      if (shared || (&arm == &arms[0]) == (one.u < middle)) {
        arm.groups.push_back(one.group);
        if (shared) arm.junctions.push_back(one.group);
      }
  }
  for (BreakComponent& arm : arms) {
    if (arm.groups.size() < arm.junctions.size() + fewest_in_arm) return {};
    std::sort(arm.groups.begin(), arm.groups.end());
    std::sort(arm.junctions.begin(), arm.junctions.end());
  }
  return arms;
}

}  // namespace

std::vector<BreakComponent> split_at_middle(const SourceMesh& mesh, const Groups& groups,
                                            const Partings& partings, std::vector<BreakComponent> breaks) {
  std::vector<std::size_t> group_of(mesh.points.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const std::int32_t node : groups[g]) group_of[node] = g;
  std::vector<std::int32_t> first_frame(groups.size(), std::numeric_limits<std::int32_t>::max());
  for (std::size_t p = 0; p < partings.pairs.size(); ++p) {
    std::int32_t& first = first_frame[group_of[partings.pairs[p][0]]];
    first = std::min(first, std::max(partings.first_frame[p], 1));  // frame 0 counts as closed
  }
  std::vector<BreakComponent> list;
  for (BreakComponent& found : breaks) {
    if (auto arms = arms_of(mesh, groups, first_frame, found))
      list.insert(list.end(), arms->begin(), arms->end());
    else
      list.push_back(std::move(found));
  }
  return list;
}

}  // namespace cleft
