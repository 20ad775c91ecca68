// The measurements for the charts, for each link of the chain. Each takes seconds to minutes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "params/parameters/parameters.h"
#include "tradeoff/chart.h"

namespace cleft {

/// The subject of the charts: a simulated case, and its study's settings.
struct ChartedCase {
  std::string snapshot;   ///< case.h5
  Parameters parameters;  ///< what it was solved with
  double tolerance;       ///< that the study encodes with
  std::string parametrization;
};

struct ChartOptions {
  double most_nodes = 120000;  ///< of the reference mesh
  std::function<void(const std::string&)> progress;
};

/// A folder for intermediate files.
using WorkFolder = std::string;

/// Largest error at any node and frame, over bytes, time to encode, and time to evaluate a point: the
/// parametrisations, and zfp at the same error (its time: of decoding all, over the points).
std::vector<Chart> encoder_charts(const ChartedCase& charted, const ChartOptions& options);

/// Error of the opening over unknowns and over time: against the finest mesh, and of a slit in a sheet
/// against its closed form; and, where the finite model has what the case needs, of small and finite strains
/// over processor time against finite strains in the finest mesh that they can afford.
std::vector<Chart> solver_charts(const ChartedCase& charted, const ChartOptions& options,
                                 const WorkFolder& work);

/// Error of replayed cuts against the solver's own simulations of them: over the time of a frame, and over
/// curvature, tilt and length of the cut and the distance of parallel ones; with the case's own field, and
/// with three fields of different prestress, superposed as the tension turns. Cuts that the solver refuses
/// are left out.
std::vector<Chart> replay_charts(const ChartedCase& charted, const ChartOptions& options,
                                 const WorkFolder& work);

/// Error of the force over the rate at which it is updated: a blade that presses, slides, cuts and leaves.
std::vector<Chart> haptic_charts(const ChartOptions& options);

}  // namespace cleft
