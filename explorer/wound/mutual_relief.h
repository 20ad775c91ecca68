// Cuts side by side relieve each other: each opens in the tension that the others leave. How much less than
// alone it opens at each place of its path, A(s), and how far its lips slide along each other, are taken from
// a membrane in which all cuts are (cut_membrane.h): the field of each is scaled, and slides, accordingly.
//
// Of parallel cuts the strip between them sinks, and the skin beyond them rises as beside a cut alone: lips
// lean. Next to them a share of the displacement across the cut is added upright, in proportion to how much
// it is relieved from that side.
#pragma once

#include <algorithm>
#include <vector>

#include "explorer/wound/wound.h"

namespace cleft {

/// Amplitude along a path, linear between stations, in mm of it; constant beyond them.
struct Amplitude {
  struct Value {
    double across = 1;  ///< of the displacement that the cut makes alone
    double slide = 0;   ///< part of its displacement across by which a vertex also moves along
    double lean = 0;    ///< and by which one on a lip rises
  };
  std::vector<double> stations;
  std::vector<Value> values;
  Value at(double s) const;
};

/// A vertex beside a cut, as its relief needs it.
struct BesideCut {
  double s = 0;                 ///< mm along the path
  Vec3 along, across, outward;  ///< unit, in the mesh's space; `outward` is shorter the further from the lips

  BesideCut() = default;
  BesideCut(const ActiveVertex& vertex, const Wound& wound);
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
    Amplitude::Value amplitude(std::size_t cut, double s) const {
      if (cut >= cuts_) return {};
      const Amplitude::Value before = before_[cut].at(s);
      if (before_ == after_) return before;
      const Amplitude::Value after = after_[cut].at(s);
      return {before.across + beyond_ * (after.across - before.across),
              before.slide + beyond_ * (after.slide - before.slide),
              before.lean + beyond_ * (after.lean - before.lean)};
    }

    /// A displacement by one cut alone, as the others leave it.
    Vec3 relieved(std::size_t cut, const BesideCut& at, const Vec3& alone) const {
      if (cut >= cuts_) return alone;
      const auto [across, slide, lean] = amplitude(cut, at.s);
      return across * alone + dot(alone, at.across) * (slide * at.along + lean * at.outward);
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
/// complete. All 1 for a single cut, and where the newest field does not open. Throws InputError if a field
/// lacks the skin's prestress.
std::vector<Amplitude> mutual_relief(const std::vector<const Wound*>& cuts, double blade);

}  // namespace cleft
