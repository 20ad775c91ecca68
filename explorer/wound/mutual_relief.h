// Cuts side by side relieve each other: each opens in the tension that the others leave. The field of each is
// scaled along its path by A(s), the tension across it relative to that without the others:
//   A_i(s) = 1 + sum over j of A_j r_ij(s),   r_ij = (change of tension across path i that cut j alone makes)
//   / (tension)
// a fixed point in the amplitudes of all cuts (Kachanov 1987, elastic solids with many cracks, with constant
// amplitudes; here they vary along the path). The change of tension in the skin is its plane stress for the
// strain of the other cut's field.
#pragma once

#include <algorithm>
#include <vector>

#include "explorer/wound/wound.h"

namespace cleft {

/// Amplitude along a path, linear between stations, in mm of it; constant beyond them.
struct Amplitude {
  std::vector<double> stations, values;
  double at(double s) const;
};

/// The amplitudes of several cuts while the blade makes the newest of them, at equal steps of its path,
/// linear between these. A single step holds for all positions of the blade; without steps, and for unknown
/// cuts, the amplitude is 1.
class Relief {
 public:
  Relief() = default;
  /// steps[i][k] is the amplitude of cut k with the blade at step i.
  explicit Relief(std::vector<std::vector<Amplitude>> steps) : steps_(std::move(steps)) {}

  const std::vector<std::vector<Amplitude>>& steps() const { return steps_; }
  std::size_t cuts() const { return steps_.empty() ? 0 : steps_.front().size(); }
  /// The amplitude at s mm of a cut's path; the blade is at `part` of its own path.
  double amplitude(std::size_t cut, double s, double part) const {
    if (cut >= cuts()) return 1;
    if (steps_.size() == 1) return steps_.front()[cut].at(s);
    const double at = part * static_cast<double>(steps_.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(at), steps_.size() - 2);
    const double beyond = at - static_cast<double>(i);
    return (1 - beyond) * steps_[i][cut].at(s) + beyond * steps_[i + 1][cut].at(s);
  }

 private:
  std::vector<std::vector<Amplitude>> steps_;
};

/// The amplitudes of all cuts, with the blade of the last one at `blade` mm of its path and the others
/// complete. All 1 for a single cut. Throws InputError if a field lacks the skin's prestress or stiffness.
std::vector<Amplitude> mutual_relief(const std::vector<const Wound*>& cuts, double blade);

}  // namespace cleft
