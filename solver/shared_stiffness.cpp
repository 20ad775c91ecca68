#include "solver/shared_stiffness.h"

#include <algorithm>
#include <limits>

#include "solver/body_mesh.h"
#include "solver/case_batch.h"
#include "solver/finite_series.h"

namespace cleft {

namespace {

/// Of the system with the tangent at the reference state: that of the small model with the geometric
/// stiffness of the prestress.
Parameters of_tangent(Parameters p) {
  if (p.model == Model::finite) p.skin.initial_stress_stiffness = true;
  return p;
}

}  // namespace

SharedStiffness::SharedStiffness(SolveJob& job, const std::vector<std::size_t>& members, KeptPatches* kept)
    : job_(job), phases_(job.communicator), kept_(kept) {
  const Parameters parameters = of_tangent(job.cases[members.front()].parameters);
  job.progress("meshing and assembling");
  if (kept) patch_ = kept->reassembled(parameters);
  if (patch_) {
    phases_.end("assemble");
    factorize_again(system(), chosen());
  } else {
    make_patch(members, parameters);
  }
  phases_.end(chosen().method == Method::direct ? "factor" : "set up");
  residual_.emplace(mesh(), system());
  for (const std::size_t c : members) {
    SolveReport& report = job.reports[c];
    MPI_Comm_size(system().communicator(), &report.ranks);
    report.nodes = static_cast<int>(mesh().points.size());
    report.unknowns = system().size();
    report.method = chosen().method == Method::direct ? "direct" : "iterative";
    report.reason = chosen().reason;
    report.expected_peak = chosen().expected_peak;
    report.cases_sharing = static_cast<int>(members.size());
  }
  job.reports[members.front()].first_of_sharing = true;
}

void SharedStiffness::make_patch(const std::vector<std::size_t>& members, const Parameters& parameters) {
  PatchMesh mesh = job_.options.body ? mesh_of(*job_.options.body) : make_patch_mesh(parameters);
  check_assembly_fits(3 * mesh.points.size(), job_.communicator);
  const KeepElements keep = kept_ ? kept_->wants(parameters, mesh) : KeepElements::no;
  patch_ = std::make_shared<MeshedPatch>(std::move(mesh), parameters, job_.communicator,
                                         job_.options.discretization, keep);
  phases_.end("assemble");
  const bool needs_factor = std::any_of(members.begin(), members.end(), [&](std::size_t c) {
    const Parameters& p = job_.cases[c].parameters;
    return p.cut.contact || p.model == Model::finite;
  });
  patch_->chosen = make_frame_solver(patch_->mesh, patch_->system, job_.options.method,
                                     needs_factor ? std::numeric_limits<double>::infinity() : many_operations,
                                     job_.progress);
  if (kept_) kept_->keep(parameters, patch_);
}

void SharedStiffness::solve(const std::vector<std::size_t>& members) {
  const Body* body = job_.options.body.get();
  const Release release =
      body ? release_of(*body) : make_release(mesh(), job_.cases[members.front()].parameters);
  chosen().solver->set_release(release);
  if (!checked_) {
    check_rounding(system(), chosen());
    checked_ = true;
    if (has_compliance(mesh())) {
      job_.progress("compliance of the skin");
      compliance_ = compliance_of(mesh(), system(), *chosen().solver);
    }
    phases_.end("compliance");
  }
  if (job_.cases[members.front()].parameters.model == Model::finite) {
    for (const std::size_t number : members) solve_finite_series(*this, release, number);
    estimate(members);
    return;
  }
  const std::size_t iterations_before = chosen().solver->iterations().size();
  // Few enough files open at a time.
  constexpr std::size_t at_once = 64;
  for (std::size_t first = 0; first < members.size(); first += at_once) {
    const std::size_t end = std::min(members.size(), first + at_once);
    CaseBatch batch(*this, release,
                    {members.begin() + static_cast<long>(first), members.begin() + static_cast<long>(end)});
    batch.solve();
  }
  estimate(members);
  const std::vector<int> iterations = chosen().solver->iterations();
  job_.reports[members.front()].iterations.assign(iterations.begin() + static_cast<long>(iterations_before),
                                                  iterations.end());
}

void SharedStiffness::estimate(const std::vector<std::size_t>& members) {
  // Cases of one stiffness and one release differ in their tension alone: their errors are alike.
  const SolveReport& first = job_.reports[members.front()];
  if (!job_.options.estimate || !first.written) return;
  job_.progress("estimating the error of mesh and patch");
  const ErrorEstimate estimate =
      job_.options.body
          ? ErrorEstimate{{}, "a body has one mesh; make it again with smaller elements and compare"}
          : expected_error(job_.cases[members.front()].parameters, first.gape, job_.communicator, kept_);
  for (const std::size_t c : members) job_.reports[c].estimate = estimate;
  phases_.end("estimate");
}

}  // namespace cleft
