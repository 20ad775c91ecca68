#include "solver/patch_system.h"

#include <Epetra_MultiVector.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/error.h"
#include "params/parameters/table.h"
#include "solver/assembly.h"
#include "solver/block_rows.h"
#include "solver/cut_nodes.h"

namespace cleft {

namespace {

Eigen::Vector3d directions(const Parameters::Skin& skin) {
  return {skin.prestress.uu, skin.prestress.vv, skin.prestress.uv};
}

}  // namespace

Block multiply(const Epetra_CrsMatrix& matrix, const Block& block) {
  Block product(block.rows(), block.cols());
  if (block.cols() == 0) return product;
  const int rows = static_cast<int>(block.rows()), columns = static_cast<int>(block.cols());
  const Epetra_MultiVector x(View, matrix.DomainMap(), const_cast<double*>(block.data()), rows, columns);
  Epetra_MultiVector y(View, matrix.RangeMap(), product.data(), rows, columns);
  CLEFT_CHECK(matrix.Apply(x, y), ==, 0);
  return product;
}

namespace {

/// What of the loads of a prestress is left when the closed patch is in equilibrium with its surroundings:
/// the forces of each node, less the mean of those at its place, so that all copies bear alike what curved
/// skin presses on the tissue. Rounded to multiples of a number so small that it does not matter, of which
/// sums are exact: adding up the copies (CutNodes::to_pulls), however many, gives 0 to the last bit.
Block released_part(const PatchSystem& system, const PatchMesh& mesh, const Block& loads) {
  const CutNodes cut(mesh, system);
  Block released = Block::Zero(loads.rows(), loads.cols());
  if (cut.nodes.empty()) return released;
  Eigen::MatrixXd forces = all_gather_rows(system, loads, cut.unknowns);
  std::vector<int> root(cut.nodes.size());  // a right node is the left one of later pairs only
  std::iota(root.begin(), root.end(), 0);
  for (const auto& [left, right] : cut.pairs) root[right] = root[left];
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(forces.rows(), forces.cols());
  std::vector<int> copies(cut.nodes.size(), 0);
  for (std::size_t n = 0; n < root.size(); ++n)
    means.middleRows<3>(3 * root[n]) += forces.middleRows<3>(static_cast<Eigen::Index>(3 * n)),
        ++copies[root[n]];
  for (std::size_t n = 0; n < root.size(); ++n) {
    const auto row = static_cast<Eigen::Index>(3 * n);
    if (root[n] == static_cast<int>(n))
      forces.middleRows<3>(row).setZero();
    else
      forces.middleRows<3>(row) -= means.middleRows<3>(3 * root[n]) / copies[root[n]];
  }
  const double unit = std::ldexp(1., std::ilogb(std::max(1e-300, forces.cwiseAbs().maxCoeff())) - 48);
  forces = (forces / unit).array().round() * unit;
  Eigen::MatrixXd sums = forces;
  cut.to_pulls(sums);
  for (std::size_t n = 0; n < root.size(); ++n)
    if (const auto row = static_cast<Eigen::Index>(3 * n); root[n] == static_cast<int>(n))
      forces.middleRows<3>(row) = -sums.middleRows<3>(row);
  set_rows(system, released, cut.unknowns, forces);
  return released;
}

}  // namespace

struct PatchSystem::Parts {
  Parts(const PatchMesh& mesh, const Parameters& parameters, MPI_Comm communicator,
        const Discretization& discretization)
      : elements(mesh, parameters, communicator, discretization) {}

  void assemble(const Parameters& parameters) {
    system.emplace(elements, 3);
    system->add(elements, parameters, 1, Eigen::Matrix3d::Identity());
    system->finish();
    unit_loads = system->loads();
    system->forget_loads();
  }

  PatchElements elements;
  std::optional<Assembly> system;
  Block unit_loads;
};

PatchSystem::PatchSystem(const PatchMesh& mesh, const Parameters& parameters, MPI_Comm communicator,
                         const Discretization& discretization, KeepElements keep)
    : parts_(std::make_unique<Parts>(mesh, parameters, communicator, discretization)) {
  reassemble(parameters);
  if (keep == KeepElements::no) parts_->elements.forget();
}

void PatchSystem::reassemble(const Parameters& parameters) {
  parts_->assemble(parameters);
  if (parameters.skin.edges == SkinEdges::held)
    parts_->unit_loads = released_part(*this, parts_->elements.mesh, parts_->unit_loads);
}

PatchSystem::~PatchSystem() = default;

MPI_Comm PatchSystem::communicator() const { return parts_->elements.communicator; }
int PatchSystem::rank() const { return parts_->elements.rank; }
int PatchSystem::size() const { return offsets().back(); }
int PatchSystem::first() const { return offsets()[rank()]; }
int PatchSystem::owned() const { return offsets()[rank() + 1] - first(); }
int PatchSystem::unknown(int node, int axis) const { return parts_->elements.first_unknown[node] + axis; }
const std::vector<int>& PatchSystem::offsets() const { return parts_->elements.offsets; }
const Block& PatchSystem::unit_loads() const { return parts_->unit_loads; }
Block PatchSystem::load(const Parameters::Skin& prestress) const {
  return unit_loads() * directions(prestress);
}
const Epetra_CrsMatrix& PatchSystem::stiffness() const {
  return parts_->system->stiffness().trilinos_matrix();
}
Block PatchSystem::multiply(const Block& block) const { return cleft::multiply(stiffness(), block); }

PatchSystem::Entries PatchSystem::lower_triangle() const { return lower_triangle(stiffness()); }

PatchSystem::Entries PatchSystem::lower_triangle(const Epetra_CrsMatrix& matrix) {
  Entries entries;
  const auto half = static_cast<std::size_t>(matrix.NumMyNonzeros()) / 2 + matrix.NumMyRows();
  for (auto* list : {&entries.row, &entries.column}) list->reserve(half);
  entries.value.reserve(half);
  for (int row = 0; row < matrix.NumMyRows(); ++row) {
    int count = 0, *columns = nullptr;
    double* values = nullptr;
    matrix.ExtractMyRowView(row, count, values, columns);
    const int global_row = matrix.GRID(row);
    for (int i = 0; i < count; ++i) {
      const int global_column = matrix.GCID(columns[i]);
      if (global_column > global_row) continue;
      entries.row.push_back(global_row);
      entries.column.push_back(global_column);
      entries.value.push_back(values[i]);
    }
  }
  return entries;
}

Eigen::MatrixX4d PatchSystem::places() const {
  Eigen::MatrixX4d places(owned(), 4);
  const std::vector<Vec3>& points = parts_->elements.mesh.points;
  for (std::size_t n = 0; n < points.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      if (const int local = row(unknown(static_cast<int>(n), axis)); local >= 0) {
        const Vec3& at = points[n];
        places.row(local) << at.x, at.y, at.z, axis;
      }
  return places;
}

std::unique_ptr<PatchElements> PatchSystem::elements(const Parameters& parameters) const {
  const PatchElements& own = parts_->elements;
  auto elements = std::make_unique<PatchElements>(own.mesh, parameters, own.communicator, own.discretization,
                                                  own.rank_of_cell);
  CLEFT_CHECK(elements->offsets == own.offsets, ==, true);
  return elements;
}

namespace {

class AssembledDerivative : public PatchSystem::Derivative {
 public:
  AssembledDerivative(Assembly assembly, Block load)
      : assembly_(std::move(assembly)), load_(std::move(load)) {}
  Block multiply(const Block& block) const override {
    return cleft::multiply(assembly_.stiffness().trilinos_matrix(), block);
  }
  Block load() const override { return load_; }

 private:
  Assembly assembly_;
  Block load_;
};

}  // namespace

std::vector<std::pair<double, double>> differences_by(const Parameters& parameters, const std::string& name) {
  const Parameter& row = find_parameter(name, "derivative");
  const double at = std::get<double>(get_parameter(parameters, row));
  // Poisson's ratios act through 1 / (1 - 2 nu): the step follows the distance from 1/2.
  const double scale = row.greatest < 1 ? std::max(0.5 - at, 1e-4) : std::max(std::abs(at), 1e-3);
  const double step = 1e-3 * scale;
  std::vector<std::pair<double, double>> differences;
  for (const auto& [steps, weight] : {std::pair(-2., 1.), {-1., -8.}, {1., 8.}, {2., -1.}})
    differences.emplace_back(at + steps * step, weight / (12 * step));
  return differences;
}

std::unique_ptr<PatchSystem::Derivative> PatchSystem::derivative(const Parameters& parameters,
                                                                 const std::string& name) const {
  const Parameter& row = find_parameter(name, "derivative");
  const std::unique_ptr<PatchElements> once_more = this->elements(parameters);
  const PatchElements& elements = *once_more;
  Assembly sum(elements, 1);
  for (const auto& [value, weight] : differences_by(parameters, name)) {
    Parameters moved = parameters;
    std::get<0>(row.access)(moved) = value;
    sum.add(elements, moved, weight, directions(moved.skin));
  }
  sum.finish();
  Block load = sum.loads();
  sum.forget_loads();
  if (parameters.skin.edges == SkinEdges::held) load = released_part(*this, elements.mesh, load);
  return std::make_unique<AssembledDerivative>(std::move(sum), std::move(load));
}

}  // namespace cleft
