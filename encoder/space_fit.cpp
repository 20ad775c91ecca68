#include "encoder/space_fit.h"

#include <algorithm>

#include "base/error.h"
#include "encoder/space_fit_parts.h"
#include "encoder/stencil_product.h"

namespace cleft {

namespace {

constexpr double diagonal_strength =
    1e-11;  // relative to the mean diagonal of B^T B; holds what neither data nor roughness reach
std::vector<double> greville(const BSplineBasis& basis) {
  std::vector<double> places(basis.size(), 0.0);
  for (int i = 0; i < basis.size(); ++i)
    for (int k = 1; k <= basis.degree(); ++k) places[i] += basis.knots()[i + k] / basis.degree();
  return places;
}

/// Scaled by the mean spacing.
std::vector<SpaceFit::Parts::Difference> differences(const std::vector<double>& places) {
  const int n = static_cast<int>(places.size());
  const double spacing = (places.back() - places.front()) / (n - 1);
  std::vector<SpaceFit::Parts::Difference> rows;
  for (int i = 1; i + 1 < n; ++i) {
    const double before = places[i] - places[i - 1], after = places[i + 1] - places[i];
    // Two control points in one place, or as good as: the break at v = 0, or knots that coincide.
    if (std::min(before, after) <= 1e-4 * spacing) continue;
    rows.push_back({i - 1, {spacing / before, -spacing / before - spacing / after, spacing / after}});
  }
  return rows;
}

}  // namespace

const ControlTies& SpaceFit::ties() const { return parts_->ties; }

SpaceFit::SpaceFit(const Parametrization& parametrization, const std::array<BSplineBasis, 3>& bases,
                   const std::vector<Sample>& samples) {
  auto parts = std::make_unique<Parts>(
      Parts{parametrization,
            bases,
            parametrization.moves() ? ControlTies::following_tip(bases) : ControlTies::none(bases),
            {},
            {},
            {},
            static_cast<Eigen::Index>(samples.size()),
            bases[1].size(),
            bases[2].size()});
  for (const BSplineBasis& basis : bases) CLEFT_CHECK(basis.degree() + 1, ==, int(order));
  Parts& p = *parts;
  p.add_samples(samples);
  std::vector<double> v_places = greville(bases[1]), w_places = greville(bases[2]);
  for (double& v : v_places) v = parametrization.v_at(v);
  for (double& w : w_places) w = parametrization.w_at(w);
  p.across_roughness = differences(v_places), p.height_roughness = differences(w_places);
  parts_ = std::move(parts);
}

void SpaceFit::Parts::add_roughness_in_row(Stencil& stencil, double strength) const {
  for (const auto& [first, weight] : across_roughness)
    for (int k = 0; k < W; ++k)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          stencil[at(first + a, k) + offset(b - a, 0)] += strength * weight[a] * weight[b];
  for (const auto& [first, weight] : height_roughness)
    for (int j = 0; j < V; ++j)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          stencil[at(j, first + a) + offset(0, b - a)] += strength * weight[a] * weight[b];
}

void SpaceFit::Parts::add_section(Stencil& stencil, const Section& section, double factor) const {
  for (const Parts::Cell& cell : section.cells)
    for (int a = 0; a < cell_size; ++a) {
      const int aj = a / order, ak = a % order;
      double* line = &stencil[at(cell.first_across + aj, cell.first_height + ak)];
      const double* normal = &cell.normal[a * cell_size];
      for (int bj = 0; bj < order; ++bj) {
        double* to = line + offset(bj - aj, -ak);
        for (int bk = 0; bk < order; ++bk) to[bk] += factor * normal[bj * order + bk];
      }
    }
}

SpaceFit::Normal SpaceFit::normal(double t, double strength) const {
  const Parts& p = *parts_;
  const int rows = p.bases[0].size();
  Normal result;
  auto& stencils = result.stencils_;
  stencils.resize(rows);
  for (auto& of_row : stencils)
    for (auto& stencil : of_row) stencil.assign(p.stencil_size(), 0.0);
  std::vector<std::array<double, order>> factors;  // of a section, by row and difference
  for (const Parts::Section& section : p.sections) {
    factors.assign(rows, {});
    int from = rows, to = 0;
    for (const int plane : section.planes) {
      const auto [first, value] = p.bases[0].evaluate(p.parametrization.along(p.planes[plane].u, t).value);
      from = std::min(from, first), to = std::max(to, first + order);
      for (int i = 0; i < order; ++i)
        for (int d = 0; i + d < order; ++d) factors[first + i][d] += value[i] * value[i + d];
    }
    for (int i = from; i < to; ++i)
      for (int d = 0; d < order; ++d)
        if (factors[i][d] != 0) p.add_section(stencils[i][d], section, factors[i][d]);
  }
  for (auto& of_row : stencils) Parts::add_to_diagonal(of_row[0], diagonal_strength * p.scale);
  roughen(result, strength);
  return result;
}

void SpaceFit::roughen(Normal& normal, double strength) const {
  const Parts& p = *parts_;
  strength *= p.scale;
  for (auto& of_row : normal.stencils_) p.add_roughness_in_row(of_row[0], strength);
  for (const auto& [first, weight] : differences(greville(p.bases[0])))
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b)
        Parts::add_to_diagonal(normal.stencils_[first + a][b - a], strength * weight[a] * weight[b]);
}

void SpaceFit::Parts::add_to_diagonal(Stencil& stencil, double value) {
  for (std::size_t at = offset(0, 0); at < stencil.size(); at += reach * reach) stencil[at] += value;
}

double SpaceFit::Normal::bytes() const {
  double sum = 0;
  for (const auto& of_row : stencils_)
    for (const auto& stencil : of_row) sum += static_cast<double>(stencil.size() * sizeof(double));
  return sum;
}

double SpaceFit::bytes() const {
  const Parts& p = *parts_;
  double cells = 0, samples = 0;
  for (const Parts::Section& section : p.sections) cells += static_cast<double>(section.cells.size());
  for (const Parts::Plane& plane : p.planes) samples += static_cast<double>(plane.samples.size());
  return cells * sizeof(Parts::Cell) + static_cast<double>(p.places.size()) * sizeof(Parts::Weights) +
         samples * sizeof(int);
}

void SpaceFit::Normal::add(double factor, const Normal& other) {
  if (stencils_.empty()) {
    stencils_ = other.stencils_;
    for (auto& of_row : stencils_)
      for (auto& stencil : of_row)
        for (double& value : stencil) value *= factor;
    return;
  }
  for (std::size_t i = 0; i < stencils_.size(); ++i)
    for (std::size_t d = 0; d < stencils_[i].size(); ++d)
      for (std::size_t k = 0; k < stencils_[i][d].size(); ++k)
        stencils_[i][d][k] += factor * other.stencils_[i][d][k];
}

std::vector<SpaceFit::Grid> SpaceFit::Parts::controls(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  std::vector<Grid> grids(ties.rows(), Grid::Zero(V * W, 4));
  for (int i = 0; i < ties.rows(); ++i) {
    const auto& row = ties.row(i);
    for (std::size_t c = 0; c < row.size(); ++c)
      for (int k = 0; k < row[c].terms; ++k)
        grids[i].row(static_cast<Eigen::Index>(c)).head(x.cols()) +=
            row[c].term[k].weight * x.row(ties.first(i) + row[c].term[k].unknown);
  }
  return grids;
}

Eigen::MatrixX4d SpaceFit::Parts::sum(const std::vector<Grid>& grids) const {
  Eigen::MatrixX4d x = Eigen::MatrixX4d::Zero(ties.size(), 4);
  for (int i = 0; i < ties.rows(); ++i) {
    const auto& row = ties.row(i);
    for (std::size_t c = 0; c < row.size(); ++c)
      for (int k = 0; k < row[c].terms; ++k)
        x.row(ties.first(i) + row[c].term[k].unknown) +=
            row[c].term[k].weight * grids[i].row(static_cast<Eigen::Index>(c));
  }
  return x;
}

Eigen::MatrixXd SpaceFit::multiply(const Normal& normal, const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd product(x.rows(), x.cols());
  for (Eigen::Index first = 0; first < x.cols(); first += 4) {
    const Eigen::Index columns = std::min<Eigen::Index>(4, x.cols() - first);
    const std::vector<Grid> grids =
        multiplied(*parts_, normal, parts_->controls(x.middleCols(first, columns)));
    product.middleCols(first, columns) = parts_->sum(grids).leftCols(columns);
  }
  return product;
}

std::vector<SpaceFit::Grid> SpaceFit::multiplied(const Parts& p, const Normal& normal,
                                                 const std::vector<Grid>& from) {
  const int rows = p.bases[0].size();
  std::vector<Grid> to(rows, Grid::Zero(p.V * p.W, 4));
  for (int i = 0; i < rows; ++i)
    for (int d = 0; d < order && i + d < rows; ++d)
      add_product({normal.stencils_[i][d].data(), p.V, p.W}, from[i + d].data(), to[i].data(), from[i].data(),
                  d > 0 ? to[i + d].data() : nullptr);
  return to;
}

Eigen::MatrixX3d SpaceFit::project(const Eigen::Ref<const Eigen::MatrixX3d>& values, double t) const {
  const Parts& p = *parts_;
  std::vector<Grid> sums(p.bases[0].size(), Grid::Zero(p.V * p.W, 4));
  Grid of_plane(p.V * p.W, 4);
  for (const Parts::Plane& plane : p.planes) {
    of_plane.setZero();
    auto sample = plane.samples.begin();
    for (const Parts::Cell& cell : p.sections[plane.section].cells)
      for (const int place : cell.places) {
        const Eigen::RowVector4d value(values(*sample, 0), values(*sample, 1), values(*sample, 2), 0);
        ++sample;
        const double* w = p.places[place].weight.data();
        for (int j = 0; j < order; ++j)
          for (int k = 0; k < order; ++k)
            of_plane.row((cell.first_across + j) * p.W + cell.first_height + k) += *w++ * value;
      }
    const auto [first, value] = p.bases[0].evaluate(p.parametrization.along(plane.u, t).value);
    for (int i = 0; i < order; ++i) sums[first + i] += value[i] * of_plane;
  }
  return p.sum(sums).leftCols<3>();
}

Eigen::MatrixX3d SpaceFit::values(const Eigen::MatrixX3d& x, double t) const {
  const Parts& p = *parts_;
  const std::vector<Grid> controls = p.controls(x);
  Eigen::MatrixX3d result = Eigen::MatrixX3d::Zero(p.sample_count, 3);
  Grid of_plane(p.V * p.W, 4);
  for (const Parts::Plane& plane : p.planes) {
    const auto [first, value] = p.bases[0].evaluate(p.parametrization.along(plane.u, t).value);
    of_plane.setZero();
    for (int i = 0; i < order; ++i) of_plane += value[i] * controls[first + i];
    auto sample = plane.samples.begin();
    for (const Parts::Cell& cell : p.sections[plane.section].cells)
      for (const int place : cell.places) {
        const Parts::Weights& weights = p.places[place];
        const double* w = weights.weight.data();
        Eigen::RowVector4d sum = Eigen::RowVector4d::Zero();
        for (int j = 0; j < order; ++j)
          for (int k = 0; k < order; ++k)
            sum += *w++ * of_plane.row((cell.first_across + j) * p.W + cell.first_height + k);
        for (int a = 0; a < 3; ++a) result(*sample, a) += weights.share * sum[a];
        ++sample;
      }
  }
  return result;
}

}  // namespace cleft
