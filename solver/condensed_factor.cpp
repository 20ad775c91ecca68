#include "solver/condensed_factor.h"

#include <dmumps_c.h>
#include <malloc.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "solver/blas.h"
#include "solver/frame_solver.h"
#include "solver/message_order.h"
#include "solver/spectrum.h"

namespace cleft {

namespace {

constexpr int most_with_same_sums = 1000000;  // unknowns, on several ranks
constexpr double few_operations = 5e10;       // of a factorisation, a second or two of a core

/// Also where that of an earlier factor does not suffice.
struct NotEnoughWorkspace : SolveError {
  using SolveError::SolveError;
};

}  // namespace

/// Moves the entries of a solution from where MUMPS left them to the ranks that own the unknowns.
class CondensedFactor::Redistribution {
 public:
  /// `unknowns`: global numbers of the entries on this rank.
  Redistribution(const PatchSystem& system, const std::vector<int>& unknowns) : system_(&system) {
    const auto& offsets = system.offsets();
    const int ranks = static_cast<int>(offsets.size()) - 1;
    const auto owner = [&](int unknown) {
      return static_cast<int>(std::upper_bound(offsets.begin(), offsets.end(), unknown) - offsets.begin()) -
             1;
    };
    send_order_.resize(unknowns.size());
    std::iota(send_order_.begin(), send_order_.end(), 0);
    std::stable_sort(send_order_.begin(), send_order_.end(),
                     [&](int a, int b) { return owner(unknowns[a]) < owner(unknowns[b]); });
    send_counts_.assign(ranks, 0);
    std::vector<int> sent;
    for (const int entry : send_order_) {
      ++send_counts_[owner(unknowns[entry])];
      sent.push_back(unknowns[entry]);
    }
    receive_counts_.resize(ranks);
    MPI_Alltoall(send_counts_.data(), 1, MPI_INT, receive_counts_.data(), 1, MPI_INT, system.communicator());
    rows_.resize(std::accumulate(receive_counts_.begin(), receive_counts_.end(), std::size_t{0}));
    exchange(sent.data(), rows_.data(), MPI_INT);
    for (int& row : rows_) row -= system.first();
  }

  /// Puts a column of entries into a column of owned unknowns.
  void operator()(const double* entries, double* owned) const {
    std::vector<double> send(send_order_.size()), received(rows_.size());
    for (std::size_t i = 0; i < send.size(); ++i) send[i] = entries[send_order_[i]];
    exchange(send.data(), received.data(), MPI_DOUBLE);
    for (std::size_t i = 0; i < rows_.size(); ++i) owned[rows_[i]] = received[i];
  }

 private:
  void exchange(const void* send, void* receive, MPI_Datatype type) const {
    const auto displacements = [](const std::vector<int>& counts) {
      std::vector<int> d(counts.size(), 0);
      std::partial_sum(counts.begin(), counts.end() - 1, d.begin() + 1);
      return d;
    };
    MPI_Alltoallv(send, send_counts_.data(), displacements(send_counts_).data(), type, receive,
                  receive_counts_.data(), displacements(receive_counts_).data(), type,
                  system_->communicator());
  }

  const PatchSystem* system_;
  std::vector<int> send_order_, send_counts_, receive_counts_, rows_;
};

struct CondensedFactor::Mumps {
  explicit Mumps(const PatchSystem& s) : system(s) {}

  const PatchSystem& system;
  DMUMPS_STRUC_C id{};
  std::vector<int> kept;  // 1-based
  PatchSystem::Entries entries;
  Eigen::MatrixXd schur;
  std::vector<int> solution_rows;              // 1-based unknowns of this rank's part of a solution
  std::optional<Redistribution> redistribute;  // known with the first solution
  bool again = false;                          // whether there has been a factor
  std::unique_ptr<double[]> workspace;
  MUMPS_INT8 workspace_size = 0;
  bool same_sums = false;  // in every run

  /// Control parameters are numbered from 1, as in the manual.
  MUMPS_INT& icntl(int number) { return id.icntl[number - 1]; }

  void take(PatchSystem::Entries new_entries) {
    entries = std::move(new_entries);
    for (int& row : entries.row) ++row;
    for (int& column : entries.column) ++column;
    id.nnz_loc = static_cast<MUMPS_INT8>(entries.value.size());
    id.irn_loc = entries.row.data();
    id.jcn_loc = entries.column.data();
    id.a_loc = entries.value.data();
  }

  /// Of further factors, which find it in memory already.
  void keep_workspace() {
    const auto numbers = static_cast<MUMPS_INT8>(id.info[7] < 0 ? -1e6 * id.info[7] : id.info[7]);
    const MUMPS_INT8 enough = numbers + numbers * icntl(14) / 100;
    if (workspace_size < enough) {
      workspace = std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(enough));
      workspace_size = enough;
    }
    if (workspace_size > std::numeric_limits<MUMPS_INT>::max()) return;
    id.wk_user = workspace.get(), id.lwk_user = static_cast<MUMPS_INT>(workspace_size);
  }

  void run(int job, const std::string& what) {
    // Small fronts, and single columns, are done sooner than several threads have agreed on their parts.
    const OneBlasThread one(id.rinfog[0] < few_operations || (job == 3 && id.nrhs == 1));
    id.job = job;
    dmumps_c(&id);
    if (id.infog[0] >= 0) return;
    const std::string codes =
        "INFOG(1:2) = " + std::to_string(id.infog[0]) + ", " + std::to_string(id.infog[1]);
    if (id.infog[0] == -10 || id.infog[0] == -40) fail_indefinite(system, what + " (MUMPS, " + codes + ")");
    if (id.infog[0] == -9 || id.infog[0] == -11)
      throw NotEnoughWorkspace(what + ": MUMPS needs more workspace than it estimated, " + codes);
    if (id.infog[0] == -13)
      throw SolveError(what + ": not enough memory (MUMPS, " + codes +
                       "); raise mesh.element_size, use more ranks, or --method iterative");
    throw SolveError(what + ": MUMPS failed with " + codes);
  }
};

CondensedFactor::CondensedFactor(const PatchSystem& system, PatchSystem::Entries entries,
                                 const std::vector<int>& kept, const std::vector<int>& order)
    : mumps_(std::make_unique<Mumps>(system)) {
  Mumps& m = *mumps_;
  m.id.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(system.communicator()));
  m.id.par = 1;
  m.id.sym = 1;
  m.run(-1, "setting up the factorisation");
  for (const int output : {1, 2, 3, 4}) m.icntl(output) = output == 4 ? 0 : -1;  // silent
  m.icntl(7) = 1;                                                                // order given by the user
  // Percent of extra workspace: alone, without pivoting, the estimate is exact; MUMPS would touch the rest
  // too.
  const int ranks = static_cast<int>(system.offsets().size()) - 1;
  m.icntl(14) = ranks > 1 ? 30 : 0;
  m.icntl(18) = 3;  // matrix distributed by the user
  m.icntl(19) = 1;  // Schur complement, whole, on rank 0
  // MUMPS merges neighbouring fronts of fewer pivots than this, or where that adds less than this percent of
  // zeros (its NEMIN, not in the manual; 5). The grid's dissection has large fronts already: of 370,000
  // unknowns the factor is 6 % smaller so, and no slower.
  m.id.keep[0] = 2;
  // A front of as many rows as this is spread over ranks (KEEP(9), not in the manual either), and its sums
  // are other ones in every run. The fronts of this many unknowns one rank can do. What came last of a
  // front's children is added first, to save memory (KEEP(234)): here they keep one order.
  m.same_sums = ranks > 1 && system.size() <= most_with_same_sums;
  if (m.same_sums) m.id.keep[8] = std::numeric_limits<MUMPS_INT>::max() / 2, m.id.keep[233] = 0;

  m.take(std::move(entries));
  m.id.n = system.size();
  for (const int unknown : kept) m.kept.push_back(unknown + 1);
  m.id.size_schur = static_cast<MUMPS_INT>(m.kept.size());
  m.id.listvar_schur = m.kept.data();
  std::vector<int> position(order);
  for (int& p : position) ++p;
  m.id.perm_in = position.data();
  m.run(1, "analysing the stiffness matrix");
  m.id.perm_in = nullptr;
}

CondensedFactor::~CondensedFactor() {
  // Ending MUMPS is collective: while an exception unwinds this rank, the others are elsewhere and would not
  // join.
  if (std::uncaught_exceptions() > exceptions_at_birth_) return;
  mumps_->id.job = -2;
  dmumps_c(&mumps_->id);
}

void CondensedFactor::replace(PatchSystem::Entries entries) {
  mumps_->take(std::move(entries));
  mumps_->again = true;
}

double CondensedFactor::bytes_needed() const { return 1e6 * mumps_->id.info[14]; }
double CondensedFactor::operations() const { return mumps_->id.rinfog[0]; }

void CondensedFactor::factorize() {
  Mumps& m = *mumps_;
  if (m.system.rank() == 0) m.schur.resize(m.id.size_schur, m.id.size_schur);
  m.id.schur = m.schur.data();
  if (m.again)
    m.keep_workspace();
  else
    malloc_trim(0);  // what was freed on the way here goes back to the system first
  try {
    m.run(2, "factorising the stiffness matrix");
  } catch (const NotEnoughWorkspace&) {  // the estimate was too small: once more with much more
    m.icntl(14) = 200;
    m.id.lwk_user = 0, m.workspace.reset(), m.workspace_size = 0;
    m.run(2, "factorising the stiffness matrix");
  }
  // MUMPS takes our word for a definite matrix, and only counts the pivots that belie it.
  if (m.id.infog[11] > 0)
    fail_indefinite(m.system, "factorising the stiffness matrix (MUMPS, INFOG(12) = " +
                                  std::to_string(m.id.infog[11]) + ")");
  m.entries = {};
  m.id.irn_loc = m.id.jcn_loc = nullptr;
  m.id.a_loc = nullptr;
  // MUMPS fills one triangle of a symmetric complement, by rows: the upper one as Eigen stores it.
  if (m.system.rank() == 0) m.schur.triangularView<Eigen::StrictlyLower>() = m.schur.transpose();
}

const Eigen::MatrixXd& CondensedFactor::schur() const { return mumps_->schur; }

Block CondensedFactor::solve(const SparseColumns& right) {
  Mumps& m = *mumps_;
  constexpr int most_columns = 64;  // solved together
  int columns = static_cast<int>(right.cols());
  MPI_Bcast(&columns, 1, MPI_INT, 0, m.system.communicator());
  Block solution = Block::Zero(m.system.owned(), columns);
  for (int first = 0; first < columns; first += most_columns) {
    const int count = std::min(most_columns, columns - first);
    SparseColumns block;
    std::vector<MUMPS_INT> rows, starts;
    if (m.system.rank() == 0) {
      block = right.middleCols(first, count);
      block.makeCompressed();
      rows.assign(block.innerIndexPtr(), block.innerIndexPtr() + block.nonZeros());
      starts.assign(block.outerIndexPtr(), block.outerIndexPtr() + count + 1);
      for (auto& row : rows) ++row;
      for (auto& start : starts) ++start;
    }
    int nonzeros = static_cast<int>(rows.size());
    MPI_Bcast(&nonzeros, 1, MPI_INT, 0, m.system.communicator());
    if (nonzeros == 0) continue;  // MUMPS takes no empty right-hand side
    m.icntl(20) = 1;              // right-hand sides sparse, on rank 0
    m.icntl(21) = 1;              // solution distributed as the factor is
    m.icntl(27) = most_columns;   // in one block
    m.id.nrhs = count;
    m.id.nz_rhs = static_cast<MUMPS_INT>(rows.size());
    m.id.irhs_sparse = rows.data();
    m.id.irhs_ptr = starts.data();
    m.id.rhs_sparse = block.valuePtr();
    const int length = std::max<int>(1, m.id.info[22]);
    m.solution_rows.resize(length);
    std::vector<double> values(static_cast<std::size_t>(length) * count);
    m.id.lsol_loc = length;
    m.id.isol_loc = m.solution_rows.data();
    m.id.sol_loc = values.data();
    {
      const auto order = m.same_sums ? std::make_unique<MessageOrder>() : nullptr;
      m.run(3, "solving for the displacements");
    }
    if (!m.redistribute) {
      std::vector<int> unknowns(m.solution_rows.begin(), m.solution_rows.begin() + m.id.info[22]);
      for (int& unknown : unknowns) --unknown;
      m.redistribute.emplace(m.system, unknowns);
    }
    for (int c = 0; c < count; ++c)
      (*m.redistribute)(values.data() + static_cast<std::size_t>(c) * length, solution.col(first + c).data());
  }
  for (const int unknown : m.kept)
    if (const int row = m.system.row(unknown - 1); row >= 0) solution.row(row).setZero();
  return solution;
}

/// MUMPS eliminates forward, gives what is left for the kept unknowns, and substitutes backward.
Block CondensedFactor::solve(const Block& right, const std::function<void(Eigen::MatrixXd&)>& find_kept) {
  Mumps& m = *mumps_;
  const auto& offsets = m.system.offsets();
  std::vector<int> counts;
  for (std::size_t r = 0; r + 1 < offsets.size(); ++r) counts.push_back(offsets[r + 1] - offsets[r]);
  const bool root = m.system.rank() == 0;
  const int own = m.system.owned(), columns = static_cast<int>(right.cols());
  Eigen::MatrixXd whole(root ? m.system.size() : 0, columns), kept(root ? m.id.size_schur : 0, columns);
  const auto column_of = [&](Eigen::Index c) { return whole.data() + c * whole.rows(); };
  for (Eigen::Index c = 0; c < columns; ++c)
    MPI_Gatherv(right.col(c).data(), own, MPI_DOUBLE, column_of(c), counts.data(), offsets.data(), MPI_DOUBLE,
                0, m.system.communicator());
  m.icntl(20) = 0, m.icntl(21) = 0;  // right-hand side and solution whole, on rank 0
  m.icntl(27) = columns;
  m.id.nrhs = columns, m.id.lrhs = m.system.size(), m.id.rhs = whole.data();
  m.id.redrhs = kept.data(), m.id.lredrhs = m.id.size_schur;
  const auto run = [&](int half) {
    const auto order = m.same_sums ? std::make_unique<MessageOrder>() : nullptr;
    m.icntl(26) = half;
    m.run(3, "solving for the displacements");
  };
  run(1);
  on_root(m.system, [&] { find_kept(kept); });
  m.id.redrhs = kept.data();
  run(2);
  m.icntl(26) = 0;
  Block solution(own, columns);
  for (Eigen::Index c = 0; c < columns; ++c)
    MPI_Scatterv(column_of(c), counts.data(), offsets.data(), MPI_DOUBLE, solution.col(c).data(), own,
                 MPI_DOUBLE, 0, m.system.communicator());
  return solution;
}

}  // namespace cleft
