// cleft explore: shows a study, case by case, on its patch or as wounds in a surface mesh.
#include <array>
#include <iostream>
#include <optional>

#include "base/command/command.h"
#include "base/error.h"
#include "base/text.h"
#include "explorer/app/run_window.h"
#include "explorer/commands/mesh_options.h"
#include "explorer/session/command_table.h"
#include "explorer/session/session.h"
#include "explorer/view/picture.h"
#include "haptic/devices/list.h"

using namespace cleft;

namespace {

struct Options {
  std::string study, mesh, path, bone, screenshot, script, state, shading;
  double scale = 1;  ///< mm in a unit of the mesh and the path
  int shown_case = 1;
  double time = -1;  ///< the end, where none is given
  std::vector<double> view{0, 0};
  double zoom = 1;
  std::vector<int> size{1280, 720};
  std::string device, device_file;
};

void add_options(CommandLine& app, Options& o) {
  app.add_option("study", o.study, "A study folder, a study.dffd or a case.dffd");
  Option* mesh = app.add_option("--mesh", o.mesh, "A surface mesh to cut instead of the patch");
  Option* path = app.add_option("--path", o.path, "The scalpel's path, CSV: x,y,z,nx,ny,nz[,depth]");
  path->needs(mesh);
  add_scale(app, o.scale)->needs(mesh);
  add_bone(app, o.bone)->needs(mesh);
  app.add_option("--script", o.script, "Do the commands of this file and open no window");
  app.add_option("--state", o.state, "Begin with a saved session: .json, or a .png written here");
  app.add_option("--screenshot", o.screenshot, "Write this PNG and open no window");
  app.add_option("--device", o.device,
                 "Cut the mesh in the window with a haptic device: " + device_choices(true))
      ->needs(mesh);
  app.add_option("--device-file", o.device_file, "The hand's path, or the recording that is played");
  app.add_option("--case", o.shown_case, "The case to begin with, from 1")->capture_default_str();
  app.add_option("--time", o.time, "Length cut, mm; default: the end")->check(at_least(0));
  app.add_option("--view", o.view, "AZIMUTH,ELEVATION from the cut's normal, degrees")
      ->delimiter(',')
      ->expected(2)
      ->check(at_least(-360));
  app.add_option("--zoom", o.zoom, "1: everything is in the picture")
      ->check(in_range(0.1, 100.))
      ->capture_default_str();
  app.add_option(
      "--shading", o.shading,
      "Light of skin and wounds: skin, as in life, or plain; default: skin in the window, plain in "
      "pictures");
  app.add_option("--size", o.size,
                 "WIDTH,HEIGHT in pixels; default: 1280,720, a window as it was closed last")
      ->delimiter(',')
      ->expected(2)
      ->check(in_range(16, 8192));
  app.footer("Commands, for --script and in the window:\n\n" + help_sheet());
}

bool has_window(const Options& o) { return o.script.empty() && o.screenshot.empty(); }

/// The options as commands.
void begin(Session& session, const CommandLine& app, const Options& o) {
  if (!o.state.empty()) session.say("load " + quoted(o.state));
  const std::string usual = has_window(o) && o.state.empty() ? "skin" : "";
  if (const std::string& shading = o.shading.empty() ? usual : o.shading; !shading.empty())
    session.say("shading " + quoted(shading));
  if (!o.study.empty()) session.say("open " + quoted(o.study));
  if (app.count("--case")) session.say("case " + std::to_string(o.shown_case));
  if (!o.mesh.empty()) session.say("mesh " + quoted(o.mesh) + " " + shortest(o.scale));
  if (!o.bone.empty()) session.say("bone " + quoted(o.bone));
  if (!o.path.empty()) session.say("cut-file " + quoted(o.path));
  if (o.time >= 0) session.say("time " + shortest(o.time));
  if (app.count("--view") + app.count("--zoom") > 0)
    session.say("camera " + shortest(o.view[0]) + " " + shortest(o.view[1]) + " " + shortest(o.zoom));
}

void explore(const CommandLine& app, const Options& o) {
  Session session(session_services([](const std::string& text) { std::cout << text << '\n'; }));
  begin(session, app, o);
  if (!o.script.empty()) session.run_script(o.script);
  if (!o.screenshot.empty())
    session.say("screenshot " + quoted(o.screenshot) + " " + std::to_string(o.size[0]) + " " +
                std::to_string(o.size[1]));
  if (!has_window(o)) return;
  const std::string file = o.device_file.empty() ? "" : " " + quoted(o.device_file);
  const std::string device = o.device.empty() ? "" : "device " + quoted(o.device) + file;
  std::optional<std::array<int, 2>> size;
  if (app.count("--size")) size = {o.size[0], o.size[1]};
  run_window(session, size, device);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Looks at a study: every case, at every length cut", "cleft explore");
  Options options;
  add_options(app, options);
  return run_command(app, argc, argv, [&] { explore(app, options); });
}
