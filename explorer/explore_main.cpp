// cleft explore: looks at a study, case by case, on its patch or as a wound in a surface mesh.
#include <iostream>

#include "base/command.h"
#include "base/error.h"
#include "explorer/view/explore_window.h"
#include "explorer/view/explorer.h"
#include "explorer/view/picture.h"
#include "params/study_index.h"

using namespace cleft;

namespace {

struct Options {
  ExplorerInput input;
  std::string screenshot;
  int shown_case = 1;
  double time = -1;  ///< the end, where none is given
  std::vector<double> view{0, 0};
  double zoom = 1;
  std::vector<int> size{1280, 720};
};

void add_options(CLI::App& app, Options& o) {
  app.add_option("study", o.input.study, "A study folder or a case.dffd")->required();
  CLI::Option* mesh = app.add_option("--mesh", o.input.mesh, "A surface mesh to cut instead of the patch");
  CLI::Option* path =
      app.add_option("--path", o.input.path, "The scalpel's path, CSV: x,y,z,nx,ny,nz[,depth]");
  mesh->needs(path), path->needs(mesh);
  app.add_option("--scale", o.input.scale, "mm in a unit of the mesh and the path")
      ->needs(mesh)
      ->check(above(0))
      ->capture_default_str();
  app.add_option("--screenshot", o.screenshot, "Write this PNG and open no window");
  app.add_option("--case", o.shown_case, "The case to begin with, from 1")->capture_default_str();
  app.add_option("--time", o.time, "Length cut, mm; default: the end")->check(at_least(0));
  app.add_option("--view", o.view, "AZIMUTH,ELEVATION from the cut's normal, degrees")
      ->delimiter(',')
      ->expected(2)
      ->check(at_least(-360));
  app.add_option("--zoom", o.zoom, "1: everything is in the picture")
      ->check(CLI::Range(0.1, 100.))
      ->capture_default_str();
  app.add_option("--size", o.size, "WIDTH,HEIGHT in pixels, default 1280,720")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::Range(16, 8192));
}

/// The fields are there: only comparing them with the simulation is not possible any more.
void tell_of_dropped_snapshots(const std::string& study) {
  int dropped = 0;
  for (const auto& [hash, one] : study_index(study)) dropped += !one.snapshot;
  if (dropped > 0)
    std::cerr << study << ": the raw data of " << dropped << " cases are gone (keep_snapshots = \"none\")\n";
}

void explore(const Options& o) {
  Explorer explorer(o.input);
  tell_of_dropped_snapshots(o.input.study);
  if (o.shown_case < 1 || o.shown_case > explorer.study().size())
    throw InputError("--case " + std::to_string(o.shown_case) + ": " + o.input.study +
                     " has the cases 1 to " + std::to_string(explorer.study().size()));
  explorer.show_case(o.shown_case - 1);
  explorer.view().set_time(o.time >= 0 ? o.time : explorer.view().duration());
  explorer.view().aim({o.view[0], o.view[1], o.zoom});
  if (!o.screenshot.empty()) {
    write_picture(explorer.view(), o.size[0], o.size[1], o.screenshot);
  } else {
    ExploreWindow(explorer, o.size[0], o.size[1]).run();
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Looks at a study: every case, at every length cut", "cleft explore");
  Options options;
  add_options(app, options);
  return run_command(app, argc, argv, [&] { explore(options); });
}
