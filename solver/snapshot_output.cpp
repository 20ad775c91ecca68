#include "solver/snapshot_output.h"

#include <filesystem>
#include <iostream>

#include "params/solve_hash.h"

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

}  // namespace

Snapshot describe(const Parameters& parameters, const PatchMesh& mesh, const Release& release,
                  const Body* body) {
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
  s.parameters = RecordedParameters(parameters);
  s.case_hash = body ? solve_hash(parameters, body->hash) : solve_hash(parameters);
  if (body) {
    s.body = body->hash;
    s.tension = body->tension;
    s.region = body->region;
    for (const RegionMaterial& material : body->materials) {
      const Parameters::Tissue tissue = material.tissue_of(parameters);
      s.region_moduli.push_back({tissue.young_modulus, tissue.poisson_ratio});
    }
    for (const Support support : body->support) s.support.push_back(static_cast<std::uint8_t>(support));
  } else {
    s.coordinates = !mesh.canonical.empty();
    s.tension = mesh.tension;
    for (const bool bone : mesh.on_bone)
      s.support.push_back(static_cast<std::uint8_t>(bone ? Support::bone : Support::springs));
  }
  return s;
}

SnapshotOutput::SnapshotOutput(const std::string& out, Snapshot snapshot,
                               const std::vector<SnapshotArray>& arrays, MPI_Comm communicator)
    : snapshot_(std::move(snapshot)), communicator_(communicator) {
  on_root([&] { writer_.emplace(out, snapshot_, arrays); });
  snapshot_ = {};
}

/// Work of rank 0. On several ranks a failure ends them all here: the others are on their way to other calls.
void SnapshotOutput::on_root(const std::function<void()>& work) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(communicator_, &rank);
  MPI_Comm_size(communicator_, &ranks);
  if (rank != 0) return;
  if (ranks == 1) return work();
  try {
    work();
  } catch (const std::exception& e) {
    std::error_code ignored;
    if (writer_) std::filesystem::remove(writer_->path(), ignored);
    std::cerr << std::string("cleft solve: failed: ") + e.what() + '\n' << std::flush;
    MPI_Abort(communicator_, 1);
  }
}

void SnapshotOutput::write_vectors(const std::string& array, std::size_t frame,
                                   const std::vector<Vec3>& values) {
  on_root([&] { writer_->write_array({array, 3, true}, frame, {&values.front().x, 3 * values.size()}); });
}

void SnapshotOutput::write_scalars(const std::string& array, const std::vector<double>& values) {
  on_root([&] { writer_->write_array({array, 1, false}, 0, values); });
}

void SnapshotOutput::write_frames(const std::string& array, const std::vector<std::array<Vec3, 3>>& values) {
  on_root([&] { writer_->write_array({array, 9, false}, 0, {&values.front()[0].x, 9 * values.size()}); });
}

void SnapshotOutput::add_figures(const FrameFigures& f) {
  snapshot_.smallest_gap.push_back(f.smallest_gap);
  snapshot_.residual_equilibrium.push_back(f.residual_equilibrium);
  snapshot_.residual_closure.push_back(f.residual_closure);
}

void SnapshotOutput::finish() {
  on_root([&] { writer_->finish(snapshot_); });
}

}  // namespace cleft
