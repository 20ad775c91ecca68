#include "solver/cut_series.h"

#include <algorithm>

#include "solver/elimination_order.h"

namespace cleft {

namespace {

std::vector<int> cut_unknowns(const PatchMesh& mesh, const PatchSystem& system) {
  std::vector<int> unknowns;
  for (const int side : {0, 1})
    for (const auto& pair : mesh.pairs)
      for (int axis = 0; axis < 3; ++axis) unknowns.push_back(system.unknown(pair[side], axis));
  return unknowns;
}

/// The load that reaches the cut's unknowns, g = f_c - K_ci K_ii^-1 f_i; rank 0.
Eigen::VectorXd condensed_load(const PatchSystem& system, CondensedFactor& factor,
                               const std::vector<int>& unknowns) {
  const bool root = system.load().size() > 0;
  Eigen::MatrixXd interior = system.load();
  factor.solve(interior);
  const Eigen::VectorXd carried = system.multiply(interior);
  if (!root) return {};
  return system.load()(unknowns) - carried(unknowns);
}

}  // namespace

CutSeries::CutSeries(const PatchMesh& mesh, const PatchSystem& system)
    : mesh_(mesh),
      system_(system),
      cut_unknowns_(cut_unknowns(mesh, system)),
      factor_(system, cut_unknowns_, elimination_order(mesh, system, cut_unknowns_)),
      opening_(factor_.schur(), condensed_load(system, factor_, cut_unknowns_)) {}

Eigen::MatrixXd CutSeries::frames(int first, int count) {
  const bool root = system_.load().size() > 0;
  Eigen::MatrixXd at_cut, solution;
  if (root) {
    at_cut = Eigen::MatrixXd::Zero(system_.size(), count);
    for (int j = 0; j < count; ++j)
      at_cut(cut_unknowns_, j) = opening_.displacement(3 * mesh_.released[first + j]);
  }
  solution = -system_.multiply(at_cut);
  if (root) solution.colwise() += system_.load();
  factor_.solve(solution);  // K_ii u_i = f_i - K_ic u_c
  return solution += at_cut;
}

std::vector<FrameFigures> CutSeries::figures(int first, const Eigen::MatrixXd& frames) const {
  const Eigen::MatrixXd product = system_.multiply(frames);
  std::vector<FrameFigures> figures(static_cast<std::size_t>(frames.cols()));
  for (Eigen::Index j = 0; j < frames.cols(); ++j) {
    FrameFigures& f = figures[static_cast<std::size_t>(j)];
    const int released = mesh_.released[static_cast<std::size_t>(first + j)];
    Eigen::VectorXd residual = system_.load() - product.col(j);
    for (std::size_t p = 0; p < mesh_.pairs.size(); ++p)
      for (int axis = 0; axis < 3; ++axis) {
        const int left = system_.unknown(mesh_.pairs[p][0], axis),
                  right = system_.unknown(mesh_.pairs[p][1], axis);
        const double gap = frames(right, j) - frames(left, j);
        if (static_cast<int>(p) >= released) {  // closed: the two share their forces
          residual(left) += residual(right);
          residual(right) = 0;
          f.residual_closure = std::max(f.residual_closure, std::abs(gap));
        } else if (axis == 1) {
          f.smallest_gap = p == 0 ? gap : std::min(f.smallest_gap, gap);
        }
      }
    const auto relative = [](double value, double scale) { return scale > 0 ? value / scale : value; };
    f.residual_equilibrium = relative(residual.cwiseAbs().maxCoeff(), system_.load().cwiseAbs().maxCoeff());
    f.residual_closure = relative(f.residual_closure, frames.col(j).cwiseAbs().maxCoeff());
  }
  return figures;
}

}  // namespace cleft
