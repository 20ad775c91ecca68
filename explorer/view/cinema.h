// A Cinema database (Spec D) of a study: a picture for every case, length cut and camera, and a table of
// them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "explorer/session/session.h"

namespace cleft {

struct CinemaGrid {
  int times = 9;                  ///< from nothing cut to the end
  int width = 640, height = 360;  ///< pixels
  /// Azimuth and elevation from the cut's normal, degrees.
  std::vector<std::pair<double, double>> cameras{{0, 0}, {25, -50}};
};

struct CinemaFigures {
  int pictures = 0, cases = 0;
};

/// Writes data.csv and images/ into the folder `out`, which is there and empty: case, its varying parameters,
/// length_cut, azimuth, elevation, gape, displacement, FILE. All cases of the session's study, as it is
/// coloured. `progress` is told how many of all pictures are done.
CinemaFigures write_cinema(Session& session, const std::string& out, const CinemaGrid& grid,
                           const std::function<void(int done, int of)>& progress);

}  // namespace cleft
