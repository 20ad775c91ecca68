// A cut as a membrane has it (cut_membrane.h): in stretches, in the middles of which amplitudes are told,
// each of one or some straight pieces. Stretches end where cuts touch each other.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/vec3.h"
#include "explorer/incision/scalpel_path.h"
#include "explorer/wound/wound.h"

namespace cleft {

struct MembraneCut {
  /// Where a cut touches others.
  struct Joint {
    double s;  ///< mm along its path
    std::optional<Vec3>
        place;  ///< mm, the same for all cuts that touch there; none where stretches end anyway
  };
  struct Piece {
    Vec3 begin, middle, end;  ///< mm
    PathFrame frame;          ///< in the middle
    double s;                 ///< likewise, mm along the path
    double length() const { return norm(end - begin); }
  };
  std::vector<Piece> pieces;
  std::vector<double> corners;                   ///< mm along the path, where stretches begin and end
  std::vector<Eigen::Index> first_pieces = {0};  ///< of stretches, and the number of pieces
  std::vector<double> mouths;                    ///< mm along the path, of cuts that open into it
  bool ends_in_another = false;

  /// What is beyond cuts that it begins and ends in opens nothing.
  MembraneCut(const Wound& wound, std::vector<Joint> joints);

  std::size_t stretches() const { return first_pieces.size() - 1; }
  /// Of a system for its pieces, two for each: along and across.
  Eigen::Index rows() const { return 2 * first_pieces.back(); }
  /// The middles of stretches.
  std::vector<double> stations() const;
  double first_stretch() const { return corners[1] - corners[0]; }
  double last_stretch() const { return corners.back() - corners.end()[-2]; }

  /// The means over the stretches that begin with number `first`, of what is told for their pieces.
  Eigen::VectorXd means(const Eigen::VectorXd& of_pieces, std::size_t first = 0) const;

  /// The pieces before and behind one in its stretch, or itself at an end of that; and half its own length
  /// over the way between their middles.
  struct Beside {
    std::size_t before, behind;
    double part;
  };
  Beside beside(std::size_t piece) const;

  /// The same, begun `count` stretches before its start, straight.
  MembraneCut begun_before(int count) const;
  /// The same, run on by `way` mm beyond its end, straight, in `count` stretches.
  MembraneCut run_on(int count, double way) const;

 private:
  void add_stretch(const Wound& wound, double end, std::vector<double> parts);
  void end_stretch(double at);
};

}  // namespace cleft
