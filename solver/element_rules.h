// Quadrature of the patch's elements, and the corners of their faces.
#pragma once

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/hp/q_collection.h>

#include <array>

#include "solver/patch_system.h"

namespace cleft {

/// `rule` of linear wedges; quadratic ones have a full one always.
dealii::Quadrature<3> wedge_rule(WedgeRule rule, ElementOrder order = ElementOrder::linear);
/// Of a wedge's faces: exact for the products of two shape functions.
dealii::hp::QCollection<2> face_rules(ElementOrder order = ElementOrder::linear);

/// The vertices of a cell at the corners of one of its triangles, in the order of the face.
std::array<int, 3> corners_of_face(const dealii::DoFHandler<3>::active_cell_iterator& cell, unsigned face);

}  // namespace cleft
