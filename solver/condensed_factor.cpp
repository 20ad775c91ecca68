#include "solver/condensed_factor.h"

#include <dmumps_c.h>

#include <exception>
#include <stdexcept>
#include <string>

namespace cleft {

namespace {

int rank_of(MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  return rank;
}

struct NotEnoughWorkspace : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace

struct CondensedFactor::Mumps {
  DMUMPS_STRUC_C id{};
  std::vector<int> kept;  // 1-based
  int rank;
  Eigen::MatrixXd schur;

  /// Control parameters are numbered from 1, as in the manual.
  MUMPS_INT& icntl(int number) { return id.icntl[number - 1]; }

  void run(int job, const std::string& what) {
    id.job = job;
    dmumps_c(&id);
    if (id.infog[0] >= 0) return;
    const std::string codes =
        "INFOG(1:2) = " + std::to_string(id.infog[0]) + ", " + std::to_string(id.infog[1]);
    if (id.infog[0] == -10 || id.infog[0] == -40)
      throw std::runtime_error(what + ": the stiffness matrix is not positive definite (MUMPS, " + codes +
                               "); are the springs and moduli large enough?");
    if (id.infog[0] == -9)
      throw NotEnoughWorkspace(what + ": MUMPS needs more workspace than it estimated, " + codes);
    if (id.infog[0] == -13)
      throw std::runtime_error(what + ": not enough memory (MUMPS, " + codes +
                               "); raise mesh.element_size or use more ranks");
    throw std::runtime_error(what + ": MUMPS failed with " + codes);
  }
};

CondensedFactor::CondensedFactor(const PatchSystem& system, const std::vector<int>& kept,
                                 const std::vector<int>& order)
    : mumps_(std::make_unique<Mumps>()) {
  Mumps& m = *mumps_;
  m.rank = rank_of(system.communicator());
  m.id.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(system.communicator()));
  m.id.par = 1;
  m.id.sym = 1;
  m.run(-1, "setting up the factorisation");
  for (const int output : {1, 2, 3, 4}) m.icntl(output) = output == 4 ? 0 : -1;  // silent
  m.icntl(7) = 1;                                                                // order given by the user
  m.icntl(14) = 40;                                                              // percent of extra workspace
  m.icntl(18) = 3;   // matrix distributed by the user
  m.icntl(19) = 1;   // Schur complement, whole, on rank 0
  m.icntl(27) = 64;  // right-hand sides in one block

  PatchSystem::Entries entries = system.lower_triangle();
  for (int& row : entries.row) ++row;
  for (int& column : entries.column) ++column;
  m.id.n = system.size();
  m.id.nnz_loc = static_cast<MUMPS_INT8>(entries.value.size());
  m.id.irn_loc = entries.row.data();
  m.id.jcn_loc = entries.column.data();
  m.id.a_loc = entries.value.data();
  for (const int unknown : kept) m.kept.push_back(unknown + 1);
  m.id.size_schur = static_cast<MUMPS_INT>(m.kept.size());
  m.id.listvar_schur = m.kept.data();
  if (m.rank == 0) m.schur.resize(m.id.size_schur, m.id.size_schur);
  m.id.schur = m.schur.data();
  std::vector<int> position(order);
  for (int& p : position) ++p;
  m.id.perm_in = position.data();
  try {
    m.run(4, "factorising the stiffness matrix");
  } catch (const NotEnoughWorkspace&) {  // the estimate was too small: once more with five times the extra
    m.icntl(14) = 200;
    m.run(4, "factorising the stiffness matrix");
  }
  m.id.irn_loc = m.id.jcn_loc = nullptr;
  m.id.a_loc = nullptr;
  m.id.perm_in = nullptr;
  // MUMPS fills one triangle of a symmetric complement, by rows: the upper one as Eigen stores it.
  if (m.rank == 0) m.schur.triangularView<Eigen::StrictlyLower>() = m.schur.transpose();
}

CondensedFactor::~CondensedFactor() {
  // Ending MUMPS is collective: while an exception unwinds this rank, the others stand elsewhere and would
  // not join.
  if (std::uncaught_exceptions() > exceptions_at_birth_) return;
  mumps_->id.job = -2;
  dmumps_c(&mumps_->id);
}

const Eigen::MatrixXd& CondensedFactor::schur() const { return mumps_->schur; }

void CondensedFactor::solve(Eigen::MatrixXd& block) {
  Mumps& m = *mumps_;
  m.id.nrhs = static_cast<MUMPS_INT>(block.cols());
  m.id.lrhs = m.id.n;
  m.id.rhs = block.data();
  m.run(3, "solving for the displacements");
  for (const int unknown : m.kept)
    if (m.rank == 0) block.row(unknown - 1).setZero();
}

}  // namespace cleft
