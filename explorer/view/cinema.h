// A Cinema database (Spec D) of a study: a picture for every case, length cut and camera, and a table of
// them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "explorer/session/session.h"

namespace cleft {

struct CinemaGrid {
  int times = 9;                  ///< from uncut to completely cut
  int width = 640, height = 360;  ///< pixels
  /// Azimuth and elevation from the cut's normal, degrees.
  std::vector<std::pair<double, double>> cameras{{0, 0}, {25, -50}};
};

struct CinemaFigures {
  int pictures = 0, cases = 0;
};

/// Writes data.csv and images/ into the existing empty folder `out`: case, its varying parameters,
/// length_cut, azimuth, elevation, gape, displacement, FILE. All cases of the session's study, with its
/// colouring. `progress` is called with the number of finished pictures and of all.
CinemaFigures write_cinema(Session& session, const std::string& out, const CinemaGrid& grid,
                           const std::function<void(int done, int of)>& progress);

}  // namespace cleft
