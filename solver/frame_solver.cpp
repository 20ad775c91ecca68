#include "solver/frame_solver.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "base/error.h"
#include "base/memory.h"
#include "solver/direct_solver.h"
#include "solver/iterative_solver.h"

namespace cleft {

namespace {

std::string gigabytes(double bytes) {
  std::ostringstream text;
  text.precision(2);
  text << bytes / 1e9 << " GB";
  return text.str();
}

/// Need and supply of the machine this rank runs on, where they are scarcest.
struct Memory {
  double needed = 0, available = 0;
  bool fits() const { return needed < 0.9 * available; }
  std::string text() const { return gigabytes(needed) + " of " + gigabytes(available) + " free"; }
};

Memory memory_on_machines(MPI_Comm communicator, double needed_here) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  Memory here;
  MPI_Allreduce(&needed_here, &here.needed, 1, MPI_DOUBLE, MPI_SUM, machine);
  const double available = available_memory();
  MPI_Allreduce(&available, &here.available, 1, MPI_DOUBLE, MPI_MIN, machine);
  MPI_Comm_free(&machine);
  struct {
    double share;
    int rank;
  } tightest{here.needed / here.available, 0};
  MPI_Comm_rank(communicator, &tightest.rank);
  MPI_Allreduce(MPI_IN_PLACE, &tightest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, communicator);
  MPI_Bcast(&here, sizeof here, MPI_BYTE, tightest.rank, communicator);
  return here;
}

/// Of all ranks together, where each needs so much more than it holds now.
double expected_peak(const PatchSystem& system, double needed_here) {
  double bytes[] = {held_memory() + needed_here, peak_memory()};
  MPI_Allreduce(MPI_IN_PLACE, bytes, 2, MPI_DOUBLE, MPI_SUM, system.communicator());
  return std::max(bytes[0], bytes[1]);
}

std::string operations_of(double count) {
  std::ostringstream text;
  text.precision(1);
  text << std::scientific << count << " operations";
  return text.str();
}

}  // namespace

void on_root(const PatchSystem& system, const std::function<void()>& work) {
  std::string failure;
  if (system.rank() == 0) try {
      work();
    } catch (const std::runtime_error& e) {
      failure = e.what();
    }
  int length = static_cast<int>(failure.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, system.communicator());
  failure.resize(length);
  MPI_Bcast(failure.data(), length, MPI_CHAR, 0, system.communicator());
  if (!failure.empty()) throw SolveError(failure);
}

Block FrameSolver::solve_each(const Block& loads, const std::vector<Frame>& frames) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    CLEFT_CHECK(frames[i].touching.places.size(), ==, std::size_t{0});
    columns.push_back({static_cast<int>(i), frames[i].open, false, 1e-10});
  }
  set_loads(loads);
  return solve(columns);
}

double rounding_error(const PatchSystem& system, FrameSolver& solver) {
  const Block translation = Block::Ones(system.owned(), 1);
  solver.set_loads(system.multiply(translation));
  const Block difference = solver.solve({{0, 0}}) - translation;
  double largest = difference.size() > 0 ? difference.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0;
  if (std::isnan(largest)) largest = std::numeric_limits<double>::infinity();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, system.communicator());
  return largest;
}

void check_rounding(const PatchSystem& system, const ChosenSolver& chosen) {
  if (chosen.method != Method::direct) return;
  const double error = rounding_error(system, *chosen.solver);
  if (error < largest_rounding) return;
  std::ostringstream text;
  text.precision(1);
  text << std::scientific << error;
  throw SolveError(
      "rounding would change the displacements by " + text.str() +
      " of themselves: the parameters differ by too many orders of magnitude; bring the moduli of "
      "skin and tissue, the springs and the sides of the elements nearer to each other");
}

void check_assembly_fits(std::size_t unknowns, MPI_Comm communicator) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  // Measured: elements of deal.II, which are freed then, and K; and on every rank what tells of the whole
  // mesh.
  constexpr double divided = 1500, on_every_rank = 100;
  const Memory memory =
      memory_on_machines(communicator, (divided / ranks + on_every_rank) * static_cast<double>(unknowns));
  if (memory.fits()) return;
  throw InputError("the elements and the stiffness of " + std::to_string(unknowns) + " unknowns need " +
                   memory.text() + ": raise mesh.element_size or mesh.grading, or use more machines");
}

ChosenSolver make_frame_solver(const PatchMesh& mesh, const PatchSystem& system, Method method,
                               double most_operations,
                               const std::function<void(const std::string&)>& progress) {
  const std::string unknowns = std::to_string(system.size()) + " unknowns";
  std::string reason = "forced";
  if (method != Method::iterative) {
    progress("analysing " + unknowns);
    auto direct = std::make_unique<DirectSolver>(mesh, system);
    const Memory memory = memory_on_machines(system.communicator(), direct->bytes_needed());
    const bool quick = direct->operations() < most_operations || mesh.is_body() || mesh.is_quadratic();
    if (memory.fits() && (quick || method == Method::direct)) {
      const double peak = expected_peak(system, direct->bytes_needed());
      progress("factorising " + unknowns + ", " + gigabytes(peak));
      direct->factorize();
      return {std::move(direct), Method::direct,
              method == Method::direct ? "forced" : "its factor fits: " + memory.text(), peak};
    }
    if (method == Method::direct || mesh.is_quadratic())
      throw InputError("the factor of " + unknowns + " needs " + memory.text() +
                       ": raise mesh.element_size or mesh.grading, use more machines, or --method iterative" +
                       (mesh.is_quadratic() ? " with mesh.elements = linear" : ""));
    reason = memory.fits() ? "a factor would take longer: " + operations_of(direct->operations())
                           : "a factor does not fit: " + memory.text();
  }
  if (mesh.is_quadratic())
    throw InputError(
        "mesh.elements = quadratic: is solved with a factor, not by iterations; use --method "
        "direct, or set mesh.elements to linear");
  const double needed = iterative_bytes_needed(mesh, system);
  const double peak = expected_peak(system, needed);
  progress("setting up iterations for " + unknowns + ", " + gigabytes(peak));
  const Memory memory = memory_on_machines(system.communicator(), needed);
  if (!memory.fits())
    throw InputError("the iterations for " + unknowns + " need " + memory.text() +
                     ": raise mesh.element_size or mesh.grading, or use more machines");
  return {make_iterative_solver(mesh, system), Method::iterative, reason, peak};
}

void factorize_again(const PatchSystem& system, const ChosenSolver& chosen) {
  auto& direct = static_cast<DirectSolver&>(*chosen.solver);
  direct.replace(system.lower_triangle());
  direct.factorize();
}

}  // namespace cleft
