// A rank's elements under finite strains: their reference state, and their response to displacements.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "params/parameters/parameters.h"
#include "solver/material/regions.h"
#include "solver/patch_elements.h"

namespace cleft {

class FiniteElements {
 public:
  /// Those of `elements` that this rank owns, which are not needed afterwards.
  FiniteElements(const PatchElements& elements, const Parameters& parameters);

  int count() const { return static_cast<int>(cells_.size()); }
  /// Unknowns of a cell; 3 a + i is the displacement of vertex a along axis i.
  const std::array<int, 18>& unknowns(int cell) const { return cells_[cell].unknowns; }
  Vec3 centroid(int cell) const { return cells_[cell].centroid; }

  /// Tissue, and the skin and springs on its faces.
  void response(int cell, const FiniteTissue::Displacements& displacements, bool tangent,
                CellResponse& out) const;

 private:
  struct Skin {
    std::array<int, 3> corner;             // vertices of the cell
    Eigen::Matrix<double, 3, 2> axes;      // of the triangle's plane: e_u and e_v in space
    Eigen::Matrix<double, 2, 3> gradient;  // of their shape functions, along e_u and e_v
    double area;
    unsigned region;
  };
  struct Cell {
    std::array<int, 18> unknowns;
    Vec3 centroid;
    unsigned region;
    int skin = -1, springs = -1;  // their numbers
  };

  void add_skin(const Skin& skin, const FiniteTissue::Displacements& displacements, bool tangent,
                CellResponse& out) const;
  void add_springs(const Eigen::Matrix<double, 6, 6>& springs,
                   const FiniteTissue::Displacements& displacements, bool tangent, CellResponse& out) const;

  FiniteMaterials materials_;
  bool mean_dilatation_;
  Eigen::Matrix3d initial_ = Eigen::Matrix3d::Zero();  // stress of the tissue
  std::size_t points_of_cell_ = 0;
  std::vector<Cell> cells_;
  std::vector<ReferencePoint> points_;
  std::vector<Skin> skins_;
  std::vector<Eigen::Matrix<double, 6, 6>> springs_;  // between vertices, alike along all axes
};

}  // namespace cleft
