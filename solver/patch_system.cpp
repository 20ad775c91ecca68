#include "solver/patch_system.h"

#include <Epetra_MultiVector.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/fe_wedge_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "solver/material/linear_isotropic.h"
#include "solver/material/membrane.h"

namespace cleft {

using namespace dealii;

namespace {

enum Boundary : types::boundary_id { other_boundary = 0, top = 1, bottom = 2, side = 3 };

void partition(Triangulation<3>& triangulation, unsigned ranks, Partitioner partitioner) {
  if (partitioner == Partitioner::zorder)
    GridTools::partition_triangulation_zorder(ranks, triangulation);
  else
    GridTools::partition_triangulation(ranks, triangulation,
                                       partitioner == Partitioner::metis
                                           ? SparsityTools::Partitioner::metis
                                           : SparsityTools::Partitioner::zoltan);
}

Quadrature<3> wedge_rule(WedgeRule rule) {
  if (rule == WedgeRule::full) return QGaussWedge<3>(2);
  std::vector<Point<3>> points;
  const QGauss<1> axis(2);
  for (const Point<1>& z : axis.get_points()) points.emplace_back(1. / 3, 1. / 3, z[0]);
  return {points, {0.25, 0.25}};
}

Eigen::Vector3d directions(const Parameters::Skin& skin) {
  return {skin.prestress_u, skin.prestress_v, skin.prestress_uv};
}

/// A matrix and columns of loads.
struct Assembled {
  TrilinosWrappers::SparseMatrix stiffness;
  std::vector<TrilinosWrappers::MPI::Vector> loads;

  Block load_block() const {
    Block block(static_cast<Eigen::Index>(loads.front().locally_owned_size()),
                static_cast<Eigen::Index>(loads.size()));
    for (std::size_t c = 0; c < loads.size(); ++c)
      std::copy(loads[c].begin(), loads[c].end(), block.col(static_cast<Eigen::Index>(c)).data());
    return block;
  }
};

/// Trilinos applies a matrix to memory that Eigen owns.
Block apply(const Epetra_CrsMatrix& matrix, const Block& block) {
  Block product(block.rows(), block.cols());
  if (block.cols() == 0) return product;
  const int rows = static_cast<int>(block.rows()), columns = static_cast<int>(block.cols());
  const Epetra_MultiVector x(View, matrix.DomainMap(), const_cast<double*>(block.data()), rows, columns);
  Epetra_MultiVector y(View, matrix.RangeMap(), product.data(), rows, columns);
  CLEFT_CHECK(matrix.Apply(x, y), ==, 0);
  return product;
}

}  // namespace

struct PatchSystem::Parts {
  /// `division`: that of earlier Parts, to get the same numbers of the unknowns; Zoltan's is never the same.
  Parts(const PatchMesh& patch, const Parameters& p, MPI_Comm comm, const Discretization& d,
        std::vector<unsigned> division = {})
      : communicator(comm),
        mesh(patch),
        parameters(p),
        discretization(d),
        rank_of_cell(std::move(division)),
        triangulation(comm),
        element(FE_WedgeP<3>(1), 3),
        mapping(FE_WedgeP<3>(1)),
        dofs(triangulation) {
    create_triangulation();
    distribute_unknowns();
  }

  void assemble_system() {
    make_empty(3, system);
    assemble(parameters, 1, Eigen::Matrix3d::Identity(), system);
    finish(system);
    unit_loads = system.load_block();
    system.loads.clear();
  }

  /// The elements have done their work; a factor will want their memory.
  void forget_elements() {
    dofs.clear();
    triangulation.clear();
    pattern.clear();
  }

  void create_triangulation();
  void distribute_unknowns();
  void make_empty(int loads, Assembled& empty) const;
  /// Adds factor K to the matrix, and factor times the unit loads, combined by columns, to the loads.
  void assemble(const Parameters& p, double factor, const Eigen::Matrix3Xd& combination,
                Assembled& into) const;
  static void finish(Assembled& assembled);
  void add_tissue(const Parameters& p, FEValues<3>& values, FullMatrix<double>& cell_matrix) const;
  void add_springs(FEFaceValues<3>& values, double spring, FullMatrix<double>& cell_matrix) const;
  void add_skin(const Parameters& p, const DoFHandler<3>::active_cell_iterator& cell, unsigned face,
                FullMatrix<double>& cell_matrix, FullMatrix<double>& cell_loads) const;

  MPI_Comm communicator;
  const PatchMesh& mesh;
  const Parameters parameters;
  const Discretization discretization;
  std::vector<unsigned> rank_of_cell;  // rank 0
  parallel::fullydistributed::Triangulation<3> triangulation;
  FESystem<3> element;
  MappingFE<3> mapping;
  DoFHandler<3> dofs;
  std::vector<int> first_unknown;  // by node: of its three
  std::vector<int> offsets;        // by rank
  int rank = 0;
  TrilinosWrappers::SparsityPattern pattern;
  Assembled system;
  Block unit_loads;
};

void PatchSystem::Parts::create_triangulation() {
  const double small = 1e-9 * parameters.patch.length;
  const auto near = [&](double a, double b) { return std::abs(a - b) < small; };
  // Rank 0 makes the whole mesh, divides it and hands out the parts.
  const auto make_whole = [&](Triangulation<3>& whole) {
    std::vector<Point<3>> vertices;
    for (const Vec3& p : mesh.points) vertices.emplace_back(p.x, p.y, p.z);
    std::vector<CellData<3>> cells;
    for (const auto& wedge : mesh.wedges) {
      CellData<3>& cell = cells.emplace_back(6);
      for (unsigned i = 0; i < 6; ++i) cell.vertices[i] = wedge[i];
    }
    whole.create_triangulation(vertices, cells, SubCellData());
    for (const auto& cell : whole.active_cell_iterators())
      for (const unsigned f : cell->face_indices()) {
        if (!cell->face(f)->at_boundary()) continue;
        const Point<3> center = cell->face(f)->center();
        if (near(center[2], 0))
          cell->face(f)->set_boundary_id(top);
        else if (near(center[2], -parameters.patch.height))
          cell->face(f)->set_boundary_id(bottom);
        else if (near(std::abs(center[0]), parameters.patch.length / 2) ||
                 near(std::abs(center[1]), parameters.patch.width / 2))
          cell->face(f)->set_boundary_id(side);
      }
  };
  const unsigned ranks = Utilities::MPI::n_mpi_processes(communicator);
  triangulation.create_triangulation(
      TriangulationDescription::Utilities::create_description_from_triangulation_in_groups<3, 3>(
          make_whole,
          [&](Triangulation<3>& whole, const MPI_Comm&, unsigned) {
            if (rank_of_cell.empty()) partition(whole, ranks, discretization.partitioner);
            rank_of_cell.resize(whole.n_active_cells(), numbers::invalid_subdomain_id);
            for (const auto& cell : whole.active_cell_iterators()) {
              unsigned& owner = rank_of_cell[cell->active_cell_index()];
              if (owner == numbers::invalid_subdomain_id) owner = cell->subdomain_id();
              cell->set_subdomain_id(owner);
            }
          },
          communicator, static_cast<int>(ranks)));
}

void PatchSystem::Parts::distribute_unknowns() {
  dofs.distribute_dofs(element);
  offsets = {0};
  for (const IndexSet& owned : Utilities::MPI::all_gather(communicator, dofs.locally_owned_dofs())) {
    CLEFT_CHECK(owned.is_contiguous(), ==, true);
    offsets.push_back(offsets.back() + static_cast<int>(owned.n_elements()));
  }
  rank = static_cast<int>(Utilities::MPI::this_mpi_process(communicator));
  std::vector<int> known(mesh.points.size(), -1);
  for (const auto& cell : dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    const auto& wedge = mesh.wedges[cell->id().get_coarse_cell_id()];
    for (const unsigned v : cell->vertex_indices()) {
      const Vec3& at = mesh.points[wedge[v]];
      CLEFT_CHECK(cell->vertex(v).distance({at.x, at.y, at.z}), ==, 0);
      known[wedge[v]] = static_cast<int>(cell->vertex_dof_index(v, 0));
      CLEFT_CHECK(cell->vertex_dof_index(v, 2), ==, cell->vertex_dof_index(v, 0) + 2);
    }
  }
  first_unknown.resize(known.size());
  MPI_Allreduce(known.data(), first_unknown.data(), static_cast<int>(known.size()), MPI_INT, MPI_MAX,
                communicator);
  const IndexSet& owned = dofs.locally_owned_dofs();
  pattern.reinit(owned, owned, communicator, 60);
  DoFTools::make_sparsity_pattern(dofs, pattern, AffineConstraints<double>(), true,
                                  triangulation.locally_owned_subdomain());
  pattern.compress();
}

void PatchSystem::Parts::make_empty(int loads, Assembled& empty) const {
  empty.stiffness.reinit(pattern);
  for (int i = 0; i < loads; ++i) empty.loads.emplace_back(dofs.locally_owned_dofs(), communicator);
}

void PatchSystem::Parts::finish(Assembled& assembled) {
  assembled.stiffness.compress(VectorOperation::add);
  for (auto& load : assembled.loads) load.compress(VectorOperation::add);
}

void PatchSystem::Parts::assemble(const Parameters& p, double factor, const Eigen::Matrix3Xd& combination,
                                  Assembled& into) const {
  FEValues<3> values(mapping, element, wedge_rule(discretization.rule), update_gradients | update_JxW_values);
  const QGaussSimplex<2> triangle(2);
  const QGauss<2> quad(2);
  FEFaceValues<3> face_values(mapping, element, hp::QCollection<2>(triangle, triangle, quad, quad, quad),
                              update_values | update_JxW_values);
  const unsigned n = element.n_dofs_per_cell();
  FullMatrix<double> cell_matrix(n, n), cell_loads(n, 3);
  std::vector<types::global_dof_index> indices(n);
  for (const auto& cell : dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell_matrix = 0;
    values.reinit(cell);
    add_tissue(p, values, cell_matrix);
    cell->get_dof_indices(indices);
    for (const unsigned f : cell->face_indices()) {
      const types::boundary_id boundary = cell->face(f)->boundary_id();
      if (!cell->face(f)->at_boundary() || boundary == other_boundary) continue;
      if (boundary == top) {
        cell_loads = 0;
        add_skin(p, cell, f, cell_matrix, cell_loads);
        for (std::size_t c = 0; c < into.loads.size(); ++c)
          for (unsigned i = 0; i < n; ++i) {
            double sum = 0;
            for (unsigned d = 0; d < 3; ++d)
              sum += cell_loads(i, d) * combination(d, static_cast<Eigen::Index>(c));
            if (sum != 0) into.loads[c](indices[i]) += factor * sum;
          }
      } else {
        face_values.reinit(cell, f);
        add_springs(face_values, boundary == bottom ? p.foundation.stiffness : p.foundation.side_stiffness,
                    cell_matrix);
      }
    }
    cell_matrix *= factor;
    into.stiffness.add(indices, cell_matrix);
  }
}

void PatchSystem::Parts::add_tissue(const Parameters& p, FEValues<3>& values,
                                    FullMatrix<double>& cell_matrix) const {
  const LinearIsotropic tissue(p.tissue);
  const bool mean = p.tissue.formulation == "mean-dilatation";
  constexpr unsigned vertices = 6;
  std::array<Tensor<1, 3>, vertices> mean_gradient;
  double volume = 0;
  for (unsigned q = 0; mean && q < values.n_quadrature_points; ++q) {
    volume += values.JxW(q);
    for (unsigned a = 0; a < vertices; ++a) mean_gradient[a] += values.shape_grad(3 * a, q) * values.JxW(q);
  }
  for (unsigned q = 0; q < values.n_quadrature_points; ++q)
    for (unsigned a = 0; a < vertices; ++a)
      for (unsigned b = 0; b < vertices; ++b) {
        // A shape function of vertex a in direction d has number 3 a + d and the scalar gradient of vertex a.
        const Tensor<1, 3>&ga = values.shape_grad(3 * a, q), &gb = values.shape_grad(3 * b, q);
        const Tensor<2, 3> dilatation =
            mean ? tissue.volumetric(mean_gradient[a] / volume, mean_gradient[b] / volume)
                 : tissue.volumetric(ga, gb);
        const Tensor<2, 3> k = (tissue.deviatoric(ga, gb) + dilatation) * values.JxW(q);
        for (unsigned i = 0; i < 3; ++i)
          for (unsigned j = 0; j < 3; ++j) cell_matrix(3 * a + i, 3 * b + j) += k[i][j];
      }
}

void PatchSystem::Parts::add_springs(FEFaceValues<3>& values, double spring,
                                     FullMatrix<double>& cell_matrix) const {
  for (const unsigned q : values.quadrature_point_indices())
    for (unsigned a = 0; a < 6; ++a)
      for (unsigned b = 0; b < 6; ++b) {
        const double k = spring * values.shape_value(3 * a, q) * values.shape_value(3 * b, q) * values.JxW(q);
        for (unsigned d = 0; d < 3; ++d) cell_matrix(3 * a + d, 3 * b + d) += k;
      }
}

void PatchSystem::Parts::add_skin(const Parameters& p, const DoFHandler<3>::active_cell_iterator& cell,
                                  unsigned face, FullMatrix<double>& cell_matrix,
                                  FullMatrix<double>& cell_loads) const {
  const Membrane membrane(p.skin);
  std::array<unsigned, 3> corner{};
  std::array<Vec3, 3> at;
  for (unsigned i = 0; i < 3; ++i)
    for (const unsigned v : cell->vertex_indices())
      if (cell->vertex_index(v) == cell->face(face)->vertex_index(i)) {
        corner[i] = v;
        at[i] = {cell->vertex(v)[0], cell->vertex(v)[1], cell->vertex(v)[2]};
      }
  const Membrane::Matrix6 k = membrane.stiffness(at[0], at[1], at[2]);
  const Membrane::Matrix63 f = membrane.unit_loads(at[0], at[1], at[2]);
  for (unsigned a = 0; a < 6; ++a) {
    const unsigned row = 3 * corner[a / 2] + a % 2;
    for (unsigned d = 0; d < 3; ++d) cell_loads(row, d) += f(a, d);
    for (unsigned b = 0; b < 6; ++b) cell_matrix(row, 3 * corner[b / 2] + b % 2) += k(a, b);
  }
  if (p.skin.initial_stress_stiffness != "true") return;
  const Eigen::Matrix3d geometric = membrane.initial_stress_stiffness(at[0], at[1], at[2]);
  for (unsigned a = 0; a < 3; ++a)
    for (unsigned b = 0; b < 3; ++b)
      for (unsigned d = 0; d < 3; ++d) cell_matrix(3 * corner[a] + d, 3 * corner[b] + d) += geometric(a, b);
}

PatchSystem::PatchSystem(const PatchMesh& mesh, const Parameters& parameters, MPI_Comm communicator,
                         const Discretization& discretization)
    : parts_(std::make_unique<Parts>(mesh, parameters, communicator, discretization)) {
  parts_->assemble_system();
  parts_->forget_elements();
}

PatchSystem::~PatchSystem() = default;

MPI_Comm PatchSystem::communicator() const { return parts_->communicator; }
int PatchSystem::rank() const { return parts_->rank; }
int PatchSystem::size() const { return parts_->offsets.back(); }
int PatchSystem::first() const { return parts_->offsets[parts_->rank]; }
int PatchSystem::owned() const { return parts_->offsets[parts_->rank + 1] - first(); }
int PatchSystem::unknown(int node, int axis) const { return parts_->first_unknown[node] + axis; }
const std::vector<int>& PatchSystem::offsets() const { return parts_->offsets; }
const Block& PatchSystem::unit_loads() const { return parts_->unit_loads; }
Block PatchSystem::load(const Parameters::Skin& prestress) const {
  return unit_loads() * directions(prestress);
}
const Epetra_CrsMatrix& PatchSystem::stiffness() const { return parts_->system.stiffness.trilinos_matrix(); }
Block PatchSystem::multiply(const Block& block) const { return apply(stiffness(), block); }

PatchSystem::Entries PatchSystem::lower_triangle() const {
  const Epetra_CrsMatrix& matrix = stiffness();
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
  for (std::size_t n = 0; n < parts_->mesh.points.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      if (const int local = row(parts_->first_unknown[n] + axis); local >= 0) {
        const Vec3& at = parts_->mesh.points[n];
        places.row(local) << at.x, at.y, at.z, axis;
      }
  return places;
}

namespace {

class AssembledDerivative : public PatchSystem::Derivative {
 public:
  explicit AssembledDerivative(Assembled assembled) : assembled_(std::move(assembled)) {}
  Block multiply(const Block& block) const override {
    return apply(assembled_.stiffness.trilinos_matrix(), block);
  }
  Block load() const override { return assembled_.load_block(); }

 private:
  Assembled assembled_;
};

}  // namespace

std::unique_ptr<PatchSystem::Derivative> PatchSystem::derivative(const Parameters& parameters,
                                                                 const std::string& name) const {
  const Parameter& row = find_parameter(name, "derivative");
  const double at = std::get<double>(get_parameter(parameters, row));
  // Poisson's ratios act through 1 / (1 - 2 nu): the step follows the distance from 1/2.
  const double scale = row.greatest < 1 ? std::max(0.5 - at, 1e-4) : std::max(std::abs(at), 1e-3);
  const double step = 1e-3 * scale;
  Parts elements(parts_->mesh, parameters, parts_->communicator, parts_->discretization,
                 parts_->rank_of_cell);
  CLEFT_CHECK(elements.offsets == parts_->offsets, ==, true);
  Assembled sum;
  elements.make_empty(1, sum);
  for (const auto& [steps, weight] : {std::pair(-2., 1.), {-1., -8.}, {1., 8.}, {2., -1.}}) {
    Parameters moved = parameters;
    std::get<0>(row.access)(moved) = at + steps * step;
    elements.assemble(moved, weight / (12 * step), directions(moved.skin), sum);
  }
  Parts::finish(sum);
  return std::make_unique<AssembledDerivative>(std::move(sum));
}

namespace {

/// The rows that this rank owns, 0 for the others.
Eigen::MatrixXd own_rows(const PatchSystem& system, const Block& block, const std::vector<int>& unknowns) {
  int columns = static_cast<int>(block.cols());
  MPI_Allreduce(MPI_IN_PLACE, &columns, 1, MPI_INT, MPI_MAX, system.communicator());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(unknowns.size()), columns);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (const int row = system.row(unknowns[i]); row >= 0)
      rows.row(static_cast<Eigen::Index>(i)) = block.row(row);
  }
  return rows;
}

}  // namespace

double dot(const PatchSystem& system, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double sum = a.dot(b);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, system.communicator());
  return sum;
}

Eigen::MatrixXd gather_rows(const PatchSystem& system, const Block& block, const std::vector<int>& unknowns) {
  Eigen::MatrixXd rows = own_rows(system, block, unknowns);
  const bool root = system.rank() == 0;
  MPI_Reduce(root ? MPI_IN_PLACE : rows.data(), rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE,
             MPI_SUM, 0, system.communicator());
  return root ? rows : Eigen::MatrixXd();
}

Eigen::MatrixXd all_gather_rows(const PatchSystem& system, const Block& block,
                                const std::vector<int>& unknowns) {
  Eigen::MatrixXd rows = own_rows(system, block, unknowns);
  MPI_Allreduce(MPI_IN_PLACE, rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE, MPI_SUM,
                system.communicator());
  return rows;
}

void set_rows(const PatchSystem& system, Block& block, const std::vector<int>& unknowns,
              const Eigen::MatrixXd& rows) {
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (const int row = system.row(unknowns[i]); row >= 0)
      block.row(row) = rows.row(static_cast<Eigen::Index>(i));
  }
}

}  // namespace cleft
