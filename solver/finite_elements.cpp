#include "solver/finite_elements.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include "solver/assembly.h"
#include "solver/element_rules.h"
#include "solver/skin_triangle.h"

namespace cleft {

using namespace dealii;

namespace {

constexpr int corners = 6;  // of a wedge

Eigen::Vector3d at(const DoFHandler<3>::active_cell_iterator& cell, unsigned vertex) {
  const Point<3>& p = cell->vertex(vertex);
  return {p[0], p[1], p[2]};
}

}  // namespace

FiniteElements::FiniteElements(const PatchElements& elements, const Parameters& p)
    : materials_(p, elements.mesh.materials),
      mean_dilatation_(p.tissue.formulation == TissueFormulation::mean_dilatation) {
  const auto [uu, vv, uv] = p.skin.prestress;
  initial_.topLeftCorner<2, 2>() << uu, uv, uv, vv;
  initial_ *= p.tissue.prestress_share;
  FEValues<3> values(elements.mapping, elements.element, wedge_rule(elements.discretization.rule),
                     update_gradients | update_JxW_values);
  FEFaceValues<3> face_values(elements.mapping, elements.element, face_rules(),
                              update_values | update_JxW_values);
  points_of_cell_ = values.n_quadrature_points;
  std::vector<types::global_dof_index> indices(3 * corners);
  for (const auto& cell : elements.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    Cell& own = cells_.emplace_back();
    cell->get_dof_indices(indices);
    std::copy(indices.begin(), indices.end(), own.unknowns.begin());
    own.region = cell->material_id();
    const Point<3> center = cell->center();
    own.centroid = {center[0], center[1], center[2]};
    values.reinit(cell);
    for (unsigned q = 0; q < points_of_cell_; ++q) {
      ReferencePoint& point = points_.emplace_back();
      point.volume = values.JxW(q);
      for (int a = 0; a < corners; ++a)
        for (int i = 0; i < 3; ++i) point.gradients(i, a) = values.shape_grad(3 * a, q)[i];
    }
    for (const unsigned f : cell->face_indices()) {
      const types::boundary_id boundary = cell->face(f)->boundary_id();
      if (!cell->face(f)->at_boundary() || boundary == BoundaryId::other) continue;
      if (boundary >= BoundaryId::skin) {
        own.skin = static_cast<int>(skins_.size());
        Skin& skin = skins_.emplace_back();
        skin.region = boundary - BoundaryId::skin;
        skin.corner = corners_of_face(cell, f);
        std::array<Vec3, 3> place;
        for (int i = 0; i < 3; ++i) {
          const Eigen::Vector3d x = at(cell, skin.corner[i]);
          place[i] = {x[0], x[1], x[2]};
        }
        const SkinTriangle triangle(
            place[0], place[1], place[2],
            elements.mesh.tension_of(static_cast<int>(cell->id().get_coarse_cell_id())));
        skin.axes = triangle.axes(), skin.gradient = triangle.gradients(), skin.area = triangle.area();
        continue;
      }
      if (own.springs < 0) {
        own.springs = static_cast<int>(springs_.size());
        springs_.emplace_back(Eigen::Matrix<double, 6, 6>::Zero());
      }
      const double spring = spring_of(boundary, p);
      face_values.reinit(cell, f);
      for (const unsigned q : face_values.quadrature_point_indices())
        for (int a = 0; a < corners; ++a)
          for (int b = 0; b < corners; ++b)
            springs_.back()(a, b) += spring * face_values.shape_value(3 * a, q) *
                                     face_values.shape_value(3 * b, q) * face_values.JxW(q);
    }
  }
}

void FiniteElements::response(int number, const FiniteTissue::Displacements& displacements, bool tangent,
                              CellResponse& out) const {
  const Cell& cell = cells_[number];
  const std::span points(points_.data() + static_cast<std::size_t>(number) * points_of_cell_,
                         points_of_cell_);
  materials_.tissue[cell.region].response(points, displacements, initial_, mean_dilatation_, tangent, out);
  if (!(out.least_determinant > 0)) return;
  if (cell.skin >= 0) add_skin(skins_[cell.skin], displacements, tangent, out);
  if (cell.springs >= 0) add_springs(springs_[cell.springs], displacements, tangent, out);
}

/// The membrane's deformation gradient F maps the plane of the triangle to space; E = (F^T F - I) / 2.
void FiniteElements::add_skin(const Skin& skin, const FiniteTissue::Displacements& displacements,
                              bool tangent, CellResponse& out) const {
  const FiniteSkin& material = materials_.skin[skin.region];
  Eigen::Matrix<double, 3, 2> f = skin.axes;
  for (int a = 0; a < 3; ++a) f += displacements.col(skin.corner[a]) * skin.gradient.col(a).transpose();
  const Eigen::Matrix2d right = f.transpose() * f;
  const SkinResponse r = material.at({(right(0, 0) - 1) / 2, (right(1, 1) - 1) / 2, right(0, 1)});
  const double volume = material.thickness * skin.area;
  Eigen::Matrix2d stress;
  stress << r.stress[0], r.stress[2], r.stress[2], r.stress[1];
  out.energy += volume * r.energy;
  const Eigen::Matrix<double, 2, 3> pulled = stress * skin.gradient;
  std::array<Eigen::Matrix3d, 3> strain;  // (E_uu, E_vv, 2 E_uv) by the displacement of a corner
  for (int a = 0; a < 3; ++a) {
    out.force.segment<3>(3 * skin.corner[a]) += volume * f * pulled.col(a);
    const double du = skin.gradient(0, a), dv = skin.gradient(1, a);
    strain[a].row(0) = du * f.col(0).transpose();
    strain[a].row(1) = dv * f.col(1).transpose();
    strain[a].row(2) = (dv * f.col(0) + du * f.col(1)).transpose();
  }
  if (!tangent) return;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      Eigen::Matrix3d k = strain[a].transpose() * r.tangent * strain[b];
      k.diagonal().array() += skin.gradient.col(a).dot(pulled.col(b));
      out.stiffness.block<3, 3>(3 * skin.corner[a], 3 * skin.corner[b]) += volume * k;
    }
}

void FiniteElements::add_springs(const Eigen::Matrix<double, 6, 6>& springs,
                                 const FiniteTissue::Displacements& displacements, bool tangent,
                                 CellResponse& out) const {
  const Eigen::Matrix<double, 3, 6> forces = displacements * springs;
  out.energy += forces.cwiseProduct(displacements).sum() / 2;
  for (int a = 0; a < corners; ++a) {
    out.force.segment<3>(3 * a) += forces.col(a);
    for (int b = 0; tangent && b < corners; ++b)
      out.stiffness.block<3, 3>(3 * a, 3 * b).diagonal().array() += springs(a, b);
  }
}

}  // namespace cleft
