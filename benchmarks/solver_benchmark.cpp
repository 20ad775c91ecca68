// What the solver's speed rests on, measured within one run: each figure beside what it is compared with.
// cleft-benchmark-solver [ELEMENT_SIZE]: default 0.87 mm, about 110,000 unknowns and 120 frames.
// `--iterations SIZE GRADING NU [FRAMES [algebraic]]` counts iterations instead (also under mpirun), of the
// multigrid of the grid, and with a last argument of the algebraic one too.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <random>

#include "base/memory.h"
#include "base/quantiles.h"
#include "base/stopwatch.h"
#include "solver/algebraic_solver.h"
#include "solver/direct_solver.h"
#include "solver/grid_solver.h"
#include "solver/mpi_session.h"
#include "solver/solve.h"

using namespace cleft;

namespace {

std::vector<FrameSolver::Column> columns_of(const Release& release) {
  std::vector<FrameSolver::Column> columns;
  for (const int open : release.released) columns.push_back({0, open});
  return columns;
}

/// One factorisation and one solve, against all frames from the same factor, against a factorisation a frame.
void series(const Parameters& p) {
  const PatchMesh mesh = make_patch_mesh(p);
  const Release release = make_release(mesh, p);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  const auto columns = columns_of(release);
  std::printf("%d unknowns, %zu pairs, %zu frames\n", system.size(), mesh.pairs.size(), columns.size());
  std::vector<double> factor, one, all;
  for (int round = 0; round < 3; ++round) {
    Stopwatch watch;
    DirectSolver solver(mesh, system);
    solver.factorize();
    factor.push_back(watch.lap());
    solver.set_release(release);
    solver.set_loads(system.load(p.skin));
    solver.solve({columns.back()});
    one.push_back(watch.lap());
    solver.set_release(release);
    solver.set_loads(system.load(p.skin));
    for (std::size_t first = 0; first < columns.size(); first += 64)
      solver.solve({columns.begin() + static_cast<long>(first),
                    columns.begin() + static_cast<long>(std::min(columns.size(), first + 64))});
    all.push_back(watch.lap());
  }
  const double f = median(factor), s = median(one), a = median(all),
               frames = static_cast<double>(columns.size());
  std::printf("factorisation               %8.3f s\n", f);
  std::printf("one frame from it           %8.3f s\n", s);
  std::printf("all frames from it          %8.3f s, %.2f ms a frame\n", a, 1e3 * a / frames);
  std::printf("series / (factor + solve)   %8.2f\n", (f + a) / (f + s));
  std::printf("a factor for each frame     %8.1f s (%zu measured), %.0f times the series\n", frames * (f + s),
              factor.size(), frames * (f + s) / (f + a));
}

/// The dense part alone: what a released pair costs once the complement stands.
void marching(int pairs) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd a =
      Eigen::MatrixXd::NullaryExpr(3 * pairs, 3 * pairs, [&] { return normal(random); });
  const Eigen::MatrixXd stiffness =
      a * a.transpose() + 3. * pairs * Eigen::MatrixXd::Identity(3 * pairs, 3 * pairs);
  std::vector<int> order(static_cast<std::size_t>(pairs));
  for (int p = 0; p < pairs; ++p) order[p] = p;
  const Opening opening(stiffness, order, std::vector<Vec3>(static_cast<std::size_t>(pairs), {0, 1, 0}));
  std::vector<double> times;
  for (int round = 0; round < 5; ++round) {
    Stopwatch watch;
    const Opening::Load load = opening.prepare(Eigen::VectorXd::Ones(3 * pairs));
    for (int open = 0; open <= pairs; ++open) opening.jumps(load, open, false);
    times.push_back(watch.lap());
  }
  std::printf("jumps of the cut            %8.3f ms a released pair (%d pairs)\n",
              1e3 * median(times) / pairs, pairs);
}

double computing(const std::vector<SolveReport>& reports) {
  double seconds = 0;
  for (const SolveReport& report : reports)
    for (const Phase& phase : report.phases)
      if (phase.name != "write") seconds += phase.seconds;
  return seconds;
}

/// What a further case costs that shares K with the first.
void sharing(Parameters p) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "cleft-benchmark-solver";
  std::filesystem::create_directories(folder);
  p.mesh.cut_length = p.cut.length, p.mesh.cut_depth = p.cut.depth;
  Parameters tense = p, shorter = p;
  tense.skin.prestress.vv *= 1.3;
  shorter.cut.length *= 0.7;
  const auto file = [&](const char* name) { return (folder / name).string(); };
  const auto seconds = [&](const std::vector<CaseToSolve>& cases) {
    return computing(solve_cases(cases, {}, MPI_COMM_WORLD, [](const auto&) {}));
  };
  // Further prestresses: from three cases on, which share their unit series.
  std::vector<CaseToSolve> three, many;
  for (int i = 0; i < 11; ++i) {
    Parameters other = p;
    other.skin.prestress.vv *= 1 + 0.1 * i;
    (i < 3 ? three : many).push_back({other, file((std::to_string(i) + ".h5").c_str())});
  }
  many.insert(many.begin(), three.begin(), three.end());
  std::vector<double> prestress, cut;
  for (int round = 0; round < 3; ++round) {
    const double alone = seconds({{p, file("a.h5")}});
    prestress.push_back((seconds(many) - seconds(three)) / static_cast<double>(many.size() - three.size()) /
                        alone);
    cut.push_back(seconds({{p, file("a.h5")}, {shorter, file("b.h5")}}) / alone - 1);
  }
  std::filesystem::remove_all(folder);
  std::printf("a further prestress         %8.1f %% of the first case\n", 100 * median(prestress));
  std::printf("a further cut of 0.7 length %8.1f %% of the first case\n", 100 * median(cut));
}

/// Frames by conjugate gradients with the multigrid of the grid, and with an algebraic one.
void iterations(const Parameters& p, std::size_t most_frames, bool algebraic_too) {
  const PatchMesh mesh = make_patch_mesh(p);
  const Release release = make_release(mesh, p);
  const double begin = processor_seconds();
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  const bool root = system.rank() == 0;
  const std::vector<FrameSolver::Column> all = columns_of(release);
  std::vector<FrameSolver::Column> columns;
  for (std::size_t i = 1; i <= std::min(most_frames, all.size() - 1); ++i)
    columns.push_back(all[i * (all.size() - 1) / std::min(most_frames, all.size() - 1)]);
  if (root)
    std::printf("%d unknowns, nu %.2f, grading %.1f, %zu frames; assembly %.2f s, peak %.2f GB\n",
                system.size(), p.tissue.poisson_ratio, p.mesh.grading, columns.size(),
                processor_seconds() - begin, peak_memory() / 1e9);
  Block reference;
  for (const bool algebraic : {false, true}) {
    if (algebraic && !algebraic_too) break;
    double before = processor_seconds();
    const auto lap = [&] {
      const double now = processor_seconds();
      return now - std::exchange(before, now);
    };
    std::unique_ptr<FrameSolver> solver;
    if (algebraic)
      solver = std::make_unique<AlgebraicSolver>(mesh, system);
    else
      solver = std::make_unique<GridSolver>(mesh, system);
    solver->set_release(release);
    solver->set_loads(system.load(p.skin));
    const double set_up = lap();
    solver->solve({columns.back()});
    const double alone = lap();
    solver->set_loads(system.load(p.skin));
    const Block frames = solver->solve(columns);
    const double all_frames = lap();
    std::vector<int> counts = solver->iterations();
    const int first = counts.front();
    counts.erase(counts.begin());
    std::sort(counts.begin(), counts.end());
    if (root)
      std::printf(
          "  %s: set-up %.2f s, a frame alone %.2f s (%d iterations), frames %.3f s each (%d to %d); peak "
          "%.2f GB\n",
          algebraic ? "algebraic" : "grid", set_up, alone, first,
          all_frames / static_cast<double>(columns.size()), counts.front(), counts.back(),
          peak_memory() / 1e9);
    if (reference.size() == 0)
      reference = frames;
    else if (std::array most = {(frames - reference).cwiseAbs().maxCoeff(), reference.cwiseAbs().maxCoeff()};
             MPI_Allreduce(MPI_IN_PLACE, most.data(), 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD), root)
      std::printf("  largest difference %.1e of the largest displacement\n", most[0] / most[1]);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const MpiSession mpi(argc, argv);
  if (argc > 1 && std::strcmp(argv[1], "--iterations") == 0) {
    if (argc < 5) {
      std::fprintf(stderr,
                   "usage: cleft-benchmark-solver --iterations SIZE GRADING NU [FRAMES [algebraic]]\n");
      return 2;
    }
    Parameters p;
    p.mesh.element_size = std::atof(argv[2]), p.mesh.grading = std::atof(argv[3]);
    p.tissue.poisson_ratio = std::atof(argv[4]);
    if (p.tissue.poisson_ratio > .48) p.tissue.formulation = TissueFormulation::mean_dilatation;
    iterations(p, argc > 5 ? std::atoi(argv[5]) : 20, argc > 6);
    return 0;
  }
  Parameters p;
  p.mesh.element_size = argc > 1 ? std::atof(argv[1]) : 0.87;
  p.cut.frames = FrameEvery::pair;
  series(p);
  marching(124);
  sharing(p);
  std::printf("peak memory                 %8.2f GB\n", peak_memory() / 1e9);
}
