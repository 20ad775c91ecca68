#include "solver/spectrum.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "solver/block_rows.h"
#include "solver/frame_solver.h"

namespace cleft {

namespace {

using Vector = Eigen::VectorXd;

/// A direction that no eigenvector is normal to, the same for any number of ranks.
Vector some_direction(const PatchSystem& system) {
  Vector direction(system.owned());
  for (int row = 0; row < system.owned(); ++row) {
    const double n = system.first() + row + 1;
    direction[row] = 1 + std::sin(n * n);
  }
  return direction / std::sqrt(dot(system, direction, direction));
}

}  // namespace

Spectrum spectrum_of(const PatchSystem& system) {
  constexpr int most_steps = 500, between_looks = 25;
  constexpr double enough = 0.01, rounding = 1e-13;
  std::vector<double> diagonal, beside;
  Vector previous = Vector::Zero(system.owned()), direction = some_direction(system);
  Spectrum found{};
  for (int step = 1; step <= std::min(most_steps, system.size()); ++step) {
    Vector next = system.multiply(direction);
    if (step > 1) next -= beside.back() * previous;
    diagonal.push_back(dot(system, direction, next));
    next -= diagonal.back() * direction;
    beside.push_back(std::sqrt(dot(system, next, next)));
    const bool ended = !(beside.back() > 0);
    if (ended || step % between_looks == 0 || step == std::min(most_steps, system.size())) {
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_steps;
      of_steps.computeFromTridiagonal(Vector::Map(diagonal.data(), step),
                                      Vector::Map(beside.data(), step - 1));
      if (of_steps.info() != Eigen::Success) break;  // what rounding has left of them
      found = {of_steps.eigenvalues()[0], of_steps.eigenvalues()[step - 1]};
      const double residual = beside.back() * std::abs(of_steps.eigenvectors()(step - 1, 0));
      if (ended || residual < enough * std::max(std::abs(found.smallest), rounding * found.largest)) break;
    }
    previous = std::move(direction);
    direction = next / beside.back();
  }
  return found;
}

void fail_indefinite(const PatchSystem& system, const std::string& shown_by) {
  const Spectrum spectrum = spectrum_of(system);
  std::ostringstream text;
  text.precision(2);
  text << shown_by << ": the stiffness matrix is not positive definite: its smallest eigenvalue is at most "
       << spectrum.smallest << " N/mm, its largest at least " << spectrum.largest << " N/mm; "
       << cause_of_indefinite;
  throw IndefiniteError(text.str());
}

}  // namespace cleft
