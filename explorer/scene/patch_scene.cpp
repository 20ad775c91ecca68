#include "explorer/scene/patch_scene.h"

#include <algorithm>
#include <cmath>

namespace cleft {
namespace {

/// Coordinates from `from` to `to`, both included: the first step is `first`, and each next one is `growth`
/// times as long.
std::vector<double> graded(double from, double to, double first, double growth) {
  const double length = std::abs(to - from);
  if (length == 0) return {from};
  std::vector<double> x{0};
  for (double step = first; x.back() < length; step *= growth) x.push_back(x.back() + step);
  for (double& value : x) value = from + (to - from) * value / x.back();
  return x;
}

}  // namespace

PatchScene::PatchScene(std::shared_ptr<const Field> shared, std::shared_ptr<const RawCase> raw)
    : shared_(std::move(shared)), raw_(std::move(raw)), field_(*shared_) {
  const Field& field = field_;
  const CanonicalCut& cut = field.cut();
  const double end = cut.start + cut.length, step = cut.length / 120;
  const Interval u = field.domain(0), v = field.domain(1);

  std::vector<double> us = graded(cut.start, u.front, step, 1.15);
  std::reverse(us.begin(), us.end());
  for (int i = 1; i <= 120; ++i) us.push_back(i == 120 ? end : cut.start + i * step);
  const std::vector<double> beyond = graded(end, u.back, step, 1.15);
  us.insert(us.end(), beyond.begin() + 1, beyond.end());

  std::vector<double> vs = graded(0, v.front, step, 1.08);
  std::reverse(vs.begin(), vs.end());
  const std::vector<double> right = graded(0, v.back, step, 1.08);
  vs.insert(vs.end(), right.begin() + 1, right.end());

  add_skin(us, vs);
  if (cut.depth > 0) add_walls(us);
  surface_.original_points = static_cast<int>(surface_.points.size());
  surface_.middle = {cut.start + cut.length / 2, 0, 0};
}

bool PatchScene::inside_cut(double u) const {
  const CanonicalCut& cut = field_.cut();
  return u > cut.start && u < cut.start + cut.length;
}

int PatchScene::add_point(const Vec3& uvw, Side side) {
  surface_.points.push_back(uvw);
  surface_.depth_fraction.push_back(field_.cut().depth > 0 ? -uvw.z / field_.cut().depth : 0);
  sides_.push_back(side);
  return static_cast<int>(surface_.points.size()) - 1;
}

void PatchScene::add_quad(int a, int b, int c, int d, Region region) {
  for (const std::array<int, 3>& t : {std::array{a, b, c}, std::array{a, c, d}}) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;  // where the sheets meet
    surface_.triangles.push_back(t);
    surface_.regions.push_back(region);
  }
}

void PatchScene::add_skin(const std::vector<double>& us, const std::vector<double>& vs) {
  std::vector<int> below, row;
  for (double v : vs) {
    row.clear();
    for (double u : us) row.push_back(add_point({u, v, 0}, side_of(v)));
    std::vector<int> upper = row;
    if (v == 0) {  // the row below ends on the left lip, the row above begins on the right one
      left_ = right_ = row;
      for (std::size_t i = 0; i < us.size(); ++i)
        if (inside_cut(us[i])) {
          sides_[left_[i]] = Side::left;
          right_[i] = add_point({us[i], 0, 0}, Side::right);
        }
      upper = right_;
    }
    for (std::size_t i = 0; i + 1 < us.size() && !below.empty(); ++i)
      add_quad(below[i], below[i + 1], row[i + 1], row[i], Region::skin);
    below = upper;
  }
}

void PatchScene::add_walls(const std::vector<double>& us) {
  constexpr int rows = 12;
  std::vector<int> left_before, right_before;
  for (std::size_t i = 0; i < us.size(); ++i) {
    if (us[i] < field_.cut().start || us[i] > field_.cut().start + field_.cut().length) continue;
    std::vector<int> left{left_[i]}, right{right_[i]};
    for (int k = 1; k <= rows; ++k) {
      const Vec3 uvw{us[i], 0, -field_.cut().depth * k / rows};
      const bool open = inside_cut(us[i]) && k < rows;
      left.push_back(add_point(uvw, open ? Side::left : Side::both));
      right.push_back(open ? add_point(uvw, Side::right) : left.back());
    }
    for (int k = 0; k < rows && !left_before.empty(); ++k) {
      add_quad(left_before[k], left[k], left[k + 1], left_before[k + 1], Region::left_wall);
      add_quad(right_before[k + 1], right[k + 1], right[k], right_before[k], Region::right_wall);
    }
    left_before = left, right_before = right;
  }
}

/// Uncut tissue is closed, whatever the fit is.
Place PatchScene::place(std::size_t point, double t) const {
  const Vec3& x = surface_.points[point];
  return {x, x.x >= field_.cut().start + t ? side_of(x.y) : sides_[point], t};
}

void PatchScene::positions(double t, std::vector<Vec3>& out) const {
  displacements(t, out);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = surface_.points[i] + out[i];
}

void PatchScene::displacements(double t, std::vector<Vec3>& out) const {
  std::vector<Place> places(surface_.points.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = place(i, t);
  out.resize(places.size());
  field_.displacements(places, out);
}

void PatchScene::values(const Coloring& coloring, const Field* reference, double t,
                        std::vector<double>& out) const {
  out.resize(surface_.points.size());
  if (coloring == Coloring::displacement) {  // by far the quickest of all at once
    std::vector<Vec3> displacement;
    displacements(t, displacement);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = norm(displacement[i]);
    return;
  }
  if (coloring == Coloring::error) return errors(t, out);
  const VaryingField field(field_);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = color_value(coloring, field, reference, place(i, t));
}

void PatchScene::errors(double t, std::vector<double>& out) const {
  if (!raw_) return out.assign(surface_.points.size(), std::nan(""));
  if (nearest_.empty())
    for (std::size_t i = 0; i < surface_.points.size(); ++i)
      nearest_.push_back(raw_->nearest_node(surface_.points[i], sides_[i]));
  const std::size_t frame = raw_->nearest_frame(t);
  auto& known = errors_[frame];
  if (known.empty()) {
    std::vector<int> nodes = nearest_;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const std::vector<double> of_nodes = raw_->errors(frame, nodes);
    for (const int node : nearest_)
      known.push_back(of_nodes[std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()]);
  }
  out = known;
}

}  // namespace cleft
