#include "solver/case_batch.h"

#include <algorithm>
#include <cmath>

#include "base/stopwatch.h"
#include "solver/block_rows.h"
#include "solver/cut_nodes.h"
#include "solver/multigrid/lanes.h"

namespace cleft {

namespace {

constexpr double block_bytes = 6e7;  // of the displacements held at a time, by all ranks
constexpr int most_frames = 24;      // held at a time

std::vector<const Parameters*> parameters_of(const std::vector<CaseToSolve>& cases,
                                             const std::vector<std::size_t>& members) {
  std::vector<const Parameters*> parameters;
  for (const std::size_t c : members) parameters.push_back(&cases[c].parameters);
  return parameters;
}

}  // namespace

/// With a factor, unit prestresses also where there is one case only, so that it comes out as among others.
/// By iterations every case's own load, which takes no more of them than a unit prestress.
CaseBatch::CaseBatch(SharedStiffness& shared, const Release& release, const std::vector<std::size_t>& members)
    : shared_(shared),
      options_(shared.job().options),
      system_(shared.system()),
      solver_(*shared.chosen().solver),
      release_(release),
      loads_(system_, parameters_of(shared.job().cases, members),
             shared.chosen().method == Method::direct || options_.unit_prestress, options_.unit_prestress) {
  for (std::size_t i = 0; i < members.size(); ++i)
    members_.push_back({members[i], &loads_.cases[i],
                        std::make_unique<CaseOutput>(shared_, release_, members[i], derivatives())});
}

void CaseBatch::solve() {
  const int frames = static_cast<int>(release_.released.size());
  // By the mesh alone: rounding depends on how many frames are solved together, and a case must not depend
  // on the others. (Iterations take as many frames of a load at a time as they have lanes.)
  const auto width =
      loads_.by_units ? most_units : std::max(most_units, static_cast<int>(loads_.loads.cols()));
  const double frame_bytes = 8. * std::max(1, system_.size()) * width;
  const bool by_iterations = shared_.chosen().method == Method::iterative;
  const int at_once =
      std::clamp(static_cast<int>(block_bytes / frame_bytes), by_iterations ? most_lanes : 1, most_frames);
  solver_.set_loads(loads_.loads, FrameSolver::Together::each);
  const Stopwatch watch;
  for (int first = 0; first < frames; first += at_once) {
    const int count = std::min(at_once, frames - first);
    const double spent = watch.seconds();
    shared_.job().progress(
        "frame " + std::to_string(first + 1) + " of " + std::to_string(frames) +
        (first > 0 ? ", " + std::to_string(std::lround(spent / first * (frames - first))) + " s left"
                   : std::string()));
    solve_block(first, count);
  }
  for (Member& member : members_)
    if (member.output->continues()) member.output->finish();
  shared_.phases().end("write");
}

/// Parameters by which the series is differentiated in every snapshot.
std::vector<std::string> CaseBatch::derivatives() const {
  std::vector<std::string> names = options_.sensitivities;
  if (options_.unit_prestress)
    for (const std::string& name : prestress_names()) names.push_back(name);
  return names;
}

void CaseBatch::solve_block(int first, int count) {
  for (std::size_t part = 0; part < loads_.parts.size(); ++part) solve_block(first, count, part);
  if (!options_.sensitivities.empty()) solver_.set_loads(loads_.loads, FrameSolver::Together::each);
}

/// Frames of a part of the loads, and with them those of the cases made of these.
void CaseBatch::solve_block(int first, int count, std::size_t part) {
  const auto [begin, end] = loads_.parts[part];
  std::vector<FrameSolver::Column> columns;
  for (std::size_t load = begin; load < end; ++load)
    for (int j = first; j < first + count; ++j)
      columns.push_back({static_cast<int>(load), release_.released[j], loads_.contact[load], 1e-10});
  LoadFrames frames{begin, end, solver_.solve(columns), {}};
  Block expanded(loads_.loads.rows(), frames.displacements.cols());
  for (std::size_t c = 0; c < columns.size(); ++c)
    expanded.col(static_cast<Eigen::Index>(c)) = loads_.loads.col(columns[c].load);
  frames.left_over = shared_.residual().left_over(expanded, frames.displacements);
  expanded.resize(0, 0);
  shared_.phases().end("frames");
  for (Member& member : members_)
    if (member.output->continues() && member.loads->part == part) finish_block(member, first, count, frames);
}

/// A case's part of a block: sums of its loads' frames.
void CaseBatch::finish_block(Member& member, int first, Eigen::Index count, const LoadFrames& loads) {
  std::vector<FrameSolver::Column> columns;
  for (Eigen::Index j = first; j < first + count; ++j)
    columns.push_back({0, release_.released[j], member.output->parameters().cut.contact, 1e-10});
  const auto combined = [&](const Block& block) {
    Block sum = Block::Zero(block.rows(), count);
    for (std::size_t load = loads.begin; load < loads.end; ++load)
      if (const double share = member.loads->share(static_cast<Eigen::Index>(load)); share != 0)
        sum += share * block.middleCols(static_cast<Eigen::Index>(load - loads.begin) * count, count);
    return sum;
  };
  const Block frames = combined(loads.displacements);
  const std::vector<FrameFigures> figures = shared_.residual().figures(
      release_, columns, frames, combined(loads.left_over), member.loads->largest_load);
  shared_.phases().end("frames");
  member.output->add_figures(figures);
  if (!member.output->continues()) return;
  member.output->write_frames(first, frames);
  for (std::size_t i = 0; options_.unit_prestress && i < loads_.units.size(); ++i)
    member.output->write_derivative(
        prestress_names()[loads_.units[i]], first,
        loads.displacements.middleCols(static_cast<Eigen::Index>(i) * count, count));
  shared_.phases().end("write");
  if (options_.sensitivities.empty()) return;
  const std::vector<FrameSolver::Frame> opened = frames_of(columns, frames);
  for (const std::string& name : options_.sensitivities) {
    shared_.job().progress("sensitivity to " + name + ", frame " + std::to_string(first) + " of " +
                           std::to_string(release_.released.size()));
    member.output->write_derivative(name, first, sensitivity(member, name, opened, frames));
    shared_.phases().end("sensitivities");
  }
}

/// K u + C^T v = f differentiated: the same system under df/dp - dK/dp u. Lips that press on each other
/// slide: where some are about to touch or to part, it is the derivative as long as they do not.
Block CaseBatch::sensitivity(const Member& member, const std::string& name,
                             const std::vector<FrameSolver::Frame>& opened, const Block& frames) {
  auto& derivative = derivatives_[name + "/" + std::to_string(member.number)];
  if (!derivative) derivative = system_.derivative(member.output->parameters(), name);
  Block loads = -derivative->multiply(frames);
  loads.colwise() += Eigen::VectorXd(derivative->load().col(0));
  Block solution(frames.rows(), frames.cols());
  constexpr Eigen::Index at_once = 16;  // these loads are full
  for (Eigen::Index c = 0; c < frames.cols(); c += at_once) {
    const Eigen::Index count = std::min(at_once, frames.cols() - c);
    const std::vector<FrameSolver::Frame> some(opened.begin() + c, opened.begin() + c + count);
    solution.middleCols(c, count) = solver_.solve_each(loads.middleCols(c, count), some);
  }
  return solution;
}

/// With contact, pairs touch that have no opening along their normals.
std::vector<FrameSolver::Frame> CaseBatch::frames_of(const std::vector<FrameSolver::Column>& columns,
                                                     const Block& displacements) const {
  constexpr double nothing = 1e-9;  // of the largest displacement at the cut
  std::vector<FrameSolver::Frame> frames;
  frames.reserve(columns.size());
  for (const FrameSolver::Column& column : columns) frames.push_back({column.open, {}});
  if (!columns.front().contact) return frames;
  const CutNodes cut(shared_.mesh(), system_);
  const Eigen::MatrixXd at_cut = all_gather_rows(system_, displacements, cut.unknowns);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Eigen::VectorXd own = at_cut.col(static_cast<Eigen::Index>(f));
    const double least = nothing * own.cwiseAbs().maxCoeff();
    FrameSolver::Touching& touching = frames[f].touching;
    for (int i = 0; i < frames[f].open; ++i) {
      const int pair = release_.order[i];
      const auto [left, right] = cut.pairs[pair];
      const Vec3& n = shared_.mesh().pairs[pair].normal;
      const Eigen::Vector3d jump = own.segment<3>(3 * right) - own.segment<3>(3 * left);
      if (Eigen::Vector3d(n.x, n.y, n.z).dot(jump) <= least) touching.places.push_back(i);
    }
    touching.openings = Eigen::VectorXd::Zero(std::ssize(touching.places));
  }
  return frames;
}

}  // namespace cleft
