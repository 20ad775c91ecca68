// cleft info: what a snapshot, a field or a study file holds.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/sealed_json.h"
#include "encoder/field/blended_field.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/field_record.h"
#include "encoder/field/file/study_file.h"
#include "solver/snapshot/snapshot.h"

using namespace cleft;

namespace {

Json parameters_of(const RecordedParameters& parameters) {
  Json list = Json::object();
  for (const auto& [name, value] : parameters.all())
    std::visit([&, &key = name](const auto& v) { list[key] = v; }, value);
  return list;
}

Json list_of(const Vec3& v) { return {v.x, v.y, v.z}; }

/// By which `cleft status` and `cleft find` name the published case of a file; empty of other files.
std::string published_hash(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  return std::filesystem::exists(folder / "manifest.json") ? folder.filename().string() : "";
}

Json info_of_source(const SnapshotSource& source) {
  return {{"source", source.file},        {"origin", list_of(source.origin)},
          {"u", list_of(source.axes[0])}, {"v", list_of(source.axes[1])},
          {"w", list_of(source.axes[2])}, {"time_start", source.time_start},
          {"break", source.break_plane}};
}

Json info_of_snapshot(const std::string& file) {
  const SnapshotReader reader(file);
  const Snapshot& s = reader.snapshot();
  Json arrays = Json::array();
  for (const SnapshotArray& array : reader.point_arrays()) arrays.push_back(array.name);
  Json info = {{"format", "cleft-snapshot"},
               {"case", s.case_hash},
               {"nodes", s.points.size()},
               {"cells", s.cell_types.size()},
               {"skin_triangles", s.skin().size()},
               {"pairs", s.pairs.size()},
               {"breaks", s.pieces.empty() ? (s.pairs.empty() ? 0 : 1) : s.pieces.size()},
               {"frames", s.frames()},
               {s.source ? "duration" : "duration_mm", s.times.back()},
               {"cut", {{"start", s.cut_start}, {"length", s.cut_length}, {"depth", s.cut_depth}}},
               {"arrays", arrays},
               {"bytes", std::filesystem::file_size(file)},
               {"parameters", parameters_of(s.parameters)}};
  if (s.source) info["import"] = info_of_source(*s.source);
  return info;
}

Json list_of(const Interpolation& made) {
  return {{"method", made.method},
          {"cases", made.cases},
          {"estimated_error", made.estimated_error},
          {"interpolation_error", made.interpolation_error},
          {"outside", made.outside}};
}

/// The manifest of a study's published case. Empty for other files.
Json manifest_of(const std::string& field) {
  const std::string manifest = (std::filesystem::path(field).parent_path() / "manifest.json").string();
  return std::filesystem::exists(manifest) ? read_sealed(manifest) : Json::object();
}

Json info_of_field(const Field& field, const std::string& file);

/// Of several breaks: the largest errors, and each piece.
Json info_of_pieces(const std::string& file) {
  std::vector<Field> fields;
  for (FieldPiece& piece : read_pieces(file)) fields.push_back(std::move(piece.field));
  FitReport report = report_of(fields);
  const auto nodes = static_cast<double>(nodes_in(file));
  const double raw = raw_bytes(fields.front()) * nodes / report.nodes;
  report.nodes = nodes;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file));
  Json info = {{"format", "cleft-field"},
               {"case", fields.front().case_hash},
               {"report", shown(report)},
               {"bytes", bytes},
               {"ratio_to_32_bit", raw / bytes}};
  for (const Field& field : fields) {
    Json piece = info_of_field(field, file);
    for (const char* of_file : {"format", "case", "bytes", "parameters", "ratio_to_32_bit"})
      piece.erase(of_file);
    info["pieces"].push_back(std::move(piece));
  }
  info["parameters"] = parameters_of(fields.front().parameters);
  return info;
}

Json info_of_field(const Field& field, const std::string& file) {
  Json counts = Json::array(), domain = Json::object();
  for (int axis = 0; axis < 4; ++axis) {
    counts.push_back(field.basis(axis).size());
    domain[std::string(1, "uvwt"[axis])] = {field.domain(axis).front, field.domain(axis).back};
  }
  Json info = {
      {"format", "cleft-field"},
      {"case", field.case_hash},
      {"control_points", counts},
      {"parametrization", field.parametrization().name()},
      {"quantum_mm", field.quantum},
      {"domain_mm", domain},
      {"cut", {{"start", field.cut().start}, {"length", field.cut().length}, {"depth", field.cut().depth}}},
      {"report", shown(field.report)},
      {"bytes", std::filesystem::file_size(file)},
      {"parameters", parameters_of(field.parameters)}};
  for (const Quantity& quantity : field.quantities) {
    Json figures = figures_of(quantity);
    figures["unit"] = field.source ? unit_of(*field.source, quantity.name) : "";
    info["quantities"].push_back(figures);
  }
  for (const ParameterDerivative& one : field.by_parameter)
    info["by_parameter"].push_back(
        {{"parameter", one.parameter}, {"largest", one.largest}, {"error", one.error}});
  if (field.report.raw_bytes() > 0)
    info["ratio_to_32_bit"] = raw_bytes(field) / static_cast<double>(std::filesystem::file_size(file));
  if (const Json manifest = manifest_of(file); !manifest.empty()) {
    info["raw_data"] = manifest.value("snapshot", "kept");
    for (const char* figure : {"fit_seconds", "measure_seconds"})
      if (manifest.contains("encoder") && manifest["encoder"].contains(figure))
        info[figure] = manifest["encoder"][figure];
  }
  if (field.interpolation) info["interpolation"] = list_of(*field.interpolation);
  return info;
}

Json info_of_study(const std::string& file) {
  const StudyFile study(file);
  Json cases = Json::array();
  for (int i = 0; i < study.size(); ++i)
    cases.push_back({{"name", study.name(i)},
                     {"case", study.case_hash(i)},
                     {"bytes", study.coefficient_bytes(i)},
                     {"modes_error", study.modes_error(i)},
                     {"report", shown(study.report(i))},
                     {"parameters", parameters_of(study.parameters(i))},
                     {"hash", study.name(i)}});
  return {{"format", "cleft-study"},
          {"cases", study.size()},
          {"modes", study.modes()},
          {"bytes", std::filesystem::file_size(file)},
          {"list", cases}};
}

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

std::string rounded(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

/// Names of parameters that are not the same in all cases.
std::vector<std::string> varying_of(const Json& cases) {
  std::vector<std::string> names;
  if (cases.empty()) return names;
  for (const auto& [name, value] : cases.front()["parameters"].items())
    if (std::any_of(cases.begin(), cases.end(), [&, &key = name, &first = value](const Json& one) {
          return one["parameters"].value(key, Json()) != first;
        }))
      names.push_back(name);
  return names;
}

/// A line for each case, in columns; of many cases and parameters, the first ones.
void print_cases(const Json& cases) {
  constexpr std::size_t most_cases = 40, most_parameters = 5;
  std::vector<std::string> varying = varying_of(cases);
  const std::size_t further = varying.size() - std::min(varying.size(), most_parameters);
  varying.resize(varying.size() - further);
  std::vector<std::vector<std::string>> rows = {{"case", "bytes", "node_error"}};
  rows[0].insert(rows[0].end(), varying.begin(), varying.end());
  for (std::size_t i = 0; i < std::min(cases.size(), most_cases); ++i) {
    const Json& one = cases[i];
    auto& row = rows.emplace_back();
    row = {text_of(one["name"]), text_of(one["bytes"]), rounded(one["report"]["node_error"].get<double>())};
    for (const std::string& name : varying) row.push_back(text_of(one["parameters"].value(name, Json("-"))));
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      std::size_t width = 0;
      for (const auto& other : rows) width = std::max(width, other[c].size());
      line += (c > 0 ? "  " : "") + row[c] + std::string(width - row[c].size(), ' ');
    }
    std::cout << line.substr(0, line.find_last_not_of(' ') + 1) << "\n";
  }
  if (cases.size() > most_cases) std::cout << "... and " << cases.size() - most_cases << " more cases";
  if (further > 0)
    std::cout << (cases.size() > most_cases ? "; " : "... and ") << further << " more parameters that differ";
  if (cases.size() > most_cases || further > 0) std::cout << " (--json prints all)\n";
}

/// A study's cases are a table where people read.
void print_info(Json info, bool as_json) {
  if (as_json || !info.contains("list")) return print_figures(info, as_json);
  const Json cases = info["list"];
  info.erase("list");
  print_figures(info, false);
  print_cases(cases);
}

Json info_of(const std::string& file) {
  const std::string format = format_of(file);
  Json info;
  if (format == "cleft-snapshot")
    info = info_of_snapshot(file);
  else if (format == "cleft-field")
    info = pieces_in(file) > 0 ? info_of_pieces(file) : info_of_field(read_field(file), file);
  else if (format == "cleft-study")
    return info_of_study(file);
  else
    throw FileError(file, "is neither a snapshot nor a field nor a study");
  if (const std::string hash = published_hash(file); !hash.empty()) info["hash"] = hash;
  return info;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Shows what a snapshot, a field or a study file holds.", "cleft info");
  std::string file;
  bool json = false;
  app.add_option("FILE", file, "case.h5, case.dffd or study.dffd")->required();
  app.add_flag("--json", json, "print as JSON");
  return run_command(app, argc, argv, [&] { print_info(info_of(file), json); });
}
