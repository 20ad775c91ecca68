#include "solver/solve.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/output_file.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "params/sensitivities.h"
#include "params/stiffness.h"
#include "solver/compliance.h"
#include "solver/frame_figures.h"
#include "solver/node_gather.h"
#include "solver/phases.h"
#include "solver/snapshot_output.h"

namespace cleft {

namespace {

constexpr double largest_residual = 1e-6;  // of the loads: beyond it the numbers mean nothing
constexpr double block_bytes = 6e7;        // of the displacements held at a time, by all ranks
constexpr int most_frames = 24;            // held at a time
constexpr int most_units = 3;              // series of unit prestresses, which these are made of
constexpr const char* prestress_names[] = {"skin.prestress_u", "skin.prestress_v", "skin.prestress_uv"};

Eigen::Vector3d prestress(const Parameters& p) {
  return {p.skin.prestress_u, p.skin.prestress_v, p.skin.prestress_uv};
}

/// How the cut opens in a given mesh.
std::string release_key(const Parameters& p) {
  return shortest(p.cut.length) + ";" + shortest(p.cut.depth) + ";" + p.cut.frames;
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

/// All cases of one K.
class SharedStiffness {
 public:
  SharedStiffness(const std::vector<CaseToSolve>& cases, const std::vector<std::size_t>& members,
                  const SolveOptions& options, MPI_Comm communicator,
                  const std::function<void(const std::string&)>& progress, std::vector<SolveReport>& reports)
      : cases_(cases), options_(options), progress_(progress), reports_(reports), phases_(communicator) {
    const Parameters& parameters = cases[members.front()].parameters;
    progress_("meshing and assembling");
    mesh_ = make_patch_mesh(parameters);
    system_.emplace(mesh_, parameters, communicator, options.discretization);
    residual_.emplace(mesh_, *system_);
    phases_.end("assemble");
    chosen_ = make_frame_solver(mesh_, *system_, options.method, progress);
    phases_.end(chosen_.method == Method::direct ? "factor" : "set up");
    for (const std::size_t c : members) describe_shared(reports_[c], static_cast<int>(members.size()));
    reports_[members.front()].first_of_sharing = true;
  }

  /// Cases whose cut opens alike.
  void solve(const std::vector<std::size_t>& members);

  const std::vector<Phase>& phases() const { return phases_.list; }

 private:
  class Batch;

  void describe_shared(SolveReport& report, int sharing) const {
    MPI_Comm_size(system_->communicator(), &report.ranks);
    report.nodes = static_cast<int>(mesh_.points.size());
    report.unknowns = system_->size();
    report.method = chosen_.method == Method::direct ? "direct" : "iterative";
    report.reason = chosen_.reason;
    report.cases_sharing = sharing;
  }

  const std::vector<CaseToSolve>& cases_;
  const SolveOptions& options_;
  const std::function<void(const std::string&)>& progress_;
  std::vector<SolveReport>& reports_;
  Phases phases_;
  PatchMesh mesh_;
  std::optional<PatchSystem> system_;
  std::optional<FrameResidual> residual_;
  ChosenSolver chosen_;
  Compliance compliance_;
};

/// Cases of one K and one release, written together.
class SharedStiffness::Batch {
 public:
  Batch(SharedStiffness& shared, const Release& release, const std::vector<std::size_t>& members)
      : shared_(shared), system_(*shared.system_), release_(release) {
    choose_loads(members);
    for (const std::size_t c : members) open_case(c);
  }

  void solve() {
    const int frames = static_cast<int>(release_.released.size());
    // By the mesh alone: rounding depends on how many frames are solved together, and a case must not depend
    // on the others. (Iterations go column by column.)
    const auto width = by_units_ ? most_units : std::max(most_units, static_cast<int>(loads_.cols()));
    const double frame_bytes = 8. * std::max(1, system_.size()) * width;
    const int at_once = std::clamp(static_cast<int>(block_bytes / frame_bytes), 1, most_frames);
    shared_.chosen_.solver->set_loads(loads_, FrameSolver::Together::each);
    const Stopwatch watch;
    for (int first = 0; first < frames; first += at_once) {
      const int count = std::min(at_once, frames - first);
      const double spent = watch.seconds();
      shared_.progress_(
          "frame " + std::to_string(first) + " of " + std::to_string(frames) +
          (first > 0 ? ", " + std::to_string(std::lround(spent / first * (frames - first))) + " s left"
                     : std::string()));
      solve_block(first, count);
    }
    for (Member& member : members_)
      if (member.writing) {
        member.writing->finish();
        shared_.reports_[member.number].written = true;
      }
    shared_.phases_.end("write");
  }

 private:
  struct Member {
    std::size_t number;                       // among all cases
    Eigen::VectorXd share;                    // of every load
    double largest_load = 0;                  // N
    std::unique_ptr<SnapshotOutput> writing;  // none once the case has failed
    std::vector<Vec3> closed;                 // frame 0, this rank's nodes
    std::size_t part = 0;                     // the part whose loads it is a sum of
  };

  /// Some loads' frames of a block, load after load.
  struct LoadFrames {
    std::size_t begin, end;  // the loads
    Block displacements, left_over;
  };

  const Parameters& parameters(const Member& member) const {
    return shared_.cases_[member.number].parameters;
  }

  /// With a factor, unit prestresses, of which the frames of every case are sums, also where there is one
  /// case only, so that it comes out as among others. By iterations every case's own load, which takes no
  /// more of them than a unit prestress. With contact a series is not linear, and solved for itself.
  void choose_loads(const std::vector<std::size_t>& members) {
    const auto& cases = shared_.cases_;
    const auto linear = [&](std::size_t c) { return cases[c].parameters.cut.contact != "true"; };
    by_units_ = shared_.chosen_.method == Method::direct || shared_.options_.unit_prestress;
    std::vector<Eigen::VectorXd> columns;
    if (by_units_) {
      Eigen::Vector3d used = Eigen::Vector3d::Constant(shared_.options_.unit_prestress ? 1. : 0.);
      for (const std::size_t c : members)
        if (linear(c)) used += prestress(cases[c].parameters).cwiseAbs();
      for (int d = 0; d < 3; ++d)
        if (used(d) > 0) {
          units_.push_back(d);
          columns.emplace_back(system_.unit_loads().col(d));
        }
    }
    parts_.emplace_back(0, columns.size());
    contact_.assign(columns.size(), false);
    for (const std::size_t c : members) {
      Member member{c, Eigen::VectorXd(), 0, nullptr, {}, 0};
      if (!by_units_ || !linear(c)) {
        columns.emplace_back(system_.load(cases[c].parameters.skin));
        contact_.push_back(!linear(c));
        if (by_units_) {
          member.part = parts_.size();
          parts_.emplace_back(columns.size() - 1, columns.size());
        } else {
          parts_.front().second = columns.size();
        }
      }
      members_.push_back(std::move(member));
    }
    loads_.resize(system_.owned(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) loads_.col(static_cast<Eigen::Index>(i)) = columns[i];
    Eigen::Index own = static_cast<Eigen::Index>(units_.size());
    for (Member& member : members_) {
      member.share = Eigen::VectorXd::Zero(loads_.cols());
      if (!by_units_ || !linear(member.number))
        member.share(own++) = 1;
      else
        for (std::size_t i = 0; i < units_.size(); ++i)
          member.share(static_cast<Eigen::Index>(i)) = prestress(parameters(member))(units_[i]);
      const Eigen::VectorXd load = loads_ * member.share;
      member.largest_load = load.size() > 0 ? load.cwiseAbs().maxCoeff() : 0;
      MPI_Allreduce(MPI_IN_PLACE, &member.largest_load, 1, MPI_DOUBLE, MPI_MAX, system_.communicator());
    }
  }

  void open_case(std::size_t c) {
    Member& member =
        *std::find_if(members_.begin(), members_.end(), [c](const Member& m) { return m.number == c; });
    SolveReport& report = shared_.reports_[c];
    report.pairs = static_cast<int>(shared_.mesh_.pairs.size());
    report.constraints = 3 * report.pairs;
    report.frames = static_cast<int>(release_.released.size());
    std::vector<SnapshotArray> arrays = {{"compliance", 1, false}, {"dent", 3, false}};
    for (const std::string& name : derivatives()) arrays.push_back({array_of(name), 3, true});
    member.writing = std::make_unique<SnapshotOutput>(shared_.cases_[c].out,
                                                      describe(parameters(member), shared_.mesh_, release_),
                                                      arrays, system_.communicator());
    member.writing->write_scalars("compliance", shared_.compliance_.at_node);
    member.writing->write_vectors("dent", 0, at_nodes(shared_.compliance_.dent.data()));
    shared_.phases_.end("write");
  }

  /// On rank 0; collective.
  std::vector<Vec3> at_nodes(const double* column) const {
    return gather_nodes(system_, shared_.mesh_.points.size(), column);
  }

  static std::string array_of(const std::string& parameter) { return "displacement_per_" + parameter; }

  std::vector<std::string> derivatives() const {
    std::vector<std::string> names = shared_.options_.sensitivities;
    if (shared_.options_.unit_prestress)
      names.insert(names.end(), std::begin(prestress_names), std::end(prestress_names));
    return names;
  }

  void solve_block(int first, int count) {
    for (std::size_t part = 0; part < parts_.size(); ++part) solve_block(first, count, part);
    if (!shared_.options_.sensitivities.empty())
      shared_.chosen_.solver->set_loads(loads_, FrameSolver::Together::each);
  }

  /// Frames of a part of the loads, and with them those of the cases made of these.
  void solve_block(int first, int count, std::size_t part) {
    const auto [begin, end] = parts_[part];
    std::vector<FrameSolver::Column> columns;
    for (std::size_t load = begin; load < end; ++load)
      for (int j = first; j < first + count; ++j)
        columns.push_back({static_cast<int>(load), release_.released[j], contact_[load], 1e-10});
    LoadFrames frames{begin, end, shared_.chosen_.solver->solve(columns), {}};
    Block expanded(loads_.rows(), frames.displacements.cols());
    for (std::size_t c = 0; c < columns.size(); ++c)
      expanded.col(static_cast<Eigen::Index>(c)) = loads_.col(columns[c].load);
    frames.left_over = shared_.residual_->left_over(expanded, frames.displacements);
    expanded.resize(0, 0);
    shared_.phases_.end("frames");
    for (Member& member : members_)
      if (member.writing && member.part == part) finish_block(member, first, count, frames);
  }

  /// A case's part of a block: sums of its loads' frames.
  void finish_block(Member& member, int first, Eigen::Index count, const LoadFrames& loads) {
    std::vector<FrameSolver::Column> columns;
    for (Eigen::Index j = first; j < first + count; ++j)
      columns.push_back({0, release_.released[j], parameters(member).cut.contact == "true", 1e-10});
    const auto combined = [&](const Block& block) {
      Block sum = Block::Zero(block.rows(), count);
      for (std::size_t load = loads.begin; load < loads.end; ++load)
        if (const double share = member.share(static_cast<Eigen::Index>(load)); share != 0)
          sum += share * block.middleCols(static_cast<Eigen::Index>(load - loads.begin) * count, count);
      return sum;
    };
    const Block frames = combined(loads.displacements);
    const std::vector<FrameFigures> figures =
        shared_.residual_->figures(release_, columns, frames, combined(loads.left_over), member.largest_load);
    shared_.phases_.end("frames");
    if (!add_figures(member, figures)) return;
    for (Eigen::Index j = 0; j < count; ++j) {
      const std::vector<Vec3> nodes = at_nodes(frames.col(j).data());
      if (first + j == 0) member.closed = nodes;
      add_largest(member, nodes);
      member.writing->write_vectors("displacement", static_cast<std::size_t>(first + j), nodes);
    }
    for (std::size_t i = 0; shared_.options_.unit_prestress && i < units_.size(); ++i)
      write_derivative(member, prestress_names[units_[i]], first,
                       loads.displacements.middleCols(static_cast<Eigen::Index>(i) * count, count));
    shared_.phases_.end("write");
    for (const std::string& name : shared_.options_.sensitivities) {
      progress_of(name, first);
      write_derivative(member, name, first, sensitivity(member, name, columns, frames));
      shared_.phases_.end("sensitivities");
    }
  }

  void progress_of(const std::string& name, int first) const {
    shared_.progress_("sensitivity to " + name + ", frame " + std::to_string(first) + " of " +
                      std::to_string(release_.released.size()));
  }

  /// K u + C^T v = f differentiated: the same system under df/dp - dK/dp u.
  Block sensitivity(const Member& member, const std::string& name, std::vector<FrameSolver::Column> columns,
                    const Block& frames) {
    auto& derivative = derivatives_[name + "/" + std::to_string(member.number)];
    if (!derivative) derivative = system_.derivative(parameters(member), name);
    Block loads = -derivative->multiply(frames);
    loads.colwise() += Eigen::VectorXd(derivative->load().col(0));
    Block solution(frames.rows(), frames.cols());
    constexpr Eigen::Index at_once = 16;  // these loads are full
    for (Eigen::Index c = 0; c < frames.cols(); c += at_once) {
      const Eigen::Index count = std::min(at_once, frames.cols() - c);
      std::vector<FrameSolver::Column> some(columns.begin() + c, columns.begin() + c + count);
      for (Eigen::Index i = 0; i < count; ++i) some[i].load = static_cast<int>(i);
      shared_.chosen_.solver->set_loads(loads.middleCols(c, count));
      solution.middleCols(c, count) = shared_.chosen_.solver->solve(some);
    }
    return solution;
  }

  void write_derivative(Member& member, const std::string& name, int first, const Block& frames) {
    for (Eigen::Index j = 0; j < frames.cols(); ++j)
      member.writing->write_vectors(array_of(name), static_cast<std::size_t>(first + j),
                                    at_nodes(frames.col(j).data()));
  }

  /// Largest displacement from frame 0.
  void add_largest(const Member& member, const std::vector<Vec3>& nodes) const {
    double largest = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      largest = std::max(largest, norm(nodes[n] - member.closed[n]));
    MPI_Bcast(&largest, 1, MPI_DOUBLE, 0, system_.communicator());
    double& of_case = shared_.reports_[member.number].largest_displacement;
    of_case = std::max(of_case, largest);
  }

  /// Whether the case continues.
  bool add_figures(Member& member, const std::vector<FrameFigures>& figures) {
    SolveReport& report = shared_.reports_[member.number];
    for (const FrameFigures& f : figures) {
      const std::size_t number = member.writing->frames_with_figures();
      member.writing->add_figures(f);
      if (number == 1 || (number > 1 && f.smallest_gap < report.smallest_gap))
        report.smallest_gap = f.smallest_gap;
      if (!(f.residual_equilibrium < largest_residual) || !std::isfinite(f.gape)) {
        const std::string frame = "frame " + std::to_string(number);
        report.failure =
            (std::isfinite(f.gape) ? "the forces of " + frame + " do not balance (relative residual " +
                                         shortest(f.residual_equilibrium) + ")"
                                   : "the displacements of " + frame + " overflow") +
            ": the parameters differ by too many orders of magnitude";
        member.writing.reset();
        return false;
      }
      report.gape = f.gape;
      report.worst_equilibrium = std::max(report.worst_equilibrium, f.residual_equilibrium);
      report.worst_closure = std::max(report.worst_closure, f.residual_closure);
    }
    return true;
  }

  SharedStiffness& shared_;
  const PatchSystem& system_;
  const Release& release_;
  bool by_units_ = false;
  std::vector<int> units_;                                  // directions of the first loads
  std::vector<std::pair<std::size_t, std::size_t>> parts_;  // of the loads: solved in one go
  std::vector<bool> contact_;                               // by load
  Block loads_;
  std::vector<Member> members_;
  std::map<std::string, std::unique_ptr<PatchSystem::Derivative>> derivatives_;
};

void SharedStiffness::solve(const std::vector<std::size_t>& members) {
  const Release release = make_release(mesh_, cases_[members.front()].parameters);
  chosen_.solver->set_release(release);
  if (compliance_.at_node.empty() && compliance_.dent.size() == 0) {
    check_rounding(*system_, chosen_);
    progress_("compliance of the skin");
    compliance_ = compliance_of(mesh_, *system_, *chosen_.solver);
    phases_.end("compliance");
  }
  const std::size_t iterations_before = chosen_.solver->iterations().size();
  // Few enough files open at a time.
  constexpr std::size_t at_once = 64;
  for (std::size_t first = 0; first < members.size(); first += at_once) {
    const std::size_t end = std::min(members.size(), first + at_once);
    Batch batch(*this, release,
                {members.begin() + static_cast<long>(first), members.begin() + static_cast<long>(end)});
    batch.solve();
  }
  const std::vector<int> iterations = chosen_.solver->iterations();
  reports_[members.front()].iterations.assign(iterations.begin() + static_cast<long>(iterations_before),
                                              iterations.end());
}

}  // namespace

void check_options(const Parameters& p, const SolveOptions& options, const std::string& where) {
  const bool contact = p.cut.contact == "true", tense = p.skin.initial_stress_stiffness == "true";
  if (options.unit_prestress && (contact || tense))
    throw InputError(where + ": --unit-prestress: the series is not linear in the prestress with " +
                     (contact ? "cut.contact" : "skin.initial_stress_stiffness") +
                     " = true; set it to false");
  if (options.method == Method::iterative && contact)
    throw InputError(where +
                     ": --method iterative: contact is found with the factor; set cut.contact to false, or "
                     "use --method direct");
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
  std::vector<std::size_t> all;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    check_options(cases[c].parameters, options, cases[c].out);
    const OutputFile probe(cases[c].out);  // reports a bad name before the work, on every rank
    reports[c].out = cases[c].out;
    all.push_back(c);
  }
  const auto stiffness = [&](std::size_t c) { return stiffness_key(cases[c].parameters); };
  for (const auto& group : grouped(all, stiffness)) {
    const auto fail = [&](const std::vector<std::size_t>& members, const std::string& why) {
      for (const std::size_t c : members)
        if (reports[c].failure.empty() && !reports[c].written) reports[c].failure = why;
    };
    try {
      SharedStiffness shared(cases, group, options, communicator, progress, reports);

      for (const auto& members :
           grouped(group, [&](std::size_t c) { return release_key(cases[c].parameters); }))
        try {
          shared.solve(members);
        } catch (const SolveError& e) {
          fail(members, e.what());
        }
      reports[group.front()].phases = shared.phases();
    } catch (const SolveError& e) {
      fail(group, e.what());
    } catch (const InputError& e) {
      if (cases.size() == 1) throw;
      fail(group, e.what());
    }
  }
  return reports;
}

}  // namespace cleft
