// Cuts side by side relieve each other: each opens in the tension that the others leave. The field of each is
// scaled along its path by an amplitude: how far the cut opens in a membrane with all of them, over what it
// opens alone (membrane_relief.h).
//
// Lips also lean: the strip between two cuts sinks, and the skin beyond them rises as it does beside one.
// What another cut shears of the tissue down to the bottom, its walls no longer pass on: the wall from which
// the shear pulled up sinks, and the other one rises. Next to a cut a share of the displacement across is
// added upright, in proportion to that shear. And lips shift along the cut, as in the membrane.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "explorer/wound/beside_cut.h"
#include "explorer/wound/wound.h"

namespace cleft {

/// Along a path, linear between stations, in mm of it; constant beyond them: the amplitude, and by which
/// parts of its displacement across a vertex on a lip rises and moves along the cut, positive where those at
/// v > 0 rise and move with u.
struct Amplitude {
  std::vector<double> stations, values;
  std::vector<double> leans = {}, shifts = {};  ///< none: 0
  /// Those of a lip into which other cuts open, next to there, where the lip across stays whole: of that at
  /// v < 0, and of that at v > 0; none where no other does.
  std::vector<Amplitude> of_corners = {};
  std::vector<double> free = {};  ///< 0 to 1: how far the corners beside each of these cuts have parted
  struct At {
    double value, lean, shift;
    /// What lips that lean, and shift along the cut, add for each mm of displacement across.
    Vec3 added(const BesideCut& at) const { return lean * at.outward + shift * at.along; }
    At toward(const At& other, double part) const {
      return {std::lerp(value, other.value, part), std::lerp(lean, other.lean, part),
              std::lerp(shift, other.shift, part)};
    }
  };
  At operator()(double s) const;
  At operator()(const BesideCut& at) const {
    const At there = (*this)(at.s);
    const double part = at.mouth < free.size() ? at.corner * free[at.mouth] : 0;
    return part == 0 || of_corners.empty() ? there : there.toward(of_corners[at.side](at.corner_s), part);
  }
  double at(double s) const { return (*this)(s).value; }
};

/// Of the displacement across: lips shift along the cut by no more, and lean by no more.
constexpr double most_shift = 1, most_lean = 1;
/// How far a cut is taken to open at most, over what it would alone, where others add to the tension. Beyond,
/// cuts nearly meet end to end.
constexpr double most_opening = 3;

/// The amplitudes of several cuts while the blade makes the newest of them, at steps of its path, linear
/// between these. A single step holds for all positions of the blade; without steps, and for unknown cuts,
/// the amplitude is 1.
class Relief {
 public:
  Relief() = default;
  /// With the blade anywhere.
  explicit Relief(std::vector<Amplitude> always) : parts_{0}, amplitudes_(std::move(always)) {}
  /// steps[i][k] is the amplitude of cut k with the blade at parts[i] of its path, ascending.
  Relief(std::vector<double> parts, const std::vector<std::vector<Amplitude>>& steps)
      : parts_(std::move(parts)) {
    for (const std::vector<Amplitude>& step : steps)
      amplitudes_.insert(amplitudes_.end(), step.begin(), step.end());
  }

  std::size_t steps() const { return parts_.size(); }
  std::size_t cuts() const { return parts_.empty() ? 0 : amplitudes_.size() / parts_.size(); }
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

    /// A displacement by one cut alone, as the others leave it.
    Vec3 relieved(std::size_t cut, const BesideCut& at, const Vec3& alone) const {
      if (cut >= cuts_) return alone;
      const Amplitude::At there =
          before_ == after_ ? before_[cut](at) : before_[cut](at).toward(after_[cut](at), beyond_);
      return there.value * alone + dot(alone, at.across) * there.added(at);
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
  std::vector<double> parts_;          // of the blade's path, ascending
  std::vector<Amplitude> amplitudes_;  // [step][cut]
};

/// The amplitudes of all cuts at each position of the blade, mm of the path of the last one, with the others
/// complete. All 1 for a single cut, and of fields that do not open. Throws InputError if a field lacks the
/// skin's prestress across the cut.
std::vector<std::vector<Amplitude>> mutual_relief(const std::vector<const Wound*>& cuts,
                                                  const std::vector<double>& blades);

/// Those of mutual_relief while the blade makes the last cut, as far as it reaches.
Relief relief_while_cut(const std::vector<const Wound*>& cuts);

}  // namespace cleft
