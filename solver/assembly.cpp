#include "solver/assembly.h"

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/fe_wedge_p.h>

#include <algorithm>
#include <optional>
#include <span>

#include "params/parameters/springs_of_bone.h"
#include "solver/bending.h"
#include "solver/element_rules.h"
#include "solver/material/regions.h"
#include "solver/skin_triangle.h"

namespace cleft {

using namespace dealii;

namespace {

// A shape function of node a in direction d has number 3 a + d.

using Cell = DoFHandler<3>::active_cell_iterator;

/// The points of a cell. With `mean` its volume changes as a whole.
void read_points(const FEValues<3>& values, bool mean, std::vector<CellPoint>& points) {
  const unsigned nodes = values.dofs_per_cell / 3;
  points.resize(values.n_quadrature_points);
  std::vector<Tensor<1, 3>> mean_gradient(nodes);
  double volume = 0;
  for (unsigned q = 0; q < points.size(); ++q) {
    points[q].volume = values.JxW(q);
    points[q].nodes.resize(nodes);
    volume += values.JxW(q);
    for (unsigned a = 0; a < nodes; ++a) {
      const Tensor<1, 3>& gradient = values.shape_grad(3 * a, q);
      points[q].nodes[a] = {gradient, gradient};
      mean_gradient[a] += gradient * values.JxW(q);
    }
  }
  if (!mean) return;
  for (Tensor<1, 3>& gradient : mean_gradient) gradient = gradient / volume;
  for (CellPoint& point : points)
    for (unsigned a = 0; a < nodes; ++a) point.nodes[a].dilatation = mean_gradient[a];
}

/// Loads of the unit prestresses uu, vv, uv of the tissue: minus the integral of B^T, times the share.
void add_tissue_loads(std::span<const CellPoint> points, double share, FullMatrix<double>& cell_loads) {
  for (const CellPoint& point : points)
    for (unsigned a = 0; a < point.nodes.size(); ++a) {
      const Tensor<1, 3> force = -share * point.volume * point.nodes[a].strain;
      cell_loads(3 * a, 0) += force[0];
      cell_loads(3 * a + 1, 1) += force[1];
      cell_loads(3 * a, 2) += force[1];
      cell_loads(3 * a + 1, 2) += force[0];
    }
}

void add_springs(const FEFaceValues<3>& values, double spring, FullMatrix<double>& cell_matrix) {
  const unsigned nodes = values.dofs_per_cell / 3;
  for (const unsigned q : values.quadrature_point_indices())
    for (unsigned a = 0; a < nodes; ++a)
      for (unsigned b = 0; b < nodes; ++b) {
        const double k = spring * values.shape_value(3 * a, q) * values.shape_value(3 * b, q) * values.JxW(q);
        for (unsigned d = 0; d < 3; ++d) cell_matrix(3 * a + d, 3 * b + d) += k;
      }
}

SkinTriangle triangle_of(const Cell& cell, const std::array<int, 3>& corner, const Vec3& direction) {
  std::array<Vec3, 3> at;
  for (unsigned i = 0; i < 3; ++i) {
    const Point<3>& p = cell->vertex(corner[i]);
    at[i] = {p[0], p[1], p[2]};
  }
  return {at[0], at[1], at[2], direction};
}

/// In which directions displacements of skin are stiffened by its prestress, and by which share of it: in
/// all, along the normal of the plane that the axes span, or in none.
std::optional<Eigen::Matrix3d> stiffened(const Parameters& p, const Eigen::Matrix<double, 3, 2>& axes) {
  if (p.skin.initial_stress_stiffness) return Eigen::Matrix3d::Identity();
  if (p.skin.turning_stiffness == 0) return {};
  const Eigen::Vector3d normal = axes.col(0).cross(axes.col(1));
  return p.skin.turning_stiffness * normal * normal.transpose();
}

void add_skin(const SkinMaterial& skin, const std::optional<Eigen::Matrix3d>& stiffened,
              const SkinTriangle& triangle, const std::array<int, 3>& corner, FullMatrix<double>& cell_matrix,
              FullMatrix<double>& cell_loads) {
  const SkinTriangle::Matrix9 k = triangle.stiffness(skin);
  const SkinTriangle::Matrix93 f = triangle.unit_loads(skin);
  for (unsigned a = 0; a < 9; ++a) {
    const unsigned row = 3 * corner[a / 3] + a % 3;
    for (unsigned d = 0; d < 3; ++d) cell_loads(row, d) += f(a, d);
    for (unsigned b = 0; b < 9; ++b) cell_matrix(row, 3 * corner[b / 3] + b % 3) += k(a, b);
  }
  if (!stiffened) return;
  const Eigen::Matrix3d geometric = triangle.initial_stress_stiffness(skin);
  for (unsigned a = 0; a < 9; ++a)
    for (unsigned b = 0; b < 9; ++b)
      cell_matrix(3 * corner[a / 3] + a % 3, 3 * corner[b / 3] + b % 3) +=
          geometric(a / 3, b / 3) * (*stiffened)(a % 3, b % 3);
}

/// The same of a triangle in which displacements are quadratic, with the gradients at the points of a face.
void add_quadratic_skin(const SkinMaterial& skin, const std::optional<Eigen::Matrix3d>& stiffened,
                        const Eigen::Matrix<double, 3, 2>& axes, const FEFaceValues<3>& values,
                        FullMatrix<double>& cell_matrix, FullMatrix<double>& cell_loads) {
  const unsigned unknowns = values.dofs_per_cell;
  Eigen::Matrix2Xd gradients(2, unknowns / 3);
  Eigen::Matrix3Xd strain(3, unknowns);
  for (const unsigned q : values.quadrature_point_indices()) {
    const double volume = skin.thickness * values.JxW(q);
    for (unsigned a = 0; a < unknowns / 3; ++a) {
      const Tensor<1, 3>& g = values.shape_grad(3 * a, q);
      gradients.col(a) = axes.transpose() * Eigen::Vector3d(g[0], g[1], g[2]);
      const double u = gradients(0, a), v = gradients(1, a);
      strain.middleCols<3>(3 * a) << u * axes.col(0).transpose(), v * axes.col(1).transpose(),
          v * axes.col(0).transpose() + u * axes.col(1).transpose();
    }
    const Eigen::MatrixXd k = volume * strain.transpose() * skin.elasticity * strain;
    for (unsigned a = 0; a < unknowns; ++a) {
      for (unsigned d = 0; d < 3; ++d) cell_loads(a, d) -= volume * strain(d, a);
      for (unsigned b = 0; b < unknowns; ++b) cell_matrix(a, b) += k(a, b);
    }
    if (!stiffened) continue;
    const Eigen::MatrixXd geometric = volume * gradients.transpose() * skin.prestress * gradients;
    for (unsigned a = 0; a < unknowns; ++a)
      for (unsigned b = 0; b < unknowns; ++b)
        cell_matrix(a, b) += geometric(a / 3, b / 3) * (*stiffened)(a % 3, b % 3);
  }
}

/// Calls `share(own, other, part)` for the unknowns in the middle of a quadratic element's upright faces,
/// those that determine them, and by which part (fill_faces).
constexpr unsigned first_of_edges = 3 * 6, first_of_faces = 3 * 15;
template <class Share>
void for_shares_of_faces(const Share& share) {
  for (unsigned f = 0; f < wedge_quads.size(); ++f)
    for (unsigned d = 0; d < 3; ++d) {
      const unsigned own = first_of_faces + 3 * f + d;
      for (const int corner : wedge_quads[f]) share(own, 3 * corner + d, part_of_corner);
      for (const int side : sides_of_quad[f]) share(own, first_of_edges + 3 * side + d, part_of_side);
    }
}

void distribute_face_loads(FullMatrix<double>& loads) {
  for_shares_of_faces([&](unsigned own, unsigned other, double part) {
    for (unsigned c = 0; c < loads.n(); ++c) loads(other, c) += part * loads(own, c);
  });
  for (unsigned i = first_of_faces; i < loads.m(); ++i)
    for (unsigned c = 0; c < loads.n(); ++c) loads(i, c) = 0;
}

/// The rows in the middle of faces keep a diagonal, which has no effect.
void distribute_face_stiffness(FullMatrix<double>& matrix) {
  const unsigned all = matrix.m();
  for_shares_of_faces([&](unsigned own, unsigned other, double part) {
    for (unsigned i = 0; i < all; ++i) matrix(other, i) += part * matrix(own, i);
  });
  for_shares_of_faces([&](unsigned own, unsigned other, double part) {
    for (unsigned i = 0; i < all; ++i) matrix(i, other) += part * matrix(i, own);
  });
  for (unsigned own = first_of_faces; own < all; ++own)
    for (unsigned i = 0; i < all; ++i)
      if (i != own) matrix(own, i) = matrix(i, own) = 0;
}

}  // namespace

double spring_of(types::boundary_id boundary, const Parameters& p) {
  if (boundary == BoundaryId::bone) return springs_of_bone(p);
  return boundary == BoundaryId::bottom ? p.foundation.stiffness : p.foundation.side_stiffness;
}

Assembly::Assembly(const PatchElements& elements, int loads) {
  stiffness_.reinit(elements.pattern);
  for (int i = 0; i < loads; ++i)
    loads_.emplace_back(elements.dofs.locally_owned_dofs(), elements.communicator);
}

void Assembly::add(const PatchElements& elements, const Parameters& p, double factor,
                   const Eigen::Matrix3Xd& combination) {
  const Materials materials(p, elements.mesh.materials);
  const bool mean_dilatation = p.tissue.formulation == TissueFormulation::mean_dilatation;
  const bool quadratic = elements.order() == ElementOrder::quadratic;
  FEValues<3> values(elements.mapping, elements.element,
                     wedge_rule(elements.discretization.rule, elements.order()),
                     update_gradients | update_JxW_values);
  FEFaceValues<3> face_values(
      elements.mapping, elements.element, face_rules(elements.order()),
      update_values | update_JxW_values | (quadratic ? update_gradients : update_default));
  const unsigned n = elements.element.n_dofs_per_cell();
  FullMatrix<double> cell_matrix(n, n), cell_loads(n, 3);
  std::vector<types::global_dof_index> indices(n);
  std::vector<CellPoint> points;
  const auto add_loads = [&] {
    if (quadratic) distribute_face_loads(cell_loads);
    for (std::size_t c = 0; c < loads_.size(); ++c)
      for (unsigned i = 0; i < n; ++i) {
        double sum = 0;
        for (unsigned d = 0; d < 3; ++d)
          sum += cell_loads(i, d) * combination(d, static_cast<Eigen::Index>(c));
        if (sum != 0) loads_[c](indices[i]) += factor * sum;
      }
  };
  for (const Cell& cell : elements.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell_matrix = 0;
    values.reinit(cell);
    read_points(values, mean_dilatation, points);
    materials.tissue[cell->material_id()].add_stiffness(points, cell_matrix);
    cell->get_dof_indices(indices);
    if (p.tissue.prestress_share != 0) {
      cell_loads = 0;
      add_tissue_loads(points, p.tissue.prestress_share, cell_loads);
      add_loads();
    }
    for (const unsigned f : cell->face_indices()) {
      const types::boundary_id boundary = cell->face(f)->boundary_id();
      if (!cell->face(f)->at_boundary() || boundary == BoundaryId::other) continue;
      if (boundary >= BoundaryId::skin) {
        cell_loads = 0;
        const SkinMaterial& skin = materials.skin[boundary - BoundaryId::skin];
        const std::array<int, 3> corner = corners_of_face(cell, f);
        const SkinTriangle triangle = triangle_of(
            cell, corner, elements.mesh.tension_of(static_cast<int>(cell->id().get_coarse_cell_id())));
        if (quadratic) {
          face_values.reinit(cell, f);
          add_quadratic_skin(skin, stiffened(p, triangle.axes()), triangle.axes(), face_values, cell_matrix,
                             cell_loads);
        } else {
          add_skin(skin, stiffened(p, triangle.axes()), triangle, corner, cell_matrix, cell_loads);
        }
        add_loads();
      } else {
        face_values.reinit(cell, f);
        add_springs(face_values, spring_of(boundary, p), cell_matrix);
      }
    }
    if (quadratic) distribute_face_stiffness(cell_matrix);
    cell_matrix *= factor;
    stiffness_.add(indices, cell_matrix);
  }
  add_bending(elements, factor * p.skin.bending_stiffness, stiffness_);
}

void Assembly::finish() {
  stiffness_.compress(VectorOperation::add);
  for (auto& load : loads_) load.compress(VectorOperation::add);
}

Block Assembly::loads() const {
  Block block(static_cast<Eigen::Index>(loads_.front().locally_owned_size()),
              static_cast<Eigen::Index>(loads_.size()));
  for (std::size_t c = 0; c < loads_.size(); ++c)
    std::copy(loads_[c].begin(), loads_[c].end(), block.col(static_cast<Eigen::Index>(c)).data());
  return block;
}

}  // namespace cleft
