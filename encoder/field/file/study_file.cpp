#include "encoder/field/file/study_file.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "base/error.h"
#include "base/h5/h5.h"
#include "base/output_file.h"
#include "base/sealed_json.h"
#include "encoder/field/file/columns.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/unknowns.h"

namespace cleft {

namespace {

namespace fs = std::filesystem;

const FileFormat study_format{"cleft-study", 3, "study file", "cleft pack"};
constexpr hsize_t chunk_bytes = 1 << 15;  // a case reads one or two of them

std::vector<double> numbers_of(const Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name) || !object[name].is_array())
    throw InputError(std::string(name) + " of the modes are missing");
  std::vector<double> numbers;
  for (const Json& number : object[name]) {
    if (!number.is_number()) throw InputError(std::string(name) + " of the modes are no numbers");
    numbers.push_back(number.get<double>());
  }
  return numbers;
}

RecordedParameters choices_of_manifest(const std::string& file) {
  const Json manifest = read_sealed(file);
  RecordedParameters choices;
  if (manifest.contains("parameters")) record_texts(manifest["parameters"], choices);
  return choices;
}

Json header_of_study(const h5::File& file) {
  require_format(file, study_format);
  return header_from(file.read<std::uint8_t>("/header", {0}));
}

}  // namespace

struct StudyFile::Parts {
  explicit Parts(const std::string& path) : file(h5::File::open(path)), columns(Json::object(), 0) {
    Json header = header_of_study(file);
    for (const char* name : {"names", "bytes", "columns"})
      if (!header.contains(name)) throw InputError(std::string("the header has no ") + name);
    begins.push_back(0);
    for (const Json& name : header["names"]) {
      if (!name.is_string()) throw InputError("a case's name is no text");
      names.push_back(name.get<std::string>());
      check_name(names.back());
    }
    check_distinct();
    for (const Json& bytes : header["bytes"]) {
      if (!bytes.is_number_unsigned()) throw InputError("a case's number of bytes is no count");
      begins.push_back(begins.back() + bytes.get<std::uint32_t>());
    }
    if (begins.size() != names.size() + 1 || begins.back() != file.shape("/coefficients").at(0))
      throw InputError("the cases' bytes are not those of /coefficients");
    columns = Columns(std::move(header["columns"]), names.size());
    if (header.contains("modes")) read_modes(header["modes"]);
  }

  /// The unknowns of a case that is a sum of modes, mm.
  std::vector<double> sum_of_modes(const Json& case_header) {
    const std::vector<double> weights = numbers_of(case_header["modes"], "weights");
    if (weights.size() != coded.quanta.size())
      throw InputError("has " + std::to_string(weights.size()) + " weights for " +
                       std::to_string(coded.quanta.size()) + " modes");
    if (modes.empty())
      for (std::size_t k = 0; k < coded.quanta.size(); ++k) {
        const auto [grid, slices] = unknown_places(case_header, coded.coefficients[k].size());
        modes.push_back(multiples(decode_coefficients(grid, slices, coded.coefficients[k]), coded.quanta[k]));
      }
    std::vector<double> sum(modes.empty() ? 0 : modes[0].size(), 0);
    const double largest = report_of(case_header).largest_displacement;
    for (std::size_t k = 0; k < modes.size(); ++k)
      for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += weights[k] * largest * modes[k][n];
    return sum;
  }

  h5::File file;
  Columns columns;
  std::vector<std::string> names;
  std::vector<std::uint64_t> begins;  // of each case in /coefficients, and their end
  CodedModes coded;
  std::vector<std::vector<double>> modes;  // mm; once a case has asked for them

 private:
  /// A case's name becomes that of a folder or a file where the study is exported.
  static void check_name(const std::string& name) {
    const bool plain = std::none_of(name.begin(), name.end(), [](char c) {
      return c == '/' || c == '\\' || static_cast<unsigned char>(c) < ' ';
    });
    if (!plain || name.empty() || name.front() == '.')
      throw InputError("a case is called '" + name + "', which is no name of a folder; pack the study again");
  }

  void check_distinct() const {
    std::vector<std::string> sorted = names;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
      throw InputError("two cases are called '" + *twice + "'; pack the study again");
  }

  void read_modes(const Json& header) {
    coded.quanta = numbers_of(header, "quanta");
    const std::vector<double> lengths = numbers_of(header, "bytes");
    const auto bytes = file.read<std::uint8_t>("/modes", {0});
    std::size_t at = 0;
    for (const double told : lengths) {
      if (!(told >= 0 && told <= static_cast<double>(bytes.size() - at)))
        throw InputError("there are fewer bytes of modes than told");
      const std::size_t length = told;
      coded.coefficients.emplace_back(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                                      bytes.begin() + static_cast<std::ptrdiff_t>(at + length));
      at += length;
    }
    if (at != bytes.size() || lengths.size() != coded.quanta.size())
      throw InputError("the modes' bytes are not those of /modes");
  }
};

StudyFile::StudyFile(const std::string& path)
    : parts_(told_of_file(path, [&] { return std::make_unique<Parts>(path); })) {}
StudyFile::~StudyFile() = default;
StudyFile::StudyFile(StudyFile&&) noexcept = default;

int StudyFile::size() const { return static_cast<int>(parts_->names.size()); }

const std::string& StudyFile::name(int i) const { return parts_->names.at(i); }

std::string StudyFile::case_hash(int i) const {
  return told_of_file(parts_->file.path(), [&] {
    const Json hash = parts_->columns.entry("case", static_cast<std::size_t>(i));
    if (!hash.is_string()) throw InputError("a case's hash is no text");
    return hash.get<std::string>();
  });
}

RecordedParameters StudyFile::parameters(int i) const {
  return told_of_file(parts_->file.path(), [&] {
    Json header = parts_->columns.group("parameters", static_cast<std::size_t>(i));
    header.update(parts_->columns.group("choices", static_cast<std::size_t>(i)));
    return parameters_of(header);
  });
}

int StudyFile::modes() const { return static_cast<int>(parts_->coded.quanta.size()); }

double StudyFile::modes_error(int i) const {
  return told_of_file(parts_->file.path(), [&] {
    const std::size_t n = i;
    for (const char* name : {"modes/error", "steps_error"})
      if (parts_->columns.has(name, n)) {
        const Json error = parts_->columns.entry(name, n);
        if (!error.is_number()) throw InputError(std::string(name) + " is no number");
        return error.get<double>();
      }
    if (parts_->columns.has("modes/weights", n)) throw InputError("the error of the modes is missing");
    return 0.;
  });
}

FitReport StudyFile::report(int i) const {
  return told_of_file(parts_->file.path(), [&] {
    FitReport report = report_of(parts_->columns.group("report", static_cast<std::size_t>(i)));
    const double cost = modes_error(i);
    report.node_error += cost, report.spline_error += cost, report.frame_error += cost;
    return report;
  });
}

std::size_t StudyFile::coefficient_bytes(int i) const {
  const std::size_t n = i;
  return parts_->begins.at(n + 1) - parts_->begins.at(n);
}

const CodedModes& StudyFile::coded_modes() const { return parts_->coded; }

FieldRecord StudyFile::record(int i) const {
  const std::size_t n = i;
  FieldRecord record{{}, std::vector<std::uint8_t>(coefficient_bytes(i))};
  if (!record.coefficients.empty())
    parts_->file.read_rows<std::uint8_t>("/coefficients", parts_->begins[n], record.coefficients.size(),
                                         record.coefficients);
  told_of_file(parts_->file.path() + ", case " + name(i), [&] { record.header = parts_->columns.header(n); });
  return record;
}

Field StudyFile::field(int i) const {
  const FieldRecord record = this->record(i);
  return told_of_file(parts_->file.path() + ", case " + name(i), [&] {
    Field field = record.header.contains("modes") ? field_of(record, parts_->sum_of_modes(record.header))
                                                  : field_of(record);
    field.report = report(i);
    return field;
  });
}

std::vector<StudyCase> published_study_cases(const std::string& study, std::vector<std::string>* older,
                                             std::vector<std::string>* damaged) {
  if (!fs::is_directory(study)) throw InputError(study + ": no such folder (give a study folder)");
  std::vector<StudyCase> cases;
  std::vector<std::string> of_older, of_damaged;
  std::error_code absent;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(study) / "cases", absent)) {
    const std::string name = entry.path().filename().string(), field = (entry.path() / "case.dffd").string(),
                      manifest = (entry.path() / "manifest.json").string();
    if (!fs::exists(manifest) || !fs::exists(field)) {
      if (fs::exists(manifest)) of_damaged.push_back(name);
      continue;
    }
    try {
      if (is_older_field(field)) {
        of_older.push_back(name);
        continue;
      }
      if (damaged) read_field_record(field);
      cases.push_back({name, field, choices_of_manifest(manifest)});
    } catch (const FileError&) {
      if (!damaged) throw;
      of_damaged.push_back(name);
    }
  }
  if (older) older->insert(older->end(), of_older.begin(), of_older.end());
  if (damaged) damaged->insert(damaged->end(), of_damaged.begin(), of_damaged.end());
  if (cases.empty() && !of_older.empty()) throw InputError(study + ": " + note_of_older(study, of_older));
  if (cases.empty() && damaged && !of_damaged.empty())
    throw InputError(study + ": no case is left (" + study + "/cases/" + of_damaged.front() +
                     "/case.dffd, for example): " + note_of_damaged(study, of_damaged));
  if (cases.empty())
    throw InputError(study +
                     ": no published case (looked for cases/*/case.dffd with manifest.json); run `cleft run "
                     "STUDY.toml --out " +
                     study + "` first");
  std::sort(cases.begin(), cases.end(),
            [](const StudyCase& a, const StudyCase& b) { return a.name < b.name; });
  return cases;
}

namespace {

/// "case a", "cases a, b and 3 more".
std::string named(std::vector<std::string>& names) {
  std::sort(names.begin(), names.end());
  constexpr std::size_t most_named = 10;
  std::string text = names.size() == 1 ? "case " : "cases ";
  for (std::size_t i = 0; i < std::min(names.size(), most_named); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > most_named) text += " and " + std::to_string(names.size() - most_named) + " more";
  return text;
}

}  // namespace

std::string note_of_older(const std::string& study, std::vector<std::string> older) {
  const std::string names = named(older);
  const bool one = older.size() == 1;
  return (one ? "left out, since its field is" : "left out, since their fields are") +
         std::string(" of an older format: ") + names + "; cleft run STUDY.toml --out " + study +
         " encodes anew what the study asks for, then " + study + "/cases/" +
         (one ? older.front() : "NAME of each") + " can be deleted";
}

std::string note_of_damaged(const std::string& study, std::vector<std::string> damaged) {
  const std::string names = named(damaged);
  return (damaged.size() == 1 ? "left out, since its field or manifest is"
                              : "left out, since their fields or manifests are") +
         std::string(" gone or damaged: ") + names + "; cleft run STUDY.toml --out " + study +
         (damaged.size() == 1 ? " makes it again" : " makes them again");
}

std::vector<StudyRecord> study_records(const std::vector<StudyCase>& cases) {
  std::vector<StudyRecord> records;
  for (const StudyCase& one : cases)
    records.push_back({one.name, read_field_record(one.field_file), one.choices});
  return records;
}

void write_study(const std::string& path, const std::vector<StudyRecord>& cases, const CodedModes& modes) {
  std::vector<Json> headers;
  std::vector<std::uint8_t> coefficients, mode_coefficients;
  Json names = Json::array(), bytes = Json::array();
  for (const StudyRecord& one : cases) {
    const FieldRecord& record = one.record;
    names.push_back(one.name);
    bytes.push_back(record.coefficients.size());
    coefficients.insert(coefficients.end(), record.coefficients.begin(), record.coefficients.end());
    Json& header = headers.emplace_back(record.header);
    for (const auto& [name, value] : one.choices.texts()) header["choices"][name] = value;
    if (!one.weights.empty())
      header["modes"] = {{"weights", one.weights}, {"error", one.modes_error}};
    else if (one.modes_error > 0)
      header["steps_error"] = one.modes_error;
  }
  Json header{{"names", names}, {"bytes", bytes}, {"columns", columns_of(headers)}};
  if (!modes.quanta.empty()) {
    Json lengths = Json::array();
    for (const auto& mode : modes.coefficients) {
      lengths.push_back(mode.size());
      mode_coefficients.insert(mode_coefficients.end(), mode.begin(), mode.end());
    }
    header["modes"] = {{"quanta", modes.quanta}, {"bytes", lengths}};
  }

  OutputFile out(path);
  h5::File file = h5::File::create(out.path(), h5::Growth::none);
  write_format(file, study_format);
  file.write_text("/", "units", "mm N MPa");
  const auto text = header_bytes(header);
  file.write<std::uint8_t>("/header", text, {text.size()}, h5::Packing::deflate);
  if (!mode_coefficients.empty())
    file.write<std::uint8_t>("/modes", mode_coefficients, {mode_coefficients.size()}, h5::Packing::deflate);
  file.create_dataset<std::uint8_t>("/coefficients", {coefficients.size()}, chunk_bytes,
                                    h5::Packing::deflate);
  file.write_rows<std::uint8_t>("/coefficients", 0, coefficients.size(), coefficients);
  file.close();
  out.commit();
}

}  // namespace cleft
