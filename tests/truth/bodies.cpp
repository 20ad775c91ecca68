// How far replays on bodies of all shapes are from simulations of these very bodies:
//   cleft-truth-bodies [--field NAME=FILE]... [--csv FILE] [--lips FILE] [SUBJECT]...
// prints a table in Markdown; each body is simulated once (minutes in all).
//   cleft-truth-bodies --finer [SUBJECT]...
// prints how far simulations, and the fields of these very bodies, are from simulations with elements of half
// the size (an hour in all).
#include <algorithm>
#include <cstdio>
#include <memory>
#include <span>

#include "base/command/command.h"
#include "base/error.h"
#include "base/h5/h5.h"
#include "base/output_file.h"
#include "base/scratch_folder.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "encoder/encode.h"
#include "encoder/samples.h"
#include "explorer/body/simulate.h"
#include "explorer/body/simulated_wounds.h"
#include "explorer/incision/near_ends.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/replayed_wounds.h"
#include "params/parameters/table.h"
#include "tests/truth/body_subjects.h"
#include "tests/truth/truth_cases.h"

namespace {

using namespace cleft;

constexpr double end = 1;  // mm of a cut

struct Options {
  std::vector<std::string> subjects, cuts, fields, assignments;
  std::string csv, lips;
  double reach = 40;
  bool list = false, finer = false;
};

/// The fields of one column, in the tension of a body.
struct Source {
  std::string name;
  std::function<CutFields(const SkinTension&)> fields;
};

/// A file of any kind; a family's and three prestresses' are turned with the body's tension.
Source from_file(const std::string& named) {
  const auto split = named.find('=');
  if (split == std::string::npos || split == 0 || split + 1 == named.size())
    throw InputError("--field " + named + ": must be NAME=FILE");
  const std::string file = named.substr(split + 1);
  if (format_of(file) != "cleft-study") {
    const auto field = std::make_shared<const Field>(read_field(file));
    return {named.substr(0, split), [field](const SkinTension&) { return CutFields(field); }};
  }
  if (Family::describes(PublishedStudy(file).varying())) {
    const auto family = std::make_shared<const FamilyFields>(std::make_shared<const Family>(file));
    return {named.substr(0, split),
            [family](const SkinTension& tension) { return CutFields(family, tension); }};
  }
  const auto three = std::make_shared<const PrestressFields>(file);
  return {named.substr(0, split), [three](const SkinTension& tension) { return CutFields(three, tension); }};
}

/// The default case's field, and those of three prestresses.
std::vector<Source> default_sources() {
  const TruthCases cases("");
  const auto one = std::make_shared<const Field>(cases.canonical());
  const auto three = std::make_shared<const PrestressFields>(cases.prestresses());
  return {{"default case", [one](const SkinTension&) { return CutFields(one); }},
          {"three tensions", [three](const SkinTension& tension) { return CutFields(three, tension); }}};
}

struct Off {
  double opening = 0, skin = 0;  ///< largest errors over the largest opening
  double inner = 0;              ///< of the opening, without the last millimetre before each end
  double where = 0;              ///< of the opening's error: part of its cut's length
  double expected = 0;           ///< of `inner`, as cleft cut tells it
  bool warned = false;           ///< by cleft cut
  double seconds = 0;            ///< to cut and to prepare the replay
};

/// The vectors from lip to lip at a place of a cut, along the path, across it and out of the skin, mm.
struct LipPair {
  std::size_t cut;
  double s;  ///< mm along the path
  Vec3 simulated, replayed;
};

/// The cuts of a body in a mesh of its skin, complete.
struct CutSkin {
  CutSkin(const BodyRequest& request, double reach) : mesh(request.skin) {
    IncisionOptions how;
    how.reach = reach;
    for (const ScalpelPath& path : request.paths) {
      made.push_back(std::make_unique<Incision>(mesh, path, how));
      made.back()->advance_to(path.length());
      cuts.push_back(made.back().get());
    }
  }
  CutMesh mesh;
  std::vector<std::unique_ptr<Incision>> made;
  std::vector<const Incision*> cuts;
};

/// Of positions against those of a simulation: `opening`, `skin`, `inner` and `where`.
Off off_of(const CutSkin& skin, std::span<const Vec3> replayed, std::span<const Vec3> simulated,
           std::vector<LipPair>* lips = nullptr) {
  Off off;
  const ReplayOff all = replay_off(skin.cuts, replayed, simulated, 0);
  off.opening = all.relative_opening(), off.skin = all.gape > 0 ? all.displacement / all.gape : 0;
  double worst = 0;
  for (std::size_t k = 0; k < skin.cuts.size(); ++k)
    for (const auto& c : skin.cuts[k]->chain()) {
      const ScalpelPath& path = skin.cuts[k]->path();
      const double s = c.s;
      const Vec3 in_simulation = simulated[c.right] - simulated[c.left],
                 in_replay = replayed[c.right] - replayed[c.left];
      const PathFrame frame = path.at(s);
      const auto in_frame = [&](const Vec3& x) {
        return Vec3{dot(x, frame.along), dot(x, frame.across), dot(x, frame.outward)};
      };
      if (lips) lips->push_back({k, s, in_frame(in_simulation), in_frame(in_replay)});
      const double error = norm(in_simulation - in_replay);
      if (error > worst) worst = error, off.where = s / path.length();
      if (all.gape > 0 && std::min(s, path.length() - s) > end)
        off.inner = std::max(off.inner, error / all.gape);
    }
  return off;
}

/// One body, cut and opened by fields as cleft cut does, against its simulation.
Off compare(const BodyRequest& request, const CutFields& fields, const BodySimulation& simulation,
            std::vector<LipPair>& lips) {
  const Stopwatch watch;
  const CutSkin skin(request, reach_of(fields.shape(), 1));
  std::vector<Wound> opened;
  opened.reserve(skin.cuts.size());
  for (const Incision* cut : skin.cuts) opened.push_back(fields.wound(*cut, 1));
  const ReplayedWounds wounds(std::move(opened));
  std::vector<Vec3> replayed(wounds.vertex_count()), simulated(wounds.vertex_count());
  wounds.positions(wounds.duration(), replayed);
  const double seconds = watch.seconds();
  const SimulatedWounds truth(skin.cuts, 1, simulation.body, *simulation.series);
  truth.bare_positions(truth.duration(), simulated);
  Off off = off_of(skin, replayed, simulated, &lips);
  off.seconds = seconds;
  for (const Validity& v : wounds.validity(fields.turning())) {
    off.warned |= !v.warnings.empty();
    off.expected = std::max(off.expected, v.expected_error.largest);
  }
  return off;
}

struct Splined {
  std::unique_ptr<SnapshotReader> series;
  double spline_error;
};

/// The simulation with the displacements of the spline that cleft encode makes of it in place of its own, in
/// a file of this folder.
Splined with_spline(const BodySimulation& simulation, const std::string& folder) {
  const SnapshotReader& series = *simulation.series;
  const Snapshot& s = series.snapshot();
  const Field spline = encode(Series(series), {}, [](const std::string&) {}).field;
  const std::vector<Sample> places = samples_in_field(series);
  std::vector<double> canonical, axes;
  for (const Vec3& at : simulation.body.canonical) canonical.insert(canonical.end(), {at.x, at.y, at.z});
  for (const auto& frame : simulation.body.frames)
    for (const Vec3& axis : frame) axes.insert(axes.end(), {axis.x, axis.y, axis.z});
  SnapshotWriter out(folder + "/spline.h5", s, {canonical_array, frame_array});
  out.write_array(canonical_array, 0, canonical);
  out.write_array(frame_array, 0, axes);
  for (std::size_t f = 0; f < s.frames(); ++f) {
    std::vector<Vec3> moved;
    for (std::size_t n = 0; n < places.size(); ++n)
      moved.push_back(in_space(spline.displacement(places[n].uvw, places[n].side, s.times[f]), &axes[9 * n]));
    out.write_frames(f, moved);
  }
  out.finish(s);
  return {std::make_unique<SnapshotReader>(folder + "/spline.h5"), spline.report.spline_error};
}

/// The simulation that cut --simulate makes, and the spline that cleft encode makes of it, against the
/// simulation with elements of half the size.
void tell_finer(const std::string& name, const BodyRequest& request) {
  const BodySimulation usual = simulate(request);
  BodyRequest half = request;
  half.parameters.mesh.element_size /= 2;
  const BodySimulation finer = simulate(half);
  const CutSkin skin(request, request.reach);
  const auto positions = [&](const Body& body, const SnapshotReader& series) {
    const SimulatedWounds wounds(skin.cuts, 1, body, series);
    std::vector<Vec3> moved(skin.mesh.vertices().size());
    wounds.bare_positions(wounds.duration(), moved);
    return moved;
  };
  const std::vector<Vec3> truth = positions(finer.body, *finer.series);
  const Off simulated = off_of(skin, positions(usual.body, *usual.series), truth);
  std::string encoded = "| | |";  // a field holds one cut
  if (request.paths.size() == 1) {
    const ScratchFolder folder("truth");
    const auto [splined, spline_error] = with_spline(usual, folder.path());
    const Off off = off_of(skin, positions(usual.body, *splined), truth);
    encoded = formatted("%.2f | %.2f | %.2f |", off.inner, off.skin, spline_error);
  }
  std::printf("| %s | %.2f | %.2f | %.2f | %s %d | %.1f | %d | %.0f |\n", name.c_str(), finer.gape,
              simulated.inner, simulated.skin, encoded.c_str(), usual.report.nodes, usual.seconds,
              finer.report.nodes, finer.seconds);
  std::fflush(stdout);
}

/// The tension that the simulation has: that of the case, along the chord of the first path.
SkinTension tension_of(const BodyRequest& request) {
  const auto& prestress = request.parameters.skin.prestress;
  if (prestress.uv != 0) throw InputError("--set skin.prestress_uv: shear is not compared here");
  SkinTension tension = default_tension(request.paths.front(), false);
  tension.larger = prestress.uu, tension.smaller = prestress.vv;
  return tension;
}

class Table {
 public:
  Table(const std::vector<Source>& sources, std::string csv, std::string lips)
      : csv_(std::move(csv)), lips_(std::move(lips)) {
    for (const Source& source : sources) names_.push_back(source.name);
    std::string head = "| body | mm |", line = "|---|---|";
    text_ = "body,opening_mm,nodes,simulation_s,thinned_columns,cut_depth_mm";
    for (const auto& [name, fields] : sources) {
      head += " " + name + " | expected | skin |", line += "---|---|---|";
      for (const char* column : {"opening_error", "skin_error", "inner_opening_error", "expected_error",
                                 "where", "warned", "replay_s"})
        text_ += "," + name + " " + column;
    }
    std::printf("%s\n%s\n", head.c_str(), line.c_str());
    std::fflush(stdout);
  }

  void add(const std::string& name, const BodySimulation& simulation, const std::vector<Off>& offs) {
    char cell[200];
    const BodyReport& body = simulation.report;
    std::printf("| %s | %.2f%s |", name.c_str(), simulation.gape, body.least_depth > 0 ? "!" : "");
    std::snprintf(cell, sizeof cell, "\n\"%s\",%.4f,%d,%.1f,%d,%.2f", name.c_str(), simulation.gape,
                  body.nodes, simulation.seconds, body.thinned, body.least_depth);
    text_ += cell;
    for (const Off& off : offs) {
      std::printf(" %.2f%s | %.2f | %.2f |", off.inner, off.warned ? "*" : "", off.expected, off.skin);
      within_ += off.inner <= 2 * off.expected, ++all_;
      std::snprintf(cell, sizeof cell, ",%.4f,%.4f,%.4f,%.4f,%.2f,%d,%.2f", off.opening, off.skin, off.inner,
                    off.expected, off.where, off.warned ? 1 : 0, off.seconds);
      text_ += cell;
    }
    std::printf("\n");
    std::fflush(stdout);
    if (!csv_.empty()) write_text_file(csv_, text_ + "\n");
  }

  void add_lips(const std::string& name, const std::vector<std::vector<LipPair>>& of_fields) {
    if (lips_.empty()) return;
    char line[200];
    for (std::size_t k = 0; k < of_fields.size(); ++k)
      for (const LipPair& pair : of_fields[k]) {
        const auto& [sx, sy, sz] = pair.simulated;
        const auto& [rx, ry, rz] = pair.replayed;
        std::snprintf(line, sizeof line, ",%zu,%.4f,%.5f,%.5f,%.5f,%.5f,%.5f,%.5f\n", pair.cut + 1, pair.s,
                      sx, sy, sz, rx, ry, rz);
        lips_text_ += "\"" + name + "\"," + names_[k] + line;
      }
    write_text_file(lips_, lips_text_);
  }

  /// Of how many replays the error is within twice what is expected.
  void end() const { std::printf("\nWithin twice the expected error: %d of %d.\n", within_, all_); }

 private:
  std::string csv_, text_, lips_;
  std::string lips_text_ =
      "body,field,cut,mm,simulated_along,simulated_across,simulated_outward,replayed_along,replayed_across,"
      "replayed_outward\n";
  std::vector<std::string> names_;
  int within_ = 0, all_ = 0;
};

BodyRequest request_of(const testing::Subject& subject, const BodyRequest& common) {
  BodyRequest request = common;
  request.skin = subject.skin;
  request.paths = with_near_ends_joined(subject.paths, narrowest_bridge).paths;
  if (subject.bone) request.bone = std::make_shared<const SurfaceIndex>(*subject.bone);
  return request;
}

void run(const Options& options) {
  std::vector<testing::NamedSubject> subjects = testing::body_subjects(options.reach + 5);
  if (!options.subjects.empty() || !options.cuts.empty())
    std::erase_if(subjects, [&](const testing::NamedSubject& one) {
      return std::ranges::none_of(options.subjects, [&](const std::string& part) {
        return one.name.find(part) != std::string::npos;
      });
    });
  for (const std::string& cuts : options.cuts)
    subjects.push_back(testing::straight_cuts(cuts, options.reach + 5));
  if (subjects.empty())
    throw InputError(options.subjects.front() + ": no body has this in its name; see --list");
  if (options.list) {
    for (const auto& one : subjects) std::printf("%s\n", one.name.c_str());
    return;
  }
  BodyRequest common;
  for (const std::string& assignment : options.assignments)
    set_from_text(common.parameters, assignment, "--set");
  common.reach = options.reach;
  std::vector<Source> sources;
  for (const std::string& named : options.fields) sources.push_back(from_file(named));
  if (options.finer) {
    std::printf(
        "| body | mm | simulated | skin | its field | skin | spline_error | nodes | s | finer nodes | s |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const auto& [name, make] : subjects) tell_finer(name, request_of(make(), common));
    return;
  }
  if (sources.empty()) sources = default_sources();
  Table table(sources, options.csv, options.lips);
  for (const auto& [name, make] : subjects) {
    try {
      const BodyRequest request = request_of(make(), common);
      const SkinTension tension = tension_of(request);
      const BodySimulation simulation = simulate(request);
      std::vector<Off> offs;
      std::vector<std::vector<LipPair>> lips(sources.size());
      offs.reserve(sources.size());
      for (const Source& source : sources) {
        CutFields fields = source.fields(tension);
        if (request.bone) fields = fields.above_bone(distance_to(request.bone));
        offs.push_back(compare(request, fields, simulation, lips[offs.size()]));
      }
      table.add(name, simulation, offs);
      table.add_lips(name, lips);
    } catch (const InputError& e) {
      std::fprintf(stderr, "cleft-truth-bodies: %s: %s\n", name.c_str(), e.what());
    }
  }
  table.end();
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Tells how far replays are from simulations of the very bodies that are cut.",
                  "cleft-truth-bodies");
  Options o;
  app.add_option("SUBJECT", o.subjects, "only the bodies that have this in their names [all]");
  app.add_option(
         "--cuts", o.cuts,
         "a body of flat skin with straight cuts: LENGTH,ANGLE,X,Y[,DEPTH] of each, with blanks between "
         "them, such as \"30,0,0,0 15,90,0,7.5\"; again for further bodies")
      ->allow_extra_args(false);
  app.add_option("--field", o.fields,
                 "NAME=FILE: a case.dffd, or a study.dffd of three tensions or of a family, which are turned "
                 "with the body's tension; again for further columns [the default case, and three tensions]")
      ->allow_extra_args(false);
  app.add_option("--set", o.assignments, "NAME=VALUE: of the simulations, such as mesh.element_size=0.5")
      ->allow_extra_args(false);
  app.add_option("--reach", o.reach, "how far bodies go around the cuts, mm")->capture_default_str();
  app.add_option("--csv", o.csv, "the table too, with the place of the largest error and times");
  app.add_option("--lips", o.lips,
                 "CSV: the vectors from lip to lip along all cuts, simulated and replayed, mm");
  auto* list = app.add_flag("--list", o.list, "the names of the bodies");
  app.add_flag("--finer", o.finer,
               "instead: how far the simulations, and the fields of these very bodies, are from simulations "
               "with elements of half the size")
      ->excludes(list);
  return run_command(app, argc, argv, [&] { run(o); });
}
