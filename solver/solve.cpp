#include "solver/solve.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "base/output_file.h"
#include "base/text.h"
#include "solver/cut_series.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

namespace {

constexpr double largest_residual = 1e-6;  // of the loads: beyond it the numbers mean nothing
constexpr int block_of_frames = 64;        // right-hand sides solved together

class Stopwatch {
 public:
  /// Seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void add_cells(Snapshot& s, const PatchMesh& mesh) {
  s.cell_offsets = {0};
  const auto add = [&s](std::uint8_t type, std::initializer_list<int> corners) {
    s.cell_types.push_back(type);
    s.connectivity.insert(s.connectivity.end(), corners.begin(), corners.end());
    s.cell_offsets.push_back(static_cast<std::int64_t>(s.connectivity.size()));
  };
  for (const auto& t : mesh.skin) add(Snapshot::triangle, {t[0], t[1], t[2]});
  // VTK's wedge begins with the face whose normal points outward: the upper one.
  for (const auto& w : mesh.wedges) add(Snapshot::wedge, {w[3], w[4], w[5], w[0], w[1], w[2]});
}

Snapshot describe(const Parameters& parameters, const PatchMesh& mesh) {
  Snapshot s;
  s.points = mesh.points;
  add_cells(s, mesh);
  s.foundation_triangles = mesh.bottom;
  s.foundation_quads = mesh.sides;
  s.pairs = mesh.pairs;
  s.released = mesh.released;
  s.position = mesh.position;
  s.cut_start = mesh.cut_start;
  s.cut_length = parameters.cut.length;
  s.cut_depth = parameters.cut.depth;
  for (const double u : mesh.position) s.times.push_back(u - mesh.cut_start);
  for (const Parameter& row : parameter_table()) s.parameters[row.name] = get_parameter(parameters, row);
  s.case_hash = solve_hash(parameters);
  return s;
}

/// One frame's unknowns as displacements of the nodes.
std::vector<Vec3> by_node(const PatchSystem& system, const Eigen::VectorXd& frame, std::size_t nodes) {
  std::vector<Vec3> displacement(nodes);
  for (std::size_t n = 0; n < nodes; ++n)
    for (int axis = 0; axis < 3; ++axis)
      displacement[n][axis] = frame(system.unknown(static_cast<int>(n), axis));
  return displacement;
}

void add_opening(SolveReport& report, const Snapshot& s, const std::vector<Vec3>& closed,
                 const std::vector<Vec3>& frame) {
  for (std::size_t n = 0; n < frame.size(); ++n)
    report.largest_displacement = std::max(report.largest_displacement, norm(frame[n] - closed[n]));
  for (const auto& [left, right] : s.pairs)
    report.gape = std::max(report.gape, frame[right].y - frame[left].y);
}

void add_figures(SolveReport& report, Snapshot& s, const std::vector<FrameFigures>& figures) {
  for (const FrameFigures& f : figures) {
    s.smallest_gap.push_back(f.smallest_gap);
    s.residual_equilibrium.push_back(f.residual_equilibrium);
    s.residual_closure.push_back(f.residual_closure);
    if (s.smallest_gap.size() > 1)
      report.smallest_gap =
          s.smallest_gap.size() == 2 ? f.smallest_gap : std::min(report.smallest_gap, f.smallest_gap);
    if (!(f.residual_equilibrium < largest_residual))
      throw std::runtime_error("the forces do not balance (relative residual " +
                               shortest(f.residual_equilibrium) +
                               "): the parameters differ by too many orders of magnitude");
    report.worst_equilibrium = std::max(report.worst_equilibrium, f.residual_equilibrium);
    report.worst_closure = std::max(report.worst_closure, f.residual_closure);
  }
}

}  // namespace

SolveReport solve_case(const Parameters& parameters, const std::string& out, MPI_Comm communicator,
                       const std::function<void(const std::string&)>& progress) {
  const OutputFile probe(out);  // a bad name is told before the work, on every rank
  Stopwatch watch;
  SolveReport report;
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &report.ranks);

  progress("meshing and assembling");
  const PatchMesh mesh = make_patch_mesh(parameters);
  const PatchSystem system(mesh, parameters, communicator);
  report.nodes = static_cast<int>(mesh.points.size());
  report.unknowns = system.size();
  report.pairs = static_cast<int>(mesh.pairs.size());
  report.frames = static_cast<int>(mesh.released.size());
  report.seconds_assemble = watch.lap();

  progress("factorising " + std::to_string(system.size()) + " unknowns");
  CutSeries series(mesh, system);
  report.seconds_factor = watch.lap();

  Snapshot snapshot = describe(parameters, mesh);
  std::optional<SnapshotWriter> writer;
  if (rank == 0) writer.emplace(out, snapshot);
  std::vector<Vec3> closed;
  for (int first = 0; first < report.frames; first += block_of_frames) {
    const int count = std::min(block_of_frames, report.frames - first);
    progress("frames " + std::to_string(first) + " to " + std::to_string(first + count - 1) + " of " +
             std::to_string(report.frames));
    const Eigen::MatrixXd frames = series.frames(first, count);
    add_figures(report, snapshot, series.figures(first, frames));
    for (Eigen::Index j = 0; j < frames.cols(); ++j) {
      const std::vector<Vec3> frame = by_node(system, frames.col(j), mesh.points.size());
      if (first == 0 && j == 0) closed = frame;
      add_opening(report, snapshot, closed, frame);
      writer->write_frames(static_cast<std::size_t>(first + j), frame);
    }
  }
  if (writer) writer->finish(snapshot);
  report.seconds_frames = watch.lap();
  return report;
}

}  // namespace cleft
