#include "solver/newton.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/text.h"
#include "solver/block_rows.h"

namespace cleft {

namespace {

constexpr double converged = 1e-7;            // residual, relative to the largest load
constexpr int most_steps = 25;                // of Newton's method, for a part of the load
constexpr int most_revisions = 60;            // of the pairs that touch, likewise
constexpr int most_iterations_of_step = 200;  // of conjugate gradients
constexpr double least_part = 1. / 64;        // of the load
constexpr double accurate = 1e-10;            // residual of a derivative's linear system, relative
constexpr double loosest = 0.1;               // residual of a step's linear system, relative

/// Closes what is closed in a frame: a prediction may part it, where a frame opens a part of a column, or a
/// branch leaves.
void close_what_is_closed(const PatchMesh& mesh, const PatchSystem& system, const Release& release, int frame,
                          Block& displacement) {
  const CutNodes cut(mesh, system);
  const std::vector<bool> closed = release.closed(release.released[frame]);
  Eigen::MatrixXd at_cut = all_gather_rows(system, displacement, cut.unknowns);
  for (std::size_t p = 0; p < cut.pairs.size(); ++p)  // a right node is the left one of later pairs only
    if (closed[p])
      at_cut.middleRows<3>(3 * cut.pairs[p][1]) = at_cut.middleRows<3>(3 * cut.pairs[p][0]).eval();
  set_rows(system, displacement, cut.unknowns, at_cut);
}

}  // namespace

NewtonSolver::NewtonSolver(const PatchMesh& mesh, const PatchSystem& system, FinitePatch& patch,
                           const Release& release, FrameSolver& reference, const FrameResidual& residual,
                           double largest_load, bool contact)
    : mesh_(mesh),
      system_(system),
      patch_(patch),
      release_(release),
      reference_(reference),
      residual_(residual),
      largest_load_(largest_load),
      prediction_(mesh, system, release),
      contact_(mesh, system, release, contact) {}

NewtonFrame NewtonSolver::solve(int frame, Block& displacement) {
  NewtonFrame report;
  report.frame = frame;
  saddle_ = false;
  const Block start = displacement;
  patch_.set_open(release_, release_.released[frame]);
  balance_ = patch_.balance(start);
  const FinitePatch::Balance at_start = balance_;
  const Block tied = left_over();  // of it what opens now transmitted
  bool predicted = predict(frame, start, displacement);
  double done = 0, part = 1;
  Block reached = start;
  for (report.load_steps = 1;;) {
    const double next = std::min(1., done + part);
    if (converge(frame, (1 - next) * tied, displacement, report)) {
      if (next == 1) break;
      done = next, part *= 2;
      ++report.load_steps;
      reached = displacement;
      continue;
    }
    if (!predicted) part /= 2;
    predicted = false;
    if (part < least_part) fail(frame, done, report);
    displacement = reached;
    balance_ = patch_.balance(displacement);
  }
  before_ = start;
  return report;
}

Block NewtonSolver::responses(int frame, const Block& displacement, const Block& forces) {
  patch_.set_tangent(displacement);
  Block responses(forces.rows(), forces.cols());
  for (Eigen::Index c = 0; c < forces.cols(); ++c) {
    Direction d = direction(forces.col(c), release_.released[frame], accurate);
    if (d.indefinite)
      throw SolveError("frame " + std::to_string(frame) +
                       ": its tangent is not positive definite, so that it has no derivative; leave the "
                       "sensitivities out, or raise skin.bending_stiffness");
    responses.col(c) = d.step;
  }
  return responses;
}

/// Starts from the prediction where its forces are nearer to balance, and says so.
bool NewtonSolver::predict(int frame, const Block& start, Block& displacement) {
  if (!prediction_.possible(frame)) return false;
  Block predicted = prediction_.predict(before_, start);
  close_what_is_closed(mesh_, system_, release_, frame, predicted);
  FinitePatch::Balance there = patch_.balance(predicted);
  const int open = release_.released[frame];
  if (!(there.least.determinant > 0) ||
      !(residual_of(open, there.left_over + contact_.forces(there.left_over), predicted) <
        residual_of(open, left_over(), start)))
    return false;
  displacement = predicted;
  balance_ = std::move(there);
  return true;
}

/// Newton's method for F(u) = f - tied from a displacement with its balance; whether it has converged.
bool NewtonSolver::converge(int frame, const Block& tied, Block& displacement, NewtonFrame& report) {
  const int open = release_.released[frame];
  contact_.begin(open);
  if (!close_gaps(open, displacement)) return false;
  for (int i = 0;; ++i) {
    const Block acting = balance_.left_over - tied;
    const Block force = acting + contact_.forces(acting);
    report.residual = residual_of(open, force, displacement);
    if (i == most_steps + most_revisions || !std::isfinite(report.residual)) return false;
    // As far as the residual lets pulls and overlaps be told.
    const double least = std::max(report.residual, converged);
    if (contact_.revise(displacement, acting, least * largest_load_, least)) {
      if (contact_.revisions() > most_revisions || !close_gaps(open, displacement)) return false;
      continue;
    }
    if (report.residual < converged) return is_stable(open, displacement);
    if (i - contact_.revisions() == most_steps) return false;
    patch_.set_tangent(displacement);
    const double enough = std::max(std::min(report.residual, loosest), 0.1 * converged / report.residual);
    Direction d = direction(force, open, enough);
    const double length = line_search(d.step, tied, displacement);
    report.steps.push_back({report.residual, d.iterations, length, d.indefinite});
    if (length == 0) return false;
  }
}

/// Moves the lips that touch onto each other, as the factor's tangent gives way.
bool NewtonSolver::close_gaps(int open, Block& displacement) {
  const FrameSolver::Touching closing = contact_.closing(displacement);
  if (closing.places.empty() || closing.openings.isZero(0)) return true;
  displacement += factor().solve_once(Block::Zero(displacement.rows(), 1), open, closing);
  balance_ = patch_.balance(displacement);
  return balance_.least.determinant > 0;
}

/// Conjugate gradients: the tangent's step, to `enough` of the residual. At a negative curvature what is
/// reached so far is a direction of descent.
NewtonSolver::Direction NewtonSolver::direction(const Block& force, int open, double enough) {
  Direction d;
  d.step = Block::Zero(force.rows(), 1);
  const auto size = [&](const Block& r) { return residual_of(open, r + contact_.forces(r), d.step); };
  Block r = force, along;
  const double first = size(r);
  for (double rz = 0; d.iterations < most_iterations_of_step && size(r) > enough * first; ++d.iterations) {
    const Block z = precondition(r, open);
    const double before = std::exchange(rz, dot(system_, r.col(0), z.col(0)));
    along = d.iterations == 0 ? z : Block(z + rz / before * along);
    const Block product = patch_.multiply(along);
    const double curvature = dot(system_, along.col(0), product.col(0));
    if (!(curvature > 0)) {
      d.indefinite = true;
      if (d.iterations == 0) d.step = along;
      break;
    }
    d.step += rz / curvature * along;
    r -= rz / curvature * product;
  }
  return d;
}

/// Along a step s, F(u + x s) . s should vanish: the whole step is taken unless this is not smaller at its
/// end by a tenth; else the secant's zero. Elements that turn inside out halve it. 0: there is none.
double NewtonSolver::line_search(const Block& step, const Block& tied, Block& displacement) {
  const auto slope = [&](const FinitePatch::Balance& at) {
    return dot(system_, (at.left_over - tied).col(0), step.col(0));
  };
  const double at_start = slope(balance_);
  double x = 1;
  for (int i = 0; i < 12; ++i) {
    const Block moved = displacement + x * step;
    FinitePatch::Balance there = patch_.balance(moved);
    const double at_end = slope(there);
    const bool possible = there.least.determinant > 0 && std::isfinite(at_end);
    if (possible && std::abs(at_end) <= 0.9 * std::abs(at_start)) {
      displacement = moved;
      balance_ = std::move(there);
      return x;
    }
    x *= possible && at_end < 0 ? std::clamp(at_start / (at_start - at_end), 0.1, 0.7) : 0.5;
  }
  return 0;
}

double NewtonSolver::residual_of(int open, const Block& force, const Block& displacement) const {
  return residual_.figures(release_, {{0, open, false, 0}}, displacement, force, largest_load_)
      .front()
      .residual_equilibrium;
}

Block NewtonSolver::precondition(const Block& force, int open) {
  return factor().solve_once(force, open, contact_.sliding());
}

/// Whether an equilibrium is none of a saddle, by the factor of its tangent: iterations need not meet a
/// negative curvature that the forces hardly feel. The factor then serves the next frame. Where it is not
/// definite with all pairs open that of the reference state does.
bool NewtonSolver::is_stable(int open, const Block& displacement) {
  patch_.set_tangent(displacement);
  has_factor_ = false;
  bool stable = false;
  try {
    if (factor_)
      factor_->replace(patch_.lower_triangle());
    else
      factor_ = std::make_unique<DirectSolver>(mesh_, system_, patch_.lower_triangle());
    factor_->factorize();
    stable = factor_->is_definite(release_, open, contact_.sliding().places);
    factor_->set_release(release_);
    has_factor_ = true;
  } catch (const IndefiniteError&) {
    factor_.reset();
  } catch (const SolveError&) {  // not definite with all pairs open
  }
  saddle_ = saddle_ || !stable;
  return stable;
}

void NewtonSolver::fail(int frame, double fraction, const NewtonFrame& report) const {
  const bool indefinite = saddle_ || std::any_of(report.steps.begin(), report.steps.end(),
                                                 [](const NewtonStep& step) { return step.indefinite; });
  const auto rounded = [](double x) { return shortest(std::round(1000 * x) / 1000); };
  const Vec3& place = balance_.least.place;
  throw SolveError("frame " + std::to_string(frame) + " (" + rounded(release_.times[frame]) +
                   " mm cut), at " + rounded(100 * fraction) +
                   " % of what it releases: Newton's method finds no equilibrium" +
                   (indefinite ? ", and the tangent is indefinite: the skin wrinkles or folds" : "") +
                   ". The element that has shrunk most, to " + rounded(balance_.least.determinant) +
                   " of its volume, is at " + (mesh_.is_body() ? "(x, y, z)" : "(u, v, w)") + " = (" +
                   rounded(place.x) + ", " + rounded(place.y) + ", " + rounded(place.z) +
                   ") mm. Raise skin.bending_stiffness or tissue.young_modulus, lower the prestress, or make "
                   "mesh.element_size smaller");
}

}  // namespace cleft
