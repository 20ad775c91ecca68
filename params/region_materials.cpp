#include "params/region_materials.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "params/toml_value.h"

namespace cleft {

namespace {

constexpr const char* section_of_faces = "faces";
constexpr std::size_t most_sections = 255;  // a wedge has the number of its own in a byte

class RegionFileReader {
 public:
  RegionFileReader(const std::string& path, const toml::table& file) : path_(path), file_(file) {}

  RegionFile read() {
    for (const auto& [key, node] : file_) {
      const std::string name(key.str());
      const toml::table* table = node.as_table();
      if (!table)
        mistakes_.add(place_of(path_, node) + ": '" + name + "' must be a section [" + name + "]");
      else if (name == section_of_faces)
        read_faces(*table);
      else
        read_section(name, *table);
    }
    mistakes_.throw_if_any();
    if (result_.sections.empty()) throw FileError(path_, "has no section; each one names a material: [fat]");
    if (result_.sections.size() > most_sections)
      throw FileError(path_, "has " + std::to_string(result_.sections.size()) + " materials; at most " +
                                 std::to_string(most_sections));
    std::sort(lines_.begin(), lines_.end());  // toml++ sorts sections by their names
    RegionFile sorted{{}, result_.faces};
    for (const auto& [line, number] : lines_) sorted.sections.push_back(result_.sections[number]);
    return sorted;
  }

 private:
  void read_faces(const toml::table& table) {
    FaceRegions& faces = result_.faces.emplace();
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      const toml::node& value = node;
      mistakes_.collect([&] {
        const std::vector<std::string> known = {"skin", "bone", "free"};
        std::vector<int>* lists[] = {&faces.skin, &faces.bone, &faces.free};
        const auto found = std::find(known.begin(), known.end(), name);
        if (found == known.end())
          throw InputError(place_of(path_, value) + ": unknown faces '" + name + "'" +
                           did_you_mean(name, known));
        *lists[found - known.begin()] = numbers(value, name);
      });
    }
  }

  void read_section(const std::string& name, const toml::table& table) {
    if (name.empty() || name.find('\n') != std::string::npos)
      return mistakes_.add(place_of(path_, table) + ": a material's name must be one line of text");
    RegionSection section{{name}, {}, {}, place_of(path_, table)};
    const std::vector<std::string> known = {"region", "to_depth", "young_modulus", "poisson_ratio"};
    for (const auto& [key, node] : table) {
      const std::string entry(key.str());
      const toml::node& value = node;
      mistakes_.collect([&] {
        if (entry == "region")
          section.regions = numbers(value, entry);
        else if (entry == "to_depth")
          section.to_depth = number(value, entry, 1e-3, 1e6, "mm below the skin");
        else if (entry == "young_modulus")
          section.material.young_modulus = number(value, entry, 1e-9, 1e9, "MPa");
        else if (entry == "poisson_ratio")
          section.material.poisson_ratio = number(value, entry, 0, 0.4999, "no unit");
        else
          throw InputError(place_of(path_, value) + ": [" + name + "] knows no '" + entry + "'" +
                           did_you_mean(entry, known));
      });
    }
    lines_.emplace_back(table.source().begin.line, result_.sections.size());
    result_.sections.push_back(std::move(section));
  }

  double number(const toml::node& node, const std::string& name, double least, double most,
                const std::string& unit) const {
    const auto value = node.value<double>();
    if (!value || !(*value >= least && *value <= most))
      throw InputError(place_of(path_, node) + ": " + name + (value ? " = " + shortest(*value) : "") +
                       ": must be a number from " + shortest(least) + " to " + shortest(most) + " (" + unit +
                       ")");
    return *value;
  }

  /// One number or a list of them.
  std::vector<int> numbers(const toml::node& node, const std::string& name) const {
    std::vector<int> result;
    const auto take = [&](const toml::node& one) {
      const auto value = one.value_exact<std::int64_t>();
      if (!value || std::abs(*value) > 1'000'000'000)
        throw InputError(place_of(path_, node) + ": " + name +
                         ": must be a whole number, or a list of them: the numbers of the cells' array");
      result.push_back(static_cast<int>(*value));
    };
    if (const toml::array* list = node.as_array())
      for (const toml::node& one : *list) take(one);
    else
      take(node);
    return result;
  }

  const std::string& path_;
  const toml::table& file_;
  RegionFile result_;
  std::vector<std::pair<toml::source_index, std::size_t>> lines_;
  Mistakes mistakes_;
};

}  // namespace

RegionFile read_region_file(const std::string& path) {
  const toml::table file = parse_toml(read_text_file(path), path);
  return RegionFileReader(path, file).read();
}

}  // namespace cleft
