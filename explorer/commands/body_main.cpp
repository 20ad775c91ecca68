// cleft body: a surface and the paths of cuts, or a mesh of one's own, to the body that cleft solve takes.
#include <optional>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "explorer/body/own_body.h"
#include "explorer/commands/body_options.h"
#include "explorer/commands/cut_figures.h"
#include "explorer/commands/mesh_options.h"
#include "explorer/io/cells_file.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/io/mesh_file.h"
#include "explorer/wound/path_file.h"

namespace {

using namespace cleft;

struct Options {
  std::string mesh, out;
  std::vector<std::string> paths;
  BodyOptions body;
  std::string materials;
  std::optional<std::string> regions, release;
  double scale = 1, depth = 0;  // mm per mesh unit; mm
  bool json = false;
};

std::vector<ScalpelPath> read_paths(const Options& options, double depth) {
  std::vector<ScalpelPath> paths;
  for (const std::string& file : options.paths)
    paths.push_back(read_path(file, options.depth, options.scale, depth).scaled(options.scale));
  return paths;
}

Json figures_of(const Body& body, const OwnBodyReport& r) {
  Json figures = {{"nodes", body.points.size()},        {"wedges", body.wedges.size()},
                  {"skin_triangles", body.skin.size()}, {"pairs", body.pairs.size()},
                  {"frames", body.times.size()},        {"least_determinant", r.least_determinant},
                  {"triangles_on_bone", r.on_bone}};
  for (const auto& cut : r.cuts)
    figures["cuts"].push_back({{"length_mm", cut.length}, {"depth_mm", cut.depth}});
  for (const auto& region : r.regions) figures["wedges_of"][region.name] = region.wedges;
  return figures;
}

/// Of a mesh of one's own.
Body make_own(const Options& options, Json& figures) {
  if (!options.body.bone.empty())
    throw InputError(
        "--bone: an own mesh says itself which of its faces are on bone: [faces] of --materials");
  if (options.depth > 0)
    throw InputError("--depth: the depth of a cut is that of its walls in " + options.mesh);
  if (options.body.given("--reach"))
    throw InputError("--reach: an own mesh goes as far as it goes; leave it out");
  const BodyRequest settings = options.body.request(options.scale);
  OwnBodyRequest request;
  FileCells file = read_cells(options.mesh, options.regions, options.release);
  request.mesh = {options.mesh, std::move(file.points), std::move(file.types), std::move(file.nodes),
                  std::move(file.regions)};
  for (Vec3& p : request.mesh.points) p *= options.scale;
  request.release = std::move(file.release), request.regions_name = file.regions_name;
  if (!options.materials.empty()) request.regions = read_region_file(options.materials);
  request.paths = read_paths(options, 1);
  request.parameters = settings.parameters, request.tension = settings.tension;
  OwnBodyReport report;
  Body body = own_body(request, &report);
  figures = figures_of(body, report);
  return body;
}

/// Below a surface.
Body make_below(const Options& options, Json& figures) {
  for (const auto& [given, name] :
       {std::pair{options.regions.has_value(), "--regions"}, {options.release.has_value(), "--release"}})
    if (given) throw InputError(std::string(name) + ": is of an own mesh of cells; --mesh is a surface");
  BodyRequest request = options.body.request(options.scale);
  MeshReport mesh;
  request.skin = read_mesh(options.mesh, &mesh);
  warn_of_size(request.skin, options.scale, nullptr, "cleft body");
  request.skin = scaled(std::move(request.skin), options.scale);
  request.bone = options.body.read_bone(options.scale, {});
  auto [paths, ends] =
      with_near_ends_joined(read_paths(options, request.parameters.cut.depth), narrowest_bridge);
  const Json joined_ends = told_of(ends, 1, "cleft body");
  request.paths = std::move(paths);
  if (!options.materials.empty()) request.layers = layers_of(read_region_file(options.materials));
  BodyReport report;
  Body body = make_body(request, &report);
  figures = cleft::figures_of(report);
  figures["mesh"] = cleft::figures_of(mesh);
  figures["joined_ends"] = joined_ends;
  print_warnings(figures["warnings"], "cleft body");
  return body;
}

void make(const Options& options) {
  std::vector<std::string> inputs = options.paths;
  inputs.insert(inputs.end(), {options.mesh, options.body.bone, options.body.case_file, options.body.lines,
                               options.materials});
  std::erase(inputs, "");
  refuse_to_overwrite(options.out, inputs);
  const OutputFile probe(options.out);
  Json figures;
  Body body =
      is_mesh(options.mesh, MeshKind::volume) ? make_own(options, figures) : make_below(options, figures);
  write_body(options.out, body);
  figures["body"] = body.hash;
  print_figures(figures, options.json);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Meshes the body below a surface, with cuts along paths, so that cleft solve --mesh simulates these "
      "very cuts; or takes a mesh of your own, whose cuts have doubled nodes.",
      "cleft body");
  Options o;
  app.add_option("--mesh", o.mesh,
                 "surface of the body: " + mesh_endings(MeshKind::surface, MeshUse::read) +
                     "; or a mesh of your own, of wedges or hexahedra in columns below triangles or quads of "
                     "skin, with doubled nodes on the cuts: " +
                     mesh_endings(MeshKind::volume, MeshUse::read))
      ->required();
  app.add_option("--path", o.paths,
                 "CSV with columns x,y,z,nx,ny,nz[,depth], in the mesh's units; again for further cuts")
      ->required();
  app.add_option("--out", o.out, "the body, body.h5")->required();
  app.add_option("--depth", o.depth, "depth of the cuts, mm [the path's column, else cut.depth]")
      ->check(above(0));
  app.add_option("--materials", o.materials,
                 "TOML file of the materials: of regions of your own mesh, or of layers below the surface");
  app.add_option("--regions", o.regions,
                 "of your own mesh: the array of its cells that numbers regions [region, gmsh:physical, "
                 "CellEntityIds, medit:ref or MaterialIDs]");
  app.add_option("--release", o.release,
                 "of your own mesh: an array of its points, the mm cut when a doubled node opens [along the "
                 "paths]");
  o.body.add_to(app);
  add_scale(app, o.scale);
  app.add_flag("--json", o.json, "figures as JSON");
  return run_command(app, argc, argv, [&] { make(o); });
}
