#include "explorer/scene/replay.h"

#include <algorithm>
#include <tuple>

#include "base/error.h"

namespace cleft {

namespace {

/// Contracts active vertices into histories in the mesh's space and units, weighted, with breaks at `times`.
struct Contractor {
  const Field& field;
  double scale;
  std::span<const double> times;

  void operator()(const ActiveVertex& a, Side side, History& out) const {
    field.contract(a.uvw, side, field.contraction_tolerance(), times, out);
    for (auto& piece : out.controls)
      for (Vec3& d : piece) d = 1 / scale * a.in_mesh(d);
  }
};

std::vector<double> offsets_of(const std::vector<ActiveVertex>& active) {
  std::vector<double> offsets;
  for (const ActiveVertex& a : active) offsets.push_back(a.time_offset);
  return offsets;
}

std::vector<int> vertices_of(const std::vector<ActiveVertex>& active) {
  std::vector<int> vertices;
  for (const ActiveVertex& a : active) vertices.push_back(a.vertex);
  return vertices;
}

std::vector<Place> places_of(const std::vector<ActiveVertex>& active) {
  std::vector<Place> places;
  for (const ActiveVertex& a : active) places.push_back({a.uvw, a.side, 0});
  return places;
}

/// In order of time offset (few different ones, outside the steady state) and of memory.
std::vector<ActiveVertex> sorted(std::vector<ActiveVertex> active) {
  std::sort(active.begin(), active.end(), [](const ActiveVertex& a, const ActiveVertex& b) {
    return std::tie(a.time_offset, a.vertex) < std::tie(b.time_offset, b.vertex);
  });
  return active;
}

}  // namespace

Replay::Replay(const Field& field, const Incision& incision, double scale)
    : path_length_(incision.path().length() * scale),
      active_(sorted(active_vertices(incision, field, scale))),
      times_(replay_times(field, field.contraction_tolerance(), places_of(active_))),
      pieces_(times_, offsets_of(active_), vertices_of(active_)) {
  rest_.reserve(incision.mesh().vertices().size());
  for (const CutMesh::Vertex& v : incision.mesh().vertices()) rest_.push_back(v.position);
  const Contractor contract{field, scale, times_};
  History open, closed;
  for (const ActiveVertex& a : active_) {
    contract(a, a.side, open);
    if (a.on_cut && a.side != Side::both) {
      contract(a, Side::both, closed);
      pieces_.append(closed, open, a.s);
    } else {
      pieces_.append(open);
    }
  }
}

void Replay::positions(double s, std::span<Vec3> out) const {
  CLEFT_CHECK(out.size(), ==, rest_.size());
  std::copy(rest_.begin(), rest_.end(), out.begin());
  pieces_.positions(s, rest_.data(), out.data());
}

}  // namespace cleft
