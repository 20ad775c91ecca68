#include "explorer/scene/replay.h"

#include <algorithm>

#include "base/error.h"
#include "explorer/scene/contractor.h"

namespace cleft {

namespace {

std::vector<ActiveVertex> sorted(std::vector<ActiveVertex> active) {
  Contractor::sort(active);
  return active;
}

}  // namespace

Replay::Replay(const VaryingField& field, const Incision& incision, double scale, double detail)
    : Replay(Contractor(field, scale), incision, field.shape(), scale, detail) {}

Replay::Replay(const Contractor& contractor, const Incision& incision, const Field& shape, double scale,
               double detail)
    : path_length_(incision.path().length() * scale),
      active_(sorted(active_vertices(incision, shape, scale))),
      left_out_(contractor.leave_out(active_, detail)),
      pieces_(contractor.contract(active_)) {
  rest_.reserve(incision.mesh().vertices().size());
  for (const CutMesh::Vertex& v : incision.mesh().vertices()) rest_.push_back(v.position);
}

void Replay::positions(double s, std::span<Vec3> out) const {
  CLEFT_CHECK(out.size(), ==, rest_.size());
  std::copy(rest_.begin(), rest_.end(), out.begin());
  pieces_.positions(s, rest_.data(), out.data());
}

}  // namespace cleft
