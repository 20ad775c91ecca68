#include "params/run/chosen_cases.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "base/output_file.h"
#include "base/process.h"
#include "base/sealed_json.h"
#include "base/text.h"

namespace cleft {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* chosen_file = "/chosen.json";
constexpr int record_version = 2;  // sealed

std::vector<std::string> names_of(const Study& study) {
  std::vector<std::string> names;
  for (const Variation& one : ranges_by_name(study)) names.push_back(one.name);
  return names;
}

void write(const std::string& file, const ChosenCases& chosen) {
  Json json = {{"version", record_version},
               {"figure", chosen.figure},
               {"names", chosen.names},
               {"sensitivities", chosen.sensitivities},
               {"batches", Json::array()}};
  for (const ChosenBatch& one : chosen.batches)
    json["batches"].push_back({{"cases", one.cases}, {"error", one.error}, {"values", one.values}});
  write_text_file(file, sealed_text(json));
}

/// The case of these values; none outside of the ranges.
std::optional<Case> case_at(const Study& study, const std::vector<Variation>& ranges,
                            const std::vector<double>& values) {
  Case one = study.base;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const auto [least, greatest] = std::minmax(ranges[k].range->from, ranges[k].range->to);
    if (!(values.at(k) >= least && values.at(k) <= greatest)) return {};
    set_parameter(one.parameters, ranges[k].name, values[k], study.name);
  }
  settle_formulation(study, one);
  return one;
}

Json proposal(const StudyFolder& folder, std::size_t count) {
  const std::string base = folder.path() + "/.propose." + std::to_string(getpid());
  const ProcessResult result = run_process(
      {executable_folder() + "/cleft-propose", folder.path(), "--count", std::to_string(count), "--json"},
      base + ".log", {}, nullptr, base + ".out");
  const std::string out = fs::exists(base + ".out") ? read_text_file(base + ".out") : "",
                    log = fs::exists(base + ".log") ? read_text_file(base + ".log") : "";
  std::error_code ignored;
  fs::remove(base + ".out", ignored), fs::remove(base + ".log", ignored);
  if (!result.success()) throw std::runtime_error("the next cases could not be chosen: " + log);
  return Json::parse(out);
}

}  // namespace

ChosenCases chosen_cases(const StudyFolder& folder, const Study& study) {
  if (!study.sampling.adapts) return {};
  ChosenCases chosen{study.sampling.of, names_of(study), study.base.sensitivities, {}};
  const std::string file = folder.path() + chosen_file;
  if (!fs::exists(file)) return chosen;
  const Json json = read_sealed(file);
  try {
    if (json.at("figure") != chosen.figure || json.at("names") != Json(chosen.names)) return chosen;
    // Earlier versions wrote none, and took none.
    if (study.sampling.differentiates)
      chosen.sensitivities = json.value("sensitivities", std::vector<std::string>());
    for (const Json& one : json.at("batches"))
      chosen.batches.push_back({one.at("cases"), one.at("error"), one.at("values")});
  } catch (const Json::exception& e) {
    throw FileError(file, e.what());
  }
  return chosen;
}

std::vector<Case> cases_of(const Study& file, const StudyFolder& folder) {
  const ChosenCases chosen = chosen_cases(folder, file);
  Study study = file;
  if (study.sampling.differentiates) {
    study.base.sensitivities = chosen.sensitivities;
    if (chosen.sensitivities.empty() && !chosen.batches.empty())  // of as many first cases as there were then
      study.sampling.count =
          std::max(study.sampling.count, static_cast<std::size_t>(chosen.batches.front().cases));
  }
  std::vector<Case> cases = cases_of(study);
  if (chosen.batches.empty()) return cases;
  const std::vector<Variation> ranges = ranges_by_name(study);
  std::set<std::string> known;
  for (const Case& one : cases) known.insert(one.hash());
  for (const ChosenBatch& batch : chosen.batches)
    for (const std::vector<double>& values : batch.values)
      if (const auto one = case_at(study, ranges, values); one && known.insert(one->hash()).second)
        cases.push_back(*one);
  return cases;
}

Decision choose_more(const StudyFolder& folder, const Study& study) {
  const SamplingSettings& settings = study.sampling;
  const ChosenCases before = chosen_cases(folder, study);
  const std::vector<Case> cases = cases_of(study, folder);
  const std::vector<CaseStatus> states = folder.status(cases, folder.index());
  const auto published = [&](std::size_t from) {
    return std::any_of(states.begin() + static_cast<std::ptrdiff_t>(from), states.end(),
                       [](const CaseStatus& one) { return one.state == CaseState::published; });
  };
  const std::size_t last =
      before.batches.empty() ? 0 : cases.size() - std::min(cases.size(), before.batches.back().values.size());
  if (last < cases.size() && !published(last)) return {Choice::failed, std::nan("")};

  const std::size_t wanted = std::min(settings.batch, settings.most - std::min(settings.most, cases.size()));
  const Json json = proposal(folder, std::max<std::size_t>(wanted, 1));
  ChosenBatch batch{json.at("cases"), json.at("error"), {}};
  const bool reached = batch.error <= settings.error;
  if (!reached && wanted > 0)
    for (const Json& one : json.at("proposed")) {
      std::vector<double>& values = batch.values.emplace_back();
      for (const std::string& name : before.names) values.push_back(one.at("values").at(name));
    }
  {
    const Moment moment(folder.path());
    ChosenCases now = chosen_cases(folder, study);
    if (now.batches.size() != before.batches.size()) return {Choice::added, batch.error};  // by another run
    if (!now.batches.empty() && now.batches.back().values.empty()) now.batches.pop_back();
    now.batches.push_back(batch);
    write(folder.path() + chosen_file, now);
  }
  if (reached) return {Choice::reached, batch.error};
  if (wanted == 0) return {Choice::most, batch.error};
  return {cases_of(study, folder).size() > cases.size() ? Choice::added : Choice::exhausted, batch.error};
}

std::optional<int> cases_for(const ChosenCases& chosen, double error) {
  // Least squares of log error over log cases.
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const ChosenBatch& one : chosen.batches) {
    if (!(one.error > 0 && one.cases > 0)) continue;
    const double a = std::log(one.cases), b = std::log(one.error);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  const double spread = n * xx - x * x;
  if (n < 3 || !(spread > 1e-9)) return {};
  const double slope = (n * xy - x * y) / spread, constant = (y - slope * x) / n;
  if (!(slope < -0.1)) return {};
  const double cases = std::exp((std::log(error) - constant) / slope);
  if (!(cases < 1e6)) return {};
  return static_cast<int>(std::ceil(cases));
}

}  // namespace cleft
