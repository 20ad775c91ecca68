// How lips lean beside other cuts: what these shear of the tissue down to the bottom, their walls no longer
// pass on.
#pragma once

#include <vector>

#include "explorer/wound/mutual_relief.h"

namespace cleft {

class ShearLean {
 public:
  /// They must outlive it.
  explicit ShearLean(const std::vector<const Wound*>& cuts);

  /// The lips of a cut at a station: numbers of their vertices, and how far they open alone, mm.
  struct Lips {
    std::size_t cut, station;
    double s, opening;  ///< mm
    int left, right;
  };
  void add(const Lips& lips);

  /// [cut][other][station]: by how much its lips lean because of another one (Amplitude::leans), with the
  /// blade of the last cut there and the others complete; 0 at other stations.
  using Leans = std::vector<std::vector<std::vector<double>>>;
  Leans leans(double blade, const std::vector<Amplitude>& in_membrane) const;

 private:
  /// A station of a cut in the volume of another one.
  struct Place {
    std::size_t cut, by, station;
    double s;        // mm, along the other's path
    double leaning;  // for each mm of shear
    double shear;    // mm, of the other one where it is complete
    ActiveVertex at;
    Vec3 normal;                          // across the own path
    const IncisionVolume::Mouth* branch;  // where it opens into the other one; null: it does not
  };

  const std::vector<const Wound*>& cuts_;
  std::vector<std::size_t> stations_;  // of each cut
  std::vector<Place> places_;
};

}  // namespace cleft
