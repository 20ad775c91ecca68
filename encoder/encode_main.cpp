// cleft encode: snapshots to their fields.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/h5/h5.h"
#include "base/memory.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/encode.h"
#include "encoder/field/blended_field.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/field_record.h"
#include "encoder/memory_need.h"
#include "encoder/tissue_below.h"
#include "params/encode_limits.h"

using namespace cleft;

namespace {

Json control_points_of(const Field& field) {
  return {field.basis(0).size(), field.basis(1).size(), field.basis(2).size(), field.basis(3).size()};
}

/// Of several pieces errors are the largest, and times those of all. `nodes`: of the whole body.
Json figures_of(const std::vector<Field>& pieces, std::size_t nodes, const std::string& out) {
  const Field& field = pieces.front();
  const double bytes = static_cast<double>(std::filesystem::file_size(out));
  FitReport report = report_of(pieces);
  const double raw = raw_bytes(field) * static_cast<double>(nodes) / report.nodes;
  report.nodes = static_cast<double>(nodes);
  Json figures = shown(report);
  double fit_seconds = 0, measure_seconds = 0;
  for (const Field& piece : pieces)
    fit_seconds += piece.report.fit_seconds, measure_seconds += piece.report.measure_seconds;
  figures.update({{"control_points", control_points_of(field)},
                  {"fit_seconds", fit_seconds},
                  {"measure_seconds", measure_seconds},
                  {"quantum_mm", field.quantum},
                  {"parametrization", field.parametrization().name()},
                  {"bytes", bytes},
                  {"ratio_to_32_bit", raw / bytes}});
  if (field.tissue) {
    figures["tissue_below_cut"]["foundation_n_per_mm3"] = field.tissue->foundation;
    for (const TissueLayerBelow& layer : field.tissue->layers)
      figures["tissue_below_cut"]["layers"].push_back({{"young_modulus_mpa", layer.young_modulus},
                                                       {"poisson_ratio", layer.poisson_ratio},
                                                       {"height_mm", layer.height}});
  }
  for (std::size_t p = 0; p < pieces.size() && pieces.size() > 1; ++p)
    figures["pieces"].push_back({{"nodes", pieces[p].report.nodes},
                                 {"control_points", control_points_of(pieces[p])},
                                 {"spline_error", pieces[p].report.spline_error},
                                 {"gape_error", pieces[p].report.gape_error}});
  figures["versions"] = {
      {"cleft", producer()},
      {"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                    std::to_string(EIGEN_MINOR_VERSION)},
      {"HDF5", h5::version()}};
  for (const Quantity& quantity : field.quantities)
    figures["quantities"].push_back({{"name", quantity.name},
                                     {"scale", quantity.scale},
                                     {"error", quantity.error},
                                     {"spline_error", quantity.spline_error}});
  for (const ParameterDerivative& one : field.by_parameter)
    figures["by_parameter"].push_back({{"parameter", one.parameter}, {"error", one.error}});
  return figures;
}

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
  FieldTolerance tolerance{parse_number(number, where), !unit.empty() && unit != "%"};
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

/// A warning where the spline, which is what is drawn, is off by more than twice the tolerance.
std::string warning_of(const Field& field, const Series& series, const EncodeOptions& options) {
  const FitReport& report = field.report;
  const double scale = report.largest_displacement,
               limit = options.tolerance_of("displacement").limit(scale > 0 ? scale : 1);
  if (options.rung || report.spline_error * scale <= 2 * limit) return "";
  const Vec3& at = series.node_samples()[static_cast<std::size_t>(report.worst_node)].uvw;
  const CanonicalCut& cut = field.cut();
  const double tip = field.parametrization().geometry().tip.at(report.worst_time);
  const bool beside_front = std::min(std::abs(at.x - tip), std::abs(at.x - cut.start)) < 0.1 * cut.length;
  const auto digits = [](double x) {
    std::ostringstream text;
    text << std::setprecision(3) << x;
    return text.str();
  };
  const std::string cause =
      cut.length == 0 ? "the field has no break; where the data jump, import them with the plane of the jump "
                        "(cleft import "
                        "--break), or with a smaller --open-at"
      : beside_front
          ? "beside the front of the break the knots are as dense as the nodes allow; refine the mesh "
            "there, or write more frames"
      : at.y == 0 ? "on the break, away from its ends; see whether all of it opens as one (cleft info, cleft "
                    "import --open-at)"
                  : "away from the break the nodes do not determine more knots; refine the mesh there";
  return "the spline, which is what is drawn between the nodes, is off by " +
         digits(100 * report.spline_error) + " % of the largest displacement, " +
         digits(report.spline_error * scale / limit) + " times the tolerance, at node " +
         shortest(report.worst_node) + " (u = " + digits(at.x) + ", v = " + digits(at.y) +
         ", w = " + digits(at.z) + " mm) and t = " + digits(report.worst_time) + ": " + cause;
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

constexpr double most_kept = 4e8;      // bytes of matrices that several snapshots share
constexpr double share_of_kept = 0.1;  // of the memory that may be used

/// Of each piece of a body, the first series of its places, without its values, and what was computed for it.
struct KeptFit {
  std::unique_ptr<Series> series;
  std::shared_ptr<FitStore> store;
};

struct Task {
  std::vector<std::string> snapshots, outs;
  EncodeOptions options;
  double memory = 0;          ///< bytes that may be used
  std::vector<KeptFit> kept;  ///< of the last snapshot, where there are several
};

/// Tells how far the encoder is, which names its steps.
class EncoderProgress {
 public:
  EncoderProgress(Progress& progress, std::size_t files) : progress_(progress), files_(files) {}
  void begin_file(std::size_t file) { file_ = file, piece_ = 0, part_ = 0; }
  /// The pieces of the body, and further quantities of each.
  void expect(std::size_t pieces, std::size_t quantities) { pieces_ = pieces, quantities_ = quantities; }
  void begin_piece(std::size_t piece) { piece_ = piece, quantity_ = 0; }

  void operator()(const std::string& state) {
    // Where the steps of a displacement begin, of its time on the default case; a quantity takes a third of
    // it.
    static const std::map<std::string, double> begins{{"reading", 0},
                                                      {"trying knots", 0.05},
                                                      {"fitting all frames", 0.18},
                                                      {"choosing the coefficients' steps", 0.9},
                                                      {"measuring", 0.91},
                                                      {"coding what the spline leaves", 0.93}};
    if (state == "writing") return tell(state, 0.97);
    const double whole = 1 + static_cast<double>(quantities_) / 3;
    if (const auto found = begins.find(state); found != begins.end() && quantity_ == 0)
      part_ = found->second / whole;
    else if (state.starts_with("fitting ") && state != "fitting derivatives")
      part_ = (1 + static_cast<double>(quantity_++) / 3) / whole;
    const std::string of =
        pieces_ > 1 ? "piece " + std::to_string(piece_ + 1) + " of " + std::to_string(pieces_) + ": " : "";
    tell(of + state,
         0.97 * (static_cast<double>(piece_) + std::min(part_, 1.)) / static_cast<double>(pieces_));
  }

 private:
  void tell(const std::string& state, double part) {
    const std::string of =
        files_ > 1 ? "snapshot " + std::to_string(file_ + 1) + " of " + std::to_string(files_) + ": " : "";
    progress_(of + state, (static_cast<double>(file_) + part) / static_cast<double>(files_));
  }

  Progress& progress_;
  std::size_t files_, file_ = 0, pieces_ = 1, quantities_ = 0, piece_ = 0, quantity_ = 0;
  double part_ = 0;
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
  kept.series->all_nodes.reset(), kept.series->read = {};
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
  for (const SnapshotReader& reader : readers)
    series.emplace_back(
        reader, SeriesStorage{need.spilled ? std::make_shared<SpillFile>(folder) : nullptr, most_fitted});
  check_names(task.options, series.front());
  if (series.size() > 1) share_scales(series);
  progress.expect(series.size(), series.front().quantities.size());
  std::vector<Encoded> all;
  Json warnings = Json::array();
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
    if (const std::string warning = warning_of(field, series[p], task.options); !warning.empty())
      warnings.push_back(of + warning);
  }
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
  CommandLine app(
      "Fits a discontinuous free-form deformation to a snapshot. What several snapshots on one mesh share is "
      "computed once.",
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
  app.add_option("--control-points", counts,
                 "U,V,W,T: control points along each axis instead of a tolerance, V for both sides together")
      ->delimiter(',')
      ->excludes(tolerance);
  app.add_option(
         "--parametrization", options.parametrization,
         "front: knots follow the front of the cut, dense as the lips close there; tip: evenly dense; fixed: "
         "they stay (the paper's)")
      ->check(one_of(parametrization_names()))
      ->capture_default_str();
  double memory = 0;
  app.add_option("--memory", memory,
                 "GB that may be used (default: nine tenths of what is free); the values of larger snapshots "
                 "are kept in a temporary file, in TMPDIR or beside the field")
      ->check(at_least(0.001));
  app.add_flag("--json", json, "print the figures as JSON; several snapshots: a list");

  return run_command(app, argc, argv, [&] {
    for (const std::string& text : tolerances) parse_tolerance(text, options);
    if (!counts.empty()) options.rung = rung_of(counts, options.parametrization != "fixed");
    Task task{snapshots,
              outputs_of(snapshots, out, ".dffd", "snapshot"),
              options,
              memory > 0 ? 1e9 * memory : 0.9 * available_memory(),
              {}};
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
