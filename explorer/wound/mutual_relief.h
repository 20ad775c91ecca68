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
  explicit Relief(const std::vector<std::vector<Amplitude>>& steps) : steps_(steps.size()) {
    for (const std::vector<Amplitude>& step : steps)
      amplitudes_.insert(amplitudes_.end(), step.begin(), step.end());
  }

  std::size_t steps() const { return steps_; }
  std::size_t cuts() const { return steps_ == 0 ? 0 : amplitudes_.size() / steps_; }
  const Amplitude& amplitude(std::size_t step, std::size_t cut) const {
    return amplitudes_[step * cuts() + cut];
  }

  /// The amplitudes at one position of the blade, evaluated for each vertex of a frame. The relief must
  /// outlive them.
  class At {
   public:
    At() = default;  ///< 1 everywhere
    /// The amplitude at s mm of a cut's path.
    double amplitude(std::size_t cut, double s) const {
      if (cut >= cuts_) return 1;
      if (before_ == after_) return before_[cut].at(s);
      return (1 - beyond_) * before_[cut].at(s) + beyond_ * after_[cut].at(s);
    }

   private:
    friend class Relief;
    const Amplitude *before_ = nullptr, *after_ = nullptr;  // of all cuts, at the two nearest steps
    std::size_t cuts_ = 0;
    double beyond_ = 0;  // weight of `after_`
  };
  /// The blade is at `part` of its own path.
  At at(double part) const;

 private:
  std::size_t steps_ = 0;
  std::vector<Amplitude> amplitudes_;  // [step][cut]
};

/// The amplitudes of all cuts, with the blade of the last one at `blade` mm of its path and the others
/// complete. All 1 for a single cut. Throws InputError if a field lacks the skin's prestress or stiffness.
std::vector<Amplitude> mutual_relief(const std::vector<const Wound*>& cuts, double blade);

}  // namespace cleft
