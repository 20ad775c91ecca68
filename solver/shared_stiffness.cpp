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

SharedStiffness::SharedStiffness(SolveJob& job, const std::vector<std::size_t>& members)
    : job_(job), phases_(job.communicator) {
  const Parameters parameters = of_tangent(job.cases[members.front()].parameters);
  job.progress("meshing and assembling");
  mesh_ = job.options.body ? mesh_of(*job.options.body) : make_patch_mesh(parameters);
  check_assembly_fits(3 * mesh_.points.size(), job.communicator);
  system_.emplace(mesh_, parameters, job.communicator, job.options.discretization);
  residual_.emplace(mesh_, *system_);
  phases_.end("assemble");
  const bool needs_factor = std::any_of(members.begin(), members.end(), [&](std::size_t c) {
    const Parameters& p = job.cases[c].parameters;
    return p.cut.contact || p.model == Model::finite;
  });
  chosen_ = make_frame_solver(mesh_, *system_, job.options.method,
                              needs_factor ? std::numeric_limits<double>::infinity() : many_operations,
                              job.progress);
  phases_.end(chosen_.method == Method::direct ? "factor" : "set up");
  for (const std::size_t c : members) {
    SolveReport& report = job.reports[c];
    MPI_Comm_size(system_->communicator(), &report.ranks);
    report.nodes = static_cast<int>(mesh_.points.size());
    report.unknowns = system_->size();
    report.method = chosen_.method == Method::direct ? "direct" : "iterative";
    report.reason = chosen_.reason;
    report.expected_peak = chosen_.expected_peak;
    report.cases_sharing = static_cast<int>(members.size());
  }
  job.reports[members.front()].first_of_sharing = true;
}

void SharedStiffness::solve(const std::vector<std::size_t>& members) {
  const Body* body = job_.options.body.get();
  const Release release =
      body ? release_of(*body) : make_release(mesh_, job_.cases[members.front()].parameters);
  chosen_.solver->set_release(release);
  if (!checked_) {
    check_rounding(*system_, chosen_);
    checked_ = true;
    if (has_compliance(mesh_)) {
      job_.progress("compliance of the skin");
      compliance_ = compliance_of(mesh_, *system_, *chosen_.solver);
    }
    phases_.end("compliance");
  }
  if (job_.cases[members.front()].parameters.model == Model::finite) {
    for (const std::size_t number : members) solve_finite_series(*this, release, number);
    estimate(members);
    return;
  }
  const std::size_t iterations_before = chosen_.solver->iterations().size();
  // Few enough files open at a time.
  constexpr std::size_t at_once = 64;
  for (std::size_t first = 0; first < members.size(); first += at_once) {
    const std::size_t end = std::min(members.size(), first + at_once);
    CaseBatch batch(*this, release,
                    {members.begin() + static_cast<long>(first), members.begin() + static_cast<long>(end)});
    batch.solve();
  }
  estimate(members);
  const std::vector<int> iterations = chosen_.solver->iterations();
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
          : expected_error(job_.cases[members.front()].parameters, first.gape, job_.communicator);
  for (const std::size_t c : members) job_.reports[c].estimate = estimate;
  phases_.end("estimate");
}

}  // namespace cleft
