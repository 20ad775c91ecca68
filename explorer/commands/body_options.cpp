#include "explorer/commands/body_options.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "explorer/body/body_warnings.h"
#include "explorer/body/simulate.h"
#include "explorer/commands/tension_options.h"
#include "explorer/incision/local_coordinates.h"
#include "explorer/io/mesh_file.h"
#include "params/consistency.h"
#include "params/parameters/table.h"
#include "params/study.h"

namespace cleft {

namespace {

constexpr double least_reach = 2;  // elements: a narrower body is held by its rim alone

double rounded(double x) { return std::round(1e4 * x) / 1e4; }

}  // namespace

void BodyOptions::add_to(CommandLine& app) {
  app_ = &app;
  app.add_option(
      "--bone", bone,
      "surface of the bone below, to which the tissue is grown: of a simulation, and of a family's fields");
  app.add_option("--case", case_file,
                 "of a simulation: case file, for skin, tissue, mesh.element_size along the cuts, "
                 "mesh.grading, and patch.height, the thickness of the tissue [those of --field's case, else "
                 "the defaults]");
  app.add_option("--set", assignments, "of a simulation: NAME=VALUE, overrides a parameter (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--reach", reach,
                 "of a simulation: how far the body goes around the cuts, over the skin, mm")
      ->check(above(0))
      ->capture_default_str();
  auto* one =
      app.add_option(
             "--direction", direction,
             "X,Y,Z, of a simulation: direction of skin.prestress_u, in space [from the first path's start "
             "to its end]")
          ->delimiter(',')
          ->expected(3);
  app.add_option("--direction-lines", lines,
                 "CSV with columns x,y,z,dx,dy,dz, in the mesh's units, of a simulation: lines along "
                 "skin.prestress_u, which has the mean of their directions between them, in place of "
                 "--direction")
      ->excludes(one);
}

std::string BodyOptions::first_given(bool but_bone) const {
  for (const char* name : {"--bone", "--case", "--set", "--reach", "--direction", "--direction-lines"})
    if (app_->count(name) > 0 && !(but_bone && name == std::string("--bone"))) return name;
  return "";
}

BodyRequest BodyOptions::request(double scale, const RecordedParameters& of_field) const {
  BodyRequest request;
  request.own_formulation =
      tells_formulation(assignments) || (!case_file.empty() && tells_formulation(read_study(case_file)));
  if (!case_file.empty()) {
    request.parameters = read_case(case_file, assignments).parameters;
  } else {
    request.parameters = parameters_of_body(of_field);
    for (const std::string& assignment : assignments) set_from_text(request.parameters, assignment, "--set");
  }
  check_tension(request.parameters, case_file.empty() ? "--set" : case_file);
  if (reach < least_reach * request.parameters.mesh.element_size)
    throw InputError("--reach " + shortest(reach) + " mm: must be at least " + shortest(least_reach) +
                     " times mesh.element_size = " + shortest(request.parameters.mesh.element_size) + " mm");
  request.reach = reach;
  if (!direction.empty()) check_direction("--direction", direction);
  if (!direction.empty()) request.tension = {{{}, {direction[0], direction[1], direction[2]}}};
  if (!lines.empty()) request.tension = read_tension_lines(lines, scale);
  return request;
}

std::shared_ptr<const SurfaceIndex> BodyOptions::read_bone(double scale, const Vec3& origin) const {
  return bone.empty() ? nullptr : bone_below(bone, scale, origin);
}

std::shared_ptr<const SurfaceIndex> bone_below(const std::string& file, double scale, const Vec3& origin) {
  return std::make_shared<const SurfaceIndex>(scaled(moved(read_mesh(file), -origin), scale));
}

SurfaceMesh scaled(SurfaceMesh mesh, double scale) {
  for (Vec3& p : mesh.points) p *= scale;
  return mesh;
}

Json figures_of(const BodyReport& r) {
  Json figures = {{"nodes", r.nodes},
                  {"wedges", r.wedges},
                  {"skin_triangles", r.triangles},
                  {"pairs", r.pairs},
                  {"frames", r.frames},
                  {"least_angle_degrees", rounded(r.least_angle)},
                  {"least_determinant", rounded(r.least_determinant)},
                  {"least_thickness_mm", rounded(r.least_thickness)},
                  {"thinned_columns", r.thinned},
                  {"blade_turned_degrees", rounded(r.blade_turn)},
                  {"left_out_triangles", r.left_out},
                  {"columns_on_bone", r.on_bone}};
  if (r.thinned > 0)
    figures["thinnest_at_mm"] = {rounded(r.thinnest.x), rounded(r.thinnest.y), rounded(r.thinnest.z)};
  figures["warnings"] = warnings_of(r);
  return figures;
}

Json figures_of(const ReplayOff& off, double scale) {
  return {{"off_by_mm", off.displacement * scale},
          {"off_by", off.relative_displacement()},
          {"opening_off_by_mm", off.opening * scale},
          {"opening_off_by", off.relative_opening()}};
}

}  // namespace cleft
