// cleft body: a surface and the paths of cuts to the mesh of a body that cleft solve takes.
#include <optional>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "explorer/commands/body_options.h"
#include "explorer/commands/cut_figures.h"
#include "explorer/commands/mesh_options.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/io/mesh_file.h"
#include "explorer/wound/path_file.h"

namespace {

using namespace cleft;

struct Options {
  std::string mesh, out;
  std::vector<std::string> paths;
  BodyOptions body;
  double scale = 1, depth = 0;  // mm per mesh unit; mm
  bool json = false;
};

void make(const Options& options) {
  std::vector<std::string> inputs = options.paths;
  inputs.insert(inputs.end(), {options.mesh, options.body.bone, options.body.case_file});
  std::erase(inputs, "");
  refuse_to_overwrite(options.out, inputs);
  const OutputFile probe(options.out);
  BodyRequest request = options.body.request();
  MeshReport mesh;
  request.skin = read_mesh(options.mesh, &mesh);
  warn_of_size(request.skin, options.scale, nullptr, "cleft body");
  request.skin = scaled(std::move(request.skin), options.scale);
  request.bone = options.body.read_bone(options.scale, {});
  for (const std::string& file : options.paths) {
    const bool own = read_csv(file).column("depth") >= 0;
    const double depth = options.depth > 0 || own ? options.depth : request.parameters.cut.depth;
    request.paths.push_back(read_path(file, depth, options.scale, nullptr).scaled(options.scale));
  }
  BodyReport report;
  Body body = make_body(request, &report);
  write_body(options.out, body);
  Json figures = figures_of(report);
  figures["body"] = body.hash;
  figures["mesh"] = cleft::figures_of(mesh);
  warn_of(report, "cleft body");
  print_figures(figures, options.json);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Meshes the body below a surface, with cuts along paths, so that cleft solve --mesh simulates these "
      "very "
      "cuts.",
      "cleft body");
  Options o;
  app.add_option("--mesh", o.mesh, "surface of the body: " + mesh_endings(MeshKind::surface, MeshUse::read))
      ->required();
  app.add_option("--path", o.paths,
                 "CSV with columns x,y,z,nx,ny,nz[,depth], in the mesh's units; again for further cuts")
      ->required();
  app.add_option("--out", o.out, "the body, body.h5")->required();
  app.add_option("--depth", o.depth, "depth of the cuts, mm [the path's column, else cut.depth]")
      ->check(above(0));
  o.body.add_to(app);
  add_scale(app, o.scale);
  app.add_flag("--json", o.json, "figures as JSON");
  return run_command(app, argc, argv, [&] { make(o); });
}
