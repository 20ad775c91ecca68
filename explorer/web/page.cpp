#include "explorer/web/page.h"

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <filesystem>
#include <span>

#include "base/error.h"
#include "base/output_file.h"
#include "encoder/field/file/columns.h"
#include "encoder/interpolate/compact.h"
#include "explorer/study/case_figures.h"
#include "explorer/web/between_cases_data.h"
#include "explorer/web/page_parts.h"
#include "params/hash.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

constexpr int page_version = 1;

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// JSON within HTML: no text of a study can end the element that holds it.
std::string within_html(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace))
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

/// As Content-Security-Policy names an element: by its text.
std::string hash_source(const std::string& text) {
  const std::string hex = sha256(text);
  std::array<std::uint8_t, 32> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::uint8_t>(std::stoi(hex.substr(2 * i, 2), nullptr, 16));
  return "'sha256-" + base64(bytes) + "'";
}

/// What the page needs of a field's header.
Json shortened(const Json& header) {
  Json kept;
  for (const char* name :
       {"case", "parametrization", "quantum", "slices", "bases", "domain", "cut", "tip", "parameters"})
    kept[name] = header.at(name);
  for (const char* name : {"spline_error", "largest_displacement"})
    kept["report"][name] = header.at("report").at(name);
  return kept;
}

/// What is not coded in steps gets some, far below its error.
FieldRecord record_for_page(Field field) {
  constexpr double step = 1e-6;  // of the largest displacement
  field.quantities.clear(), field.by_parameter.clear();
  if (field.quantum == 0 && field.report.largest_displacement > 0)
    field = compact(field, step * field.report.largest_displacement);
  return record_of(field);
}

/// What the page shows of cases, and the text of "coefficients".
struct Cases {
  std::vector<Json> headers;
  Json list = Json::array();
  Json modes;  // that cases are sums of; null: none are
  std::string coefficients;
};

/// Those that cases of the study are sums of.
Json coded_modes(const CodedModes& modes, std::string& coefficients) {
  Json bytes = Json::array();
  for (const auto& mode : modes.coefficients) coefficients += base64(mode), bytes.push_back(mode.size());
  return {{"quanta", modes.quanta}, {"bytes", bytes}};
}

Cases cases_of(const PublishedStudy& study, const ReportState& report) {
  Cases cases;
  if (study.sums()) cases.modes = coded_modes(study.sums()->coded_modes(), cases.coefficients);
  for (int i = 0; i < study.size(); ++i) {
    if (report) report("case " + std::to_string(i + 1) + " of " + std::to_string(study.size()));
    const Field field = study.read(i);
    const CaseFigures figures = case_figures(field);
    FieldRecord record;
    if (study.sums()) record = study.sums()->record(study.number_in_file(i));
    const bool sum = record.header.contains("modes");
    if (!sum) record = record_for_page(field);
    cases.headers.push_back(shortened(record.header));
    if (sum) cases.headers.back()["modes"] = {{"weights", record.header["modes"].at("weights")}};
    cases.coefficients += base64(record.coefficients);
    cases.list.push_back({{"name", study.name(i)},
                          {"hash", study.hash(i)},
                          {"bytes", record.coefficients.size()},
                          {"gape", figures.gape},
                          {"displacement", figures.largest_displacement},
                          {"error", figures.error}});
  }
  return cases;
}

/// The same of a mesh: fields move it, and are not in the page themselves.
Cases cases_of(const PublishedStudy& study, const MeshMotion& mesh, const MeshMotionData& motion) {
  Cases cases;
  for (int i = 0; i < mesh.cases; ++i) {
    cases.headers.push_back({{"parameters", study.parameters(i).numbers()}});
    const auto at = static_cast<std::size_t>(i);
    cases.list.push_back({{"name", study.name(i)},
                          {"hash", study.hash(i)},
                          {"bytes", 0},
                          {"gape", motion.gapes[at]},
                          {"displacement", motion.largest[at]},
                          {"error", study.report(i).spline_error}});
  }
  return cases;
}

/// The element "study".
Json study_data(const PublishedStudy& study, const Cases& cases) {
  Json parameters = Json::array();
  for (const std::string& name : cases.headers.size() > 1 ? study.varying() : std::vector<std::string>{}) {
    const Parameter* row = find_parameter(name);
    parameters.push_back({{"name", name}, {"unit", row ? row->unit : ""}, {"help", row ? row->help : ""}});
  }
  std::filesystem::path path(study.path());
  if (path.filename().empty()) path = path.parent_path();
  return {{"format", "cleft-page"},   {"version", page_version}, {"title", path.filename().string()},
          {"parameters", parameters}, {"cases", cases.list},     {"columns", columns_of(cases.headers)},
          {"modes", cases.modes}};
}

std::string base64(const std::vector<std::vector<std::uint8_t>>& pieces) {
  std::string text;
  for (const auto& piece : pieces) text += base64(piece);
  return text;
}

std::uint32_t crc_of(const std::string& text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return crc.checksum();
}

std::string element(const std::string& id, const std::string& text) {
  return "<script type=\"application/json\" id=\"" + id + "\" data-bytes=\"" + std::to_string(text.size()) +
         "\" data-crc=\"" + std::to_string(crc_of(text)) + "\">" + text + "</script>\n";
}

std::string replaced(std::string text, const std::string& mark, const std::string& by) {
  const std::size_t at = text.find(mark);
  CLEFT_CHECK(at, !=, std::string::npos);
  return text.replace(at, mark.size(), by);
}

}  // namespace

PageFigures write_page(const PublishedStudy& study, const std::string& path, const ReportState& report,
                       const MeshMotion* mesh) {
  MeshMotionData motion;
  if (mesh)
    motion = mesh_motion_data(*mesh, [&](int i) {
      if (report) report("case " + std::to_string(i + 1) + " of " + std::to_string(mesh->cases));
    });
  const Cases cases = mesh ? cases_of(study, *mesh, motion) : cases_of(study, report);
  Json data = study_data(study, cases);
  BetweenCasesData between;
  if (cases.list.size() > 1) {
    if (report) report("fields between the cases");
    between = between_cases_data(study, !mesh);
  }
  data["between"] = between.model.empty() ? Json() : Json::parse(between.model);
  data["not_between"] = between.reason;
  data["mesh"] = mesh ? Json::parse(motion.json) : Json();

  const std::string script = page_parts::script, style = page_parts::style;
  std::string page = page_parts::document;
  page = replaced(page, "{{policy}}",
                  "default-src 'none'; script-src " + hash_source(script) + "; style-src " +
                      hash_source(style) + "; base-uri 'none'; form-action 'none'");
  page = replaced(page, "{{style}}", style);
  page = replaced(page, "{{script}}", script);
  page = replaced(page, "{{data}}",
                  element("study", within_html(data)) + element("coefficients", cases.coefficients) +
                      element("modes", base64(mesh ? motion.pieces : between.pieces)));
  write_text_file(path, page);
  return {static_cast<int>(cases.list.size()), page.size(), mesh ? motion.modes : between.modes,
          mesh ? motion.error : between.error, between.reason};
}

}  // namespace cleft
