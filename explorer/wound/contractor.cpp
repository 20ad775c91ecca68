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

/// The times as far as to the first one beyond `last`.
std::vector<double> Contractor::times_to(double last) const {
  auto end = std::upper_bound(times_.begin() + 1, times_.end(), last);
  if (end != times_.end()) ++end;
  return {times_.begin(), end};
}

void Contractor::history(const ActiveVertex& a, Side side, std::span<const double> times,
                         History& out) const {
  field_.contract(a.uvw, side, a.s, times, out);
  for (auto& piece : out.controls)
    for (Vec3& d : piece) d = 1 / scale_ * a.in_mesh(d);
}

ReplayPieces Contractor::contract(const std::vector<ActiveVertex>& sorted, int shift, double reach) const {
  std::vector<double> offsets;
  std::vector<int> vertices;
  for (const ActiveVertex& a : sorted) offsets.push_back(a.time_offset), vertices.push_back(a.vertex + shift);
  const std::vector<double> times = times_to(offsets.empty() ? 0 : reach + offsets.back());
  ReplayPieces pieces(times, std::move(offsets), std::move(vertices), reach);
  History open, closed;
  for (const ActiveVertex& a : sorted) {
    history(a, a.side, times, open);
    if (a.on_cut && a.side != Side::both) {
      history(a, Side::both, times, closed);
      pieces.append(closed, open, a.s);
    } else {
      pieces.append(open);
    }
  }
  return pieces;
}

}  // namespace cleft
