#include "explorer/view/mesh_scene.h"

namespace cleft {

MeshScene::MeshScene(std::shared_ptr<const Incision> incision, const Field& field, int original_points)
    : incision_(std::move(incision)), replay_(field, *incision_, 1) {
  surface_.original_points = original_points;
  for (const CutMesh::Vertex& v : incision_->mesh().vertices()) {
    surface_.points.push_back(v.position);
    surface_.depth_fraction.push_back(v.depth_fraction);
  }
  for (const CutMesh::Triangle& t : incision_->mesh().triangles()) {
    surface_.triangles.push_back(t.vertex);
    surface_.regions.push_back(t.region);
  }
  const ScalpelPath& path = incision_->path();
  const PathFrame middle = path.at(path.length() / 2);
  surface_.middle = middle.position;
  surface_.along = middle.along;
  surface_.outward = {};
  constexpr int samples = 20;
  for (int i = 0; i <= samples; ++i) surface_.outward += path.at(path.length() * i / samples).outward;
}

void MeshScene::positions(double t, std::vector<Vec3>& out) const {
  out.resize(surface_.points.size());
  replay_.positions(t, out);
}

}  // namespace cleft
