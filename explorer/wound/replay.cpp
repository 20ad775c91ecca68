#include "explorer/wound/replay.h"

#include <algorithm>

#include "base/error.h"
#include "explorer/wound/contractor.h"

namespace cleft {

namespace {

std::vector<ActiveVertex> sorted(std::vector<ActiveVertex> active) {
  Contractor::sort(active);
  return active;
}

std::shared_ptr<const std::vector<Vec3>> rest_of(const CutMesh& mesh) {
  std::vector<Vec3> rest;
  rest.reserve(mesh.vertices().size());
  for (const CutMesh::Vertex& v : mesh.vertices()) rest.push_back(v.position);
  return std::make_shared<const std::vector<Vec3>>(std::move(rest));
}

}  // namespace

Replay::Replay(const Wound& wound, double detail) : Replay(wound, Contractor(wound.field, wound.scale())) {
  if (detail <= 0) return;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < active_.size(); ++i)
    if (bound(i) > detail) chosen.push_back(i);
  *this = of(chosen);
}

Replay::Replay(const Wound& wound, const Contractor& contractor)
    : path_length_(wound.incision->path().length() * wound.scale()),
      scale_(wound.scale()),
      opened_to_(wound.volume.opened_to()),
      rest_(rest_of(wound.incision->mesh())),
      active_(sorted(wound.volume.active())),
      pieces_(contractor.contract(active_, 0, opened_to_(path_length_))) {}

Replay Replay::of(const std::vector<std::size_t>& chosen) const {
  Replay few(*this, pieces_.of(chosen));
  for (const std::size_t i : chosen) few.active_.push_back(active_[i]);
  few.left_out_ = left_out_ + active_.size() - chosen.size();
  return few;
}

void Replay::positions(double s, std::span<Vec3> out) const {
  CLEFT_CHECK(out.size(), ==, rest_->size());
  std::copy(rest_->begin(), rest_->end(), out.begin());
  pieces_.positions(opened_to_(s), rest_->data(), out.data());
}

}  // namespace cleft
