#include "explorer/scene/body_scene.h"

#include <algorithm>
#include <cmath>

#include "explorer/study/mesh_skin.h"

namespace cleft {

BodyScene::BodyScene(std::shared_ptr<const FieldOnMesh> field) : field_(std::move(field)) {
  const Snapshot& mesh = field_->mesh();
  std::vector<int> point_of(mesh.points.size(), -1);
  for (std::array<int, 3> triangle : skin_of(mesh)) {
    for (int& corner : triangle) {
      int& point = point_of[corner];
      if (point < 0) {
        point = static_cast<int>(nodes_.size());
        nodes_.push_back(corner), surface_.points.push_back(mesh.points[corner]);
      }
      corner = point;
    }
    surface_.triangles.push_back(triangle);
  }
  surface_.regions.assign(surface_.triangles.size(), Region::skin);
  surface_.depth_fraction.assign(surface_.points.size(), 0);
  surface_.original_points = static_cast<int>(surface_.points.size());
  if (surface_.points.empty()) return;
  Vec3 low = surface_.points.front(), high = low;
  for (const Vec3& p : surface_.points)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  surface_.middle = 0.5 * (low + high);
  const bool is_flat = high.z - low.z <= 1e-9 * norm(high - low);
  surface_.outward = is_flat ? Vec3{0, 0, 1} : Vec3{0.4, -0.5, 1};  // three sides of a box are seen
}

void BodyScene::positions(double t, std::vector<Vec3>& out) const {
  const std::vector<Vec3> moved = field_->displacement(t);
  out.resize(nodes_.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = surface_.points[i] + moved[nodes_[i]];
}

void BodyScene::values(const Coloring& coloring, const Field* reference, double t,
                       std::vector<double>& out) const {
  const auto take = [&](const std::vector<double>& of_nodes) {
    out.resize(nodes_.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = of_nodes[nodes_[i]];
  };
  switch (coloring.kind) {
    case Coloring::tissue:
    case Coloring::own:
      return out.assign(nodes_.size(), 0);
    case Coloring::quantity:
      return take(quantities(coloring.name, t));
    case Coloring::error:
      return take(errors(t));
    case Coloring::displacement: {
      std::vector<double> lengths;
      for (const Vec3& d : field_->displacement(t)) lengths.push_back(norm(d));
      return take(lengths);
    }
    default:
      break;
  }
  out.assign(nodes_.size(), std::nan(""));
  if (!field_->field()) return;
  const VaryingField field(*field_->field());
  for (std::size_t i = 0; i < out.size(); ++i) {
    Place place = field_->places()[nodes_[i]];
    place.t = t;
    out[i] = color_value(coloring, field, reference, place);
  }
}

std::vector<double> BodyScene::quantities(const std::string& name, double t) const {
  const auto& all = field_->quantities();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& q) { return q.name == name; });
  const std::size_t count = field_->mesh().points.size();
  if (found == all.end()) return std::vector<double>(count, std::nan(""));
  const std::vector<double> components = field_->quantity(static_cast<std::size_t>(found - all.begin()), t);
  std::vector<double> values(count);
  for (std::size_t n = 0; n < count; ++n)
    values[n] = magnitude_of({&components[n * found->components], found->components});
  return values;
}

/// Against the data of the frame that is nearest in time.
std::vector<double> BodyScene::errors(double t) const {
  const std::vector<double>& times = field_->mesh().times;
  const auto nearest = std::min_element(
      times.begin(), times.end(), [&](double a, double b) { return std::abs(a - t) < std::abs(b - t); });
  const std::vector<Vec3> data = field_->data(static_cast<std::size_t>(nearest - times.begin())),
                          found = field_->displacement(*nearest);
  std::vector<double> values(data.size());
  for (std::size_t n = 0; n < data.size(); ++n) values[n] = norm(found[n] - data[n]);
  return values;
}

}  // namespace cleft
