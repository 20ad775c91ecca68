#include "explorer/session/study_answers.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "base/process.h"
#include "base/text.h"
#include "base/unfinished.h"

namespace cleft {

namespace {

namespace fs = std::filesystem;
using AnswerJson = nlohmann::ordered_json;

/// A folder of the system's temporary files, for the two outputs of a command.
class AnswerFolder {
 public:
  AnswerFolder() {
    std::string name = (fs::temp_directory_path() / "cleft-answer-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder can be made: " + name);
    path_ = name;
    begin_unfinished(path_);
  }
  ~AnswerFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    end_unfinished(path_);
  }
  AnswerFolder(const AnswerFolder&) = delete;
  AnswerFolder& operator=(const AnswerFolder&) = delete;
  std::string operator/(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Without the name of the command and of the kind of the error.
std::string essence(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (const char* mark : {"error: ", "failed: "})
    if (const auto at = text.rfind(mark); at != std::string::npos)
      return text.substr(at + std::string(mark).size());
  return text.empty() ? "the command said nothing" : text;
}

AnswerJson answer_of(const std::string& command, std::vector<std::string> arguments,
                     const LookMeanwhile& look) {
  const char* folder = std::getenv("CLEFT_BIN");
  arguments.insert(arguments.begin(),
                   (folder ? std::string(folder) : executable_folder()) + "/cleft-" + command);
  arguments.insert(arguments.end(), {"--json", "--quiet"});
  const AnswerFolder files;
  const std::string log = files / "log", output = files / "output";
  StopCount stop = 0;
  auto running =
      std::async(std::launch::async, [&] { return run_process(arguments, log, {}, &stop, output); });
  constexpr std::chrono::milliseconds moment(100);
  try {
    while (running.wait_for(moment) != std::future_status::ready) look();
  } catch (...) {
    stop = 2;
    running.wait();
    throw;
  }
  if (!running.get().success()) throw InputError(essence(read_text_file(log)));
  return AnswerJson::parse(read_text_file(output));
}

}  // namespace

StudyAnalysis analyze_study(const std::string& study, const std::string& figure, const LookMeanwhile& look) {
  const AnswerJson json = answer_of("analyze", {study, "--of", figure}, look);
  StudyAnalysis found;
  found.figure = json.at("figure"), found.unit = json.at("unit");
  found.mean = json.at("mean"), found.deviation = json.at("deviation");
  found.error = json.at("interpolation_error").at("median");
  for (const AnswerJson& one : json.at("parameters")) {
    StudyAnalysis::Effect& effect = found.effects.emplace_back();
    effect.name = one.at("name");
    effect.first = one.at("first_order").at("value"), effect.first_error = one.at("first_order").at("error");
    effect.total = one.at("total").at("value"), effect.total_error = one.at("total").at("error");
    effect.at = one.at("main_effect").at("at").get<std::vector<double>>();
    effect.mean = one.at("main_effect").at("mean").get<std::vector<double>>();
  }
  std::stable_sort(found.effects.begin(), found.effects.end(),
                   [](const auto& a, const auto& b) { return a.total > b.total; });
  return found;
}

StudyFit fit_study(const std::string& study, const std::string& measurements, double deviation,
                   const LookMeanwhile& look) {
  std::vector<std::string> arguments{study, "--to", measurements};
  if (deviation > 0) arguments.insert(arguments.end(), {"--deviation", shortest(deviation)});
  const AnswerJson json = answer_of("fit", arguments, look);
  StudyFit found;
  found.measurements = measurements;
  for (const AnswerJson& one : json.at("parameters"))
    found.values.push_back(
        {one.at("name"), one.at("most_likely"), one.at("interval_90").at(0), one.at("interval_90").at(1)});
  found.misfit = json.at("misfit"), found.misfit_probability = json.at("misfit_probability");
  found.open = json.at("open").get<std::vector<std::string>>();
  found.next = json.at("next_measurement").at("figure");
  return found;
}

StudyProposal propose_cases(const std::string& study, int count, const LookMeanwhile& look) {
  const AnswerJson json = answer_of("propose", {study, "--count", std::to_string(count)}, look);
  StudyProposal found;
  found.error = json.at("error");
  for (const AnswerJson& one : json.at("proposed"))
    found.cases.push_back(one.at("values").get<std::map<std::string, double>>());
  return found;
}

StudyOptimum best_in_study(const std::string& study, bool greatest, const std::string& figure,
                           const std::string& where, const LookMeanwhile& look) {
  std::vector<std::string> arguments{study, greatest ? "--maximize" : "--minimize", figure};
  if (!where.empty()) arguments.insert(arguments.end(), {"--where", where});
  const AnswerJson optimum = answer_of("find", arguments, look).at("optimum");
  StudyOptimum found{optimum.at("values").get<std::map<std::string, double>>(),
                     optimum.at("holds"),
                     optimum.at("holds_within_errors"),
                     {}};
  for (const AnswerJson& one : optimum.at("figures"))
    found.figures.push_back({one.at("figure"), one.at("value"), one.at("interpolation_error")});
  return found;
}

std::string study_of(const std::string& study_file, const StudyProposal& proposal) {
  std::istringstream lines(read_text_file(study_file));
  std::string text;
  bool kept = true;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != std::string::npos && line[first] == '[')
      kept = !line.substr(first).starts_with("[vary]") && !line.substr(first).starts_with("[sampling]");
    if (kept) text += line + "\n";
  }
  text += "\n[sampling]\nmethod = \"list\"\n\n[vary]\n";
  if (proposal.cases.empty()) return text;
  for (const auto& [name, value] : proposal.cases.front()) {
    text += "\"" + name + "\" = [";
    for (std::size_t i = 0; i < proposal.cases.size(); ++i)
      text += (i ? ", " : "") + shortest(proposal.cases[i].at(name));
    text += "]\n";
  }
  return text;
}

}  // namespace cleft
