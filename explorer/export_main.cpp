// cleft export: snapshots in the files of other programs.
#include <filesystem>

#include "base/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/output_folder.h"
#include "explorer/io/paraview_file.h"
#include "params/study_folder.h"

using namespace cleft;

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string input, paraview;
  bool json = false;
};

/// Where the output stands: `out`, `out/` and, for a series, `out.pvd` mean the same.
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

void export_case(const Options& o, Progress& progress, Json& figures) {
  const Place place = place_of(o.paraview, true);
  refuse_to_replace_series(place.folder, place.name);
  OutputFolder out(place.folder, place.name);
  const SnapshotReader reader(o.input);
  const std::string frames = std::to_string(reader.snapshot().frames());
  const ExportFigures done = write_paraview_series(reader, out.path(), place.name, [&](std::size_t j) {
    progress("frame " + std::to_string(j + 1) + " of " + frames);
  });
  out.commit({place.name, place.name + ".pvd"});
  figures = {{"frames", done.frames}, {"files", done.files}, {"bytes", done.bytes}};
}

void export_study(const Options& o, Progress& progress, Json& figures) {
  const StudyFolder study(o.input);
  const std::vector<std::string> cases = study.published_cases();
  if (cases.empty())
    throw InputError(o.input + ": no case is published yet; cleft status " + o.input + " tells more");
  if (fs::path(o.paraview).extension() == ".pvd")
    throw InputError("--paraview " + o.paraview + ": " + o.input +
                     " is a study, with a .pvd for each case; give a folder");
  const Place place = place_of(o.paraview, false);
  refuse_to_replace_folder_of_series((fs::path(place.folder) / place.name).string());
  OutputFolder out(place.folder, place.name);
  const std::string folder = out.path() + "/" + place.name;
  fs::create_directory(folder);

  const auto snapshot = [&](const std::string& hash) { return study.published(hash) + "/case.h5"; };
  Mistakes mistakes;  // told at once, before the long part
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
    done += write_paraview_series(SnapshotReader(snapshot(cases[i])), folder, cases[i]);
  }
  out.commit({place.name});
  figures = {{"cases", cases.size()}, {"frames", done.frames}, {"files", done.files}, {"bytes", done.bytes}};
}

void export_files(const Options& o) {
  std::error_code absent;
  if (fs::equivalent(o.paraview, o.input, absent))
    throw InputError("--paraview " + o.paraview + ": is the input; give another name");
  Json figures;
  {
    Progress progress("exporting");
    (fs::is_directory(o.input) ? export_study : export_case)(o, progress, figures);
  }
  print_figures(figures, o.json);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes snapshots as files of other programs.", "cleft export");
  Options o;
  app.add_option("CASE.h5|DIR", o.input, "a snapshot, or a study folder: all its published cases")
      ->required();
  app.add_option("--paraview", o.paraview,
                 "for ParaView and VTK: OUT.pvd, and a .vtu file a frame in OUT/; of a study, OUT/<case>.pvd")
      ->required();
  app.add_flag("--json", o.json, "figures as JSON");
  return run_command(app, argc, argv, [&] { export_files(o); });
}
