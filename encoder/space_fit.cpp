#include "encoder/space_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

#include "base/error.h"

namespace cleft {

namespace {

constexpr double diagonal_strength =
    1e-11;  // relative to the mean diagonal of B^T B; holds what neither data nor roughness reach
constexpr int order = 4;  // cubics: four functions an axis
constexpr int cell_size = order * order;
constexpr int reach = 2 * order - 1;  // control points meet only where indices differ by at most 3: a stencil

/// The samples of one plane u = const within one span across and in height: what they add to B^T B.
struct Cell {
  int first_across, first_height;
  std::vector<int> samples;                            // rows of `weights`
  std::array<double, cell_size * cell_size> normal{};  // sum of w w^T over the samples
};
struct Plane {
  double u;
  std::vector<Cell> cells;
};
struct Weighted {
  int sample;
  double share;                          // of the sample's value: 1/2 where both sides of v = 0 see it
  std::array<double, cell_size> weight;  // N_j(across) N_k(height)
};

using Grid = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // a row a control point

std::vector<double> greville(const BSplineBasis& basis) {
  std::vector<double> places(basis.size(), 0.0);
  for (int i = 0; i < basis.size(); ++i)
    for (int k = 1; k <= basis.degree(); ++k) places[i] += basis.knots()[i + k] / basis.degree();
  return places;
}

/// Second divided differences: rows of (first index, three weights), scaled by the mean spacing.
struct Difference {
  int first;
  std::array<double, 3> weight;
};
std::vector<Difference> differences(const std::vector<double>& places) {
  const int n = static_cast<int>(places.size());
  const double spacing = (places.back() - places.front()) / (n - 1);
  std::vector<Difference> rows;
  for (int i = 1; i + 1 < n; ++i) {
    const double before = places[i] - places[i - 1], after = places[i + 1] - places[i];
    // Two control points in one place, or as good as: the break at v = 0, or knots that coincide.
    if (std::min(before, after) <= 1e-4 * spacing) continue;
    rows.push_back({i - 1, {spacing / before, -spacing / before - spacing / after, spacing / after}});
  }
  return rows;
}

}  // namespace

struct SpaceFit::Parts {
  const Parametrization& parametrization;
  std::array<BSplineBasis, 3> bases;
  ControlTies ties;
  std::vector<Plane> planes;
  std::vector<Weighted> weights;
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

  Eigen::MatrixXd tie(const Stencil& stencil, int row, int column) const;
  void add_roughness_in_row(Stencil& stencil, double strength) const;
  std::vector<Grid> controls(
      const Eigen::Ref<const Eigen::MatrixXd>& x) const;      // ties x, row after row along
  Eigen::MatrixXd sum(const std::vector<Grid>& grids) const;  // ties^T of such
};

struct SpaceFit::Factor::Parts {
  const ControlTies* ties;
  std::vector<Eigen::MatrixXd> diagonal;              // L of the diagonal blocks
  std::vector<std::array<Eigen::MatrixXd, 3>> lower;  // L of rows i + 1 .. i + 3 in column i
};

SpaceFit::~SpaceFit() = default;
SpaceFit::SpaceFit(SpaceFit&&) noexcept = default;
SpaceFit::Factor::~Factor() = default;
SpaceFit::Factor::Factor(Factor&&) noexcept = default;
SpaceFit::Factor::Factor(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
const ControlTies& SpaceFit::ties() const { return parts_->ties; }

SpaceFit::SpaceFit(const Parametrization& parametrization, const std::array<BSplineBasis, 3>& bases,
                   const std::vector<Sample>& samples) {
  auto parts = std::make_unique<Parts>(
      Parts{parametrization,
            bases,
            parametrization.moves() ? ControlTies::following_tip(bases) : ControlTies::none(bases),
            {},
            {},
            static_cast<Eigen::Index>(samples.size()),
            bases[1].size(),
            bases[2].size()});
  for (const BSplineBasis& basis : bases) CLEFT_CHECK(basis.degree() + 1, ==, int(order));
  Parts& p = *parts;
  std::map<double, std::map<std::array<int, 2>, Cell>> planes;
  const bool ahead_is_tied = p.ties.size() < bases[0].size() * p.V * p.W;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const Vec3& uvw = samples[s].uvw;
    const Side side = samples[s].side;
    for (const Limit limit : {Limit::from_left, Limit::from_right}) {
      const bool left = limit == Limit::from_left, uncut_plane = uvw.y == 0 && side == Side::both;
      // Uncut tissue on the plane is both sides' business where nothing ties them.
      if (uncut_plane ? ahead_is_tied && !left : left != (uvw.y < 0 || (uvw.y == 0 && side == Side::left)))
        continue;
      const auto v = bases[1].evaluate(parametrization.across(uvw.y).value, limit),
                 w = bases[2].evaluate(parametrization.height(uvw.z).value);
      Cell& cell =
          planes[uvw.x].try_emplace({v.first, w.first}, Cell{v.first, w.first, {}, {}}).first->second;
      Weighted weighted{static_cast<int>(s), uncut_plane && !ahead_is_tied ? 0.5 : 1, {}};
      for (int j = 0; j < order; ++j)
        for (int k = 0; k < order; ++k) weighted.weight[j * order + k] = v.value[j] * w.value[k];
      cell.samples.push_back(static_cast<int>(p.weights.size()));
      p.weights.push_back(weighted);
      for (int a = 0; a < cell_size; ++a)
        for (int b = 0; b < cell_size; ++b)
          cell.normal[a * cell_size + b] += weighted.weight[a] * weighted.weight[b];
    }
  }
  for (auto& [u, cells] : planes) {
    p.planes.push_back({u, {}});
    for (auto& [key, cell] : cells) p.planes.back().cells.push_back(std::move(cell));
  }
  // Functions sum to 1, and so do their products: the mean diagonal is about the sum of squares over them.
  for (const Weighted& w : p.weights)
    for (const double value : w.weight) p.scale += value * value;
  p.scale /= static_cast<double>(bases[0].size()) * p.V * p.W * 2;
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

/// The block between the unknowns of two rows: ties^T stencil ties.
Eigen::MatrixXd SpaceFit::Parts::tie(const Stencil& stencil, int row, int column) const {
  const auto &of_row = ties.row(row), &of_column = ties.row(column);
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(ties.row_size(row), ties.row_size(column));
  for (int j = 0; j < V; ++j)
    for (int k = 0; k < W; ++k) {
      const ControlTies::Control& a = of_row[j * W + k];
      const double* values = &stencil[(static_cast<std::size_t>(j) * W + k) * reach * reach];
      for (int jj = std::max(0, j - order + 1); jj <= std::min(V - 1, j + order - 1); ++jj)
        for (int kk = std::max(0, k - order + 1); kk <= std::min(W - 1, k + order - 1); ++kk) {
          const double value = values[offset(jj - j, kk - k)];
          if (value == 0) continue;
          const ControlTies::Control& b = of_column[jj * W + kk];
          for (int x = 0; x < a.terms; ++x)
            for (int y = 0; y < b.terms; ++y)
              block(a.term[x].unknown, b.term[y].unknown) += value * a.term[x].weight * b.term[y].weight;
        }
    }
  return block;
}

SpaceFit::Normal SpaceFit::normal(double t, double strength) const {
  const Parts& p = *parts_;
  const int rows = p.bases[0].size();
  Normal result;
  auto& stencils = result.stencils_;
  stencils.resize(rows);
  for (auto& of_row : stencils)
    for (auto& stencil : of_row) stencil.assign(p.stencil_size(), 0.0);
  for (const Plane& plane : p.planes) {
    const auto [first, value] = p.bases[0].evaluate(p.parametrization.along(plane.u, t).value);
    for (int i = 0; i < order; ++i)
      for (int d = 0; i + d < order; ++d) {
        const double weight = value[i] * value[i + d];
        if (weight == 0) continue;
        Parts::Stencil& stencil = stencils[first + i][d];
        for (const Cell& cell : plane.cells)
          for (int a = 0; a < cell_size; ++a) {
            const int aj = a / order, ak = a % order;
            double* line = &stencil[p.at(cell.first_across + aj, cell.first_height + ak)];
            const double* normal = &cell.normal[a * cell_size];
            for (int bj = 0; bj < order; ++bj) {
              double* to = line + Parts::offset(bj - aj, -ak);
              for (int bk = 0; bk < order; ++bk) to[bk] += weight * normal[bj * order + bk];
            }
          }
      }
  }
  // Roughness, and a little of the identity.
  strength *= p.scale;
  for (int i = 0; i < rows; ++i) p.add_roughness_in_row(stencils[i][0], strength);
  const auto add_diagonal = [&](Parts::Stencil& stencil, double value) {
    for (std::size_t at = Parts::offset(0, 0); at < stencil.size(); at += reach * reach) stencil[at] += value;
  };
  for (const auto& [first, weight] : differences(greville(p.bases[0])))
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b) add_diagonal(stencils[first + a][b - a], strength * weight[a] * weight[b]);
  for (int i = 0; i < rows; ++i) add_diagonal(stencils[i][0], diagonal_strength * p.scale);
  return result;
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

SpaceFit::Factor SpaceFit::factorize(const Normal& normal) const {
  const Parts& p = *parts_;
  const int rows = p.bases[0].size();
  auto factor = std::make_unique<Factor::Parts>(Factor::Parts{&p.ties, {}, {}});
  std::vector<std::array<Eigen::MatrixXd, order>> blocks(rows);
  for (int i = 0; i < rows; ++i)
    for (int d = 0; d < order && i + d < rows; ++d)
      blocks[i][d] = d == 0 ? p.tie(normal.stencils_[i][0], i, i)
                            : Eigen::MatrixXd(p.tie(normal.stencils_[i][d], i, i + d).transpose());
  factor->diagonal.resize(rows), factor->lower.resize(rows);
  for (int i = 0; i < rows; ++i) {  // block Cholesky, column after column
    const Eigen::LLT<Eigen::MatrixXd> cholesky(blocks[i][0]);
    if (cholesky.info() != Eigen::Success)
      throw std::runtime_error("the fit's normal matrix is not positive definite");
    factor->diagonal[i] = cholesky.matrixL();
    const auto upper = factor->diagonal[i].transpose().triangularView<Eigen::Upper>();
    for (int d = 1; d < order && i + d < rows; ++d)
      factor->lower[i][d - 1] = upper.solve<Eigen::OnTheRight>(blocks[i][d]);
    for (int d = 1; d < order && i + d < rows; ++d)
      for (int e = d; e < order && i + e < rows; ++e)
        blocks[i + d][e - d].noalias() -= factor->lower[i][e - 1] * factor->lower[i][d - 1].transpose();
  }
  return Factor(std::move(factor));
}

Eigen::MatrixXd SpaceFit::Factor::solve(Eigen::MatrixXd x) const {
  const ControlTies& ties = *parts_->ties;
  const int rows = ties.rows();
  const auto part = [&](int i) { return x.middleRows(ties.first(i), ties.row_size(i)); };
  for (int i = 0; i < rows; ++i) {
    parts_->diagonal[i].triangularView<Eigen::Lower>().solveInPlace(part(i));
    for (int d = 1; d < order && i + d < rows; ++d)
      part(i + d).noalias() -= parts_->lower[i][d - 1] * part(i);
  }
  for (int i = rows - 1; i >= 0; --i) {
    for (int d = 1; d < order && i + d < rows; ++d)
      part(i).noalias() -= parts_->lower[i][d - 1].transpose() * part(i + d);
    parts_->diagonal[i].transpose().triangularView<Eigen::Upper>().solveInPlace(part(i));
  }
  return x;
}

std::vector<Grid> SpaceFit::Parts::controls(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  std::vector<Grid> grids(ties.rows(), Grid(V * W, x.cols()));
  for (int i = 0; i < ties.rows(); ++i) {
    const auto& row = ties.row(i);
    for (std::size_t c = 0; c < row.size(); ++c) {
      auto control = grids[i].row(static_cast<Eigen::Index>(c));
      control = row[c].term[0].weight * x.row(ties.first(i) + row[c].term[0].unknown);
      if (row[c].terms == 2) control += row[c].term[1].weight * x.row(ties.first(i) + row[c].term[1].unknown);
    }
  }
  return grids;
}

Eigen::MatrixXd SpaceFit::Parts::sum(const std::vector<Grid>& grids) const {
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(ties.size(), grids[0].cols());
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
  const Parts& p = *parts_;
  const int rows = p.bases[0].size();
  const auto columns = x.cols();
  const std::vector<Grid> from = p.controls(x);
  std::vector<Grid> to(rows, Grid::Zero(p.V * p.W, columns));
  for (int i = 0; i < rows; ++i)
    for (int d = 0; d < order && i + d < rows; ++d) {
      const Parts::Stencil& stencil = normal.stencils_[i][d];
      const double *right = from[i + d].data(), *left = from[i].data();
      double *of_i = to[i].data(), *of_right = to[i + d].data();
      for (int j = 0; j < p.V; ++j)
        for (int k = 0; k < p.W; ++k) {
          const int c = j * p.W + k, k_from = std::max(0, k - order + 1),
                    k_to = std::min(p.W - 1, k + order - 1);
          for (int jj = std::max(0, j - order + 1); jj <= std::min(p.V - 1, j + order - 1); ++jj) {
            const double* value = &stencil[p.at(j, k) + Parts::offset(jj - j, k_from - k)];
            for (int kk = k_from; kk <= k_to; ++kk, ++value)
              for (Eigen::Index a = 0; a < columns; ++a) {
                of_i[c * columns + a] += *value * right[(jj * p.W + kk) * columns + a];
                if (d > 0) of_right[(jj * p.W + kk) * columns + a] += *value * left[c * columns + a];
              }
          }
        }
    }
  return p.sum(to);
}

Eigen::MatrixX3d SpaceFit::project(const Eigen::MatrixX3d& values, double t) const {
  const Parts& p = *parts_;
  std::vector<Grid> sums(p.bases[0].size(), Grid::Zero(p.V * p.W, 3));
  Grid of_plane(p.V * p.W, 3);
  for (const Plane& plane : p.planes) {
    of_plane.setZero();
    for (const Cell& cell : plane.cells)
      for (const int s : cell.samples) {
        const Weighted& weighted = p.weights[s];
        const double x = values(weighted.sample, 0), y = values(weighted.sample, 1),
                     z = values(weighted.sample, 2);
        for (int j = 0; j < order; ++j) {
          double* to = &of_plane((cell.first_across + j) * p.W + cell.first_height, 0);
          for (const double* w = &weighted.weight[j * order]; w != &weighted.weight[j * order] + order;
               ++w, to += 3)
            to[0] += *w * x, to[1] += *w * y, to[2] += *w * z;
        }
      }
    const auto [first, value] = p.bases[0].evaluate(p.parametrization.along(plane.u, t).value);
    for (int i = 0; i < order; ++i) sums[first + i] += value[i] * of_plane;
  }
  return p.sum(sums);
}

double SpaceFit::Factor::condition() const {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const Eigen::MatrixXd& block : parts_->diagonal) {
    least = std::min(least, block.diagonal().minCoeff());
    greatest = std::max(greatest, block.diagonal().maxCoeff());
  }
  return (greatest / least) * (greatest / least);
}

Eigen::MatrixX3d SpaceFit::values(const Eigen::MatrixX3d& x, double t) const {
  const Parts& p = *parts_;
  const std::vector<Grid> controls = p.controls(x);
  Eigen::MatrixX3d result = Eigen::MatrixX3d::Zero(p.sample_count, 3);
  Grid of_plane(p.V * p.W, 3);
  for (const Plane& plane : p.planes) {
    const auto [first, value] = p.bases[0].evaluate(p.parametrization.along(plane.u, t).value);
    of_plane.setZero();
    for (int i = 0; i < order; ++i) of_plane += value[i] * controls[first + i];
    for (const Cell& cell : plane.cells)
      for (const int s : cell.samples) {
        const Weighted& weighted = p.weights[s];
        double sum[3] = {};
        for (int j = 0; j < order; ++j) {
          const double* from = &of_plane((cell.first_across + j) * p.W + cell.first_height, 0);
          for (const double* w = &weighted.weight[j * order]; w != &weighted.weight[j * order] + order;
               ++w, from += 3)
            for (int a = 0; a < 3; ++a) sum[a] += *w * from[a];
        }
        for (int a = 0; a < 3; ++a) result(weighted.sample, a) += weighted.share * sum[a];
      }
  }
  return result;
}

}  // namespace cleft
