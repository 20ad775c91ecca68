// cleft decode: a field as the series that it was made from.
#include <filesystem>

#include "base/command/command.h"
#include "base/error.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "encoder/import/decode_series.h"
#include "encoder/import/frame_files.h"
#include "solver/snapshot/snapshot.h"

using namespace cleft;

namespace {

SourceMesh mesh_of(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".vtu") return read_vtu_mesh(path);
  return open_series(path)->read(0, {}).mesh;
}

/// The snapshot's own nodes and cells, at which residuals are kept.
DecodeMesh mesh_of(const SnapshotReader& reader, const Field& field, const std::string& path) {
  const Snapshot& s = reader.snapshot();
  if (s.times.back() != field.duration())
    throw InputError(path + ": ends at t = " + shortest(s.times.back()) + ", and the field at t = " +
                     shortest(field.duration()) + "; is it the snapshot that the field was made from?");
  DecodeMesh result;
  result.mesh.cell_types = s.cell_types, result.mesh.cell_offsets = s.cell_offsets;
  result.mesh.connectivity = s.connectivity;
  std::vector<double> canonical;
  if (s.coordinates) canonical = reader.point_array(canonical_array, 0);
  for (std::size_t n = 0; n < s.points.size(); ++n) {
    const Vec3& p = s.points[n];
    const Vec3 uvw = s.coordinates ? Vec3{canonical[3 * n], canonical[3 * n + 1], canonical[3 * n + 2]} : p;
    result.nodes.push_back({uvw, side_of(uvw.y)});
    if (s.source) {
      const auto& [u, v, w] = s.source->axes;
      result.mesh.points.push_back(s.source->origin + p.x * u + p.y * v + p.z * w);
    } else {
      result.mesh.points.push_back(p);
    }
  }
  for (const auto& [left, right] : s.pairs)
    result.nodes[left].side = Side::left, result.nodes[right].side = Side::right;
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Writes a field as a series of .vtu files, in the axes, names and times of the one it was made from.",
      "cleft decode");
  std::string file, on, nodes, out;
  app.add_option("CASE.dffd", file, "field")->required();
  auto* on_option =
      app.add_option("--on", on,
                     "mesh whose nodes get the values, in the space of the source: a .vtu, or the first "
                     "frame of a series; any mesh of the same body");
  app.add_option(
         "--nodes", nodes,
         "instead of --on: the snapshot the field was made from; its nodes, with what the file keeps of "
         "them beside the spline")
      ->excludes(on_option);
  app.add_option("--out", out, "series to write: OUT.pvd, and the folder OUT")->required();
  return run_command(app, argc, argv, [&] {
    if (on.empty() && nodes.empty())
      throw InputError("cleft decode needs a mesh: --on MESH.vtu, or --nodes CASE.h5");
    Progress progress("decoding");
    progress("reading");
    const Field field = read_field(file);
    KeptField kept{&field, {}, {}};
    DecodeMesh mesh;
    if (!nodes.empty()) {
      const SnapshotReader reader(nodes);
      mesh = mesh_of(reader, field, nodes);
      kept.residual = read_residual(file);
      for (std::size_t q = 0; q < field.quantities.size(); ++q)
        kept.of_quantities.push_back(read_quantity_residual(file, q));
      if (kept.residual && static_cast<std::size_t>(kept.residual->nodes) != mesh.nodes.size())
        throw InputError(nodes + ": holds " + std::to_string(mesh.nodes.size()) +
                         " nodes, and the field has a residual at " + std::to_string(kept.residual->nodes));
    } else {
      mesh = mesh_in_source(mesh_of(on), field);
    }
    write_decoded(kept, mesh, out, [&](const std::string& state) { progress(state); });
  });
}
