// The simulation of the cuts of a true body, by the solver, in a process of its own.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/process.h"
#include "explorer/body/body_maker.h"
#include "params/parameters/recorded.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

struct BodySimulation {
  Body body;
  BodyReport report;
  std::unique_ptr<SnapshotReader> series;
  std::vector<std::string> warnings;  ///< of the body, and of the solution
  double gape = 0;                    ///< largest opening of the last frame, mm
  double seconds = 0;                 ///< for mesh and solution
};

/// Those of a case as far as a body has them, and the defaults where its file lacks them.
Parameters parameters_of_body(const RecordedParameters& of_case);

/// Leaves out frames until there are about `most`, but the first one and those in which a cut ends.
void thin_frames(Body& body, std::size_t most);

/// Meshes the body and solves it, under tilted blades with mean dilatation
/// (params/parameters/lip_formulation.h), with contact of the lips, in files of a temporary folder, which is
/// removed. Small strains leave out that skin under tension resists turning, without which wounds on edges of
/// an organ open up to three times too wide: where skin would turn by more than much_turn, the body is solved
/// again with turning_share() of that stiffness (skin.turning_stiffness). `progress` is called with the
/// current step. When *stop is 1 the solver is asked to end. Throws InputError for what cannot be meshed or
/// solved, std::runtime_error, with the solver's message, if it fails or was stopped.
BodySimulation simulate(BodyRequest request, const std::function<void(const std::string&)>& progress = {},
                        const StopCount* stop = nullptr);

}  // namespace cleft
