// cleft encode: snapshots to their fields.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>

#include "base/command/command.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/output_file.h"
#include "base/ranks/other_ranks.h"
#include "base/text.h"
#include "encoder/command/encoder_progress.h"
#include "encoder/command/figures.h"
#include "encoder/command/spread_nodes.h"
#include "encoder/command/warnings.h"
#include "encoder/encode.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/field_record.h"
#include "encoder/memory_need.h"
#include "encoder/tissue_below.h"
#include "params/encode_limits.h"

using namespace cleft;

namespace {

std::optional<FieldSource> source_of(const Snapshot& s) {
  if (!s.source) return {};
  FieldSource source{s.source->file, s.source->origin, s.source->axes, s.times, s.source->fields, {}};
  for (double& t : source.times) t += s.source->time_start;
  if (!s.source->break_map.empty()) source.map = BreakMap::from(s.source->break_map);
  if (!s.source->break_extent.empty()) source.extent = BreakExtent::from(s.source->break_extent);
  return source;
}

/// "0.01" for all fields, "NAME=0.02" for one; 2% is 0.02, and a number with a unit (0.5K) is absolute.
void parse_tolerance(const std::string& text, EncodeOptions& options) {
  const std::size_t equals = text.find('=');
  const std::string name = equals == text.npos ? "" : text.substr(0, equals);
  const std::string value = equals == text.npos ? text : text.substr(equals + 1);
  const std::size_t end = value.find_first_not_of("0123456789.eE+-");
  std::string number = value.substr(0, end), unit = end == value.npos ? "" : value.substr(end);
  if (!number.empty() && !unit.empty() && (number.back() == 'e' || number.back() == 'E'))
    unit = number.back() + unit, number.pop_back();  // of eV, say
  const std::string where = "--tolerance" + (name.empty() ? "" : " " + name);
  if (number.empty()) number = value;
  FieldTolerance tolerance{parse_number(number, where), !unit.empty() && unit != "%", unit};
  if (unit == "%") tolerance.value /= 100;
  const bool good = tolerance.absolute ? tolerance.value > 0 && std::isfinite(tolerance.value)
                                       : tolerance.value >= least_tolerance && tolerance.value < 1;
  if (!good)
    throw InputError(where + ": " + value +
                     ": must be at least 1e-9 and less than 1, or positive with the field's unit");
  if (name.empty() && tolerance.absolute)
    options.tolerances["displacement"] = tolerance;
  else if (name.empty())
    options.tolerance = tolerance.value;
  else if (!options.tolerances.emplace(name, tolerance).second)
    throw InputError(where + " is given twice");
}

/// The names of all fields, for messages.
std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list.append(list.empty() ? "" : ", ").append(name);
  return list;
}

/// A unit that is told of a field must be that of its tolerance: numbers are not converted.
void check_units(const EncodeOptions& options, const Snapshot& s) {
  for (const auto& [name, tolerance] : options.tolerances) {
    if (!tolerance.absolute) continue;
    const std::string field = name == Series::at_start ? "displacement" : name,
                      unit = s.source ? unit_of(FieldSource{.fields = s.source->fields}, field) : "mm";
    if (unit.empty() || unit == tolerance.unit) continue;
    std::string mistake = "--tolerance " + name;
    mistake.append(": is in ").append(unit).append(", not in ").append(tolerance.unit);
    throw InputError(mistake.append("; give the number in ").append(unit));
  }
}

void check_names(const EncodeOptions& options, const Series& series) {
  std::vector<std::string> names = {"displacement"};
  for (const SeriesQuantity& quantity : series.quantities) names.push_back(quantity.name);
  const auto is_unknown = [&](const auto& tolerance) {
    return std::find(names.begin(), names.end(), tolerance.first) == names.end();
  };
  const auto wrong = std::find_if(options.tolerances.begin(), options.tolerances.end(), is_unknown);
  if (wrong == options.tolerances.end()) return;
  throw InputError("--tolerance " + wrong->first +
                   ": the snapshot has no such field; there are: " + listed(names));
}

/// Spans of bases with about so many control points: as many as requested if nothing is tied.
Rung rung_of(const std::vector<int>& counts, bool follows_tip) {
  if (counts.size() != 4) throw InputError("--control-points: expected four whole numbers U,V,W,T");
  check_control_points({counts[0], counts[1], counts[2], counts[3]}, follows_tip ? "front" : "fixed",
                       "--control-points");
  Rung rung;
  rung.across = counts[1] / 2 - 3, rung.time = counts[3] - 3;
  if (follows_tip) {
    const int u = counts[0] - 7, w = counts[2] - 5;
    rung.before = std::max(1, u / 4), rung.after = std::max(1, u / 4),
    rung.along = u - rung.before - rung.after;
    rung.bends = true;  // so that cases of one study have the same knots, whether their cuts bend or not
    rung.below = std::max(1, w / 3), rung.above = w - rung.below;
  } else {
    rung.along = counts[0] - 3, rung.above = counts[2] - 3;
  }
  return rung;
}

bool same(const std::optional<CodedResidual>& a, const std::optional<CodedResidual>& b) {
  return a.has_value() == b.has_value() && (!a || (a->quantum == b->quantum && a->nodes == b->nodes &&
                                                   a->frames == b->frames && a->blocks == b->blocks));
}

bool same(const Encoded& a, const Encoded& b) {
  bool good = a.field.coefficients() == b.field.coefficients() && same(a.residual, b.residual) &&
              a.field.quantities.size() == b.field.quantities.size() &&
              a.field.by_parameter.size() == b.field.by_parameter.size() &&
              a.of_quantities.size() == b.of_quantities.size();
  for (std::size_t q = 0; good && q < a.field.quantities.size(); ++q)
    good = a.field.quantities[q].coefficients == b.field.quantities[q].coefficients &&
           same(a.of_quantities[q], b.of_quantities[q]);
  for (std::size_t d = 0; good && d < a.field.by_parameter.size(); ++d)
    good = a.field.by_parameter[d].control_points == b.field.by_parameter[d].control_points;
  return good;
}

/// The report is that of the file's content; otherwise no file is written.
void verify_written(const std::string& out, const std::vector<Encoded>& all) {
  const std::vector<Encoded> kept = read_encoded(out);
  if (std::equal(kept.begin(), kept.end(), all.begin(), all.end(),
                 [](const Encoded& a, const Encoded& b) { return same(a, b); }))
    return;
  std::filesystem::remove(out);
  throw std::runtime_error(out + ": reads back as something else than was written, and was removed");
}

/// The snapshot, or the pieces of one with several breaks.
std::vector<SnapshotReader> readers_of(const std::string& path) {
  std::vector<SnapshotReader> readers;
  readers.emplace_back(path);
  const std::size_t pieces = readers.front().snapshot().pieces.size();
  if (pieces > 0) readers.clear();
  for (std::size_t p = 0; p < pieces; ++p) readers.emplace_back(path, p);
  return readers;
}

void write_encoded(const std::string& out, const std::vector<Encoded>& all, std::size_t nodes) {
  if (all.size() == 1)
    write_field(out, all.front());
  else
    write_pieces(out, all, nodes);
}

constexpr double most_kept = 1e9;      // bytes of matrices that several snapshots share
constexpr double share_of_kept = 0.1;  // of the memory that may be used

/// Of each piece of a body, the first series of its places, without its values, and what was computed for it.
struct KeptFit {
  std::unique_ptr<Series> series;
  std::shared_ptr<FitStore> store;
};

struct Task {
  std::vector<std::string> snapshots, outs;
  EncodeOptions options;
  double memory = 0;             ///< bytes that may be used
  const Ranks* ranks = nullptr;  ///< over which large snapshots are spread
  std::vector<KeptFit> kept;     ///< of the last snapshot, where there are several
};

/// Where values that do not fit into memory are kept.
std::string spill_folder(const std::string& out) {
  if (const char* folder = std::getenv("TMPDIR"); folder && *folder) return folder;
  const std::filesystem::path parent = std::filesystem::path(out).parent_path();
  return parent.empty() ? "." : parent.string();
}

/// What the last snapshot's piece of this number has left for one of the same places and times; made anew
/// where that is another.
std::shared_ptr<FitStore> store_for(const Series& series, std::size_t piece, Task& task) {
  if (task.snapshots.size() == 1) return nullptr;
  task.kept.resize(std::max(task.kept.size(), piece + 1));
  KeptFit& kept = task.kept[piece];
  if (kept.store && kept.store->serves(series)) return kept.store;
  kept.store.reset();
  kept.series = std::make_unique<Series>(series);
  kept.series->frames.clear(), kept.series->quantities.clear(), kept.series->derivatives.clear();
  kept.series->all_nodes.reset(), kept.series->node_values.reset(), kept.series->elsewhere.reset();
  kept.store = fit_store(*kept.series, task.options, std::min(most_kept, share_of_kept * task.memory));
  return kept.store;
}

/// The figures of what was written, with warnings.
Json encode_file(Task& task, std::size_t file, EncoderProgress& progress) {
  const std::string &snapshot = task.snapshots[file], &out = task.outs[file];
  progress.begin_file(file);
  const std::vector<SnapshotReader> readers = readers_of(snapshot);
  const std::string folder = spill_folder(out);
  MemoryNeed need;
  for (const SnapshotReader& reader : readers) need = need + memory_need(reader);
  need.fit_into(task.memory, folder, snapshot);
  progress("reading: up to " + gigabytes(need.in_memory()) + " of memory are needed" +
           (need.spilled ? ", and " + gigabytes(need.values) + " of disk" : ""));
  std::vector<Series> series;
  series.reserve(readers.size());
  for (const SnapshotReader& reader : readers) {
    SeriesStorage storage{need.spilled ? std::make_shared<SpillFile>(folder) : nullptr, most_fitted};
    if (task.ranks->count() > 1) storage.spread = spread_over(*task.ranks);
    series.emplace_back(reader, storage);
  }
  check_names(task.options, series.front());
  check_units(task.options, readers.front().snapshot());
  if (series.size() > 1) share_scales(series), share_kinks(series);
  progress.expect(series.size(), series.front().quantities.size());
  std::vector<Encoded> all;
  Json warnings = Json::array();
  if (task.ranks->count() > 1 &&
      std::none_of(series.begin(), series.end(), [](const Series& one) { return one.elsewhere; }))
    warnings.push_back(one_works(*task.ranks, "encodes this snapshot") + ": only snapshots of more than " +
                       std::to_string(most_fitted) + " nodes are spread over processes");
  for (std::size_t p = 0; p < series.size(); ++p) {
    const std::string of =
        series.size() > 1 ? "piece " + std::to_string(p + 1) + " of " + std::to_string(series.size()) + ": "
                          : "";
    progress.begin_piece(p);
    all.push_back(encode(series[p], task.options, std::ref(progress), store_for(series[p], p, task)));
    Field& field = all.back().field;
    const Snapshot& s = readers[p].snapshot();
    field.parameters = s.parameters, field.case_hash = s.case_hash, field.source = source_of(s);
    field.tissue = tissue_below(readers[p]);
    const std::vector<BetweenNodes> between = add_between_nodes(field, series[p]);
    field.report = rounded_report(field.report);
    for (const std::string& warning : warnings_of(field, between, series[p], task.options))
      warnings.push_back(of + warning);
  }
  if (const auto& source = readers.front().snapshot().source;
      !warnings.empty() && source && source->rules < SnapshotSource::newest_rules)
    warnings.push_back(
        "an earlier version of cleft import made the snapshot, which did not know all kinds of breaks; "
        "import the series again");
  progress("writing");
  const std::size_t nodes = series.size() > 1 ? SnapshotReader(snapshot).snapshot().points.size()
                                              : readers.front().snapshot().points.size(),
                    measured = series.size() > 1 ? nodes : series.front().node_samples().size();
  series.clear();
  write_encoded(out, all, nodes);
  verify_written(out, all);
  std::vector<Field> fields;
  fields.reserve(all.size());
  for (Encoded& one : all) fields.push_back(std::move(one.field));
  Json figures = figures_of(fields, measured, out);
  figures["memory_mb"] = {{"expected", std::round(need.in_memory() / 1e6)},
                          {"disk", need.spilled ? std::round(need.values / 1e6) : 0},
                          {"peak", std::round(peak_memory() / 1e6)}};
  if (!warnings.empty()) figures["warnings"] = warnings;
  return figures;
}

void warn_of(const Json& figures) {
  const std::string of = figures.contains("out") ? figures["out"].get<std::string>() + ": " : "";
  for (const Json& warning : figures.value("warnings", Json::array()))
    std::cerr << "cleft encode: warning: " << of << warning.get<std::string>() << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_blocks();
  const Ranks ranks(argc, argv);
  if (ranks.rank() > 0) {
    serve_nodes(ranks);
    return 0;
  }
  const OtherRanks others(ranks);
  CommandLine app(
      "Fits a discontinuous free-form deformation to a snapshot. What several snapshots on one mesh share is "
      "computed once. Under mpirun or srun, snapshots of more than a million nodes are spread over the "
      "processes, which read, measure and code their parts.",
      "cleft encode");
  std::vector<std::string> snapshots;
  std::string out;
  std::vector<int> counts;
  bool json = false;
  EncodeOptions options;
  app.add_option("CASE.h5", snapshots, "snapshots")->required();
  app.add_option("--out", out, "field to write, case.dffd; for several snapshots a folder: DIR/CASE.dffd")
      ->required();
  std::vector<std::string> tolerances;
  auto* tolerance =
      app.add_option(
             "--tolerance", tolerances,
             "[FIELD=]X,...: largest error at any node and frame over the largest displacement (of a further "
             "quantity: over its largest value, or its range where that is less), at most; with a unit, such "
             "as "
             "T=0.5K, in the field's own; for all fields, or for one (default: 0.01)")
          ->delimiter(',')
          ->allow_extra_args(false);
  auto* control_points =
      app.add_option(
             "--control-points", counts,
             "U,V,W,T: control points along each axis instead of a tolerance, V for both sides together")
          ->delimiter(',')
          ->excludes(tolerance);
  app.add_option(
         "--regularisation", options.regularisation,
         "with --control-points: the strength of the displacement's regularisation, the same for all cases "
         "of "
         "a study, so that what the nodes leave free changes smoothly from case to case, such as 3e-5 "
         "(default: for each case the strongest of 1e-4, 1e-5, ... 1e-8 that costs its fit next to nothing)")
      ->needs(control_points);
  app.add_option(
         "--parametrization", options.parametrization,
         "front: knots follow the front of the cut, dense as the lips close there; tip: evenly dense; fixed: "
         "they stay (the paper's)")
      ->check(one_of(parametrization_names()))
      ->capture_default_str();
  std::string memory;
  app.add_option("--memory", memory,
                 "GB that may be used, as 4, 4GB or 500MB (default: nine tenths of what is free); the values "
                 "of larger snapshots are kept in a temporary file, in TMPDIR or beside the field");
  app.add_flag("--json", json, "print the figures as JSON; several snapshots: a list");

  return run_command(app, argc, argv, [&] {
    for (const std::string& text : tolerances) parse_tolerance(text, options);
    if (options.regularisation) check_regularisation(*options.regularisation, "--regularisation");
    if (!counts.empty()) options.rung = rung_of(counts, options.parametrization != "fixed");
    Task task{snapshots, outputs_of(snapshots, out, ".dffd", "snapshot"),
              options,   memory_to_use(memory, "--memory"),
              &ranks,    {}};
    ranks.check();
    for (const std::string& file : task.outs) {
      refuse_to_overwrite(file, snapshots);
      const OutputFile probe(file);  // reports a bad name before the work
    }
    Json list = Json::array();
    {
      Progress bar("encoding");
      EncoderProgress progress(bar, snapshots.size());
      for (std::size_t file = 0; file < snapshots.size(); ++file)
        list.push_back(encode_file(task, file, progress));
    }
    if (snapshots.size() > 1)
      for (std::size_t file = 0; file < snapshots.size(); ++file) list[file]["out"] = task.outs[file];
    for (const Json& figures : list) warn_of(figures);
    if (json && snapshots.size() > 1) return print_figures(list, true);
    for (const Json& figures : list) print_figures(figures, json);
  });
}
