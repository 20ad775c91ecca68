#include "solver/case_output.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "solver/compliance.h"
#include "solver/node_gather.h"

namespace cleft {

namespace {

constexpr double largest_residual = 1e-6;  // of the loads: beyond it the numbers mean nothing

std::string array_of(const std::string& parameter) { return "displacement_per_" + parameter; }

}  // namespace

CaseOutput::CaseOutput(SharedStiffness& shared, const Release& release, std::size_t number,
                       const std::vector<std::string>& derivatives)
    : shared_(shared), number_(number) {
  report().pairs = static_cast<int>(shared_.mesh().pairs.size());
  report().constraints = 3 * report().pairs;
  report().frames = static_cast<int>(release.released.size());
  const Body* body = shared_.job().options.body.get();
  const PatchMesh& mesh = shared_.mesh();
  const bool coordinates = body || !mesh.canonical.empty(), compliance = has_compliance(mesh);
  std::vector<SnapshotArray> arrays;
  if (coordinates) arrays = {canonical_array, frame_array};
  if (compliance) arrays.insert(arrays.end(), {{"compliance", 1, false}, {"dent", 3, false}});
  for (const std::string& name : derivatives) arrays.push_back({array_of(name), 3, true});
  writing_ = std::make_unique<SnapshotOutput>(shared_.job().cases[number_].out,
                                              describe(parameters(), shared_.mesh(), release, body), arrays,
                                              shared_.system().communicator());
  if (coordinates) {
    writing_->write_vectors(canonical_array.name, 0, body ? body->canonical : mesh.canonical);
    writing_->write_frames(frame_array.name, body ? body->frames : mesh.frames);
  }
  if (compliance) {
    writing_->write_scalars("compliance", shared_.compliance().at_node);
    writing_->write_vectors("dent", 0, at_nodes(shared_.compliance().dent.data()));
  }
  shared_.phases().end("write");
}

const Parameters& CaseOutput::parameters() const { return shared_.job().cases[number_].parameters; }

SolveReport& CaseOutput::report() const { return shared_.job().reports[number_]; }

/// Displacements of the mesh's nodes, on rank 0.
std::vector<Vec3> CaseOutput::at_nodes(const double* column) const {
  return gather_nodes(shared_.system(), shared_.mesh(), column);
}

void CaseOutput::write_frames(int first, const Block& frames) {
  for (Eigen::Index j = 0; j < frames.cols(); ++j) {
    const std::vector<Vec3> nodes = at_nodes(frames.col(j).data());
    if (first + j == 0) closed_ = nodes;
    add_largest(nodes);
    writing_->write_vectors("displacement", static_cast<std::size_t>(first + j), nodes);
  }
}

void CaseOutput::write_derivative(const std::string& name, int first, const Block& frames) {
  for (Eigen::Index j = 0; j < frames.cols(); ++j)
    writing_->write_vectors(array_of(name), static_cast<std::size_t>(first + j),
                            at_nodes(frames.col(j).data()));
}

/// Largest displacement from frame 0.
void CaseOutput::add_largest(const std::vector<Vec3>& nodes) {
  double largest = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) largest = std::max(largest, norm(nodes[n] - closed_[n]));
  MPI_Bcast(&largest, 1, MPI_DOUBLE, 0, shared_.system().communicator());
  report().largest_displacement = std::max(report().largest_displacement, largest);
}

void CaseOutput::add_figures(const std::vector<FrameFigures>& figures) {
  SolveReport& report = this->report();
  for (const FrameFigures& f : figures) {
    const std::size_t number = writing_->frames_with_figures();
    writing_->add_figures(f);
    if (number == 1 || (number > 1 && f.smallest_gap < report.smallest_gap))
      report.smallest_gap = f.smallest_gap;
    if (!(f.residual_equilibrium < largest_residual) || !std::isfinite(f.gape)) {
      const std::string frame = "frame " + std::to_string(number);
      report.failure =
          (std::isfinite(f.gape) ? "the forces of " + frame + " do not balance (relative residual " +
                                       shortest(f.residual_equilibrium) + ")"
                                 : "the displacements of " + frame + " overflow") +
          ": the parameters differ by too many orders of magnitude";
      writing_.reset();
      return;
    }
    report.gape = f.gape;
    report.worst_equilibrium = std::max(report.worst_equilibrium, f.residual_equilibrium);
    report.worst_closure = std::max(report.worst_closure, f.residual_closure);
  }
}

void CaseOutput::finish() {
  writing_->finish();
  report().written = true;
}

}  // namespace cleft
