// cleft find: cases of a study, lengths cut and places where a condition holds.
#include <cstdio>
#include <iostream>

#include "base/command/command.h"
#include "explorer/study/find.h"

using namespace cleft;

namespace {

struct Options {
  std::string study, where;
  bool json = false;
};

Json to_json(const PublishedStudy& study, int i, const Finding& f) {
  return {{"case", i + 1},
          {"hash", study.hash(i)},
          {"name", study.name(i)},
          {"length_cut_mm", {f.first_t, f.last_t}},
          {"place_mm", {f.least_u, f.greatest_u}},
          {"widest_gape_mm", f.gape},
          {"at_length_cut_mm", f.best_t},
          {"at_place_mm", f.best_u},
          {"confirmed", f.confirmed ? Json(*f.confirmed) : Json()}};
}

std::string to_text(const PublishedStudy& study, int i, const Finding& f) {
  char figures[200];
  std::snprintf(figures, sizeof figures, "  %.1f to %.1f mm cut, u %.1f to %.1f mm, gape up to %.2f mm",
                f.first_t, f.last_t, f.least_u, f.greatest_u, f.gape);
  const std::string& hash = study.hash(i);
  return "case " + std::to_string(i + 1) + (hash.empty() ? "" : " (" + hash + ")") + ": " + study.name(i) +
         "\n" + figures +
         (!f.confirmed   ? " (the simulation is not kept)"
          : *f.confirmed ? " (confirmed by the simulation)"
                         : " (NOT confirmed by the simulation)");
}

void find(const Options& o) {
  const Condition condition(o.where);
  const PublishedStudy study(o.study);
  for (const std::string& sentence : study.left_out())
    std::cerr << "cleft find: warning: " << sentence << "\n";
  Json cases = Json::array();
  std::string lines;
  {
    Progress progress("finding");
    for (int i = 0; i < study.size(); ++i) {
      progress("case " + std::to_string(i + 1) + " of " + std::to_string(study.size()));
      const std::optional<Finding> found = find_in_case(condition, study, i);
      if (!found) continue;
      cases.push_back(to_json(study, i, *found));
      lines += to_text(study, i, *found) + "\n";
    }
  }
  if (o.json)
    print_figures({{"where", o.where}, {"cases_searched", study.size()}, {"found", cases}}, true);
  else
    std::cout << lines << cases.size() << " of " << study.size() << " cases\n";
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Finds cases of a study, lengths cut and places where a condition holds.", "cleft find");
  Options o;
  app.add_option("STUDY", o.study, "a study folder, a study.dffd or a case.dffd")->required();
  app.add_option(
         "--where", o.where,
         "like 'gape > 3 and tissue.young_modulus < 0.01': gape (of the lips at a place, mm), t (length "
         "cut, mm), u (place along the cut, mm), error (of the field as it is drawn, %), displacement "
         "(largest, mm), and parameters; "
         "and or not, < <= > >= = !=, + - * / and brackets")
      ->required();
  app.add_flag("--json", o.json, "as JSON");
  return run_command(app, argc, argv, [&] { find(o); });
}
