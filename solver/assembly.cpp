#include "solver/assembly.h"

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/fe_wedge_p.h>

#include <algorithm>
#include <span>

#include "solver/bending.h"
#include "solver/element_rules.h"
#include "solver/material/regions.h"
#include "solver/skin_triangle.h"

namespace cleft {

using namespace dealii;

namespace {

constexpr unsigned vertices =
    6;  // of a wedge; a shape function of vertex a in direction d has number 3 a + d

using Cell = DoFHandler<3>::active_cell_iterator;

/// The points of a cell. With `mean` its volume changes as a whole.
void read_points(const FEValues<3>& values, bool mean, std::vector<CellPoint>& points) {
  points.resize(values.n_quadrature_points);
  std::array<Tensor<1, 3>, vertices> mean_gradient;
  double volume = 0;
  for (unsigned q = 0; q < points.size(); ++q) {
    points[q].volume = values.JxW(q);
    volume += values.JxW(q);
    for (unsigned a = 0; a < vertices; ++a) {
      const Tensor<1, 3>& gradient = values.shape_grad(3 * a, q);
      points[q].vertices[a] = {gradient, gradient};
      mean_gradient[a] += gradient * values.JxW(q);
    }
  }
  if (!mean) return;
  for (Tensor<1, 3>& gradient : mean_gradient) gradient = gradient / volume;
  for (CellPoint& point : points)
    for (unsigned a = 0; a < vertices; ++a) point.vertices[a].dilatation = mean_gradient[a];
}

/// Loads of the unit prestresses uu, vv, uv of the tissue: minus the integral of B^T, times the share.
void add_tissue_loads(std::span<const CellPoint> points, double share, FullMatrix<double>& cell_loads) {
  for (const CellPoint& point : points)
    for (unsigned a = 0; a < vertices; ++a) {
      const Tensor<1, 3> force = -share * point.volume * point.vertices[a].strain;
      cell_loads(3 * a, 0) += force[0];
      cell_loads(3 * a + 1, 1) += force[1];
      cell_loads(3 * a, 2) += force[1];
      cell_loads(3 * a + 1, 2) += force[0];
    }
}

void add_springs(const FEFaceValues<3>& values, double spring, FullMatrix<double>& cell_matrix) {
  for (const unsigned q : values.quadrature_point_indices())
    for (unsigned a = 0; a < vertices; ++a)
      for (unsigned b = 0; b < vertices; ++b) {
        const double k = spring * values.shape_value(3 * a, q) * values.shape_value(3 * b, q) * values.JxW(q);
        for (unsigned d = 0; d < 3; ++d) cell_matrix(3 * a + d, 3 * b + d) += k;
      }
}

void add_skin(const SkinMaterial& skin, bool initial_stress_stiffness, const Cell& cell, unsigned face,
              const Vec3& direction, FullMatrix<double>& cell_matrix, FullMatrix<double>& cell_loads) {
  const std::array<int, 3> corner = corners_of_face(cell, face);
  std::array<Vec3, 3> at;
  for (unsigned i = 0; i < 3; ++i) {
    const Point<3>& p = cell->vertex(corner[i]);
    at[i] = {p[0], p[1], p[2]};
  }
  const SkinTriangle triangle(at[0], at[1], at[2], direction);
  const SkinTriangle::Matrix9 k = triangle.stiffness(skin);
  const SkinTriangle::Matrix93 f = triangle.unit_loads(skin);
  for (unsigned a = 0; a < 9; ++a) {
    const unsigned row = 3 * corner[a / 3] + a % 3;
    for (unsigned d = 0; d < 3; ++d) cell_loads(row, d) += f(a, d);
    for (unsigned b = 0; b < 9; ++b) cell_matrix(row, 3 * corner[b / 3] + b % 3) += k(a, b);
  }
  if (!initial_stress_stiffness) return;
  const Eigen::Matrix3d geometric = triangle.initial_stress_stiffness(skin);
  for (unsigned a = 0; a < 3; ++a)
    for (unsigned b = 0; b < 3; ++b)
      for (unsigned d = 0; d < 3; ++d) cell_matrix(3 * corner[a] + d, 3 * corner[b] + d) += geometric(a, b);
}

}  // namespace

double spring_of(types::boundary_id boundary, const Parameters& p) {
  constexpr double firm = 1e3;
  if (boundary == BoundaryId::bone) return firm * p.tissue.young_modulus / p.patch.height;
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
  const bool initial_stress_stiffness = p.skin.initial_stress_stiffness;
  FEValues<3> values(elements.mapping, elements.element, wedge_rule(elements.discretization.rule),
                     update_gradients | update_JxW_values);
  FEFaceValues<3> face_values(elements.mapping, elements.element, face_rules(),
                              update_values | update_JxW_values);
  const unsigned n = elements.element.n_dofs_per_cell();
  FullMatrix<double> cell_matrix(n, n), cell_loads(n, 3);
  std::vector<types::global_dof_index> indices(n);
  std::vector<CellPoint> points;
  const auto add_loads = [&] {
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
        add_skin(materials.skin[boundary - BoundaryId::skin], initial_stress_stiffness, cell, f,
                 elements.mesh.tension_of(static_cast<int>(cell->id().get_coarse_cell_id())), cell_matrix,
                 cell_loads);
        add_loads();
      } else {
        face_values.reinit(cell, f);
        add_springs(face_values, spring_of(boundary, p), cell_matrix);
      }
    }
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
