// cleft export: snapshots and fields in the files of other programs.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/output_folder.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "explorer/commands/mesh_options.h"
#include "explorer/commands/tension_options.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/io/paraview_file.h"
#include "explorer/scene/patch_scene.h"
#include "explorer/session/command_table.h"
#include "explorer/study/field_on_mesh.h"
#include "explorer/view/cinema.h"
#include "explorer/view/picture.h"
#include "explorer/web/page.h"
#include "params/run/study_folder.h"

using namespace cleft;

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string input, color = "displacement";
  std::optional<std::string> paraview, cinema, web;  // one of them
  std::string nodes;
  bool decoded = false, json = false;
  int frames = 61;
  CinemaGrid grid;
  std::vector<int> size{640, 360};
  std::string mesh, bone;  // of a page
  std::vector<std::string> paths;
  double scale = 1;
  TensionOptions tension;
};

/// The path of the output: `out`, `out/` and, for a series, `out.pvd` are equivalent.
struct Place {
  std::string folder, name;
};

Place place_of(const std::string& out, bool is_series) {
  fs::path path = fs::path(out).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  if (is_series && path.extension() == ".pvd") path.replace_extension();
  const std::string name = path.filename().string();
  if (name.empty() || name == "." || name == "..")
    throw InputError("--paraview '" + out + "': give a name, like out.pvd");
  return {path.has_parent_path() ? path.parent_path().string() : ".", name};
}

/// Of simulations lengths are mm; others are what the source's fields tell.
Units units_of(const std::vector<std::string>* source_fields) {
  if (!source_fields)
    return [](const std::string& name) { return std::string(name == "displacement" ? "mm" : ""); };
  return [source = FieldSource{.fields = *source_fields}](const std::string& name) {
    return unit_of(source, name);
  };
}
Units units_of(const Snapshot& s) { return units_of(s.source ? &s.source->fields : nullptr); }

void export_case(const Options& o, Progress& progress, Json& figures) {
  const Place place = place_of(*o.paraview, true);
  refuse_to_replace_series(place.folder, place.name);
  OutputFolder out(place.folder, place.name);
  const SnapshotReader reader(o.input);
  const std::string frames = std::to_string(reader.snapshot().frames());
  const ExportFigures done = write_paraview_series(
      reader, out.path(), place.name, units_of(reader.snapshot()),
      [&](std::size_t j) { progress("frame " + std::to_string(j + 1) + " of " + frames); });
  out.commit({place.name, place.name + ".pvd"});
  figures = {{"frames", done.frames}, {"files", done.files}, {"bytes", done.bytes}};
}

/// Of a study: the folder for the series of all its cases.
Place place_of_study(const Options& o) {
  if (fs::path(*o.paraview).extension() == ".pvd")
    throw InputError("--paraview " + *o.paraview + ": " + o.input +
                     " is a study, with a .pvd for each case; give a folder");
  const Place place = place_of(*o.paraview, false);
  refuse_to_replace_folder_of_series((fs::path(place.folder) / place.name).string());
  return place;
}

void export_study(const Options& o, Progress& progress, Json& figures) {
  const StudyFolder study(o.input);
  const std::vector<std::string> cases = study.published_cases();
  if (cases.empty())
    throw InputError(o.input + ": no case is published yet; cleft status " + o.input + " tells more");
  const Place place = place_of_study(o);
  OutputFolder out(place.folder, place.name);
  const std::string folder = out.path() + "/" + place.name;
  fs::create_directory(folder);

  const auto snapshot = [&](const std::string& hash) { return study.published(hash) + "/case.h5"; };
  Mistakes mistakes;  // reported together, before the long part
  for (const std::string& hash : cases)
    mistakes.collect([&] {
      if (study.manifest(hash).value("snapshot", "kept") == "dropped")
        throw InputError(snapshot(hash) +
                         ": its raw data are gone (keep_snapshots = \"none\" in the study file): solve " +
                         study.published(hash) + "/case.toml again to export it");
      SnapshotReader(snapshot(hash)).point_arrays();
    });
  mistakes.throw_if_any();
  ExportFigures done;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    progress("case " + std::to_string(i + 1) + " of " + std::to_string(cases.size()));
    const SnapshotReader reader(snapshot(cases[i]));
    done += write_paraview_series(reader, folder, cases[i], units_of(reader.snapshot()));
  }
  out.commit({place.name});
  figures = {{"cases", cases.size()}, {"frames", done.frames}, {"files", done.files}, {"bytes", done.bytes}};
}

/// The surface that the explorer shows, as the field moves it.
SurfaceSeries series_of(const std::shared_ptr<const Field>& field, int frames) {
  const auto scene = std::make_shared<const PatchScene>(field);
  SurfaceSeries series;
  series.points = scene->surface().points;
  series.triangles = scene->surface().triangles;
  for (const Region region : scene->surface().regions) series.parts.push_back(static_cast<int>(region));
  for (int j = 0; j < frames; ++j) series.times.push_back(field->duration() * j / std::max(1, frames - 1));
  series.displacement = [scene](double t) {
    std::vector<Vec3> moved;
    scene->positions(t, moved);
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = moved[i] - scene->surface().points[i];
    return moved;
  };
  series.units = units_of(field->source ? &field->source->fields : nullptr);
  return series;
}

/// Further quantities are exported on the mesh of the snapshot, not on the explorer's surface.
void tell_what_is_left_out(const Field& field) {
  std::string names;
  for (const Quantity& quantity : field.quantities) names += (names.empty() ? "" : ", ") + quantity.name;
  if (names.empty()) return;
  std::cerr << "cleft export: warning: left out without the snapshot: " << names
            << "; name it (--nodes CASE.h5), or give a mesh of the body to cleft decode --on\n";
}

/// A field of imported data on its own mesh, with all quantities.
ExportFigures export_on_mesh(const Options& o, const FieldOnMesh& field, Progress& progress,
                             const std::string& folder, const std::string& name) {
  MeshSeries series{&field.mesh(),
                    {},
                    [&](double t) { return field.displacement(t); },
                    field.quantities(),
                    [&](std::size_t a, double t) { return field.quantity(a, t); },
                    units_of(field.mesh())};
  for (int j = 0; j < o.frames; ++j) series.times.push_back(field.duration() * j / std::max(1, o.frames - 1));
  return write_paraview_series(series, folder, name, [&](std::size_t j) {
    progress("frame " + std::to_string(j + 1) + " of " + std::to_string(o.frames));
  });
}

/// Of one field a .pvd with its folder, of a study a folder with those of all cases.
void export_decoded(const Options& o, Progress& progress, Json& figures) {
  const bool single = !fs::is_directory(o.input) && format_of(o.input) == "cleft-field";
  if (single) {
    const auto field =
        o.nodes.empty() ? field_on_own_mesh(o.input) : std::make_shared<const FieldOnMesh>(o.input, o.nodes);
    if (field) {
      const Place place = place_of(*o.paraview, true);
      refuse_to_replace_series(place.folder, place.name);
      OutputFolder out(place.folder, place.name);
      const ExportFigures done = export_on_mesh(o, *field, progress, out.path(), place.name);
      out.commit({place.name, place.name + ".pvd"});
      figures = {{"frames", done.frames},
                 {"files", done.files},
                 {"bytes", done.bytes},
                 {"nodes", field->mesh().points.size()}};
      return;
    }
    if (pieces_in(o.input) > 0)
      throw InputError(
          o.input +
          ": is the field of a body with several breaks, which is exported on its mesh: give its "
          "snapshot with --nodes CASE.h5, or any mesh of the body to cleft decode --on");
  }
  PublishedStudy study(o.input);
  const Place place = single ? place_of(*o.paraview, true) : place_of_study(o);
  OutputFolder out(place.folder, place.name);
  ExportFigures done;
  if (single) {
    refuse_to_replace_series(place.folder, place.name);
    tell_what_is_left_out(*study.field(0));
    done = write_paraview_series(series_of(study.field(0), o.frames), out.path(), place.name);
    out.commit({place.name, place.name + ".pvd"});
  } else {
    const std::string folder = out.path() + "/" + place.name;
    fs::create_directory(folder);
    for (int i = 0; i < study.size(); ++i) {
      progress("case " + std::to_string(i + 1) + " of " + std::to_string(study.size()));
      const std::string hash = fs::path(study.snapshot(i)).parent_path().filename().string();
      done += write_paraview_series(series_of(study.field(i), o.frames), folder, hash);
    }
    out.commit({place.name});
  }
  figures = {{"cases", study.size()}, {"frames", done.frames}, {"files", done.files}, {"bytes", done.bytes}};
}

void export_cinema(const Options& o, Progress& progress, Json& figures) {
  const Place place = place_of(*o.cinema, false);
  if (!place.name.ends_with(".cdb"))
    throw InputError("--cinema " + *o.cinema + ": a Cinema database is a folder that ends in .cdb");
  if (fs::exists(*o.cinema)) throw InputError(*o.cinema + ": exists; give another name, or remove it");
  Session session(
      session_services([](const std::string& text) { std::cerr << "cleft export: " << text << '\n'; }));
  session.say("open " + quoted(o.input));
  session.say("color " + quoted(o.color));
  OutputFolder out(place.folder, place.name);
  const std::string folder = out.path() + "/" + place.name;
  fs::create_directory(folder);
  CinemaGrid grid = o.grid;
  grid.width = o.size[0], grid.height = o.size[1];
  const CinemaFigures done = write_cinema(session, folder, grid, [&](int picture, int of) {
    progress("picture " + std::to_string(picture + 1) + " of " + std::to_string(of));
  });
  out.commit({place.name});
  figures = {{"cases", done.cases}, {"pictures", done.pictures}};
}

void export_paraview(const Options& o, Progress& progress, Json& figures) {
  const bool folder = fs::is_directory(o.input),
             snapshot = !folder && format_of(o.input) == snapshot_format.name,
             fields = !folder && fs::path(o.input).extension() == ".dffd";
  if (snapshot && o.decoded)
    throw InputError(o.input + " is a simulation: --decoded takes a field (case.dffd) or a study");
  if (o.decoded || fields) return export_decoded(o, progress, figures);
  (folder ? export_study : export_case)(o, progress, figures);
}

/// The session in which the cases open the cuts of a mesh.
std::unique_ptr<Session> session_of_mesh(const Options& o) {
  auto session = std::make_unique<Session>(
      session_services([](const std::string& text) { std::cerr << "cleft export: " << text << '\n'; }));
  const auto list = [](const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "" : ",") + shortest(number);
    return text;
  };
  session->say("open " + quoted(o.input));
  session->say("mesh " + quoted(o.mesh) + " " + shortest(o.scale));
  if (!o.bone.empty()) session->say("bone " + quoted(o.bone));
  if (o.tension.read(o.scale))
    session->say("tension " +
                 (o.tension.lines.empty() ? list(o.tension.direction) : quoted(o.tension.lines)) + " " +
                 list(o.tension.prestresses));
  for (const std::string& path : o.paths) session->say("cut-file " + quoted(path));
  return session;
}

MeshMotion motion_of(Session& session) {
  MeshMotion motion;
  const std::shared_ptr<const WoundScene> first = session.scene_of(0);
  const bool turning = session.cut_fields(0)->turning();
  motion.surface = first->surface(), motion.duration = first->duration();
  motion.cases = turning ? 1 : session.study()->size();
  if (turning) motion.note = "All of the study: " + session.title_of(0) + ". ";
  if (!session.validity().empty())
    motion.note +=
        "In this mesh: " + error_of_openings(session.validity()) + (motion.cases > 1 ? " (case 1)." : ".");
  for (const auto& cut : session.shown_cut_surface()->cuts()) {
    MeshMotion::Cut& added = motion.cuts.emplace_back();
    for (const auto& [left, right, place] : cut->chain())
      added.left.push_back(left), added.right.push_back(right), added.places.push_back(place);
  }
  double begin = 0;
  for (std::size_t k = 0; k < motion.cuts.size(); begin += session.cut_paths()[k].length(), ++k)
    motion.cuts[k].begin = begin;
  motion.positions = [&session, shown = -1, scene = first](int i, double t, std::vector<Vec3>& out) mutable {
    if (i != shown) scene = session.scene_of(i), shown = i;
    if (scene->surface().points.size() != session.scene_of(0)->surface().points.size())
      throw InputError("the cases cut the mesh to different depths: give a column depth in the path");
    scene->positions(t, out);
  };
  return motion;
}

void export_web(const Options& o, Progress& progress, Json& figures) {
  const fs::path out(*o.web);
  if (out.extension() != ".html")
    throw InputError("--web " + *o.web + ": a page for browsers is a file that ends in .html");
  if (fs::is_directory(out)) throw InputError("--web " + *o.web + ": is a folder; give another name");
  check_output_folder(out.has_parent_path() ? out.parent_path().string() : ".", *o.web);
  if (!fs::is_directory(o.input) && format_of(o.input) == snapshot_format.name)
    throw InputError(
        o.input + " is a simulation: --web takes a field (case.dffd) or a study; cleft encode makes a field");
  const ReportState report = [&](const std::string& state) { progress(state); };
  PageFigures done;
  if (o.mesh.empty()) {
    done = write_page(PublishedStudy(o.input), *o.web, report);
  } else {
    const auto session = session_of_mesh(o);
    const MeshMotion motion = motion_of(*session);
    done = write_page(*session->study(), *o.web, report, &motion);
  }
  figures = {{"cases", done.cases}, {"bytes", done.bytes}};
  if (done.modes > 0) figures["modes"] = done.modes, figures["modes_error"] = done.modes_error;
  if (!done.not_between.empty()) figures["not_between"] = done.not_between;
}

void export_files(const Options& o) {
  if (o.paraview.has_value() + o.cinema.has_value() + o.web.has_value() != 1)
    throw InputError("give one of --paraview OUT, --cinema OUT.cdb and --web OUT.html");
  const std::string& out = o.paraview ? *o.paraview : o.cinema ? *o.cinema : *o.web;
  std::error_code absent;
  if (fs::equivalent(out, o.input, absent))
    throw InputError((o.paraview ? "--paraview "
                      : o.cinema ? "--cinema "
                                 : "--web ") +
                     out + ": is the input; give another name");
  if (!fs::exists(o.input)) throw InputError(o.input + ": no such file or folder");
  Json figures;
  {
    Progress progress("exporting");
    (o.paraview ? export_paraview : o.cinema ? export_cinema : export_web)(o, progress, figures);
  }
  print_figures(figures, o.json);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Writes snapshots and fields as files of other programs.", "cleft export");
  Options o;
  app.add_option("CASE.h5|CASE.dffd|DIR", o.input,
                 "a snapshot, a field, or a study (folder or study.dffd): all its published cases")
      ->required();
  app.add_option(
      "--paraview", o.paraview,
      "for ParaView and VTK: OUT.pvd, and a .vtu file a frame in OUT/; of a study, OUT/<case>.pvd");
  app.add_flag("--decoded", o.decoded,
               "of a study, the fields rather than the simulations: skin and walls of the wound");
  app.add_option("--nodes", o.nodes,
                 "of a field of imported data: its snapshot, on whose mesh all its quantities are written "
                 "(default: CASE.h5 beside CASE.dffd, where there is one)");
  app.add_option("--frames", o.frames, "of a field")->check(in_range(2, 100000))->capture_default_str();
  app.add_option(
      "--cinema", o.cinema,
      "OUT.cdb, a Cinema database (Spec D): a picture for every case, length cut and of two cameras");
  app.add_option(
      "--web", o.web,
      "OUT.html, one page for any browser, without server and network: the wound, the parameters and "
      "the time of a field or a study");
  auto* mesh = app.add_option("--mesh", o.mesh,
                              "of a page: a surface that the cases cut, in place of their patch: " +
                                  mesh_endings(MeshKind::surface, MeshUse::read));
  auto* path =
      app.add_option("--path", o.paths, "its cut, CSV: x,y,z,nx,ny,nz[,depth]; again for further cuts");
  mesh->needs(path), path->needs(mesh);
  add_scale(app, o.scale)->needs(mesh);
  add_bone(app, o.bone)->needs(mesh);
  o.tension.add_to(app);
  app.add_option("--times", o.grid.times, "lengths cut in a Cinema database")
      ->check(in_range(2, 1000))
      ->capture_default_str();
  app.add_option("--size", o.size, "WIDTH,HEIGHT of its pictures, pixels")
      ->delimiter(',')
      ->expected(2)
      ->check(in_range(16, 8192))
      ->capture_default_str();
  app.add_option("--color", o.color, "what its surfaces are coloured by")->capture_default_str();
  app.add_flag("--json", o.json, "figures as JSON");
  return run_command(app, argc, argv, [&] { export_files(o); });
}
