#include "solver/frame_figures.h"

#include <algorithm>
#include <cmath>

#include "solver/block_rows.h"

namespace cleft {

FrameResidual::FrameResidual(const PatchMesh& mesh, const PatchSystem& system)
    : mesh_(mesh), system_(system), cut_(mesh, system), in_face_(in_faces(mesh)) {}

FrameFigures FrameResidual::at_cut(const Release& release, const FrameSolver::Column& column,
                                   const Eigen::VectorXd& displacement, Eigen::VectorXd force) const {
  FrameFigures f;
  const std::vector<bool> closed = release.closed(column.open);
  bool any_open = false;
  for (std::size_t p = mesh_.pairs.size(); p-- > 0;) {  // a right node is the left one of later pairs only
    if (in_face_[mesh_.pairs[p].left]) continue;
    const int left = 3 * cut_.pairs[p][0], right = 3 * cut_.pairs[p][1];
    const Eigen::Vector3d jump = displacement.segment<3>(right) - displacement.segment<3>(left);
    const Eigen::Vector3d normal(mesh_.pairs[p].normal.x, mesh_.pairs[p].normal.y, mesh_.pairs[p].normal.z);
    Eigen::Vector3d shared = Eigen::Vector3d::Zero();
    if (closed[p]) {  // the two share their forces
      shared = force.segment<3>(right);
      f.residual_closure = std::max(f.residual_closure, jump.cwiseAbs().maxCoeff());
    } else {
      const double gap = normal.dot(jump);
      f.smallest_gap = any_open ? std::min(f.smallest_gap, gap) : gap;
      f.gape = std::max(f.gape, gap);
      any_open = true;
      if (column.contact) shared = normal * normal.dot(force.segment<3>(right));
    }
    force.segment<3>(left) += shared;
    force.segment<3>(right) -= shared;
  }
  f.residual_equilibrium = force.cwiseAbs().maxCoeff();
  return f;
}

std::vector<FrameFigures> FrameResidual::figures(const Release& release,
                                                 const std::vector<FrameSolver::Column>& columns,
                                                 const Block& displacements, const Block& left_over,
                                                 double largest_load) const {
  const Eigen::MatrixXd at = gather_rows(system_, displacements, cut_.unknowns);
  const Eigen::MatrixXd forces = gather_rows(system_, left_over, cut_.unknowns);
  std::vector<bool> of_cut(static_cast<std::size_t>(system_.owned()), false);
  for (const int unknown : cut_.unknowns)
    if (const int row = system_.row(unknown); row >= 0) of_cut[row] = true;
  const auto count = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(2, count);  // force elsewhere, displacement
  for (Eigen::Index c = 0; c < count; ++c)
    for (Eigen::Index i = 0; i < displacements.rows(); ++i) {
      if (!of_cut[i]) largest(0, c) = std::max(largest(0, c), std::abs(left_over(i, c)));
      largest(1, c) = std::max(largest(1, c), std::abs(displacements(i, c)));
    }
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_DOUBLE, MPI_MAX,
                system_.communicator());
  std::vector<FrameFigures> figures(columns.size());
  const auto relative = [](double value, double scale) { return scale > 0 ? value / scale : value; };
  for (Eigen::Index c = 0; c < count && system_.rank() == 0; ++c) {
    FrameFigures& f = figures[c];
    f = at_cut(release, columns[c], at.col(c), forces.col(c));
    f.residual_equilibrium = relative(std::max(f.residual_equilibrium, largest(0, c)), largest_load);
    f.residual_closure = relative(f.residual_closure, largest(1, c));
  }
  MPI_Bcast(figures.data(), static_cast<int>(figures.size() * sizeof(FrameFigures)), MPI_BYTE, 0,
            system_.communicator());
  return figures;
}

}  // namespace cleft
