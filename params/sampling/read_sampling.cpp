#include "params/sampling/read_sampling.h"

#include <algorithm>

#include "base/text.h"
#include "params/parameters/table.h"
#include "params/sampling/sampling.h"
#include "params/toml_value.h"

namespace cleft {

namespace {

constexpr std::int64_t most_values = 100'000;  // of one parameter
constexpr std::int64_t most_level = 12;
constexpr std::size_t first_cases = 12, cases_of_range = 3;  // of adaptive sampling, if the file does not say
constexpr std::int64_t most_adaptive = 10'000;

class SamplingReader {
 public:
  SamplingReader(const std::string& path, Study& study, Mistakes& mistakes)
      : path_(path), study_(study), mistakes_(mistakes) {}

  void read(const toml::table& file) {
    const toml::table *sampling = file["sampling"].as_table(), *vary = file["vary"].as_table();
    if (sampling)
      read_settings(*sampling);
    else
      method_ = &find_sampling(study_.sampling.method, path_);
    if (vary) read_variations(*vary, ""), check_shares(*vary), check_not_with(*vary);
    // Where the first cases are too few, what they tell is worse than an even sequence.
    if (SamplingSettings& s = study_.sampling; s.adapts && !sampling->contains("start"))
      s.count = std::min(s.most, std::max(s.count, cases_of_range * study_.vary.size()));
    if (study_.sampling.unit_tensions) check_tensions(*sampling);
    if (draws() && (!vary || vary->empty()))
      mistakes_.add(where(*sampling) + ": sampling method '" + method_->name +
                    "' draws from ranges; give them under [vary], as NAME = { from = a, to = b }");
  }

 private:
  std::string where(const toml::node& node) const { return place_of(path_, node); }
  bool draws() const { return method_ && method_->draws; }
  bool takes_values() const { return method_ && !method_->draws; }

  void read_settings(const toml::table& table) {
    check_keys(table,
               {"method", "count", "seed", "level", "unit_tensions", "start", "most", "error", "batch", "of"},
               "sampling.", "");
    mistakes_.collect([&] { read_method(table); });
    if (adapts()) read_adaptive(table);
    mistakes_.collect([&] { check_adaptive_keys(table); });
    mistakes_.collect([&] { read_number(table, "count", 1, most_cases, study_.sampling.count); });
    mistakes_.collect([&] { read_number(table, "seed", 0, INT64_MAX, study_.sampling.seed); });
    mistakes_.collect([&] { read_number(table, "level", 1, most_level, study_.sampling.level); });
    mistakes_.collect([&] { read_unit_tensions(table); });
    if (draws() && !adapts() && !table.contains(number_of_cases()))
      mistakes_.add(where(table) + ": sampling method '" + method_->name + "' needs " +
                    (method_->levels ? "level = n: 1 takes the middle and the ends of each range, 2 pairs too"
                                     : "count = n, the number of cases"));
  }

  bool adapts() const { return method_ && method_->adapts; }

  void read_adaptive(const toml::table& table) {
    SamplingSettings& s = study_.sampling;
    s.adapts = true, s.count = first_cases;
    mistakes_.collect([&] { read_count(table, "start", 3, s.count); });
    mistakes_.collect([&] { read_count(table, "batch", 1, s.batch); });
    mistakes_.collect([&] {
      if (!table.contains("most"))
        throw InputError(where(table) +
                         ": sampling method 'adaptive' needs most = n, the most cases it may take");
      read_count(table, "most", 3, s.most);
      if (s.most < s.count && table.contains("start"))
        throw InputError(where(*table.get("most")) + ": sampling.most = " + std::to_string(s.most) +
                         ": must be at least start, " + std::to_string(s.count));
    });
    mistakes_.collect([&] {
      const toml::node* node = table.get("error");
      const auto given = node ? node->value<double>() : std::nullopt;
      if (!given || !(*given > 0 && *given < 1))
        throw InputError(
            where(node ? *node : table) +
            ": sampling.error: the error at which no more cases are wanted, over the figure's largest "
            "value; must be a number above 0 and below 1");
      s.error = *given;
    });
    mistakes_.collect([&] {
      const toml::node* node = table.get("of");
      if (!node) return;
      const auto text = node->value<std::string>();
      if (!text || text->empty())
        throw InputError(
            where(*node) +
            ": sampling.of: the figure that the error is of, in quotes: \"field\", \"gape\", or another of "
            "cleft analyze");
      s.of = *text;
    });
    if (s.unit_tensions)
      mistakes_.add(where(table) +
                    ": sampling.unit_tensions: is not for method 'adaptive'; vary the prestress, which "
                    "superposes between the cases anyway");
  }

  void check_adaptive_keys(const toml::table& table) const {
    if (adapts() && table.contains("count"))
      throw InputError(where(*table.get("count")) +
                       ": sampling.count: method 'adaptive' takes start and most; remove count");
    if (!method_ || adapts()) return;
    for (const char* key : {"start", "most", "error", "batch", "of"})
      if (const toml::node* node = table.get(key))
        throw InputError(where(*node) + ": sampling." + key + ": is for method \"adaptive\"; remove it");
  }

  void read_count(const toml::table& table, const std::string& key, std::int64_t least,
                  std::size_t& number) const {
    const toml::node* node = table.get(key);
    if (!node) return;
    const auto given = node->value<std::int64_t>();
    if (!given || *given < least || *given > most_adaptive)
      throw InputError(where(*node) + ": sampling." + key + (given ? " = " + std::to_string(*given) : "") +
                       ": must be a whole number between " + std::to_string(least) + " and " +
                       std::to_string(most_adaptive));
    number = static_cast<std::size_t>(*given);
  }

  /// The key that says how many cases are drawn.
  const char* number_of_cases() const { return method_->levels ? "level" : "count"; }

  void read_unit_tensions(const toml::table& table) {
    const toml::node* node = table.get("unit_tensions");
    if (!node) return;
    const auto given = node->value_exact<bool>();
    if (!given) throw InputError(where(*node) + ": sampling.unit_tensions: must be true or false");
    study_.sampling.unit_tensions = *given;
  }

  /// The unit tensions are those of every case.
  void check_tensions(const toml::table& table) {
    const auto is_tension = [](const std::string& name) { return name.starts_with("skin.prestress_"); };
    std::string own;
    for (const Variation& variation : study_.vary)
      if (is_tension(variation.name)) own = variation.name + " under [vary]";
    for (const std::string& name : study_.given)
      if (is_tension(name)) own = name + " under [case]";
    if (!own.empty())
      mistakes_.add(where(table) + ": sampling.unit_tensions sets the skin's prestress; remove " + own);
    if (!is_linear_in_prestress(study_.base.parameters))
      mistakes_.add(where(table) +
                    ": sampling.unit_tensions: tensions are sums of others in the small model alone, without "
                    "cut.contact, skin.initial_stress_stiffness and skin.turning_stiffness");
  }

  void check_keys(const toml::table& table, const std::vector<std::string>& known, const std::string& prefix,
                  const std::string& of) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (std::find(known.begin(), known.end(), name) == known.end())
        mistakes_.add(where(node) + ": unknown key '" + prefix + name + "'" + of + did_you_mean(name, known));
    }
  }

  /// No method if it is unknown; rules that depend on it are then not checked.
  void read_method(const toml::table& table) {
    if (const toml::node* node = table.get("method")) {
      const auto text = node->value<std::string>();
      if (!text) throw InputError(where(*node) + ": sampling.method must be a text in quotes");
      study_.sampling.method = *text;
    }
    method_ = &find_sampling(study_.sampling.method,
                             where(table.contains("method") ? *table.get("method") : table));
  }

  template <class Whole>
  void read_number(const toml::table& table, const std::string& key, std::int64_t least, std::int64_t most,
                   Whole& number) const {
    const toml::node* node = table.get(key);
    if (!node || (adapts() && key == "count")) return;
    if (takes_values())
      throw InputError(where(*node) + ": sampling." + key + ": method '" + method_->name +
                       "' takes the values under [vary]; remove " + key +
                       ", or set method = " + drawing_methods());
    if (method_ && method_->levels != (key == "level"))
      throw InputError(where(*node) + ": sampling." + key + ": method '" + method_->name + "' takes " +
                       (method_->levels ? "level" : "count and seed") + "; remove " + key);
    const auto given = node->value<std::int64_t>();
    if (!given || *given < least || *given > most)
      throw InputError(where(*node) + ": sampling." + key + (given ? " = " + std::to_string(*given) : "") +
                       ": must be a whole number between " + std::to_string(least) + " and " +
                       std::to_string(most));
    number = static_cast<Whole>(*given);
  }

  /// Dotted keys are nested tables, as in [case]; a range is a table too.
  void read_variations(const toml::table& table, const std::string& prefix) {
    const std::vector<std::string> names = parameter_names();
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      const toml::table* group = node.as_table();
      if (group && !group->contains("from") && std::find(names.begin(), names.end(), name) == names.end())
        read_variations(*group, name + ".");
      else
        mistakes_.collect([&, &entry = node] { study_.vary.push_back(variation(name, entry)); });
    }
  }

  Variation variation(const std::string& name, const toml::node& node) {
    const Parameter& parameter = find_parameter(name, where(node));
    const std::string here = where(node) + ": " + name;
    for (const Variation& other : study_.vary)
      if (other.name == name) throw InputError(here + ": stands twice under [vary]; remove one of them");
    if (draws()) check_drawable(parameter, here);
    if (const toml::array* list = node.as_array()) return {name, list_values(parameter, *list), {}};
    if (const toml::table* table = node.as_table()) return range_variation(parameter, *table);
    throw InputError(here + ": give " + (draws() ? "" : "a list [a, b, ...] or ") + range_form());
  }

  void check_drawable(const Parameter& parameter, const std::string& here) const {
    if (parameter.is_text() || parameter.whole)
      throw InputError(
          here + ": takes " + (parameter.whole ? "whole numbers" : "texts") + " only, and sampling method '" +
          method_->name +
          "' draws any number of a range; set it under [case], or use method \"grid\" or \"list\"");
  }

  std::string range_form() const {
    return method_ && method_->draws
               ? "{ from = a, to = b }"
               : "{ from = a, to = b, count = n } with n from 2 to " + std::to_string(most_values);
  }

  std::vector<Value> list_values(const Parameter& parameter, const toml::array& list) const {
    const std::string here = where(list) + ": " + parameter.name;
    if (draws())
      throw InputError(here + ": sampling method '" + method_->name + "' draws from a range, " +
                       range_form() + "; lists are for method \"grid\" or \"list\"");
    if (list.empty()) throw InputError(here + ": the list is empty");
    std::vector<Value> values;
    for (const toml::node& entry : list) {
      values.push_back(value_of(entry, parameter.name, where(entry)));
      check_value(parameter, values.back(), where(entry));
    }
    return values;
  }

  Variation range_variation(const Parameter& parameter, const toml::table& table) {
    if (parameter.is_text())
      throw InputError(where(table) + ": " + parameter.name +
                       ": takes texts, of which there are no ranges; give a list");
    const Range range = read_range(parameter, table);
    Variation result{parameter.name, {}, range};
    if (takes_values()) {
      result.range.reset();
      result.values = range_values(parameter, range, table);
    } else if (draws() && table.contains("count")) {
      throw InputError(where(table) + ": " + parameter.name + ": method '" + method_->name +
                       "' draws as many cases as sampling." + number_of_cases() +
                       " says; remove count from the range");
    }
    return result;
  }

  Range read_range(const Parameter& parameter, const toml::table& table) {
    const std::string place = where(table), here = place + ": " + parameter.name;
    check_keys(table, {"from", "to", "count", "scale", "alone", "with", "shares", "not_with"}, "",
               " in the range of " + parameter.name);
    const auto from = table["from"].value<double>(), to = table["to"].value<double>();
    if (!from || !to) throw InputError(here + ": a range is " + range_form());
    const std::string scale = table["scale"].value_or(std::string(table.contains("scale") ? "" : "linear"));
    if (scale != "linear" && scale != "log")
      throw InputError(here + ": scale" + (scale.empty() ? "" : " = " + scale) +
                       ": must be \"linear\" or \"log\"" + did_you_mean(scale, {"linear", "log"}));
    for (const double end : {*from, *to}) check_value(parameter, end, place);
    if (*from == *to) throw InputError(here + ": from and to are the same; set it under [case]");
    if (scale == "log" && (*from <= 0 || *to <= 0))
      throw InputError(here + ": from = " + shortest(*from) + ", to = " + shortest(*to) +
                       ": with scale = \"log\" both must be greater than 0");
    const auto [alone, group] = read_alone(parameter, table);
    return {*from,
            *to,
            scale == "log",
            alone,
            read_shares(parameter, table, alone),
            read_with(parameter, table, alone),
            group,
            read_not_with(parameter, table, alone)};
  }

  /// Whether it is varied alone, and the group with which it is.
  std::pair<bool, std::string> read_alone(const Parameter& parameter, const toml::table& table) const {
    const toml::node* node = table.get("alone");
    if (!node) return {false, ""};
    const std::string here = where(*node) + ": " + parameter.name + ": alone";
    if (!method_ || !method_->levels)
      throw InputError(here + ": is for sampling method \"sparse-grid\"; remove it");
    if (const auto group = node->value_exact<std::string>(); group && !group->empty()) return {true, *group};
    const auto given = node->value_exact<bool>();
    if (!given)
      throw InputError(here +
                       ": must be true or false, or in quotes the name of a group that is varied together");
    return {*given, ""};
  }

  std::string read_shares(const Parameter& parameter, const toml::table& table, bool alone) const {
    const toml::node* node = table.get("shares");
    if (!node) return "";
    const std::string here = where(*node) + ": " + parameter.name + ": shares";
    if (!method_ || !method_->levels || alone)
      throw InputError(here +
                       ": is for ranges of sampling method \"sparse-grid\" that are not alone; remove it");
    const auto name = node->value<std::string>();
    if (!name) throw InputError(here + ": must be the name of another range, in quotes");
    return *name;
  }

  std::vector<std::string> read_not_with(const Parameter& parameter, const toml::table& table,
                                         bool alone) const {
    std::vector<std::string> names;
    const toml::node* node = table.get("not_with");
    if (!node) return names;
    const std::string here = where(*node) + ": " + parameter.name + ": not_with";
    if (!method_ || !method_->levels || alone)
      throw InputError(here +
                       ": is for ranges of sampling method \"sparse-grid\" that are not alone; remove it");
    const toml::array* list = node->as_array();
    for (std::size_t n = 0; list && n < list->size(); ++n)
      if (const auto name = list->get(n)->value<std::string>()) names.push_back(*name);
    if (!list || names.empty() || names.size() != list->size())
      throw InputError(here + ": must be a list of names of other ranges, [\"NAME\", ...]");
    return names;
  }

  std::string where_varied(const toml::table& vary, const Variation& one) const {
    return where(vary.contains(one.name) ? *vary.get(one.name) : vary);
  }

  // Of all ranges, once all are read:

  void check_not_with(const toml::table& vary) {
    for (const Variation& one : study_.vary) {
      if (!one.range) continue;
      for (const std::string& name : one.range->not_with)
        if (name == one.name || std::ranges::find(study_.vary, name, &Variation::name) == study_.vary.end())
          mistakes_.add(where_varied(vary, one) + ": " + one.name + ": not_with = [\"" + name +
                        "\"]: must name other ranges under [vary]");
    }
  }

  void check_shares(const toml::table& vary) {
    for (const Variation& one : study_.vary) {
      if (!one.range || one.range->shares.empty()) continue;
      const auto other = std::find_if(study_.vary.begin(), study_.vary.end(), [&](const Variation& v) {
        return v.name == one.range->shares && v.name != one.name;
      });
      if (other == study_.vary.end() || !other->range || other->range->alone || !other->range->shares.empty())
        mistakes_.add(where_varied(vary, one) + ": " + one.name + ": shares = \"" + one.range->shares +
                      "\": must name another range under [vary], which is not alone and shares with none");
    }
  }

  std::vector<std::pair<std::string, Value>> read_with(const Parameter& parameter, const toml::table& table,
                                                       bool alone) const {
    std::vector<std::pair<std::string, Value>> values;
    const toml::node* node = table.get("with");
    if (!node) return values;
    const std::string place = where(*node), here = place + ": " + parameter.name + ": with";
    if (!alone) throw InputError(here + ": is of what is varied alone; add alone = true, or remove it");
    const toml::table* list = node->as_table();
    if (!list) throw InputError(here + ": must be { \"NAME\" = VALUE, ... }");
    for (const auto& [key, value] : *list) {
      const Parameter& other = find_parameter(std::string(key.str()), where(value));
      values.emplace_back(other.name, value_of(value, other.name, where(value)));
      check_value(other, values.back().second, where(value));
    }
    return values;
  }

  std::vector<Value> range_values(const Parameter& parameter, const Range& range,
                                  const toml::table& table) const {
    const auto count = table["count"].value<std::int64_t>();
    if (!count || *count < 2 || *count > most_values)
      throw InputError(where(table) + ": " + parameter.name + ": a range is " + range_form());
    std::vector<Value> values;
    for (std::int64_t i = 0; i < *count; ++i) {
      values.emplace_back(range.at(static_cast<double>(i), static_cast<double>(*count - 1)));
      check_value(parameter, values.back(), where(table));
    }
    return values;
  }

  const std::string& path_;
  Study& study_;
  Mistakes& mistakes_;
  const SamplingMethod* method_ = nullptr;
};

}  // namespace

void read_sampling(const toml::table& file, const std::string& path, Study& study, Mistakes& mistakes) {
  SamplingReader(path, study, mistakes).read(file);
}

}  // namespace cleft
