// cleft decode: a field as the series that it was made from.
#include <filesystem>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/ranks/other_ranks.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "encoder/import/decoded_vtu.h"
#include "encoder/import/frame_files.h"
#include "solver/snapshot/snapshot.h"

using namespace cleft;

namespace {

SourceMesh mesh_of(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".vtu") return read_vtu_mesh(path);
  return open_series({path})->read(0, {}).mesh;
}

void check_times(const Snapshot& s, const Field& field, const std::string& path) {
  if (s.times.back() != field.duration())
    throw InputError(path + ": ends at t = " + shortest(s.times.back()) + ", and the field at t = " +
                     shortest(field.duration()) + "; is it the snapshot that the field was made from?");
}

SourceMesh mesh_of(const Snapshot& s) {
  return {s.points_in_source(), s.cell_types, s.cell_offsets, s.connectivity};
}

FramesInTurn turn_of(const Ranks& ranks) {
  return {static_cast<std::size_t>(ranks.rank()), static_cast<std::size_t>(ranks.count())};
}

struct Task {
  std::string file, on, nodes, out;
};

using Use = std::function<void(const DecodedNodes&, const SourceMesh&)>;

void use_with_loose(DecodedNodes decoded, const SourceMesh& mesh, const Use& use) {
  decoded.loose = loose_nodes(mesh);
  use(decoded, mesh);
}

void decode_pieces(const Task& task, const Use& use) {
  std::vector<FieldPiece> kept = read_pieces(task.file);
  SourceMesh mesh;
  std::vector<NodesOfPiece> nodes;
  std::size_t frames = 0;
  if (!task.nodes.empty()) {
    const SnapshotReader reader(task.nodes);
    const Snapshot& s = reader.snapshot();
    check_times(s, kept.front().field, task.nodes);
    mesh = mesh_of(s), frames = s.frames();
    for (const SnapshotPiece& piece : s.pieces)
      nodes.push_back(
          counting_nodes(piece.nodes, static_cast<std::size_t>(piece.counting), piece.places, piece.pairs));
  } else {
    mesh = mesh_of(task.on);
    nodes = nodes_in_pieces(mesh, read_blended(task.file));
  }
  const PiecesAtNodes pieces(std::move(kept), std::move(nodes),
                             places_inside_cells(mesh.points, mesh.cell_offsets, mesh.connectivity), frames);
  use_with_loose(decoded_at(pieces), mesh, use);
}

void decode_field(const Task& task, const Use& use) {
  const Field field = read_field(task.file);
  KeptField kept{&field, {}, {}};
  SourceMesh mesh;
  std::vector<Place> nodes;
  if (!task.nodes.empty()) {
    // The snapshot's own nodes, at which residuals are kept.
    const SnapshotReader reader(task.nodes);
    const Snapshot& s = reader.snapshot();
    check_times(s, field, task.nodes);
    mesh = mesh_of(s);
    nodes = places_of(reader.coordinates(), s.pairs);
    kept.residual = read_residual(task.file);
    for (std::size_t q = 0; q < field.quantities.size(); ++q)
      kept.of_quantities.push_back(read_quantity_residual(task.file, q));
    if (kept.residual && static_cast<std::size_t>(kept.residual->nodes) != nodes.size())
      throw InputError(task.nodes + ": holds " + std::to_string(nodes.size()) +
                       " nodes, and the field has a residual at " + std::to_string(kept.residual->nodes));
  } else {
    mesh = mesh_of(task.on);
    nodes = nodes_in_field(mesh, field);
  }
  use_with_loose(decoded_at(kept, nodes), mesh, use);
}

void decode(const Task& task, const Use& use) {
  (pieces_in(task.file) > 0 ? decode_pieces : decode_field)(task, use);
}

Packer request_of(const Task& task, const std::string& folder) {
  Packer request;
  for (const std::string& path : {task.file, task.on, task.nodes, folder})
    request.add(path.empty() ? path : std::filesystem::absolute(path).string());
  return request;
}

/// Its frames of the series, in a process that serves.
void decode_in_turn(const Ranks& ranks, Unpacker& request) {
  Task task;
  for (std::string* path : {&task.file, &task.on, &task.nodes}) *path = request.take_text();
  const std::string folder = request.take_text();
  decode(task, [&](const DecodedNodes& decoded, const SourceMesh& mesh) {
    write_frames(decoded, mesh, turn_of(ranks), folder, [](const std::string&) {});
  });
}

void write_series(const Task& task, const Ranks& ranks,
                  const std::function<void(const std::string&)>& progress) {
  DecodedVtu series(task.out);
  std::vector<double> times;
  const auto write = [&](const DecodedNodes& decoded, const SourceMesh& mesh) {
    write_frames(decoded, mesh, turn_of(ranks), series.folder(), progress);
    times = times_of(*decoded.first);
  };
  on_all_ranks(
      ranks, request_of(task, series.folder()).bytes(), [&] { decode(task, write); }, [](int, Unpacker&) {});
  series.commit(times);
}

}  // namespace

int main(int argc, char** argv) {
  const Ranks ranks(argc, argv);
  if (ranks.rank() > 0) {
    serve(ranks, [&](Unpacker& request, Packer&) { decode_in_turn(ranks, request); });
    return 0;
  }
  const OtherRanks others(ranks);
  CommandLine app(
      "Writes a field as a series of .vtu files, or as one VTKHDF file, in the axes, names and times of the "
      "one "
      "it was made from. Under mpirun or srun the processes share the .vtu files.",
      "cleft decode");
  Task task;
  app.add_option("CASE.dffd", task.file, "field")->required();
  auto* on_option =
      app.add_option("--on", task.on,
                     "mesh whose nodes get the values, in the space of the source: a .vtu, or the first "
                     "frame of a series; any mesh of the same body");
  app.add_option(
         "--nodes", task.nodes,
         "instead of --on: the snapshot the field was made from; its nodes, with what the file keeps of "
         "them beside the spline")
      ->excludes(on_option);
  app.add_option("--out", task.out,
                 "series to write: OUT.pvd, and the folder OUT; or OUT.vtkhdf, one file, which "
                 "large series are written to in a tenth of the time")
      ->required();
  return run_command(app, argc, argv, [&] {
    if (task.on.empty() && task.nodes.empty())
      throw InputError("cleft decode needs a mesh: --on MESH.vtu, or --nodes CASE.h5");
    ranks.check();
    const bool one_file = std::filesystem::path(task.out).extension() == ".vtkhdf";
    if (one_file && ranks.count() > 1)
      std::cerr << "cleft decode: warning: " << one_works(ranks, "writes " + task.out)
                << ": only the frames of a .pvd are shared\n";
    Progress bar("decoding");
    bar("reading");
    const auto progress = [&](const std::string& state) { bar(state); };
    if (!one_file) return write_series(task, ranks, progress);
    decode(task, [&](const DecodedNodes& decoded, const SourceMesh& mesh) {
      write_vtkhdf(decoded, mesh, task.out, progress);
    });
  });
}
