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
#include "explorer/commands/haptic_figures.h"
#include "explorer/commands/mesh_options.h"
#include "explorer/commands/tension_options.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/io/mesh_file.h"
#include "explorer/scalpel/hand_script.h"
#include "explorer/scalpel/scalpel_cutting.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/path_file.h"
#include "haptic/devices/list.h"
#include "haptic/devices/recorded.h"
#include "haptic/firmness_above_bone.h"
#include "haptic/real_time.h"
#include "haptic/surface_stiffness.h"
#include "params/run/signal_handler.h"
#include "solver/snapshot/snapshot.h"

namespace {

using namespace cleft;

constexpr int steps_a_second = 60;  // of the mesh: a picture each

struct Options {
  std::string mesh, path, field, bone, snapshot, device = default_device(), trajectory, record, out,
                                                 clock = "wall";
  double scale = 1, rate = 1000, speed = 30;
  double depth = 0, seconds = 0, stiffness = 0;  // 0: not given
  double delay = 0;                              // ms
  bool real_time = false, json = false;
  TensionOptions tension;
};

/// N/mm, of the skin over the middle of the cut in a simulation, closed. Throws InputError if it is of
/// another case than the field.
double snapshot_stiffness(const std::string& file, const Field* field) {
  const SnapshotReader reader(file);
  const Snapshot& s = reader.snapshot();
  if (field && !field->case_hash.empty() && !s.case_hash.empty() && field->case_hash != s.case_hash)
    throw FileError(file, "is the simulation of case " + s.case_hash + ", but --field is of case " +
                              field->case_hash + ": give the field's own simulation, or --stiffness");
  const Vec3 middle{s.cut_start + s.cut_length / 2, 0, 0};
  std::size_t nearest = 0;
  for (std::size_t n = 0; n < s.points.size(); ++n)
    if (squared_norm(s.points[n] - middle) < squared_norm(s.points[nearest] - middle)) nearest = n;
  for (const SnapshotArray& array : reader.point_arrays())
    if (array.name == "compliance" && array.components == 1)
      return stiffness_from_compliance(reader.point_array(array, 0)[nearest]);
  throw FileError(file,
                  "has no compliance of the skin (imported data, bodies and shaped patches have none): leave "
                  "--snapshot out, since a --field of a body knows the tissue below its cut, or give "
                  "--stiffness");
}

double stiffness(const Options& o, const std::optional<CutFields>& fields) {
  if (o.stiffness > 0) return o.stiffness;
  const Field* field = fields ? &fields->shape() : nullptr;
  if (!o.snapshot.empty())
    return snapshot_stiffness(o.snapshot, fields && fields->turning() ? nullptr : field);
  return field ? surface_stiffness(*field) : ForceParameters{}.stiffness;
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

/// Set by SIGINT and SIGTERM: the blade stops where it is, and what it did is reported.
std::atomic<bool> stopped_by_signal{false};

/// Loop and cutting on threads of their own, by the wall's clock; for `seconds` or as long as the device
/// moves.
BareTimer cut_by_wall_clock(HapticLoop& loop, ScalpelCutting& cutting, const Options& o,
                            std::optional<double> seconds) {
  Progress progress("haptic");
  BareTimer bare;
  std::atomic<bool> stop{false}, over{false};
  Beside timer{stop, std::thread([&] { bare = bare_timer(o.rate, o.real_time, stop); })};
  Beside ticks{stop, std::thread([&] {
                 loop.run(stopped_by_signal, seconds);
                 over = true;
               })};
  repeat(
      clock_second / steps_a_second, [&] { return over.load(); },
      [&] {
        cutting.step(loop.for_cutting());
        progress(shortest(std::round(10 * loop.for_view().read().time) / 10) + " s");
      });
  return bare;
}

/// Tick by tick in one thread, a step of the mesh after those of a picture: the same on every machine.
void cut_by_virtual_clock(HapticLoop& loop, ScalpelCutting& cutting, const Options& o, double seconds) {
  Progress progress("haptic");
  const auto ticks = static_cast<std::int64_t>(std::ceil(seconds * o.rate - 1e-6));
  const auto a_step = std::max<std::int64_t>(1, std::llround(o.rate / steps_a_second));
  for (std::int64_t tick = 1; tick <= ticks && !stopped_by_signal; ++tick) {
    loop.update(1 / o.rate);
    if (tick % a_step != 0) continue;
    cutting.step(loop.for_cutting());
    progress(shortest(std::round(10 * loop.state().time) / 10) + " s");
  }
}

/// Checks the names of files before the work.
void check_files(const Options& o) {
  for (const std::string& file : {o.record, o.out})
    if (!file.empty()) {
      refuse_to_overwrite(file, {o.mesh, o.path, o.field, o.bone, o.snapshot, o.trajectory});
      const OutputFile probe(file);
    }
  if (!o.out.empty()) surface_format(o.out, MeshUse::write);
}

void check_clock(const Options& o, const DeviceKind& kind) {
  if (o.clock == "wall") return;
  if (!kind.input)
    throw InputError("--clock virtual: the device " + o.device +
                     " is moved by a hand, which follows the wall's clock; give --device hand or recorded");
  if (o.real_time)
    throw InputError("--real-time: is about the wall's clock; leave it out with --clock virtual");
}

/// Cuts what the blade has passed since the last step, ends its cut, and passes all motion on.
void finish(HapticLoop& loop, ScalpelCutting& cutting) {
  cutting.step(loop.for_cutting());
  cutting.end_cut();
  cutting.settle();
}

void haptic(const Options& o) {
  const DeviceKind kind = device_of(o);
  check_clock(o, kind);
  check_files(o);
  std::optional<CutFields> fields;
  if (!o.field.empty()) fields = read_cut_fields(o.field, o.tension.read(o.scale));
  const auto bone = o.bone.empty() ? nullptr : bone_below(o.bone, o.scale, {});
  if (bone) fields = fields->above_bone(distance_to(bone));
  const Field* field = fields ? &fields->shape() : nullptr;
  const SurfaceMesh mesh = read_mesh(o.mesh);
  warn_of_size(mesh, o.scale, field, "cleft haptic");
  tell_note(mesh, o.mesh, "cleft haptic");
  std::optional<ScalpelPath> path;
  if (!o.path.empty()) {
    const auto of_field = field ? std::optional(field->cut().depth) : std::nullopt;
    path = read_path(o.path, o.depth, o.scale, of_field);
  }

  ForceParameters force;
  force.stiffness = stiffness(o, fields);
  DeviceRequest request;
  request.trajectory = o.trajectory;
  request.hand.delay = 1e-3 * o.delay;
  request.hand.period = 1 / o.rate;
  request.start = path ? pose_over(*path, o.scale, 0, 10) : pose_above(mesh, o.scale);
  if (path) request.script = hand_along(*path, o.scale, o.speed, request.hand, force);
  const std::unique_ptr<Device> device = kind.make(request);
  std::optional<double> seconds;  // none: as long as the device moves
  if (o.seconds > 0 || !std::isfinite(device->duration())) seconds = o.seconds > 0 ? o.seconds : 10;

  ScalpelCutting::Setup setup{path, {}, fields, o.scale, o.depth, o.clock != "wall"};
  if (bone && o.stiffness == 0) setup.firmness = firmness_above_bone(*field, least_distance_to(bone));
  ScalpelCutting cutting(mesh, std::move(setup));
  LoopOptions options;
  options.rate = o.rate;
  options.measure = true;
  options.real_time = o.real_time;
  const double at_most = seconds.value_or(device->duration());
  if (!o.record.empty()) options.record = static_cast<std::size_t>(at_most * o.rate) + 1;
  HapticLoop loop(*device, cutting.surface(), force, options);
  Json figures;
  {
    const SignalHandler handler({SIGINT, SIGTERM}, [](int) { stopped_by_signal = true; });
    std::optional<BareTimer> bare;
    if (o.clock == "wall")
      bare = cut_by_wall_clock(loop, cutting, o, seconds);
    else
      cut_by_virtual_clock(loop, cutting, o, at_most);
    finish(loop, cutting);
    figures = figures_of(loop, cutting);
    if (bare) add_times(figures, loop, *bare, cutting);
  }
  if (!o.record.empty()) write_recording(o.record, loop.recorded());
  if (!o.out.empty()) write_cut_mesh(o.out, cutting, o.scale);
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
  app.add_option("--seconds", o.seconds,
                 "how long, s [as long as the hand or the recording moves, else 10]; Ctrl-C ends it too, "
                 "with its report")
      ->check(above(0));
  app.add_option("--snapshot", o.snapshot, "simulation case.h5 whose compliance tells the stiffness");
  app.add_option(
         "--stiffness", o.stiffness,
         "of the skin, N/mm, everywhere [the snapshot's, else the field's tissue's, firmer above --bone, "
         "else 0.3]")
      ->check(above(0));
  app.add_option("--trajectory", o.trajectory, "recording that the recorded device plays");
  app.add_option("--record", o.record, "write the poses as a recording");
  app.add_option("--out", o.out,
                 "write the mesh as the blade leaves it: " + mesh_endings(MeshKind::surface, MeshUse::write));
  app.add_option(
         "--clock", o.clock,
         "wall: ticks at their times, as a hand feels them; virtual, for a simulated hand or a recording: "
         "tick by tick, as fast as they are computed, with the same cuts, forces and mesh on every machine")
      ->check(one_of({"wall", "virtual"}))
      ->capture_default_str();
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
