#include "solver/solve.h"

#include <algorithm>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "params/parameters/table.h"
#include "params/sensitivities.h"
#include "params/stiffness.h"
#include "solver/body_mesh.h"
#include "solver/shared_stiffness.h"

namespace cleft {

namespace {

/// How the cut opens in a given mesh.
std::string release_key(const Parameters& p) {
  return shortest(p.cut.length) + ";" + shortest(p.cut.depth) + ";" + text_of(p, p.cut.frames);
}

/// Options that the finite model does not have.
void check_finite(const Parameters& p, const SolveOptions& options, const std::string& where) {
  const std::string finite = row_of(p, p.model).name + " = finite";
  if (options.unit_prestress)
    throw InputError(where + ": --unit-prestress: the series is not linear in the prestress with " + finite +
                     "; vary the prestress in a study");
  if (options.method == Method::iterative)
    throw InputError(where + ": --method iterative: " + finite +
                     " needs the factor; use --method direct, or raise mesh.element_size");
}

/// Indices of the cases, together where their keys are equal.
template <class Key>
std::vector<std::vector<std::size_t>> grouped(const std::vector<std::size_t>& cases, const Key& key) {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;
  for (const std::size_t c : cases) {
    const std::string k = key(c);
    auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == k; });
    if (found == groups.end()) found = groups.insert(groups.end(), {k, {}});
    found->second.push_back(c);
  }
  std::vector<std::vector<std::size_t>> result;
  for (auto& group : groups) result.push_back(std::move(group.second));
  return result;
}

/// Cases of one K.
void solve_group(SolveJob& job, const std::vector<std::size_t>& group, KeptPatches* kept) {
  const auto fail = [&](const std::vector<std::size_t>& members, const std::string& why) {
    for (const std::size_t c : members)
      if (job.reports[c].failure.empty() && !job.reports[c].written) job.reports[c].failure = why;
  };
  try {
    SharedStiffness shared(job, group, kept);
    for (const auto& members :
         grouped(group, [&](std::size_t c) { return release_key(job.cases[c].parameters); }))
      try {
        shared.solve(members);
      } catch (const SolveError& e) {
        fail(members, e.what());
      }
    job.reports[group.front()].phases = shared.phases().list;
  } catch (const SolveError& e) {
    fail(group, e.what());
  } catch (const InputError& e) {
    if (job.cases.size() == 1) throw;
    fail(group, e.what());
  }
}

}  // namespace

void check_options(const Parameters& p, const SolveOptions& options, const std::string& where) {
  const bool contact = p.cut.contact;
  if (options.unit_prestress && (contact || is_stiffened_by_prestress(p))) {
    const PrestressSetting setting =
        contact ? PrestressSetting{row_of(p, p.cut.contact).name + " = true", "false"} : prestress_setting(p);
    throw InputError(where + ": --unit-prestress: the series is not linear in the prestress with " +
                     setting.text + "; set it to " + setting.without);
  }
  if (options.method == Method::iterative && contact)
    throw InputError(where +
                     ": --method iterative: contact is found with the factor; set cut.contact to false, or "
                     "use --method direct");
  if (p.model == Model::finite) check_finite(p, options, where);
  if (options.body) check_body_case(*options.body, p, where);
  check_sensitivities(options.sensitivities, p, where + ": --sensitivities");
  for (const std::string& name : options.sensitivities)
    if (options.unit_prestress && name.find("prestress") != std::string::npos)
      throw InputError(where + ": --sensitivities " + name +
                       ": --unit-prestress writes it already; leave one out");
}

std::vector<SolveReport> solve_cases(const std::vector<CaseToSolve>& cases, const SolveOptions& options,
                                     MPI_Comm communicator,
                                     const std::function<void(const std::string&)>& progress) {
  std::vector<SolveReport> reports(cases.size());
  SolveJob job{cases, options, communicator, progress, reports};
  std::vector<std::size_t> all;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    check_options(cases[c].parameters, options, cases[c].out);
    const OutputFile probe(cases[c].out);  // reports a bad name before the work, on every rank
    reports[c].out = cases[c].out;
    all.push_back(c);
  }
  const auto stiffness = [&](std::size_t c) { return stiffness_key(cases[c].parameters); };
  const auto pattern = [&](std::size_t c) { return pattern_key(cases[c].parameters); };
  for (const auto& of_mesh : grouped(all, pattern)) {
    KeptPatches kept;
    const auto groups = grouped(of_mesh, stiffness);
    for (const auto& group : groups) solve_group(job, group, groups.size() > 1 ? &kept : nullptr);
  }
  return reports;
}

}  // namespace cleft
