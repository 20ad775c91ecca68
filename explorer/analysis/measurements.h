// Measurements that a study is fitted to.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "explorer/analysis/figure.h"

namespace cleft {

struct Measurements {
  std::vector<Figure> figures;
  Eigen::VectorXd values;      ///< mm
  Eigen::VectorXd deviations;  ///< mm: standard deviations of their errors
};

/// Reads a CSV file with a row for each place: columns gape (with u; without u the widest), or displacement,
/// du, dv, dw (with u, v, w), one of them or several; t, the length that is cut (without it all of it); and
/// deviation, the standard deviation of the values' errors, mm. An empty cell is not possible: another place
/// is another file. `deviation` is taken where the file has no such column. Throws InputError or FileError
/// with the place in the file.
Measurements read_measurements(const std::string& file, double deviation);

}  // namespace cleft
