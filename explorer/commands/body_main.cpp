// cleft body: a surface and the paths of cuts to the mesh of a body that cleft solve takes.
#include <cmath>
#include <optional>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "explorer/body/body_maker.h"
#include "explorer/commands/cut_figures.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/io/mesh_file.h"
#include "explorer/wound/path_file.h"
#include "params/consistency.h"
#include "params/study.h"

namespace {

using namespace cleft;

struct Options {
  std::string mesh, bone, out, case_file;
  std::vector<std::string> paths, assignments;
  std::vector<double> direction;
  double scale = 1, depth = 0, reach = 40;  // mm per mesh unit; mm
  bool json = false;
};

Parameters parameters_of(const Options& options) {
  if (!options.case_file.empty()) return read_case(options.case_file, options.assignments).parameters;
  Parameters parameters;
  for (const std::string& assignment : options.assignments) set_from_text(parameters, assignment, "--set");
  return parameters;
}

SurfaceMesh scaled(SurfaceMesh mesh, double scale) {
  for (Vec3& p : mesh.points) p *= scale;
  return mesh;
}

Json figures_of(const BodyReport& r) {
  const auto rounded = [](double x) { return std::round(1e4 * x) / 1e4; };
  Json figures = {{"nodes", r.nodes},
                  {"wedges", r.wedges},
                  {"skin_triangles", r.triangles},
                  {"pairs", r.pairs},
                  {"frames", r.frames},
                  {"least_angle_degrees", rounded(r.least_angle)},
                  {"least_determinant", rounded(r.least_determinant)},
                  {"least_thickness_mm", rounded(r.least_thickness)},
                  {"thinned_columns", r.thinned},
                  {"columns_on_bone", r.on_bone}};
  std::vector<std::string> warnings;
  if (r.thinned > 0) {
    figures["thinnest_at_mm"] = {rounded(r.thinnest.x), rounded(r.thinnest.y), rounded(r.thinnest.z)};
    warnings.push_back("the tissue is thinner than patch.height below " + std::to_string(r.thinned) +
                       " points of the skin, by up to " + shortest(rounded(r.least_thickness)) +
                       " mm: the body is thinner there, or its curvature stronger");
  }
  if (r.least_depth > 0)
    warnings.push_back("the cut is only " + shortest(rounded(r.least_depth)) +
                       " mm deep where the tissue is thin");
  figures["warnings"] = warnings;
  return figures;
}

void make(const Options& options) {
  std::vector<std::string> inputs = options.paths;
  inputs.insert(inputs.end(), {options.mesh, options.bone, options.case_file});
  std::erase(inputs, "");
  refuse_to_overwrite(options.out, inputs);
  const OutputFile probe(options.out);
  BodyRequest request;
  request.parameters = parameters_of(options);
  MeshReport mesh;
  request.skin = scaled(read_mesh(options.mesh, &mesh), options.scale);
  std::optional<SurfaceIndex> bone;
  if (!options.bone.empty()) {
    bone.emplace(scaled(read_mesh(options.bone), options.scale));
    request.bone = &*bone;
  }
  const double depth = options.depth > 0 ? options.depth : 0;
  for (const std::string& file : options.paths) {
    const NumberTable table = read_csv(file);
    const bool own = table.column("depth") >= 0;
    const double used = depth > 0 ? depth : own ? 0 : request.parameters.cut.depth;
    request.paths.push_back(read_path(file, used, options.scale, nullptr).scaled(options.scale));
  }
  request.reach = options.reach;
  if (!options.direction.empty())
    request.tension = {{options.direction[0], options.direction[1], options.direction[2]}};
  BodyReport report;
  Body body = make_body(request, &report);
  write_body(options.out, body);
  Json figures = figures_of(report);
  figures["body"] = body.hash;
  figures["mesh"] = cleft::figures_of(mesh);
  for (const auto& warning : figures["warnings"]) std::cerr << "cleft body: warning: " << std::string(warning) << "\n";
  print_figures(figures, options.json);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Meshes the body below a surface, with cuts along paths, so that cleft solve --mesh simulates these very "
      "cuts.",
      "cleft body");
  Options o;
  app.add_option("--mesh", o.mesh, "surface of the body: " + mesh_endings(MeshKind::surface, MeshUse::read))
      ->required();
  app.add_option("--path", o.paths,
                 "CSV with columns x,y,z,nx,ny,nz[,depth], in the mesh's units; again for further cuts")
      ->required();
  app.add_option("--out", o.out, "the body, body.h5")->required();
  app.add_option("--bone", o.bone, "surface of the bone below, to which the tissue is grown");
  app.add_option("--case", o.case_file,
                 "case file: mesh.element_size along the cuts, mesh.grading, mesh.front, and patch.height, the "
                 "thickness of the tissue [the defaults]");
  app.add_option("--set", o.assignments, "NAME=VALUE: overrides a parameter of the case (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--reach", o.reach, "how far the body goes around the cuts, over the skin, mm")
      ->check(above(0))
      ->capture_default_str();
  app.add_option("--depth", o.depth, "depth of the cuts, mm [the path's column, else cut.depth]")->check(above(0));
  app.add_option("--direction", o.direction,
                 "X,Y,Z: direction of skin.prestress_u, in space [from the first path's start to its end]")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--scale", o.scale, "mm per unit of the meshes and paths")->check(above(0))->capture_default_str();
  app.add_flag("--json", o.json, "figures as JSON");
  return run_command(app, argc, argv, [&] { make(o); });
}
