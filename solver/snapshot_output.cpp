#include "solver/snapshot_output.h"

#include <filesystem>
#include <iostream>

namespace cleft {

namespace {

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

/// Runs what writes. On several ranks a failure ends them all here: it is one rank's, the others wait for it,
/// and an exception would have HDF5 close files, which waits for them.
template <class Work>
void written(MPI_Comm communicator, const std::string& unfinished, const Work& work) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  if (ranks == 1) return work();
  try {
    work();
  } catch (const std::exception& e) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    std::cerr << std::string("cleft solve: failed: ") + e.what() + '\n' << std::flush;
    MPI_Abort(communicator, 1);
  }
}

}  // namespace

Snapshot describe(const Parameters& parameters, const PatchMesh& mesh, const Release& release) {
  Snapshot s;
  s.points = mesh.points;
  add_cells(s, mesh);
  s.foundation_triangles = mesh.bottom;
  s.foundation_quads = mesh.sides;
  for (const int pair : release.order) s.pairs.push_back({mesh.pairs[pair].left, mesh.pairs[pair].right});
  s.released = release.released;
  s.position = release.position;
  s.times = release.times;
  s.cut_start = release.start;
  s.cut_length = release.length;
  s.cut_depth = release.depth;
  for (const Parameter& row : parameter_table()) s.parameters[row.name] = get_parameter(parameters, row);
  s.case_hash = solve_hash(parameters);
  return s;
}

SnapshotOutput::SnapshotOutput(const std::string& out, Snapshot snapshot,
                               const std::vector<SnapshotArray>& arrays, const NodeSlabs& slabs,
                               const PatchSystem& system)
    : snapshot_(std::move(snapshot)),
      nodes_(snapshot_.points.size()),
      slabs_(slabs),
      communicator_(system.communicator()) {
  written(communicator_, name_, [&] {
    if (system.rank() != 0) return;
    writer_.emplace(out, snapshot_, arrays);
    name_ = writer_->path();
    writer_->close();
  });
  int length = static_cast<int>(name_.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, communicator_);
  name_.resize(static_cast<std::size_t>(length));
  MPI_Bcast(name_.data(), length, MPI_CHAR, 0, communicator_);
  written(communicator_, name_, [&] { rows_.emplace(name_, nodes_, communicator_); });
  snapshot_ = {};
}

void SnapshotOutput::write_vectors(const std::string& array, std::size_t frame,
                                   const std::vector<Vec3>& slab) {
  written(communicator_, name_, [&] {
    rows_->write(array, 3, frame, slabs_.first(),
                 {slab.empty() ? nullptr : &slab.front().x, 3 * slab.size()});
  });
}

void SnapshotOutput::write_scalars(const std::string& array, std::vector<double> values) {
  values.resize(nodes_);
  MPI_Bcast(values.data(), static_cast<int>(nodes_), MPI_DOUBLE, 0, communicator_);
  written(communicator_, name_, [&] {
    rows_->write(array, 1, 0, slabs_.first(),
                 std::span<const double>(values).subspan(slabs_.first(), slabs_.count()));
  });
}

void SnapshotOutput::add_figures(const FrameFigures& f) {
  snapshot_.smallest_gap.push_back(f.smallest_gap);
  snapshot_.residual_equilibrium.push_back(f.residual_equilibrium);
  snapshot_.residual_closure.push_back(f.residual_closure);
}

void SnapshotOutput::finish() {
  written(communicator_, name_, [&] {
    rows_->close();
    if (writer_) writer_->finish(snapshot_);
  });
}

}  // namespace cleft
