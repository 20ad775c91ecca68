#include "params/study.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "base/error.h"
#include "base/file_versions.h"
#include "base/text.h"
#include "params/consistency.h"
#include "params/encode_limits.h"
#include "params/hash.h"
#include "params/parameters/lip_formulation.h"
#include "params/parameters/mirror_image.h"
#include "params/sampling/read_sampling.h"
#include "params/sampling/sampling.h"
#include "params/sensitivities.h"
#include "params/solve_hash.h"
#include "params/toml_value.h"

namespace cleft {

namespace {

/// "26,16,9,16", as --control-points takes it.
std::string control_points_text(const std::array<int, 4>& counts) {
  std::string text;
  for (const int count : counts) text += (text.empty() ? "" : ",") + std::to_string(count);
  return text;
}

/// As TOML writes a text.
std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) (c == '"' || c == '\\' ? result += '\\' : result) += c;
  return result + "\"";
}

/// Reads one parsed file into a Study.
class StudyReader {
 public:
  StudyReader(std::string path, const toml::table& file) : path_(std::move(path)), file_(file) {}

  Study read() {
    for (const auto& [key, node] : file_) read_section(std::string(key.str()), node);
    read_sampling(file_, path_, study_, mistakes_);
    if (!study_.base.body.empty())
      for (const Variation& one : study_.vary) check_has_effect(one.name);
    mistakes_.throw_if_any();
    if (study_.sampling.adapts && !file_.contains("sensitivities")) differentiate();
    return std::move(study_);
  }

 private:
  /// Of a body: its file has the shape of the cuts and the mesh.
  void check_has_effect(const std::string& name) {
    const auto starts = [&](const char* with) { return name.starts_with(with); };
    if (name == "cut.contact" || name == "patch.height" ||
        !(starts("cut.") || starts("patch.") || starts("mesh.") || starts("skin.curvature_")))
      return;
    mistakes_.add(
        path_ + ": vary." + name +
        ": has no effect with [body], whose file holds the cuts and the shape of the skin; leave it "
        "out, and make a study for each body file");
  }

  std::string where(const toml::node& node) const { return place_of(path_, node); }

  /// A derivative tells as much as a further case, and costs less. (Under finite strains an equilibrium may
  /// have none.)
  void differentiate() {
    if (study_.base.parameters.model == Model::finite) return;
    study_.sampling.differentiates = true;
    for (const Variation& one : ranges_by_name(study_)) {
      const auto exists_at = [&](double value) {
        Parameters at = study_.base.parameters;
        set_parameter(at, one.name, value, path_);
        return has_sensitivity(one.name, at);
      };
      if (exists_at(one.range->from) && exists_at(one.range->to))
        study_.base.sensitivities.push_back(one.name);
    }
    if (2 * study_.base.sensitivities.size() < study_.vary.size()) return;
    const auto says = [&](const char* key) { return bool(file_["sampling"][key]); };
    SamplingSettings& s = study_.sampling;
    if (!says("start")) s.count = std::min(s.most, (2 * s.count + 2) / 3);
    if (!says("batch")) s.batch /= 2;
  }

  void read_section(const std::string& key, const toml::node& node) {
    static const std::vector<std::string> known = {
        "name", "keep_snapshots", "error_estimates", "pack_error", "sensitivities", "case",
        "vary", "body",           "sampling",        "encode",     "slurm"};
    if (key == "name") {
      mistakes_.collect([&] { study_.name = text(node, "name"); });
    } else if (key == "keep_snapshots") {
      mistakes_.collect([&] { study_.keep_snapshots = all_or_none(node, key); });
    } else if (key == "error_estimates") {
      mistakes_.collect([&] { study_.estimate_errors = all_or_none(node, key); });
    } else if (key == "pack_error") {
      mistakes_.collect([&] { study_.pack_error = pack_error(node); });
    } else if (key == "sensitivities") {
      mistakes_.collect([&] { study_.base.sensitivities = texts(node, key); });
    } else if (std::find(known.begin(), known.end(), key) == known.end()) {
      mistakes_.add(where(node) + ": unknown section '" + key + "'" + did_you_mean(key, known));
    } else if (const toml::table* table = node.as_table()) {
      if (key == "case") read_case_values(*table, "");
      if (key == "encode") read_encode(*table);
      if (key == "body") read_body(*table);
      if (key == "slurm") read_slurm(*table);
    } else {
      mistakes_.add(where(node) + ": " + key + " must be a section [" + key + "]");
    }
  }

  std::string text(const toml::node& node, const std::string& name) const {
    const auto value = node.value<std::string>();
    if (!value) throw InputError(where(node) + ": " + name + " must be a text in quotes");
    return *value;
  }

  std::vector<std::string> texts(const toml::node& node, const std::string& name) const {
    const toml::array* list = node.as_array();
    if (!list) throw InputError(where(node) + ": " + name + " must be a list of texts");
    std::vector<std::string> result;
    for (const toml::node& entry : *list) result.push_back(text(entry, name));
    return result;
  }

  bool all_or_none(const toml::node& node, const std::string& key) const {
    const std::string which = text(node, key);
    if (which != "all" && which != "none")
      throw InputError(path_ + ": " + key + " = \"" + which + "\": must be \"all\" or \"none\"");
    return which == "all";
  }

  double pack_error(const toml::node& node) const {
    const auto value = node.value<double>();
    if (!value) throw InputError(where(node) + ": pack_error: must be a number");
    if (!(*value >= least_pack_error && *value <= greatest_pack_error))
      throw InputError(where(node) + ": pack_error = " + shortest(*value) + ": must be from " +
                       shortest(least_pack_error) + " to " + shortest(greatest_pack_error));
    return *value;
  }

  void read_slurm(const toml::table& table) {
    static const std::vector<std::string> known = {"partition", "account", "time", "options",
                                                   "cases_per_task"};
    SlurmSettings& slurm = study_.slurm;
    for (const auto& [key, entry] : table) {
      const std::string name = "slurm." + std::string(key.str());
      const toml::node& node = entry;
      mistakes_.collect([&, &key = key] {
        if (key == "partition") {
          slurm.partition = text(node, name);
        } else if (key == "account") {
          slurm.account = text(node, name);
        } else if (key == "time") {
          slurm.time = text(node, name);
        } else if (key == "cases_per_task") {
          const auto count = node.value<std::int64_t>().value_or(0);
          if (count < 1 || count > 10000)
            throw InputError(where(node) + ": " + name + " must be a whole number between 1 and 10000");
          slurm.cases_per_task = static_cast<int>(count);
        } else if (key == "options") {
          slurm.options = texts(node, name);
          for (const std::string& option : slurm.options)
            check_sbatch_option(option, where(node) + ": " + name);
        } else {
          throw InputError(where(node) + ": unknown key '" + name + "'" +
                           did_you_mean(std::string(key.str()), known));
        }
      });
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
          set_parameter(study_.base.parameters, name, value_of(entry, name, where(entry)), where(entry));
          study_.given.push_back(name);
        });
    }
  }

  /// The file's place is relative to that of this one.
  void read_body(const toml::table& table) {
    for (const auto& [key, entry] : table) {
      const std::string name = "body." + std::string(key.str());
      const toml::node& node = entry;
      mistakes_.collect([&, &key = key] {
        if (key != "file")
          throw InputError(where(node) + ": unknown key '" + name + "'" +
                           did_you_mean(std::string(key.str()), {"file"}));
        namespace fs = std::filesystem;
        const fs::path folder = fs::absolute(fs::path(path_)).parent_path();
        fs::path file = folder / text(node, name);
        // The folder of a study keeps its own copy.
        if (const fs::path kept = folder / kept_body; fs::is_directory(folder / "cases") && fs::exists(kept))
          file = kept;
        if (!fs::is_regular_file(file))
          throw InputError(where(node) + ": body.file = " + text(node, name) + ": there is no " +
                           file.lexically_normal().string() + " (cleft body makes it)");
        study_.base.body = file.lexically_normal().string();
        study_.base.body_digest = sha256_of_file(study_.base.body);
      });
    }
    if (!table.contains("file")) mistakes_.add(where(table) + ": [body] needs file = \"body.h5\"");
  }

  void read_encode(const toml::table& table) {
    static const std::vector<std::string> known = {"control_points", "parametrization", "regularisation",
                                                   "tolerance"};
    EncodeSettings& encode = study_.base.encode;
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (std::find(known.begin(), known.end(), name) == known.end())
        mistakes_.add(where(node) + ": unknown key 'encode." + name + "'" + did_you_mean(name, known));
    }
    if (const toml::node* node = table.get("parametrization"))
      mistakes_.collect([&] { encode.parametrization = parametrization(*node); });
    if (const toml::node* node = table.get("tolerance"))
      mistakes_.collect([&] { encode.tolerance = tolerance(*node); });
    if (const toml::node* node = table.get("control_points")) {
      mistakes_.collect([&] { encode.control_points = control_points(*node, encode.parametrization); });
      if (table.contains("tolerance"))
        mistakes_.add(where(*node) +
                      ": encode.control_points and encode.tolerance: give one of them, as the tolerance "
                      "chooses the control points");
    }
    if (const toml::node* node = table.get("regularisation")) {
      mistakes_.collect([&] { encode.regularisation = regularisation(*node); });
      if (!table.contains("control_points"))
        mistakes_.add(where(*node) +
                      ": encode.regularisation needs encode.control_points: with a tolerance the knots and "
                      "the regularisation are chosen together");
    }
  }

  std::string parametrization(const toml::node& node) const {
    const std::string name = node.value_or(std::string());
    if (name != "front" && name != "tip" && name != "fixed")
      throw InputError(where(node) + ": encode.parametrization" + (name.empty() ? "" : " = " + name) +
                       ": must be \"front\", \"tip\" or \"fixed\"");
    return name;
  }

  double tolerance(const toml::node& node) const {
    const auto value = node.value<double>();
    if (!value) throw InputError(where(node) + ": encode.tolerance: must be a number");
    if (!(*value >= least_tolerance && *value < 1))
      throw InputError(where(node) + ": encode.tolerance = " + shortest(*value) + ": must be at least " +
                       shortest(least_tolerance) + " and less than 1");
    return *value;
  }

  double regularisation(const toml::node& node) const {
    const auto value = node.value<double>();
    if (!value) throw InputError(where(node) + ": encode.regularisation: must be a number");
    check_regularisation(*value, where(node) + ": encode.regularisation");
    return *value;
  }

  std::array<int, 4> control_points(const toml::node& node, const std::string& parametrization) const {
    std::array<int, 4> counts;
    const toml::array* list = node.as_array();
    if (!list || list->size() != 4)
      throw InputError(where(node) + ": encode.control_points must be a list of four: [U, V, W, T]");
    for (std::size_t i = 0; i < 4; ++i)
      counts[i] = static_cast<int>(
          std::clamp<std::int64_t>((*list)[i].value<std::int64_t>().value_or(0), 0, 1 << 20));
    check_control_points(counts, parametrization, where(node));
    return counts;
  }

  std::string path_;
  const toml::table& file_;
  Study study_;
  Mistakes mistakes_;
};

}  // namespace

std::vector<std::string> EncodeSettings::arguments() const {
  if (!control_points) return {"--parametrization", parametrization, "--tolerance", shortest(tolerance)};
  std::vector<std::string> list = {"--parametrization", parametrization, "--control-points",
                                   control_points_text(*control_points)};
  if (regularisation) list.insert(list.end(), {"--regularisation", shortest(*regularisation)});
  return list;
}

std::string Case::snapshot_hash() const {
  std::string text = solve_hash(parameters, body_digest.substr(0, 16));
  if (sensitivities.empty()) return text;
  for (const std::string& name : sensitivities) text += " per " + name;
  return sha256(text).substr(0, 16);
}

std::string Case::hash() const {
  std::string text = snapshot_hash() + " field " + std::to_string(field_version);
  for (const std::string& argument : encode.arguments()) text += " " + argument;
  return sha256(text).substr(0, 16);
}

void check_sbatch_option(const std::string& option, const std::string& where) {
  if (option.size() < 3 || !option.starts_with("--") || option[2] == '=' || option[2] == '-')
    throw InputError(where + ": \"" + option +
                     "\" is not a long option of sbatch; give each as \"--name\" or \"--name=value\"");
  if (option == "--wrap" || option.starts_with("--wrap="))
    throw InputError(where + ": \"" + option + "\" would run another script in place of the study's");
}

Study read_study(const std::string& path) {
  const std::string text = read_text_file(path);
  const toml::table file = parse_toml(text, path);
  Study study = StudyReader(path, file).read();
  study.text = text;
  return study;
}

Case read_case(const std::string& path, const std::vector<std::string>& assignments) {
  Study study = read_study(path);
  if (!study.vary.empty())
    throw InputError(path +
                     ": is a study with [vary]; use cleft run, or remove [vary] to solve its base case");
  for (const std::string& assignment : assignments) set_from_text(study.base.parameters, assignment, "--set");
  if (!tells_formulation(assignments)) settle_formulation(study, study.base);
  check_consistency(study.base.parameters, assignments.empty() ? path : path + " with --set");
  check_sensitivities(study.base.sensitivities, study.base.parameters, path + ": sensitivities");
  return study.base;
}

namespace {

/// MPa: as large as those of skin. Of the third, the smaller principal stress is tension too.
constexpr Prestress unit_tensions[] = {{0.01, 0, 0}, {0, 0.01, 0}, {0.01, 0.01, 0.005}};

std::vector<Case> in_unit_tensions(const std::vector<Case>& cases) {
  std::vector<Case> result;
  for (const Case& one : cases)
    for (const Prestress& tension : unit_tensions)
      result.emplace_back(one).parameters.skin.prestress = tension;
  return result;
}

/// Takes away the images of earlier cases, where these stand for them.
void leave_out_mirror_images(std::vector<Case>& cases) {
  std::set<std::string> images;
  std::erase_if(cases, [&](const Case& one) {
    if (!one.parameters.cut.mirrored) return false;
    const std::string own = one.hash();
    if (images.contains(own)) return true;
    Case image = one;
    image.parameters = mirror_image(one.parameters);
    if (const std::string hash = image.hash(); hash != own) images.insert(hash);
    return false;
  });
}

}  // namespace

bool tells_formulation(const Study& study) {
  const auto is_it = [](const std::string& name) { return name == formulation_name; };
  return std::ranges::any_of(study.given, is_it) || std::ranges::any_of(study.vary, is_it, &Variation::name);
}

bool tells_formulation(const std::vector<std::string>& assignments) {
  return std::ranges::any_of(
      assignments, [](const std::string& one) { return one.substr(0, one.find('=')) == formulation_name; });
}

void settle_formulation(const Study& study, Case& one) {
  if (!tells_formulation(study)) settle_formulation(one.parameters, one.parameters.cut.tilt);
}

std::vector<Case> cases_of(const Study& study) {
  std::vector<Case> cases = find_sampling(study.sampling.method, study.name).sample(study);
  for (Case& one : cases) settle_formulation(study, one);
  leave_out_mirror_images(cases);
  if (study.sampling.unit_tensions) cases = in_unit_tensions(cases);
  Mistakes mistakes;
  std::set<std::string> identities;
  for (const Case& one : cases) {
    std::string which = study.name;
    for (const Variation& v : study.vary)
      which += ", " + v.name + " = " + to_text(get_parameter(one.parameters, find_parameter(v.name, which)));
    mistakes.collect([&] {
      check_consistency(one.parameters, which);
      check_sensitivities(one.sensitivities, one.parameters, which + ": sensitivities");
    });
    if (!identities.insert(one.hash()).second)
      mistakes.add(which + ": the case stands twice in the study; remove the repeated value");
  }
  mistakes.throw_if_any();
  return cases;
}

std::string case_file_text(const Case& a_case) {
  std::string text;
  for (const std::string& name : a_case.sensitivities)
    text += (text.empty() ? "sensitivities = [\"" : ", \"") + name + "\"";
  if (!text.empty()) text += "]\n\n";
  if (!a_case.body.empty()) text += "[body]\nfile = " + in_quotes(a_case.body) + "\n\n";
  text += "[case]\n";
  for (const Parameter& row : parameter_table()) {
    const std::string quote = row.is_text() ? "\"" : "";
    text += row.name + " = " + quote + to_text(get_parameter(a_case.parameters, row)) + quote +
            (row.unit.empty() ? "" : "  # " + row.unit) + "\n";
  }
  const EncodeSettings& encode = a_case.encode;
  text += "\n[encode]\nparametrization = \"" + encode.parametrization + "\"\n";
  if (encode.control_points)
    text += "control_points = [" + control_points_text(*encode.control_points) + "]\n";
  else
    text += "tolerance = " + shortest(encode.tolerance) + "\n";
  if (encode.regularisation) text += "regularisation = " + shortest(*encode.regularisation) + "\n";
  return text;
}

std::string with_settings(const Study& study, const std::vector<std::pair<std::string, Value>>& values,
                          double tolerance) {
  toml::table file = toml::parse(study.text);
  const auto section = [](toml::table& parent, std::string_view name) -> toml::table& {
    return *parent.insert(name, toml::table{}).first->second.as_table();
  };
  toml::table& a_case = section(file, "case");
  for (const auto& [name, value] : values) {
    const auto dot = name.find('.');
    a_case.erase(name);  // as one quoted key
    toml::table& group = dot == std::string::npos ? a_case : section(a_case, name.substr(0, dot));
    const std::string key = dot == std::string::npos ? name : name.substr(dot + 1);
    std::visit([&](const auto& v) { group.insert_or_assign(key, v); }, value);
  }
  toml::table& encode = section(file, "encode");
  encode.erase("control_points");
  encode.erase("regularisation");
  encode.insert_or_assign("tolerance", tolerance);
  std::ostringstream text;
  text << file << "\n";
  // Numbers in all their digits, 0.10000000000000001, in the fewest that say the same.
  const std::regex digits(R"(\d+\.\d{15,}(e[+-]?\d+)?)");
  std::string shown, all = text.str();
  auto from = all.cbegin();
  for (std::sregex_iterator it(all.begin(), all.end(), digits), end; it != end; ++it) {
    shown.append(from, (*it)[0].first).append(shortest(std::stod(it->str())));
    from = (*it)[0].second;
  }
  return shown.append(from, all.cend());
}

}  // namespace cleft
