#include "params/study.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "params/hash.h"
#include "params/sampling/sampling.h"

namespace cleft {

namespace {

constexpr std::int64_t most_values = 100'000;  // of one parameter
constexpr const char* axis_names[] = {"u", "v", "w", "t"};

/// Reads one parsed file into a Study.
class StudyReader {
 public:
  StudyReader(std::string path, const toml::table& file) : path_(std::move(path)), file_(file) {}

  Study read() {
    for (const auto& [key, node] : file_) read_section(std::string(key.str()), node);
    mistakes_.throw_if_any();
    return std::move(study_);
  }

 private:
  std::string where(const toml::node& node) const {
    return path_ + ", line " + std::to_string(node.source().begin.line);
  }

  void read_section(const std::string& key, const toml::node& node) {
    static const std::vector<std::string> known = {"name", "case", "vary", "sampling", "encode"};
    if (key == "name") {
      if (const auto text = node.value<std::string>())
        study_.name = *text;
      else
        mistakes_.add(where(node) + ": name must be a text in quotes");
    } else if (std::find(known.begin(), known.end(), key) == known.end()) {
      mistakes_.add(where(node) + ": unknown section '" + key + "'" + did_you_mean(key, known));
    } else if (const toml::table* table = node.as_table()) {
      if (key == "case") read_case_values(*table, "");
      if (key == "vary") read_variations(*table, "");
      if (key == "sampling") read_sampling(*table);
      if (key == "encode") read_encode(*table);
    } else {
      mistakes_.add(where(node) + ": " + key + " must be a section [" + key + "]");
    }
  }

  /// Dotted keys are nested tables in TOML: skin.thickness and "skin.thickness" both arrive as one dotted
  /// name.
  void read_case_values(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      if (const toml::table* group = node.as_table())
        read_case_values(*group, name + ".");
      else
        mistakes_.collect([&, &entry = node] {
          set_parameter(study_.base.parameters, name, value_of(entry, name), where(entry));
        });
    }
  }

  Value value_of(const toml::node& node, const std::string& name) const {
    find_parameter(name, where(node));  // an unknown name is told first
    if (const toml::value<bool>* flag = node.as_boolean()) return flag->get() ? "true" : "false";
    if (const auto number = node.value<double>()) return *number;
    if (const auto text = node.value<std::string>()) return *text;
    throw InputError(where(node) + ": " + name + ": must be a number or a text");
  }

  void read_variations(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      const toml::table* group = node.as_table();
      if (group && !group->contains("from"))
        read_variations(*group, name + ".");
      else
        mistakes_.collect([&, &entry = node] { study_.vary.push_back(variation(name, entry)); });
    }
  }

  Variation variation(const std::string& name, const toml::node& node) const {
    const Parameter& parameter = find_parameter(name, where(node));
    Variation result{name, {}};
    if (const toml::array* list = node.as_array()) {
      for (const toml::node& entry : *list) result.values.push_back(value_of(entry, name));
    } else if (const toml::table* range = node.as_table()) {
      result.values = range_values(name, *range);
    } else {
      throw InputError(where(node) + ": " + name +
                       ": give a list [a, b, ...] or { from = a, to = b, count = n }");
    }
    if (result.values.empty()) throw InputError(where(node) + ": " + name + ": the list is empty");
    for (const Value& value : result.values) check_value(parameter, value, where(node));
    return result;
  }

  std::vector<Value> range_values(const std::string& name, const toml::table& range) const {
    const auto from = range["from"].value<double>(), to = range["to"].value<double>();
    const auto count = range["count"].value<std::int64_t>();
    if (!from || !to || !count || *count < 2 || *count > most_values || range.size() != 3)
      throw InputError(where(range) + ": " + name +
                       ": a range is { from = a, to = b, count = n } with n from 2 to " +
                       std::to_string(most_values));
    std::vector<Value> values;
    for (std::int64_t i = 0; i < *count; ++i)
      values.emplace_back(i + 1 == *count ? *to
                                          : *from + (*to - *from) * static_cast<double>(i) /
                                                        static_cast<double>(*count - 1));
    return values;
  }

  void read_sampling(const toml::table& table) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (name != "method")
        mistakes_.add(where(node) + ": unknown key 'sampling." + name + "'" + did_you_mean(name, {"method"}));
      else
        mistakes_.collect([&, &entry = node] {
          study_.sampling = entry.value_or(std::string("not a text"));
          find_sampling(study_.sampling, where(entry));
        });
    }
  }

  void read_encode(const toml::table& table) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (name == "control_points")
        mistakes_.collect([&, &entry = node] { study_.base.encode.control_points = control_points(entry); });
      else
        mistakes_.add(where(node) + ": unknown key 'encode." + name + "'" +
                      did_you_mean(name, {"control_points"}));
    }
  }

  std::array<int, 4> control_points(const toml::node& node) const {
    std::array<int, 4> counts;
    const toml::array* list = node.as_array();
    if (!list || list->size() != 4)
      throw InputError(where(node) + ": encode.control_points must be a list of four: [U, V, W, T]");
    for (std::size_t i = 0; i < 4; ++i)
      counts[i] = static_cast<int>(
          std::clamp<std::int64_t>((*list)[i].value<std::int64_t>().value_or(0), 0, 1 << 20));
    check_control_points(counts, where(node));
    return counts;
  }

  std::string path_;
  const toml::table& file_;
  Study study_;
  Mistakes mistakes_;
};

}  // namespace

std::string Case::hash() const {
  std::string text = solve_hash(parameters) + " fixed";
  if (encode.control_points) text += " " + control_points_text(*encode.control_points);
  return sha256(text).substr(0, 16);
}

std::string control_points_text(const std::array<int, 4>& counts) {
  std::string text;
  for (const int count : counts) text += (text.empty() ? "" : ",") + std::to_string(count);
  return text;
}

Study read_study(const std::string& path) {
  const std::string text = read_text_file(path);
  try {
    const toml::table file = toml::parse(text, path);
    Study study = StudyReader(path, file).read();
    study.text = text;
    return study;
  } catch (const toml::parse_error& e) {
    throw InputError(path + ", line " + std::to_string(e.source().begin.line) + ": " +
                     std::string(e.description()));
  }
}

Case read_case(const std::string& path, const std::vector<std::string>& assignments) {
  Study study = read_study(path);
  if (!study.vary.empty())
    throw InputError(path +
                     ": is a study with [vary]; use cleft run, or remove [vary] to solve its base case");
  for (const std::string& assignment : assignments) set_from_text(study.base.parameters, assignment, "--set");
  check_consistency(study.base.parameters, assignments.empty() ? path : path + " with --set");
  return study.base;
}

std::vector<Case> cases_of(const Study& study) {
  std::vector<Case> cases = find_sampling(study.sampling, study.name)(study);
  Mistakes mistakes;
  std::set<std::string> identities;
  for (const Case& one : cases) {
    std::string which = study.name;
    for (const Variation& v : study.vary)
      which += ", " + v.name + " = " + to_text(get_parameter(one.parameters, find_parameter(v.name, which)));
    mistakes.collect([&] { check_consistency(one.parameters, which); });
    if (!identities.insert(one.hash()).second)
      mistakes.add(which + ": the case stands twice in the study; remove the repeated value");
  }
  mistakes.throw_if_any();
  return cases;
}

std::string case_file_text(const Case& a_case) {
  std::string text = "[case]\n";
  for (const Parameter& row : parameter_table()) {
    const std::string quote = row.is_text() ? "\"" : "";
    text += row.name + " = " + quote + to_text(get_parameter(a_case.parameters, row)) + quote +
            (row.unit.empty() ? "" : "  # " + row.unit) + "\n";
  }
  if (a_case.encode.control_points)
    text += "\n[encode]\ncontrol_points = [" + control_points_text(*a_case.encode.control_points) + "]\n";
  return text;
}

void check_control_points(const std::array<int, 4>& counts, const std::string& where) {
  for (std::size_t i = 0; i < 4; ++i) {
    const int least = i == 1 ? 8 : 4;
    if (counts[i] < least || counts[i] > 1000)
      throw InputError(where + ": " + std::to_string(counts[i]) + " control points along " + axis_names[i] +
                       ": must be a whole number between " + std::to_string(least) + " and 1000" +
                       (i == 1 ? " (both sides of the cut together)" : ""));
  }
}

}  // namespace cleft
