#include "solver/patch_system.h"

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/fe_wedge_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

#include "base/error.h"
#include "solver/material/linear_isotropic.h"
#include "solver/material/membrane.h"

namespace cleft {

using namespace dealii;

namespace {

enum Boundary : types::boundary_id { other_boundary = 0, top = 1, bottom = 2, side = 3 };

}  // namespace

struct PatchSystem::Parts {
  Parts(const PatchMesh& patch, const Parameters& p, MPI_Comm comm)
      : communicator(comm),
        parameters(p),
        triangulation(comm, dealii::Triangulation<3>::none, false,
                      parallel::shared::Triangulation<3>::partition_zorder),
        element(FE_WedgeP<3>(1), 3),
        mapping(FE_WedgeP<3>(1)),
        dofs(triangulation) {
    create_triangulation(patch);
    distribute_unknowns(patch);
    assemble();
    gather_load();
  }

  void create_triangulation(const PatchMesh& patch);
  void distribute_unknowns(const PatchMesh& patch);
  void assemble();
  void add_tissue(FEValues<3>& values, FullMatrix<double>& cell_matrix) const;
  void add_springs(FEFaceValues<3>& values, double stiffness, FullMatrix<double>& cell_matrix) const;
  void add_skin(const DoFHandler<3>::active_cell_iterator& cell, unsigned face, const Membrane& membrane,
                FullMatrix<double>& cell_matrix, Vector<double>& cell_load) const;
  void gather_load();
  std::vector<double> gathered(const TrilinosWrappers::MPI::Vector& vector) const;

  MPI_Comm communicator;
  const Parameters parameters;
  parallel::shared::Triangulation<3> triangulation;
  FESystem<3> element;
  MappingFE<3> mapping;
  DoFHandler<3> dofs;
  std::vector<std::array<types::global_dof_index, 3>> unknown;  // by node
  std::vector<int> owned_counts, owned_offsets;                 // by rank
  TrilinosWrappers::SparseMatrix stiffness;
  TrilinosWrappers::MPI::Vector distributed_load;
  Eigen::VectorXd load;
};

void PatchSystem::Parts::create_triangulation(const PatchMesh& patch) {
  std::vector<Point<3>> vertices;
  for (const Vec3& p : patch.points) vertices.emplace_back(p.x, p.y, p.z);
  std::vector<CellData<3>> cells;
  for (const auto& wedge : patch.wedges) {
    CellData<3>& cell = cells.emplace_back(6);
    for (unsigned i = 0; i < 6; ++i) cell.vertices[i] = wedge[i];
  }
  triangulation.create_triangulation(vertices, cells, SubCellData());
  CLEFT_CHECK(triangulation.n_vertices(), ==, patch.points.size());

  const double small = 1e-9 * parameters.patch.length;
  const auto near = [&](double a, double b) { return std::abs(a - b) < small; };
  for (const auto& cell : triangulation.active_cell_iterators())
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
}

void PatchSystem::Parts::distribute_unknowns(const PatchMesh& patch) {
  dofs.distribute_dofs(element);
  unknown.resize(patch.points.size());
  for (const auto& cell : dofs.active_cell_iterators())
    for (const unsigned v : cell->vertex_indices())
      for (unsigned axis = 0; axis < 3; ++axis)
        unknown[cell->vertex_index(v)][axis] = cell->vertex_dof_index(v, axis);
  int offset = 0;
  for (const IndexSet& owned : Utilities::MPI::all_gather(communicator, dofs.locally_owned_dofs())) {
    CLEFT_CHECK(owned.is_contiguous(), ==, true);
    owned_offsets.push_back(offset);
    owned_counts.push_back(static_cast<int>(owned.n_elements()));
    offset += owned_counts.back();
  }
}

void PatchSystem::Parts::assemble() {
  const IndexSet& owned = dofs.locally_owned_dofs();
  TrilinosWrappers::SparsityPattern pattern(owned, owned, communicator, 60);
  DoFTools::make_sparsity_pattern(dofs, pattern, AffineConstraints<double>(), true,
                                  triangulation.locally_owned_subdomain());
  pattern.compress();
  stiffness.reinit(pattern);
  distributed_load.reinit(owned, communicator);

  const Membrane membrane(parameters.skin);
  FEValues<3> values(mapping, element, QGaussWedge<3>(2), update_gradients | update_JxW_values);
  const QGaussSimplex<2> triangle(2);
  const QGauss<2> quad(2);
  FEFaceValues<3> face_values(mapping, element, hp::QCollection<2>(triangle, triangle, quad, quad, quad),
                              update_values | update_JxW_values);
  const unsigned n = element.n_dofs_per_cell();
  FullMatrix<double> cell_matrix(n, n);
  Vector<double> cell_load(n);
  std::vector<types::global_dof_index> indices(n);
  for (const auto& cell : dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell_matrix = 0;
    cell_load = 0;
    values.reinit(cell);
    add_tissue(values, cell_matrix);
    for (const unsigned f : cell->face_indices()) {
      const types::boundary_id boundary = cell->face(f)->boundary_id();
      if (!cell->face(f)->at_boundary() || boundary == other_boundary) continue;
      if (boundary == top) {
        add_skin(cell, f, membrane, cell_matrix, cell_load);
      } else {
        face_values.reinit(cell, f);
        add_springs(
            face_values,
            boundary == bottom ? parameters.foundation.stiffness : parameters.foundation.side_stiffness,
            cell_matrix);
      }
    }
    cell->get_dof_indices(indices);
    stiffness.add(indices, cell_matrix);
    distributed_load.add(indices, cell_load);
  }
  stiffness.compress(VectorOperation::add);
  distributed_load.compress(VectorOperation::add);
}

void PatchSystem::Parts::add_tissue(FEValues<3>& values, FullMatrix<double>& cell_matrix) const {
  const LinearIsotropic tissue(parameters.tissue.young_modulus, parameters.tissue.poisson_ratio);
  const unsigned vertices = 6;
  for (unsigned q = 0; q < values.n_quadrature_points; ++q)
    for (unsigned a = 0; a < vertices; ++a)
      for (unsigned b = 0; b < vertices; ++b) {
        // A shape function of vertex a in direction d has number 3 a + d and the scalar gradient of vertex a.
        const Tensor<2, 3> k =
            tissue.stiffness(values.shape_grad(3 * a, q), values.shape_grad(3 * b, q)) * values.JxW(q);
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

void PatchSystem::Parts::add_skin(const DoFHandler<3>::active_cell_iterator& cell, unsigned face,
                                  const Membrane& membrane, FullMatrix<double>& cell_matrix,
                                  Vector<double>& cell_load) const {
  std::array<unsigned, 3> corner{};
  std::array<Vec3, 3> at;
  for (unsigned i = 0; i < 3; ++i)
    for (const unsigned v : cell->vertex_indices())
      if (cell->vertex_index(v) == cell->face(face)->vertex_index(i)) {
        corner[i] = v;
        at[i] = {cell->vertex(v)[0], cell->vertex(v)[1], cell->vertex(v)[2]};
      }
  const Membrane::Matrix6 k = membrane.stiffness(at[0], at[1], at[2]);
  const Membrane::Vector6 f = membrane.load(at[0], at[1], at[2]);
  for (unsigned a = 0; a < 6; ++a) {
    const unsigned row = 3 * corner[a / 2] + a % 2;
    cell_load(row) += f[a];
    for (unsigned b = 0; b < 6; ++b) cell_matrix(row, 3 * corner[b / 2] + b % 2) += k(a, b);
  }
}

std::vector<double> PatchSystem::Parts::gathered(const TrilinosWrappers::MPI::Vector& vector) const {
  const int rank = Utilities::MPI::this_mpi_process(communicator);
  std::vector<double> local(vector.begin(), vector.end()), whole(rank == 0 ? dofs.n_dofs() : 0);
  MPI_Gatherv(local.data(), static_cast<int>(local.size()), MPI_DOUBLE, whole.data(), owned_counts.data(),
              owned_offsets.data(), MPI_DOUBLE, 0, communicator);
  return whole;
}

void PatchSystem::Parts::gather_load() {
  const std::vector<double> whole = gathered(distributed_load);
  load = Eigen::Map<const Eigen::VectorXd>(whole.data(), static_cast<Eigen::Index>(whole.size()));
}

PatchSystem::PatchSystem(const PatchMesh& mesh, const Parameters& parameters, MPI_Comm communicator)
    : parts_(std::make_unique<Parts>(mesh, parameters, communicator)) {}

PatchSystem::~PatchSystem() = default;

MPI_Comm PatchSystem::communicator() const { return parts_->communicator; }
int PatchSystem::size() const { return static_cast<int>(parts_->dofs.n_dofs()); }
int PatchSystem::unknown(int node, int axis) const { return static_cast<int>(parts_->unknown[node][axis]); }
const Eigen::VectorXd& PatchSystem::load() const { return parts_->load; }

Eigen::MatrixXd PatchSystem::multiply(const Eigen::MatrixXd& block) const {
  const Parts& p = *parts_;
  long columns = block.cols();
  MPI_Bcast(&columns, 1, MPI_LONG, 0, p.communicator);
  const bool root = parts_->load.size() > 0;
  Eigen::MatrixXd product;
  if (root) product.resize(block.rows(), columns);
  TrilinosWrappers::MPI::Vector x(p.distributed_load), y(p.distributed_load);
  std::vector<double> local(x.locally_owned_size());
  for (long c = 0; c < columns; ++c) {
    const double* column = root ? block.col(c).data() : nullptr;
    MPI_Scatterv(column, p.owned_counts.data(), p.owned_offsets.data(), MPI_DOUBLE, local.data(),
                 static_cast<int>(local.size()), MPI_DOUBLE, 0, p.communicator);
    std::copy(local.begin(), local.end(), x.begin());
    p.stiffness.vmult(y, x);
    const std::vector<double> whole = p.gathered(y);
    if (root) product.col(c) = Eigen::Map<const Eigen::VectorXd>(whole.data(), product.rows());
  }
  return product;
}

PatchSystem::Entries PatchSystem::lower_triangle() const {
  const Epetra_CrsMatrix& matrix = parts_->stiffness.trilinos_matrix();
  Entries entries;
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

}  // namespace cleft
