#include "params/run/case_list.h"

#include <iostream>

#include "params/parameters/table.h"

namespace cleft {

using Json = nlohmann::ordered_json;

Json case_entry(const Study& study, const Case& one, const CaseStatus& status) {
  Json entry = {{"case", one.hash()}, {"state", to_text(status.state)}};
  if (!status.reason.empty()) entry["reason"] = status.reason;
  for (const Variation& v : study.vary)
    std::visit([&](const auto& value) { entry[v.name] = value; },
               get_parameter(one.parameters, find_parameter(v.name, study.name)));
  return entry;
}

void print_cases(const Json& entries) {
  for (const Json& entry : entries) {
    for (const auto& [name, value] : entry.items())
      std::cout << (name == "case" || name == "state" ? "" : name + "=")
                << (value.is_string() ? value.get<std::string>() : value.dump()) << "  ";
    std::cout << "\n";
  }
}

}  // namespace cleft
