#include "explorer/session/study_answers.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "base/message.h"
#include "base/process.h"
#include "base/scratch_folder.h"
#include "base/text.h"
#include "params/study.h"

namespace cleft {

namespace {

using AnswerJson = nlohmann::ordered_json;

AnswerJson answer_of(const std::string& command, std::vector<std::string> arguments,
                     const LookMeanwhile& look) {
  arguments.insert(arguments.begin(), command_path(command));
  arguments.insert(arguments.end(), {"--json", "--quiet"});
  const ScratchFolder files("answer");
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
  if (!running.get().success()) throw InputError(last_error(read_text_file(log), "the command said nothing"));
  return AnswerJson::parse(read_text_file(output));
}

/// The first of the pairs, which begin with the largest share, that the parameter belongs to.
std::optional<StudyAnalysis::Partner> partner_of(const std::string& name, const AnswerJson& pairs) {
  constexpr double least_share = 0.01;
  for (const AnswerJson& pair : pairs) {
    const bool first = pair.at("parameters").at(0) == name;
    if (!first && pair.at("parameters").at(1) != name) continue;
    StudyAnalysis::Partner partner;
    partner.share = pair.at("share").at("value"), partner.error = pair.at("share").at("error");
    if (partner.share < std::max(least_share, partner.error)) return {};
    const std::size_t own = first ? 0 : 1;
    partner.name = pair.at("parameters").at(1 - own);
    partner.at = pair.at("at").at(own).get<std::vector<double>>();
    const auto values = pair.at("at").at(1 - own).get<std::vector<double>>();
    partner.low = values.front(), partner.high = values.back();
    const auto mean = pair.at("mean").get<std::vector<std::vector<double>>>();  // by the second parameter
    for (std::size_t k = 0; k < partner.at.size(); ++k)
      partner.mean_at_low.push_back(first ? mean.front()[k] : mean[k].front()),
          partner.mean_at_high.push_back(first ? mean.back()[k] : mean[k].back());
    return partner;
  }
  return {};
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
    effect.partner = partner_of(effect.name, json.at("interactions"));
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
  if (const Study study = read_study(study_file); study.sampling.differentiates) {
    for (const std::string& name : study.base.sensitivities)
      text += (text.empty() ? "sensitivities = [\"" : ", \"") + name + '"';
    if (!text.empty()) text += "]\n";
  }
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
