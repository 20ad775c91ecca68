// cleft import: another program's time series to a snapshot.
#include <map>

#include "base/command/command.h"
#include "base/error.h"
#include "base/ranks/other_ranks.h"
#include "encoder/import/import_series.h"
#include "encoder/import/series_on_ranks.h"

using namespace cleft;

namespace {

const std::map<std::string, Box> boxes = {
    {"smaller", Box::smaller}, {"aligned", Box::aligned}, {"principal", Box::principal}};

Json list_of(const Vec3& v) { return {v.x, v.y, v.z}; }

Json figures_of(const ImportReport& report) {
  const Snapshot& s = report.snapshot;
  Json fields = Json::array();
  if (report.has_displacement) fields.push_back("displacement");
  for (const SnapshotArray& array : report.arrays) fields.push_back(array.name);
  Json figures = {{"nodes", s.points.size()},
                  {"cells", s.cell_types.size()},
                  {"frames", s.frames()},
                  {"duration", s.times.back()},
                  {"fields", fields},
                  {"pairs", s.pairs.size()},
                  {"released", s.released.back()},
                  {"breaks", s.pieces.empty() ? (s.pairs.empty() ? 0 : 1) : s.pieces.size()},
                  {"cut", {{"start", s.cut_start}, {"length", s.cut_length}, {"depth", s.cut_depth}}},
                  {"break", s.source->break_plane},
                  {"origin", list_of(s.source->origin)}};
  for (int i = 0; i < 3; ++i) figures[std::string(1, "uvw"[i])] = list_of(s.source->axes[i]);
  figures["notes"] = report.notes;
  return figures;
}

}  // namespace

int main(int argc, char** argv) {
  const Ranks ranks(argc, argv);
  if (ranks.rank() > 0) {
    serve_series(ranks);
    return 0;
  }
  const OtherRanks others(ranks);
  CommandLine app(
      "Takes another program's time series as a snapshot, and finds its discontinuity. Under "
      "mpirun or srun the processes share the frames to read.",
      "cleft import");
  ImportOptions o;
  std::string plane, open_at, box = "smaller";
  bool json = false;
  std::vector<std::string> series;
  app.add_option("SERIES", series,
                 "a .pvd, or a .series in JSON, that lists .vtu, .pvtu, .vtp, .vtm or .vtk files with their "
                 "times; a temporal .vtkhdf; .xdmf; Exodus (.e .exo .ex2); EnSight (.case); .cgns; or "
                 "CalculiX's .frd. Several: further fields of the same mesh at the same times, whose "
                 "names, where they are in several, are SERIES/NAME")
      ->required();
  app.add_option(
         "--field", o.fields,
         "SOURCE[:NAME[UNIT]],...: arrays of the points, or of the cells, whose mean a node gets, their "
         "names here, and their units, with which legends show them, as S:stress[MPa]; one named "
         "displacement is what fields are fitted to. Where components are arrays, SOURCE is what their names "
         "begin with (disp of disp_x, disp_y, disp_z) or their sum (u+v+w). May be repeated")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--break", plane,
                 "nx,ny,nz,offset: the discontinuity's plane, of the points x with n . x = offset; "
                 "or none (default: that of the coincident nodes that part)");
  app.add_option(
      "--open-at", open_at,
      "jump above which a pair is open: a number in units of the field that tells, such as 0.002, or "
      "a share of the largest jump, such as 0.5% (default: rounding, or the data's noise)");
  app.add_option("--box", box,
                 "without a break: along the axes (aligned), the nodes' principal ones (principal), or "
                 "those where they save a fifth (smaller)")
      ->check(one_of(boxes))
      ->capture_default_str();
  app.add_option("--set", o.parameters,
                 "NAME=VALUE, as often as needed: what the series does not tell of skin, tissue and load, "
                 "named and in units as cleft solve --help says; where several cuts are made in one mesh, "
                 "skin.thickness, skin.young_modulus, skin.poisson_ratio, skin.prestress_v, "
                 "tissue.young_modulus and tissue.poisson_ratio are asked for")
      ->allow_extra_args(false);
  app.add_option("--out", o.out, "snapshot to write, case.h5")->required();
  app.add_flag("--json", json, "print the figures as JSON");

  return run_command(app, argc, argv, [&] {
    ranks.check();
    if (app.count("--break") > 0) o.break_plane = plane;
    if (app.count("--open-at") > 0) o.open_at = open_at;
    o.box = boxes.at(box);
    o.series = series.front();
    o.more_series.assign(series.begin() + 1, series.end());
    ImportReport report;
    {
      Progress progress("importing");
      report = import_series(
          o, [&](const std::string& state) { progress(state); }, &ranks);
    }
    print_figures(figures_of(report), json);
  });
}
