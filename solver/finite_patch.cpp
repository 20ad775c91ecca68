#include "solver/finite_patch.h"

#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "solver/bending.h"
#include "solver/block_rows.h"
#include "solver/finite_elements.h"

namespace cleft {

namespace {

/// Numbers of the unknowns of a rank's elements, sorted.
std::vector<int> unknowns_of(const FiniteElements& elements) {
  std::vector<int> all;
  for (int c = 0; c < elements.count(); ++c)
    all.insert(all.end(), elements.unknowns(c).begin(), elements.unknowns(c).end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Epetra_Map map_of(const std::vector<int>& unknowns, const Epetra_Comm& communicator) {
  return {-1, static_cast<int>(unknowns.size()), unknowns.data(), 0, communicator};
}

}  // namespace

struct FinitePatch::Parts {
  Parts(const PatchSystem& s, const PatchElements& all, const Parameters& parameters)
      : system(s),
        elements(all, parameters),
        near(map_of(unknowns_of(elements), s.stiffness().Comm())),
        exchange(near, s.stiffness().RowMap()) {
    tangent.reinit(all.pattern);
    bends = parameters.skin.bending_stiffness > 0;
    if (bends) {
      bending.reinit(all.pattern);
      add_bending(all, parameters.skin.bending_stiffness, bending);
      bending.compress(dealii::VectorOperation::add);
      joints = skin_joints(all.mesh), first_unknown = all.first_unknown;
      stiffness_of_joints = parameters.skin.bending_stiffness;
      holds.assign(joints.size(), false);
    }
    for (int c = 0; c < elements.count(); ++c)
      for (int a = 0; a < 6; ++a) {
        places.push_back(near.LID(elements.unknowns(c)[3 * a]));
        CLEFT_CHECK(near.LID(elements.unknowns(c)[3 * a + 2]), ==, places.back() + 2);
      }
  }

  /// Where the stiffness of each element whose rows this rank owns goes in the matrix.
  void find_entries() {
    const Epetra_CrsMatrix& matrix = tangent.trilinos_matrix();
    int *starts = nullptr, *columns = nullptr;
    CLEFT_CHECK(matrix.ExtractCrsDataPointers(starts, columns, values), ==, 0);
    entries.assign(elements.count(), {});
    for (int c = 0; c < elements.count(); ++c) {
      const std::array<int, 18>& unknowns = elements.unknowns(c);
      std::array<int, 6> column;  // local: of a vertex's first unknown
      for (int b = 0; b < 6; ++b) column[b] = matrix.LCID(unknowns[3 * b]);
      for (int r = 0; r < 18 && owns(c); ++r) {
        const int row = matrix.LRID(unknowns[r]);
        for (int b = 0; b < 6; ++b) {
          const int* const found =
              std::lower_bound(columns + starts[row], columns + starts[row + 1], column[b]);
          for (int i = 0; i < 3; ++i) CLEFT_CHECK(matrix.GCID(found[i]), ==, unknowns[3 * b + i]);
          entries[c][6 * r + b] = static_cast<int>(found - columns);
        }
      }
    }
  }

  bool owns(int cell) const {
    const auto& unknowns = elements.unknowns(cell);
    return std::all_of(unknowns.begin(), unknowns.end(),
                       [&](int unknown) { return system.row(unknown) >= 0; });
  }

  void add_to_tangent(int cell, const Eigen::Matrix<double, 18, 18>& stiffness) {
    if (!owns(cell)) {
      const auto& unknowns = elements.unknowns(cell);
      for (int a = 0; a < 18; ++a)
        for (int b = 0; b < 18; ++b) cell_matrix(a, b) = stiffness(a, b);
      tangent.add({unknowns.begin(), unknowns.end()}, cell_matrix, false);
      return;
    }
    const auto* entry = entries[cell].data();
    for (int a = 0; a < 18; ++a)  // the stiffness is symmetric
      for (int b = 0; b < 6; ++b)
        Eigen::Map<Eigen::Vector3d>(values + *entry++) += stiffness.col(a).segment<3>(3 * b);
  }

  /// Calls visit(cell, response, its first unknowns' places) of every element of this rank.
  template <class Visit>
  void each_response(const Block& displacement, bool with_tangent, const Visit& visit) const {
    const Epetra_Vector own(View, exchange.SourceMap(), const_cast<double*>(displacement.data()));
    Epetra_Vector around(near);
    CLEFT_CHECK(around.Import(own, exchange, Insert), ==, 0);
    CellResponse response;
    FiniteTissue::Displacements u;
    for (int c = 0; c < elements.count(); ++c) {
      const int* place = places.data() + 6 * static_cast<std::size_t>(c);
      for (int a = 0; a < 6; ++a) u.col(a) = Eigen::Map<const Eigen::Vector3d>(around.Values() + place[a]);
      elements.response(c, u, with_tangent, response);
      visit(c, response, place);
    }
  }

  const PatchSystem& system;
  FiniteElements elements;
  Epetra_Map near;          // unknowns of this rank's elements
  Epetra_Import exchange;   // from the owned unknowns to these
  std::vector<int> places;  // in `near`, of the vertices of the elements
  dealii::TrilinosWrappers::SparseMatrix tangent, bending;
  double* values = nullptr;  // of the tangent's entries on this rank
  // By element: of each row of its stiffness and each vertex, the number of the first of three entries.
  std::vector<std::array<int, 108>> entries;
  dealii::FullMatrix<double> cell_matrix{18, 18};
  bool bends = false;  // whether the skin has a bending stiffness, as `bending` and the joints that hold
  std::vector<Joint> joints;
  std::vector<bool> holds;
  std::vector<int> first_unknown;  // by node
  double stiffness_of_joints = 0;
  Block pull;  // dead loads, N
};

FinitePatch::FinitePatch(const PatchSystem& system, const Parameters& parameters) {
  const std::unique_ptr<PatchElements> elements = system.elements(parameters);
  parts_ = std::make_unique<Parts>(system, *elements, parameters);
  parts_->pull = Block::Zero(system.owned(), 1);
  const Block own_forces = -balance(Block::Zero(system.owned(), 1)).left_over;
  parts_->pull = system.load(parameters.skin) + own_forces;
}

FinitePatch::~FinitePatch() = default;

void FinitePatch::set_open(const Release& release, int open) {
  Parts& p = *parts_;
  const std::vector<bool> closed = release.closed(open);
  const int first = p.system.first(), end = first + p.system.owned();
  for (std::size_t j = 0; j < p.joints.size(); ++j) {
    const Joint& joint = p.joints[j];
    const bool now =
        std::all_of(joint.pairs.begin(), joint.pairs.end(), [&](int pair) { return closed[pair]; });
    if (now == p.holds[j]) continue;
    add_hinge(joint.hinge, now ? p.stiffness_of_joints : -p.stiffness_of_joints, p.first_unknown, first, end,
              p.bending);
    p.holds[j] = now;
  }
  if (p.bends) p.bending.compress(dealii::VectorOperation::add);
}

FinitePatch::Balance FinitePatch::balance(const Block& displacement) const {
  const Parts& p = *parts_;
  Epetra_Vector forces(p.near);
  Balance balance;
  struct {
    double determinant;
    int rank;
  } least{std::numeric_limits<double>::infinity(), p.system.rank()};
  int least_cell = -1;
  p.each_response(displacement, false, [&](int cell, const CellResponse& response, const int* place) {
    balance.energy += response.energy;
    for (int a = 0; a < 6; ++a)
      for (int i = 0; i < 3; ++i) forces[place[a] + i] += response.force[3 * a + i];
    const double determinant = response.force.allFinite() ? response.least_determinant : 0;
    if (determinant < least.determinant) least.determinant = determinant, least_cell = cell;
  });
  if (least_cell >= 0) balance.least.place = p.elements.centroid(least_cell);
  MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, p.system.communicator());
  balance.least.determinant = least.determinant;
  MPI_Bcast(&balance.least.place, 3, MPI_DOUBLE, least.rank, p.system.communicator());
  MPI_Allreduce(MPI_IN_PLACE, &balance.energy, 1, MPI_DOUBLE, MPI_SUM, p.system.communicator());
  Epetra_Vector sum(p.exchange.SourceMap());
  CLEFT_CHECK(sum.Export(forces, p.exchange, Add), ==, 0);
  balance.left_over = p.pull - Eigen::Map<const Eigen::VectorXd>(sum.Values(), p.system.owned());
  balance.energy -= dot(p.system, p.pull.col(0), displacement.col(0));
  if (p.bends) {
    const Block forces_of_bending = cleft::multiply(p.bending.trilinos_matrix(), displacement);
    balance.left_over -= forces_of_bending;
    balance.energy += dot(p.system, forces_of_bending.col(0), displacement.col(0)) / 2;
  }
  return balance;
}

void FinitePatch::set_tangent(const Block& displacement) {
  Parts& p = *parts_;
  if (!p.values) p.find_entries();
  p.tangent = 0;
  p.each_response(displacement, true, [&](int cell, const CellResponse& response, const int*) {
    p.add_to_tangent(cell, response.stiffness);
  });
  p.tangent.compress(dealii::VectorOperation::add);
  if (p.bends) p.tangent.add(1, p.bending);
}

Block FinitePatch::multiply(const Block& block) const {
  return cleft::multiply(parts_->tangent.trilinos_matrix(), block);
}

PatchSystem::Entries FinitePatch::lower_triangle() const {
  return PatchSystem::lower_triangle(parts_->tangent.trilinos_matrix());
}

}  // namespace cleft
