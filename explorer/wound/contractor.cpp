#include "explorer/wound/contractor.h"

#include <algorithm>
#include <tuple>

namespace cleft {

Contractor::Contractor(VaryingField field, double scale)
    : field_(std::move(field)),
      scale_(scale),
      times_(replay_times(field_.typical(), field_.contraction_tolerance())) {}

void Contractor::sort(std::vector<ActiveVertex>& active) {
  std::sort(active.begin(), active.end(), [](const ActiveVertex& a, const ActiveVertex& b) {
    return std::tie(a.time_offset, a.vertex) < std::tie(b.time_offset, b.vertex);
  });
}

void Contractor::history(const ActiveVertex& a, Side side, History& out) const {
  field_.contract(a.uvw, side, a.s, times_, out);
  for (auto& piece : out.controls)
    for (Vec3& d : piece) d = 1 / scale_ * a.in_mesh(d);
}

ReplayPieces Contractor::contract(const std::vector<ActiveVertex>& sorted, int shift, double reach) const {
  std::vector<double> offsets;
  std::vector<int> vertices;
  for (const ActiveVertex& a : sorted) offsets.push_back(a.time_offset), vertices.push_back(a.vertex + shift);
  ReplayPieces pieces(times_, std::move(offsets), std::move(vertices), reach);
  History open, closed;
  for (const ActiveVertex& a : sorted) {
    history(a, a.side, open);
    if (a.on_cut && a.side != Side::both) {
      history(a, Side::both, closed);
      pieces.append(closed, open, a.s);
    } else {
      pieces.append(open);
    }
  }
  return pieces;
}

}  // namespace cleft
