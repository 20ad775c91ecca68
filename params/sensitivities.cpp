#include "params/sensitivities.h"

#include <algorithm>

#include "base/error.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

std::string group_of(const Parameter& row) { return row.name.substr(0, row.name.find('.')); }

/// Groups of what K and f depend on smoothly: materials and springs. With patch, cut and mesh the mesh
/// changes in steps.
std::vector<std::string> smooth_groups() {
  std::vector<std::string> groups;
  for (const Parameter& row : parameter_table()) {
    const std::string group = group_of(row);
    if (!row.is_text() && group != "patch" && group != "cut" && group != "mesh" &&
        std::find(groups.begin(), groups.end(), group) == groups.end())
      groups.push_back(group);
  }
  return groups;
}

/// Those of the skin's shape belong to the mesh too.
bool shapes_the_mesh(const Parameters& p, const Parameter& row) {
  const void* member = row.address(p);
  return member == &p.skin.curvature_u || member == &p.skin.curvature_v || member == &p.skin.curvature_uv;
}

/// "a, b or c".
std::string either(const std::vector<std::string>& names) {
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) text += (i + 1 < names.size() ? ", " : " or ") + names[i];
  return text;
}

}  // namespace

void check_sensitivities(const std::vector<std::string>& names, const Parameters& parameters,
                         const std::string& where) {
  if (!names.empty() && parameters.cut.contact && parameters.model == Model::finite)
    throw InputError(where +
                     ": with contact the series is differentiated in small strains only; set cut.contact to "
                     "false, or model to \"small\"");
  const std::vector<std::string> groups = smooth_groups();
  for (const std::string& name : names) {
    const Parameter& row = find_parameter(name, where);
    if (row.is_text() || std::find(groups.begin(), groups.end(), group_of(row)) == groups.end())
      throw InputError(where + " " + name + ": must be a number of " + either(groups));
    if (shapes_the_mesh(parameters, row))
      throw InputError(std::string(where).append(" ").append(name) +
                       ": is a shape, with which the mesh changes; vary it in a study");
    // Its entries of the matrix are not there, and a skin of less than 0 does not exist.
    if (name == row_of(parameters, parameters.skin.bending_stiffness).name &&
        parameters.skin.bending_stiffness == 0)
      throw InputError(std::string(where).append(" ").append(name) +
                       ": is 0, where it has no derivative; set it above 0");
  }
}

bool has_sensitivity(const std::string& name, const Parameters& parameters) {
  try {
    check_sensitivities({name}, parameters, "");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace cleft
