// Inside SpaceFit: the samples by planes, sections and cells.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "encoder/space_fit.h"

namespace cleft {

inline constexpr int order = 4;  // cubics: four functions an axis
inline constexpr int cell_size = order * order;
// Control points meet only where indices differ by at most 3: a stencil.
inline constexpr int reach = 2 * order - 1;

struct SpaceFit::Parts {
  /// Places within one span across and in height, and their contribution to B^T B.
  struct Cell {
    int first_across, first_height;
    std::vector<int> places;                             // of `places`
    std::array<double, cell_size * cell_size> normal{};  // sum of w w^T over them
  };
  /// A plane u = const. Planes of a mesh usually have their nodes at the same places across and in height,
  /// and share a section.
  struct Section {
    std::vector<Cell> cells;
    std::vector<int> planes;  // of `planes`
  };
  struct Plane {
    double u;
    int section;
    std::vector<int> samples;  // at the places of the section's cells, one cell after another
  };
  struct Weights {
    int first_across, first_height;
    double share;                          // of a sample's value: 1/2 if it belongs to both sides of v = 0
    std::array<double, cell_size> weight;  // N_j(across) N_k(height)
  };
  /// Second divided differences: rows of (first index, three weights), scaled by the mean spacing.
  struct Difference {
    int first;
    std::array<double, 3> weight;
  };

  const Parametrization& parametrization;
  std::array<BSplineBasis, 3> bases;
  ControlTies ties;
  std::vector<Plane> planes;
  std::vector<Section> sections;
  std::vector<Weights> places;
  Eigen::Index sample_count;
  int V, W;
  double scale = 0;  // mean diagonal of B^T B
  std::vector<Difference> across_roughness = {}, height_roughness = {};

  /// A block of the normal matrix between control points of rows i and i + d: by row j W + k, then by the
  /// differences across and in height, reach each.
  using Stencil = std::vector<double>;
  std::size_t at(int j, int k) const { return (static_cast<std::size_t>(j) * W + k) * reach * reach; }
  std::size_t stencil_size() const { return static_cast<std::size_t>(V) * W * reach * reach; }
  static std::size_t offset(int dj, int dk) { return (dj + order - 1) * reach + dk + order - 1; }

  int place_of(const Vec3& uvw, Limit limit, double share, std::map<std::array<double, 4>, int>& known);
  void add_samples(const std::vector<Sample>& samples);
  void add_section(Stencil& stencil, const Section& section, double factor) const;
  void add_cells(Section& section, const std::vector<int>& sorted) const;
  Eigen::MatrixXd tie(const Stencil& stencil, int row, int column) const;
  static void add_to_diagonal(Stencil& stencil, double value);
  void add_roughness_in_row(Stencil& stencil, double strength) const;
  std::vector<Grid> controls(
      const Eigen::Ref<const Eigen::MatrixXd>& x) const;       // ties x, row after row along
  Eigen::MatrixX4d sum(const std::vector<Grid>& grids) const;  // ties^T of such
};

}  // namespace cleft
