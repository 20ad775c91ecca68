// How frames by iterations scale with ranks, and what the ranks send each other. Prints a row of CSV.
// mpirun -n RANKS cleft-benchmark-scaling ELEMENT_SIZE GRADING NU [LENGTHS]
// Eight frames in the default patch, LENGTHS times as long with its cut: for weak scaling as many as ranks.
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "base/memory.h"
#include "base/stopwatch.h"
#include "solver/grid_solver.h"
#include "solver/mpi_session.h"
#include "solver/multigrid/lanes.h"

namespace {

/// What this rank has sent, and how often all waited for each other, while `counting`.
struct Traffic {
  bool counting = false;
  double messages = 0, bytes = 0, sums = 0, gathers = 0;
  double processor_seconds = 0;  ///< inside these calls: packing is not, waiting is
};
Traffic traffic;

double bytes_of(int count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return static_cast<double>(count) * size;
}

/// Runs a call of the library, and counts the time in it.
template <class Call>
int timed(const Call& call) {
  const double before = cleft::processor_seconds();
  const int result = call();
  if (traffic.counting) traffic.processor_seconds += cleft::processor_seconds() - before;
  return result;
}

}  // namespace

// These stand before the library's own functions, which are reached by their second names.
extern "C" int MPI_Isend(const void* buffer, int count, MPI_Datatype type, int to, int tag,
                         MPI_Comm communicator, MPI_Request* request) {
  if (traffic.counting) traffic.messages += 1, traffic.bytes += bytes_of(count, type);
  return timed([&] { return PMPI_Isend(buffer, count, type, to, tag, communicator, request); });
}

extern "C" int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
  return timed([&] { return PMPI_Waitall(count, requests, statuses); });
}

extern "C" int MPI_Allreduce(const void* from, void* to, int count, MPI_Datatype type, MPI_Op operation,
                             MPI_Comm communicator) {
  if (traffic.counting) traffic.sums += 1;
  return timed([&] { return PMPI_Allreduce(from, to, count, type, operation, communicator); });
}

extern "C" int MPI_Allgatherv(const void* from, int count, MPI_Datatype type, void* to, const int* counts,
                              const int* offsets, MPI_Datatype to_type, MPI_Comm communicator) {
  if (traffic.counting) traffic.gathers += 1, traffic.bytes += bytes_of(count, type);
  return timed(
      [&] { return PMPI_Allgatherv(from, count, type, to, counts, offsets, to_type, communicator); });
}

namespace {

using namespace cleft;

Parameters longer_patch(double element_size, double grading, double nu, double lengths) {
  Parameters p;
  p.mesh.element_size = element_size, p.mesh.grading = grading;
  p.tissue.poisson_ratio = nu;
  if (nu > 0.48) p.tissue.formulation = TissueFormulation::mean_dilatation;
  p.patch.length *= lengths, p.cut.length *= lengths;
  return p;
}

/// Eight frames, spread over the series.
std::vector<FrameSolver::Column> eight_frames(const Release& release) {
  std::vector<FrameSolver::Column> columns;
  const std::size_t last = release.released.size() - 1;
  for (std::size_t i = 1; i <= most_lanes; ++i)
    columns.push_back({0, release.released[i * last / most_lanes]});
  return columns;
}

void measure(const Parameters& p) {
  const PatchMesh mesh = make_patch_mesh(p);
  const Release release = make_release(mesh, p);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  MPI_Barrier(MPI_COMM_WORLD);
  Stopwatch watch;
  const double begin = processor_seconds();
  GridSolver solver(mesh, system);
  solver.set_release(release);
  solver.set_loads(system.load(p.skin));
  const double levels = watch.lap(), levels_processor = processor_seconds() - begin;
  MPI_Barrier(MPI_COMM_WORLD);
  const double start = processor_seconds();
  watch.lap();
  traffic.counting = true;
  solver.solve(eight_frames(release));
  traffic.counting = false;
  const double frames = watch.lap(), frames_processor = processor_seconds() - start;
  const std::vector<int> iterations = solver.iterations();
  const int cycles = *std::max_element(iterations.begin(), iterations.end());

  // Of the slowest rank, or the one that sends most.
  std::array<double, 9> most = {levels,
                                levels_processor,
                                frames / most_lanes,
                                frames_processor / most_lanes,
                                (frames_processor - traffic.processor_seconds) / most_lanes,
                                traffic.messages / cycles,
                                traffic.bytes / cycles / 1e3,
                                traffic.sums / cycles,
                                traffic.gathers / cycles};
  MPI_Allreduce(MPI_IN_PLACE, most.data(), static_cast<int>(most.size()), MPI_DOUBLE, MPI_MAX,
                MPI_COMM_WORLD);
  double memory = peak_memory() / 1e9;
  MPI_Allreduce(MPI_IN_PLACE, &memory, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  if (system.rank() != 0) return;
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::printf(
      "ranks,unknowns,iterations,levels_s,levels_processor_s,frame_s,frame_processor_s,frame_computing_s,"
      "messages_a_cycle,kilobytes_a_cycle,sums_a_cycle,gathers_a_cycle,memory_gb\n%d,%d,%d",
      ranks, system.size(), cycles);
  for (const double value : most) std::printf(",%.4g", value);
  std::printf(",%.3g\n", memory);
}

}  // namespace

int main(int argc, char** argv) {
  const MpiSession mpi(argc, argv);
  if (argc < 4) {
    std::fprintf(stderr, "cleft-benchmark-scaling ELEMENT_SIZE GRADING NU [LENGTHS]\n");
    return 2;
  }
  measure(longer_patch(std::atof(argv[1]), std::atof(argv[2]), std::atof(argv[3]),
                       argc > 4 ? std::atof(argv[4]) : 1));
}
