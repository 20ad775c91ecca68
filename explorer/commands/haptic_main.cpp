// cleft haptic: the scalpel of 1 kHz on a mesh, cutting it on another thread, without a window.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <optional>
#include <thread>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "explorer/commands/body_options.h"
#include "explorer/commands/cut_figures.h"
#include "explorer/commands/mesh_options.h"
#include "explorer/commands/tension_options.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/io/mesh_file.h"
#include "explorer/scalpel/hand_script.h"
#include "explorer/scalpel/scalpel_cutting.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/path_file.h"
#include "haptic/bare_timer.h"
#include "haptic/devices/list.h"
#include "haptic/devices/recorded.h"
#include "haptic/real_time.h"
#include "haptic/surface_stiffness.h"
#include "solver/snapshot/snapshot.h"

namespace {

using namespace cleft;

struct Options {
  std::string mesh, path, field, bone, snapshot, device = default_device(), trajectory, record;
  double scale = 1, rate = 1000, speed = 30;
  double depth = 0, seconds = 0, stiffness = 0;  // 0: not given
  double delay = 0;                              // ms
  bool real_time = false, json = false;
  TensionOptions tension;
};

/// N/mm, of the skin over the middle of the cut in a simulation, closed.
double snapshot_stiffness(const std::string& file) {
  const SnapshotReader reader(file);
  const Snapshot& s = reader.snapshot();
  const Vec3 middle{s.cut_start + s.cut_length / 2, 0, 0};
  std::size_t nearest = 0;
  for (std::size_t n = 0; n < s.points.size(); ++n)
    if (squared_norm(s.points[n] - middle) < squared_norm(s.points[nearest] - middle)) nearest = n;
  for (const SnapshotArray& array : reader.point_arrays())
    if (array.name == "compliance" && array.components == 1)
      return stiffness_from_compliance(reader.point_array(array, 0)[nearest]);
  throw FileError(file, "has no compliance of the skin (imported data have none): give --stiffness");
}

double stiffness(const Options& o, const Field* field) {
  if (o.stiffness > 0) return o.stiffness;
  if (!o.snapshot.empty()) return snapshot_stiffness(o.snapshot);
  return field ? surface_stiffness(*field) : ForceParameters{}.stiffness;
}

Json quantiles_us(const TimeHistogram& h) {
  return {{"p50", 1e6 * h.quantile(0.5)},
          {"p99", 1e6 * h.quantile(0.99)},
          {"p99.9", 1e6 * h.quantile(0.999)},
          {"max", 1e6 * h.largest()}};
}

Json figures_of(const HapticLoop& loop, const BareTimer& bare, const ScalpelCutting& cutting) {
  const LoopStatistics& s = loop.statistics();
  const CuttingFigures& c = cutting.figures();
  const auto named = std::min<std::uint64_t>(s.overruns, s.overrun_ticks.size());
  return {
      {"seconds", loop.state().time},
      {"ticks", s.ticks},
      {"compute_us", quantiles_us(s.compute)},
      {"lateness_us", quantiles_us(s.lateness)},
      {"bare_timer_compute_us", quantiles_us(bare.compute)},
      {"bare_timer_lateness_us", quantiles_us(bare.lateness)},
      {"page_faults", s.page_faults},
      {"overruns", s.overruns},
      {"overrun_ticks", std::vector<std::uint64_t>(s.overrun_ticks.begin(), s.overrun_ticks.begin() + named)},
      {"real_time_refused", loop.refused()},
      {"stiffness_N_per_mm", loop.model().stiffness()},
      {"largest_force_N", s.largest_force},
      {"largest_change_N", s.largest_change},
      {"change_beyond_permitted_N", s.excess_change},
      {"energy_put_in_Nmm", -loop.passivity().delivered()},
      {"energy_created_Nmm", loop.passivity().created()},
      {"punctures", loop.state().punctures},
      {"last_puncture_N", loop.model().last_puncture_force()},
      {"cuts", cutting.incisions()},
      {"cut_mm", cutting.cut_length()},
      {"triangles_cut", c.triangles_cut},
      {"cut_steps", c.cuts},
      {"cut_step_us", quantiles_us(c.cut)},
      {"grid_update_us", quantiles_us(c.update)},
      {"wound_us", quantiles_us(c.open)},
      {"stopped", c.stopped}};
}

/// A thread that is told to stop and waited for, whatever happens beside it.
struct Beside {
  std::atomic<bool>& stop;
  std::thread thread;
  ~Beside() {
    stop = true;
    if (thread.joinable()) thread.join();
  }
};

/// Throws InputError for a device that only the explorer's window has.
DeviceKind device_of(const Options& o) {
  DeviceKind kind = find_device(o.device);
  if (!kind.in_window) return kind;
  throw InputError("--device " + o.device + ": it needs the window of cleft explore --device " + o.device +
                   "; here there are " + device_choices(false));
}

void haptic(const Options& o) {
  const DeviceKind kind = device_of(o);
  refuse_to_overwrite(o.record, {o.mesh, o.path, o.field, o.bone, o.snapshot, o.trajectory});
  std::optional<OutputFile> probe;
  if (!o.record.empty()) probe.emplace(o.record);  // reports a bad name before the work
  std::optional<CutFields> fields;
  if (!o.field.empty()) fields = read_cut_fields(o.field, o.tension.direction, o.tension.prestresses);
  if (fields && !o.bone.empty()) fields = fields->above_bone(distance_to(bone_below(o.bone, o.scale, {})));
  const Field* field = fields ? &fields->shape() : nullptr;
  const SurfaceMesh mesh = read_mesh(o.mesh);
  warn_of_size(mesh, o.scale, field, "cleft haptic");
  std::optional<ScalpelPath> path;
  if (!o.path.empty()) path = read_path(o.path, o.depth, o.scale, field);

  ForceParameters force;
  force.stiffness = stiffness(o, field);
  DeviceRequest request;
  request.trajectory = o.trajectory;
  request.hand.delay = 1e-3 * o.delay;
  request.hand.period = 1 / o.rate;
  request.start = path ? pose_over(*path, o.scale, 0, 10) : pose_above(mesh, o.scale);
  if (path) request.script = hand_along(*path, o.scale, o.speed, request.hand, force);
  const std::unique_ptr<Device> device = kind.make(request);
  const double moving = std::isfinite(device->duration()) ? device->duration() : 10;
  const double seconds = o.seconds > 0 ? o.seconds : moving;

  ScalpelCutting cutting(mesh, {path, {}, fields, o.scale, o.depth});
  LoopOptions options;
  options.rate = o.rate;
  options.measure = true;
  options.real_time = o.real_time;
  if (!o.record.empty()) options.record = static_cast<std::size_t>(seconds * o.rate) + 1;
  HapticLoop loop(*device, cutting.surface(), force, options);
  BareTimer bare;
  std::atomic<bool> stop{false}, over{false};
  {
    Progress progress("haptic");
    Beside timer{stop, std::thread([&] { bare = bare_timer(o.rate, o.real_time, stop); })};
    Beside ticks{stop, std::thread([&] {
                   loop.run(stop, seconds);
                   over = true;
                 })};
    repeat(
        clock_second / 60, [&] { return over.load(); },
        [&] {
          cutting.step(loop.for_cutting());
          progress(shortest(std::round(10 * loop.for_view().read().time) / 10) + " s");
        });
  }
  cutting.step(loop.for_cutting());  // what the blade did while the last step was made
  if (!o.record.empty()) {
    probe.reset();
    write_recording(o.record, loop.recorded());
  }
  Json figures = figures_of(loop, bare, cutting);
  figures["warnings"] = warnings_of(cutting.validity(), "cleft haptic");
  print_figures(figures, o.json);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Feels and cuts a mesh with a haptic device, and reports what the loop did.",
                  "cleft haptic");
  Options o;
  app.add_option("--mesh", o.mesh, "surface mesh: " + mesh_endings(MeshKind::surface, MeshUse::read))
      ->required();
  app.add_option("--device", o.device, device_choices(false))->capture_default_str();
  app.add_report("--list-devices", device_sheet,
                 "list the devices and plug-ins there are, with what they need, and end");
  app.add_option("--path", o.path,
                 "CSV with columns x,y,z,nx,ny,nz[,depth], in the mesh's units: where the cut goes "
                 "[wherever the scalpel does]");
  app.add_option(
      "--field", o.field,
      "field file case.dffd that opens the cut; or study.dffd of three cases of other prestress, or of a "
      "family");
  add_bone(app, o.bone);
  o.tension.add_to(app);
  app.add_option("--depth", o.depth,
                 "depth of the cut, mm [the path's column, else the field's; without a path the scalpel's]")
      ->check(above(0));
  add_scale(app, o.scale);
  app.add_option("--seconds", o.seconds, "how long, s [the hand's or the recording's time, else 10]")
      ->check(above(0));
  app.add_option("--snapshot", o.snapshot, "simulation case.h5 whose compliance tells the stiffness");
  app.add_option("--stiffness", o.stiffness,
                 "of the skin, N/mm [the snapshot's, else the field's tissue's, else 0.3]")
      ->check(above(0));
  app.add_option("--trajectory", o.trajectory, "recording that the recorded device plays");
  app.add_option("--record", o.record, "write the poses as a recording");
  app.add_option("--rate", o.rate, "ticks a second, 100 to 10000")->check(above(0))->capture_default_str();
  app.add_option("--speed", o.speed, "of the hand along the path, mm/s")
      ->check(above(0))
      ->capture_default_str();
  app.add_option("--delay", o.delay, "of the hand, from pose to force, ms")
      ->check(at_least(0))
      ->capture_default_str();
  app.add_flag("--real-time", o.real_time, "ask for SCHED_FIFO and locked memory");
  app.add_flag("--json", o.json, "figures as JSON");
  return run_command(app, argc, argv, [&] {
    if (!o.bone.empty() && o.field.empty())
      throw InputError("--bone " + o.bone + ": is for the fields that open the cut; give --field");
    haptic(o);
  });
}
