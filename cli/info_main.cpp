// cleft info: what a snapshot, a field or a study file holds.
#include <filesystem>

#include "base/command.h"
#include "base/error.h"
#include "base/sealed_json.h"
#include "encoder/field/field_file.h"
#include "encoder/field/field_record.h"
#include "encoder/field/study_file.h"
#include "solver/snapshot/snapshot.h"

using namespace cleft;

namespace {

Json parameters_of(const std::map<std::string, std::variant<double, std::string>>& parameters) {
  Json list = Json::object();
  for (const auto& [name, value] : parameters)
    std::visit([&, &key = name](const auto& v) { list[key] = v; }, value);
  return list;
}

Json list_of(const Vec3& v) { return {v.x, v.y, v.z}; }

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

/// Of a study's published case: whether its snapshot was kept. Empty elsewhere.
std::string raw_data_beside(const std::string& field) {
  const std::string manifest = (std::filesystem::path(field).parent_path() / "manifest.json").string();
  return std::filesystem::exists(manifest) ? read_sealed(manifest).value("snapshot", "kept") : "";
}

Json info_of_field(const std::string& file) {
  const Field field = read_field(file);
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
      {"parameters", field.parameters}};
  for (const Quantity& quantity : field.quantities)
    info["quantities"].push_back({{"name", quantity.name},
                                  {"components", quantity.components},
                                  {"largest", quantity.largest},
                                  {"error", quantity.error},
                                  {"spline_error", quantity.spline_error}});
  for (const ParameterDerivative& one : field.by_parameter)
    info["by_parameter"].push_back(
        {{"parameter", one.parameter}, {"largest", one.largest}, {"error", one.error}});
  if (const std::string raw = raw_data_beside(file); !raw.empty()) info["raw_data"] = raw;
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
                     {"parameters", study.parameters(i)}});
  return {{"format", "cleft-study"},
          {"cases", study.size()},
          {"modes", study.modes()},
          {"bytes", std::filesystem::file_size(file)},
          {"list", cases}};
}

Json info_of(const std::string& file) {
  const std::string format = format_of(file);
  if (format == "cleft-snapshot") return info_of_snapshot(file);
  if (format == "cleft-field") return info_of_field(file);
  if (format == "cleft-study") return info_of_study(file);
  throw FileError(file, "is neither a snapshot nor a field nor a study");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Shows what a snapshot, a field or a study file holds.", "cleft info");
  std::string file;
  bool json = false;
  app.add_option("FILE", file, "case.h5, case.dffd or study.dffd")->required();
  app.add_flag("--json", json, "print as JSON");
  return run_command(app, argc, argv, [&] { print_figures(info_of(file), json); });
}
