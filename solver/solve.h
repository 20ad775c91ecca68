// From cases to their snapshots.
#pragma once

#include <mpi.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "params/parameters/parameters.h"
#include "solver/body/body.h"
#include "solver/companion.h"
#include "solver/frame_solver.h"
#include "solver/phases.h"

namespace cleft {

/// A step of Newton's method.
struct NewtonStep {
  double residual;  ///< before the step: largest force out of balance / largest load
  int iterations;   ///< of conjugate gradients for the step's linear system
  double length;    ///< that the line search took; 1: the whole step
  bool indefinite;  ///< the tangent was found to have a negative curvature
};

/// How a frame of the finite model was solved.
struct NewtonFrame {
  int frame = 0;
  std::vector<NewtonStep> steps;  ///< of all parts of the load
  int load_steps = 1;             ///< in which the released forces were taken away
  double residual = 0;            ///< in the end
};

struct SolveOptions {
  Method method = Method::automatic;
  Discretization discretization = {};
  bool unit_prestress = false;  ///< write the series of the unit prestresses uu, vv and uv as well
  std::vector<std::string> sensitivities = {};       ///< parameters to differentiate the series by
  bool estimate = true;                              ///< the error that the mesh and the patch leave
  std::shared_ptr<const Body> body = {};             ///< in place of the patch; its error is not estimated
  std::function<void(const std::string&)> log = {};  ///< takes a line for each frame of the finite model
};

struct CaseToSolve {
  Parameters parameters;
  std::string out;  ///< the snapshot's path
};

struct SolveReport {
  std::string out, failure;  ///< the error; empty if the snapshot was written
  bool written = false;
  int ranks = 1, nodes = 0, unknowns = 0, constraints = 0, pairs = 0, frames = 0;
  std::string method, reason;
  double expected_peak = 0;       ///< bytes of all ranks, as told before the factorisation or the iterations
  int cases_sharing = 1;          ///< that use the same factorisation, this one included
  bool first_of_sharing = false;  ///< whose phases hold the shared work
  std::vector<Phase> phases;
  std::vector<int> iterations;      ///< of every frame, where it was solved by iterations
  std::vector<NewtonFrame> newton;  ///< of every frame of the finite model
  double gape = 0;                  ///< mm: largest opening in the last frame
  ErrorEstimate estimate;           ///< of the gape's error; empty if none was asked for
  double largest_displacement = 0;  ///< mm, from frame 0
  double worst_equilibrium = 0, worst_closure = 0, smallest_gap = 0;
};

/// Throws InputError if these options do not permit a case; `where` names its source in the message.
void check_options(const Parameters& parameters, const SolveOptions& options, const std::string& where);

/// Solves cases and writes their snapshots, each of which appears complete or not at all. Cases of the same K
/// share its factorisation; among these, cases that differ only in the prestress also share the frames, which
/// are linear in it. A case that fails does not affect the others. Collective; the reports, in the order of
/// the cases, are the same on every rank. `progress` is called with the current step.
std::vector<SolveReport> solve_cases(const std::vector<CaseToSolve>& cases, const SolveOptions& options,
                                     MPI_Comm communicator,
                                     const std::function<void(const std::string&)>& progress);

}  // namespace cleft
