#include "explorer/scene/replay.h"

#include <algorithm>
#include <tuple>

#include "base/error.h"

namespace cleft {

Replay::Replay(const Field& field, const Incision& incision, double scale)
    : cut_length_(field.cut().length),
      path_length_(incision.path().length() * scale),
      active_(active_vertices(incision, field, scale)) {
  rest_.reserve(incision.mesh().vertices().size());
  for (const CutMesh::Vertex& v : incision.mesh().vertices()) rest_.push_back(v.position);
  // In order of time offset (few different ones, outside the steady state) and of memory.
  std::sort(active_.begin(), active_.end(), [](const ActiveVertex& a, const ActiveVertex& b) {
    return std::tie(a.time_offset, a.vertex) < std::tie(b.time_offset, b.vertex);
  });
  first_.reserve(active_.size());
  for (const ActiveVertex& a : active_) {
    first_.push_back(histories_.size());
    append_history(field, a, a.side, scale);
    if (a.on_cut && a.side != Side::both) append_history(field, a, Side::both, scale);
  }
}

void Replay::append_history(const Field& field, const ActiveVertex& a, Side side, double scale) {
  History& history = histories_.emplace_back();
  field.contract(a.uvw, side, field.contraction_tolerance(), history);
  for (auto& piece : history.controls)
    for (Vec3& d : piece) d = a.weight / scale * (d.x * a.along + d.y * a.across + d.z * a.outward);
}

void Replay::positions(double s, std::span<Vec3> out) const {
  CLEFT_CHECK(out.size(), ==, rest_.size());
  std::copy(rest_.begin(), rest_.end(), out.begin());
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const ActiveVertex& a = active_[i];
    const double time = std::clamp(s + a.time_offset, 0.0, cut_length_);
    const bool closed = a.on_cut && a.side != Side::both && a.s >= s;
    out[a.vertex] += evaluate(histories_[first_[i] + (closed ? 1 : 0)], time);
  }
}

}  // namespace cleft
