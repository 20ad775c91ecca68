// Measurements that a study is fitted to.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "explorer/analysis/figure.h"
#include "explorer/analysis/skin_force.h"

namespace cleft {

struct Measurements {
  std::vector<Figure> figures;
  std::vector<SkinForce> forces = {};
  /// Of the figures, and after them of the forces, in their units; and the standard deviations of their
  /// errors.
  Eigen::VectorXd values, deviations;

  Eigen::Index size() const { return values.size(); }
  std::string text(Eigen::Index i) const;
  std::string unit(Eigen::Index i) const;
};

/// Reads CSV files with a row for each place. One of lengths, mm: columns gape (with u; without u the
/// widest), or displacement, du, dv, dw (with u, v, w), one of them or several; t, the length that is cut
/// (without it all of it). One of a force: columns force (N), dent and radius (mm); or tension (N/mm).
/// deviation: the standard deviation of the values' errors, in their unit; of lengths `deviation` is taken
/// where the file has no such column. An empty cell is not possible: another kind of place is another file.
/// Throws InputError or FileError with the place in the file.
Measurements read_measurements(const std::vector<std::string>& files, double deviation);

}  // namespace cleft
