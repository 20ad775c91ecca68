// cross_validate STUDY HELD_OUT: how far cleft interpolate is off at cases that it did not see, and what it
// says of itself. README.md.
#include <chrono>
#include <cstdio>

#include "base/command/command.h"
#include "base/error.h"
#include "base/quantiles.h"
#include "tests/interpolate/held_out.h"

using namespace cleft;

namespace {

Json figures_of(const StudyInterpolator& study, const std::vector<HeldOut>& list) {
  Json features = Json::array();
  for (const std::string& name : study.features().names()) features.push_back(name);
  const auto middle = [&](auto function) { return median(of_each(list, function)); };
  const auto share = [&](auto function, double most) { return share_within(of_each(list, function), most); };
  const Eigen::VectorXd& left_out = study.left_out_errors();
  return {
      {"cases", study.cases().size()},
      {"held_out", list.size()},
      {"features", features},
      {"method", study.regression().covariance().name},
      {"left_out_error", median({left_out.begin(), left_out.end()})},
      {"error", middle([](const HeldOut& one) { return one.error; })},
      {"fit_error", middle([](const HeldOut& one) { return one.fit; })},
      {"error_against_field", middle([](const HeldOut& one) { return one.against_field; })},
      {"nearest_error", middle([](const HeldOut& one) { return one.nearest; })},
      {"error_over_nearest", middle([](const HeldOut& one) { return one.error / one.nearest; })},
      {"below_a_fifth_of_nearest", share([](const HeldOut& one) { return one.error / one.nearest; }, 0.2)},
      {"estimate_over_error", middle([](const HeldOut& one) { return one.estimate / one.error; })},
      {"within_twice_the_estimate", share([](const HeldOut& one) { return one.error / one.estimate; }, 2)},
      {"estimate_over_error_against_field",
       middle([](const HeldOut& one) { return one.interpolation_estimate / one.against_field; })},
      {"within_twice_the_estimate_against_field",
       share([](const HeldOut& one) { return one.against_field / one.interpolation_estimate; }, 2)},
      {"milliseconds", middle([](const HeldOut& one) { return one.milliseconds; })}};
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Interpolates a study at cases of another one and compares with their simulations (medians).",
      "cross_validate");
  std::string folder, held;
  bool json = false;
  app.add_option("STUDY", folder, "study folder or study.dffd")->required();
  app.add_option("HELD_OUT", held, "study folder of cases that are not in STUDY")->required();
  app.add_flag("--json", json, "print the figures as JSON");
  return run_command(app, argc, argv, [&] {
    const std::vector<StudyMember> members = read_members(folder);
    const auto start = std::chrono::steady_clock::now();
    const StudyInterpolator study{CommonCases(members)};
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const std::vector<HeldOut> list = compare_held_out(study, members, held);
    std::fprintf(stderr, "   error  of fit  against fit  nearest  estimate  against fit  outside\n");
    for (const HeldOut& one : list)
      std::fprintf(stderr, "%8.4f%8.4f%13.4f%9.4f%10.4f%13.4f%9.3f\n", one.error, one.fit, one.against_field,
                   one.nearest, one.estimate, one.interpolation_estimate, one.outside);
    Json figures = figures_of(study, list);
    figures["seconds_to_train"] = took.count();
    print_figures(figures, json);
  });
}
