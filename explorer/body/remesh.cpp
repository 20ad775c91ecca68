#include "explorer/body/remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace cleft {

namespace {

constexpr int smoothing_rounds = 10;
constexpr double longest = 4. / 3, shortest_part = 4. / 5;  // of the wanted length
constexpr double straight_rim = 0.9;     // cosine of the turn of the outline where a point may go
constexpr double least_agreement = 0.5;  // of a triangle's normal before and after a change: cosine
constexpr double least_shape = 0.15;     // 4 sqrt(3) area / sum of squared sides; 1: equilateral
constexpr double most_bulge = 0.25;      // of an edge: how far its middle is from the surface

using Edge = std::pair<int, int>;
Edge key(int a, int b) { return std::minmax(a, b); }

class Remesher {
 public:
  Remesher(LinedSurface surface, const std::vector<bool>& stations, const SurfaceIndex& shape,
           const std::function<double(const Vec3&)>& size)
      : s_(std::move(surface)), p_(s_.mesh.points), t_(s_.mesh.triangles), shape_(shape), wanted_at_(size) {
    station_ = stations;
    on_line_.assign(p_.size(), false);
    around_.resize(p_.size());
    for (int t = 0; t < static_cast<int>(t_.size()); ++t)
      for (const int v : t_[t]) around_[v].push_back(t);
    alive_.assign(t_.size(), true);
    for (const Vec3& p : p_) wanted_.push_back(size(p));
    for (const auto& lines : s_.cuts)
      for (const CutLine& line : lines) {
        lines_.insert(key(line.from, line.to));
        on_line_[line.from] = on_line_[line.to] = true;
      }
  }

  LinedSurface run() {
    for (int round = 0; round < smoothing_rounds; ++round) {
      collapse_short();
      split_long();
      collapse_short();
      flip_all();
      relax();
    }
    flip_all();
    return result();
  }

 private:
  // ---- what is where

  std::vector<int> triangles_of(int a, int b) const {
    std::vector<int> both;
    for (const int t : around_[a])
      if (std::find(t_[t].begin(), t_[t].end(), b) != t_[t].end()) both.push_back(t);
    return both;
  }
  std::vector<int> neighbors(int v) const {
    std::vector<int> list;
    for (const int t : around_[v])
      for (const int w : t_[t])
        if (w != v) list.push_back(w);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }
  int opposite(int t, int a, int b) const {
    for (const int v : t_[t])
      if (v != a && v != b) return v;
    return -1;
  }
  bool on_rim(int v) const {
    for (const int w : neighbors(v))
      if (triangles_of(v, w).size() == 1) return true;
    return false;
  }
  /// Whether the rim goes straight on at one of its points.
  bool is_straight(int v) const {
    std::vector<Vec3> ways;
    for (const int w : neighbors(v))
      if (triangles_of(v, w).size() == 1) ways.push_back(normalized(p_[w] - p_[v]));
    return ways.size() == 2 && dot(ways[0], ways[1]) < -straight_rim;
  }
  std::vector<Edge> edges() const {
    std::set<Edge> all;
    for (std::size_t t = 0; t < t_.size(); ++t)
      for (int i = 0; alive_[t] && i < 3; ++i) all.insert(key(t_[t][i], t_[t][(i + 1) % 3]));
    return {all.begin(), all.end()};
  }
  Vec3 twice_area(const std::array<int, 3>& t) const {
    return cross(p_[t[1]] - p_[t[0]], p_[t[2]] - p_[t[0]]);
  }
  double shape_of(const std::array<int, 3>& t) const {
    const double sides = squared_norm(p_[t[1]] - p_[t[0]]) + squared_norm(p_[t[2]] - p_[t[1]]) +
                         squared_norm(p_[t[0]] - p_[t[2]]);
    return 2 * std::sqrt(3.) * norm(twice_area(t)) / sides;
  }
  double length(int a, int b) const { return norm(p_[a] - p_[b]); }
  double wanted(int a, int b) const { return std::min(wanted_[a], wanted_[b]); }
  static bool agree(const Vec3& before, const Vec3& after) {
    return dot(before, after) > least_agreement * norm(before) * norm(after);
  }

  int add_point(const Vec3& p, bool outline) {
    p_.push_back(p);
    s_.outline.push_back(outline);
    station_.push_back(false), on_line_.push_back(false);
    around_.emplace_back();
    wanted_.push_back(wanted_at_(p));
    return static_cast<int>(p_.size()) - 1;
  }
  void replace(int t, const std::array<int, 3>& corners) {
    for (const int v : t_[t]) std::erase(around_[v], t);
    t_[t] = corners;
    for (const int v : corners) around_[v].push_back(t);
  }
  void add_triangle(const std::array<int, 3>& corners) {
    t_.push_back(corners), alive_.push_back(true);
    for (const int v : corners) around_[v].push_back(static_cast<int>(t_.size()) - 1);
  }
  void remove(int t) {
    alive_[t] = false;
    for (const int v : t_[t]) std::erase(around_[v], t);
  }

  // ---- the four operations

  void split_long() {
    for (int pass = 0; pass < 8; ++pass) {
      bool changed = false;
      for (const auto& [a, b] : edges()) {
        if (length(a, b) <= longest * wanted(a, b) || lines_.contains(key(a, b))) continue;
        const std::vector<int> both = triangles_of(a, b);
        if (both.empty() || both.size() > 2) continue;
        const int m = add_point(middle(a, b), both.size() == 1 && s_.outline[a] && s_.outline[b]);
        for (const int t : both) {
          auto first = t_[t], second = t_[t];
          std::replace(first.begin(), first.end(), b, m);
          std::replace(second.begin(), second.end(), a, m);
          replace(t, first);
          add_triangle(second);
        }
        changed = true;
      }
      if (!changed) return;
    }
  }

  void collapse_short() {
    for (const auto& [a, b] : edges()) {
      if (around_[a].empty() || around_[b].empty() || triangles_of(a, b).empty()) continue;
      const bool of_line = lines_.contains(key(a, b));
      const double most = of_line ? 1e-9 + length(a, b) : shortest_part * wanted(a, b);
      if (length(a, b) >= most) continue;
      if (!try_collapse(a, b, of_line)) try_collapse(b, a, of_line);
    }
  }

  /// Moves `gone` onto `kept`.
  bool try_collapse(int gone, int kept, bool of_line) {
    if (station_[gone] || (on_line_[gone] && !of_line)) return false;
    const std::vector<int> both = triangles_of(gone, kept);
    const bool gone_on_rim = on_rim(gone);
    if (gone_on_rim && (both.size() != 1 || (s_.outline[gone] && !(s_.outline[kept] && is_straight(gone)))))
      return false;
    const std::vector<int> p = neighbors(gone), q = neighbors(kept);
    std::vector<int> common;
    std::set_intersection(p.begin(), p.end(), q.begin(), q.end(), std::back_inserter(common));
    if (common.size() != both.size() || both.size() > 2) return false;
    for (const int v : p)
      if (v != kept && !of_line && length(v, kept) > longest * std::max(wanted(v, kept), length(v, gone)))
        return false;
    for (const int t : around_[gone]) {
      if (std::find(both.begin(), both.end(), t) != both.end()) continue;
      std::array<int, 3> moved = t_[t];
      std::replace(moved.begin(), moved.end(), gone, kept);
      const double before = shape_of(t_[t]), after = shape_of(moved);
      // Next to a crossing each of two short lines keeps the other from going: one must make a sliver.
      if (!of_line && after < least_shape && after < before) return false;
      if (before > 1e-3 && !agree(twice_area(t_[t]), twice_area(moved))) return false;
    }
    for (const int v : p)
      if (v != kept && lines_.erase(key(gone, v)) > 0) lines_.insert(key(kept, v));
    lines_.erase(key(gone, kept));
    for (const int t : both) remove(t);
    for (const int t : std::vector<int>(around_[gone])) {
      std::array<int, 3> moved = t_[t];
      std::replace(moved.begin(), moved.end(), gone, kept);
      replace(t, moved);
    }
    into_[gone] = kept;
    return true;
  }

  double angle_at(int v, int a, int b) const {
    const Vec3 x = p_[a] - p_[v], y = p_[b] - p_[v];
    return std::atan2(norm(cross(x, y)), dot(x, y));
  }

  void flip_all() {
    for (int pass = 0; pass < 4; ++pass) {
      bool changed = false;
      for (const auto& [a, b] : edges()) changed = flip(a, b) || changed;
      if (!changed) return;
    }
  }

  bool flip(int a, int b) {
    if (lines_.contains(key(a, b))) return false;
    const std::vector<int> both = triangles_of(a, b);
    if (both.size() != 2) return false;
    const int c = opposite(both[0], a, b), d = opposite(both[1], a, b);
    if (c == d || !triangles_of(c, d).empty()) return false;
    constexpr double straight = 3.141592653589793;
    if (angle_at(c, a, b) + angle_at(d, a, b) < straight + 1e-6) return false;
    // Triangle both[0] has the directed edge from -> to.
    const auto& first = t_[both[0]];
    const int i = static_cast<int>(std::find(first.begin(), first.end(), a) - first.begin());
    const bool forward = first[(i + 1) % 3] == b;
    const int from = forward ? a : b, to = forward ? b : a;
    const std::array<int, 3> left = {c, from, d}, right = {d, to, c};
    const Vec3 mean = twice_area(t_[both[0]]) + twice_area(t_[both[1]]);
    if (!agree(mean, twice_area(left)) || !agree(mean, twice_area(right))) return false;
    replace(both[0], left);
    replace(both[1], right);
    return true;
  }

  void relax() {
    for (int v = 0; v < static_cast<int>(p_.size()); ++v) {
      if (around_[v].empty() || on_line_[v] || on_rim(v)) continue;
      Vec3 sum, normal;
      double weights = 0, worst = 1;
      for (const int t : around_[v]) {
        const Vec3 n = twice_area(t_[t]);
        const double local = (wanted_[t_[t][0]] + wanted_[t_[t][1]] + wanted_[t_[t][2]]) / 3;
        const double weight = norm(n) / (local * local);
        sum += weight / 3 * (p_[t_[t][0]] + p_[t_[t][1]] + p_[t_[t][2]]);
        normal += n, weights += weight;
        worst = std::min(worst, shape_of(t_[t]));
      }
      if (!(weights > 0) || !(squared_norm(normal) > 0)) continue;
      normal = normalized(normal);
      Vec3 step = 1 / weights * sum - p_[v];
      step = step - dot(step, normal) * normal;
      const Vec3 before = p_[v];
      std::vector<Vec3> areas;
      for (const int t : around_[v]) areas.push_back(twice_area(t_[t]));
      p_[v] = on_shape(before + step);
      bool good = true;
      for (std::size_t i = 0; i < areas.size() && good; ++i) {
        const auto& t = t_[around_[v][i]];
        good =
            shape_of(t) >= std::min(worst, least_shape) && (worst < 1e-3 || agree(areas[i], twice_area(t)));
      }
      if (!good)
        p_[v] = before;
      else
        wanted_[v] = wanted_at_(p_[v]);
    }
  }

  Vec3 on_shape(const Vec3& x) const { return shape_.nearest(x).position; }
  /// Of an edge, on the surface; but not where another part of the surface is nearer, through which it
  /// passes: both halves are shorter than the edge, so that splitting ends.
  Vec3 middle(int a, int b) const {
    const Vec3 straight = 0.5 * (p_[a] + p_[b]), on = on_shape(straight);
    return norm(on - straight) < most_bulge * length(a, b) ? on : straight;
  }

  // ---- what is left

  int survivor(int v) const {
    for (auto next = into_.find(v); next != into_.end(); next = into_.find(v)) v = next->second;
    return v;
  }

  LinedSurface result() const {
    LinedSurface out;
    std::vector<int> number(p_.size(), -1);
    for (std::size_t t = 0; t < t_.size(); ++t) {
      if (!alive_[t]) continue;
      std::array<int, 3> corners;
      for (int i = 0; i < 3; ++i) {
        int& n = number[t_[t][i]];
        if (n < 0) {
          n = static_cast<int>(out.mesh.points.size());
          out.mesh.points.push_back(p_[t_[t][i]]), out.outline.push_back(s_.outline[t_[t][i]]);
        }
        corners[i] = n;
      }
      out.mesh.triangles.push_back(corners);
    }
    for (const auto& lines : s_.cuts) {
      out.cuts.emplace_back();
      std::map<int, double> begins, ends;  // by point: the arc length with which its lines begin and end
      for (const CutLine& line : lines) begins[line.from] = line.s_from, ends[line.to] = line.s_to;
      for (const CutLine& line : lines) {
        const int from = survivor(line.from), to = survivor(line.to);
        if (from == to) continue;
        out.cuts.back().push_back({number[from], number[to], begins.at(from), ends.at(to)});
      }
    }
    return out;
  }

  LinedSurface s_;
  std::vector<Vec3>& p_;
  std::vector<std::array<int, 3>>& t_;
  const SurfaceIndex& shape_;
  const std::function<double(const Vec3&)>& wanted_at_;
  std::vector<bool> station_, on_line_, alive_;
  std::vector<std::vector<int>> around_;  // triangles, by point
  std::vector<double> wanted_;
  std::set<Edge> lines_;
  std::map<int, int> into_;  // by collapsed point: where it went
};

}  // namespace

LinedSurface remeshed(LinedSurface surface, const std::vector<bool>& stations, const SurfaceIndex& shape,
                      const std::function<double(const Vec3&)>& size) {
  return Remesher(std::move(surface), stations, shape, size).run();
}

}  // namespace cleft
