#include "params/parameters/table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <type_traits>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A row of which only the name and the member are known; `Member` is a lambda that returns a reference to
/// the member of the parameters it is given.
template <class Member>
Parameter row_of_member(const char* name, Member) {
  using T = std::remove_reference_t<std::invoke_result_t<Member, Parameters&>>;
  Parameter row{};
  row.name = name;
  row.address = [](const Parameters& p) -> const void* { return &Member{}(p); };
  if constexpr (std::is_enum_v<T>)
    row.access = Parameter::Choice{[](const Parameters& p) { return static_cast<std::size_t>(Member{}(p)); },
                                   [](Parameters& p, std::size_t i) { Member{}(p) = static_cast<T>(i); }};
  else
    row.access = +[](Parameters& p) -> T& { return Member{}(p); };
  return row;
}

#define CLEFT_NAMED(name, path) \
  row_of_member(                \
      name, [](auto& p) -> auto& { return p.path; })
#define CLEFT_MEMBER(path) CLEFT_NAMED(#path, path)

std::vector<Parameter> make_table() {
  const auto between = [](Parameter row, std::string unit, double least, double greatest, std::string help) {
    row.unit = std::move(unit), row.least = least, row.greatest = greatest, row.help = std::move(help);
    return row;
  };
  const auto not_negative = [&](Parameter row, std::string unit, std::string help) {
    return between(std::move(row), std::move(unit), 0, infinity, std::move(help));
  };
  const auto positive = [&](Parameter row, std::string unit, std::string help) {
    row.open = true;
    return not_negative(std::move(row), std::move(unit), std::move(help));
  };
  const auto stress = [&](Parameter row, std::string help) {
    return between(std::move(row), "MPa", -infinity, infinity, std::move(help));
  };
  const auto poisson = [&](Parameter row, double greatest, std::string help) {
    return between(std::move(row), "", 0, greatest, std::move(help));
  };
  const auto whole_between = [&](Parameter row, std::string unit, double least, double greatest,
                                 std::string help) {
    row.whole = true;
    return between(std::move(row), std::move(unit), least, greatest, std::move(help));
  };
  const auto choice = [](Parameter row, std::vector<std::string> choices, std::string help) {
    row.choices = std::move(choices), row.help = std::move(help);
    return row;
  };
  const auto later = [](Parameter row) {
    row.added_later = true;
    return row;
  };
  const std::vector<std::string> no_or_yes = {"false", "true"};
  return {
      choice(CLEFT_MEMBER(model), {"small", "finite"},
             "small: strains are small, all is linear; finite: finite strains, by Newton's method"),
      positive(CLEFT_MEMBER(patch.length), "mm", "length of the tissue patch along the cut (u)"),
      positive(CLEFT_MEMBER(patch.width), "mm", "width of the patch across the cut (v)"),
      positive(CLEFT_MEMBER(patch.height), "mm", "height of the patch below the skin (w)"),
      between(CLEFT_MEMBER(patch.slope), "", -2, 2,
              "how much deeper the patch's bottom lies for each mm toward +v, near the cut; it levels off "
              "between a quarter and seven quarters of patch.height"),
      choice(CLEFT_MEMBER(patch.bottom), {"springs", "bone"},
             "springs: the bottom is held by foundation.stiffness; bone: the tissue is grown to bone"),
      positive(CLEFT_MEMBER(cut.length), "mm", "length of the cut (an arc: along it), centred on the patch"),
      positive(CLEFT_MEMBER(cut.depth), "mm", "depth of the cut below the skin"),
      choice(CLEFT_MEMBER(cut.contact), no_or_yes,
             "true: the lips of the cut press on each other, without friction"),
      not_negative(CLEFT_MEMBER(cut.radius), "mm", "radius of a cut that curves toward +v; 0: straight"),
      between(CLEFT_MEMBER(cut.curvature), "1/mm", -0.2, 0.2,
              "curvature of the cut, positive toward +v, in a patch that bends with it, for fields; the "
              "prestress is that at the middle of the cut, and keeps its direction in the plane"),
      between(
          later(CLEFT_MEMBER(cut.curvature_rate)), "1/mm^2", -0.02, 0.02,
          "by how much cut.curvature, which is that at the middle of the cut, grows for each mm along it"),
      between(CLEFT_MEMBER(cut.tilt), "degrees", -60, 60,
              "tilt of the blade: the cut's bottom lies toward +v"),
      whole_between(CLEFT_MEMBER(cut.count), "", 1, 100,
                    "parallel cuts, made one after the other from -v to +v"),
      positive(CLEFT_MEMBER(cut.spacing), "mm", "distance between parallel cuts (v)"),
      not_negative(CLEFT_MEMBER(cut.branch), "mm",
                   "length of a second cut, from the middle of the first toward +v, made after it; 0: none"),
      choice(CLEFT_MEMBER(cut.frames), {"column", "pair"},
             "a frame for every released column of node pairs, or for every pair"),
      choice(
          later(CLEFT_MEMBER(cut.mirrored)), no_or_yes,
          "true: fields between the cases of a study use the case's mirror image too (v to -v: bends, tilt "
          "and twist with the other sign), and the study leaves that out"),
      positive(CLEFT_MEMBER(mesh.element_size), "mm",
               "largest edge of an element along u, v and w, at the cut"),
      between(CLEFT_MEMBER(mesh.grading), "", 1, 2,
              "growth from one element to the next away from the cut; 1: none"),
      choice(later(CLEFT_MEMBER(mesh.elements)), {"linear", "quadratic"},
             "quadratic: wedges of 15 nodes, for errors of 3 % and less: nodes are half of mesh.element_size "
             "apart; for straight, upright cuts in small strains"),
      choice(CLEFT_MEMBER(mesh.front), {"effective", "nodes"},
             "effective: the cut ends a part of an element inside its first closed nodes, where its opening "
             "behaves as if it ended; nodes: at these nodes"),
      not_negative(
          CLEFT_MEMBER(mesh.cut_length), "mm",
          "longest cut the mesh is made for: the case's own ends at its nearest nodes; 0: the case's own"),
      not_negative(CLEFT_MEMBER(mesh.cut_depth), "mm", "deepest cut the mesh is made for; 0: the case's own"),
      positive(CLEFT_MEMBER(skin.thickness), "mm", "thickness of the skin membrane"),
      positive(CLEFT_MEMBER(skin.young_modulus), "MPa", "Young's modulus of the skin"),
      poisson(CLEFT_MEMBER(skin.poisson_ratio), 0.5, "Poisson's ratio of the skin (plane stress)"),
      stress(CLEFT_NAMED("skin.prestress_u", skin.prestress.uu), "prestress of the skin along the cut"),
      stress(CLEFT_NAMED("skin.prestress_v", skin.prestress.vv), "prestress of the skin across the cut"),
      stress(CLEFT_NAMED("skin.prestress_uv", skin.prestress.uv), "shear prestress of the skin"),
      between(CLEFT_MEMBER(skin.curvature_u), "1/mm", -0.1, 0.1,
              "curvature of the skin along the cut, positive where the body bulges; it fades away from the "
              "cut"),
      between(CLEFT_MEMBER(skin.curvature_v), "1/mm", -0.1, 0.1,
              "curvature of the skin across the cut, likewise"),
      between(CLEFT_MEMBER(skin.curvature_uv), "1/mm", -0.1, 0.1,
              "twist of the skin: how its normal turns toward +v along the cut, likewise"),
      choice(
          CLEFT_MEMBER(skin.edges), {"held", "free"},
          "held: the skin around the patch pulls at its edges, so that the closed patch is in equilibrium; "
          "free: a piece that was cut out"),
      choice(CLEFT_MEMBER(skin.initial_stress_stiffness), no_or_yes,
             "true: the prestress stiffens the skin against bending and stretching (geometric stiffness)"),
      between(
          later(CLEFT_MEMBER(skin.turning_stiffness)), "", 0, 1,
          "share of the stiffness against turning out of its plane that its prestress gives to the skin; 1 "
          "comes near to finite strains"),
      not_negative(CLEFT_MEMBER(skin.bending_stiffness), "N mm",
                   "resistance of the skin to bending: E t^3 / (12 (1 - nu^2)) of a sheet; 0: a membrane"),
      choice(CLEFT_MEMBER(skin.law), {"st-venant-kirchhoff", "neo-hookean", "fung"},
             "how the skin's stress follows finite strains; no effect in the small model"),
      between(CLEFT_MEMBER(skin.stiffening), "", 1, 1000,
              "fung: the modulus under the prestress over that without stress; 1: they are equal"),
      between(CLEFT_MEMBER(skin.fibre_share), "", 0, 0.9, "fung: share of fibres in the skin's stiffness"),
      between(CLEFT_MEMBER(skin.fibre_angle), "degrees", -180, 180,
              "fung: direction of the fibres (Langer's lines), from u toward v"),
      between(CLEFT_MEMBER(skin.fibre_dispersion), "", 0, 0.5,
              "fung: 0: all fibres in one direction; 0.5: in all directions of the skin alike"),
      positive(CLEFT_MEMBER(tissue.young_modulus), "MPa", "Young's modulus of the tissue below the skin"),
      poisson(CLEFT_MEMBER(tissue.poisson_ratio), 0.4999, "Poisson's ratio of the tissue"),
      between(CLEFT_MEMBER(tissue.prestress_share), "", 0, 1,
              "initial stress of the tissue in the plane of the skin, over the skin's prestress"),
      choice(
          CLEFT_MEMBER(tissue.formulation), {"displacement", "mean-dilatation"},
          "mean-dilatation: the volume of an element changes as a whole, for nearly incompressible tissue"),
      choice(CLEFT_MEMBER(tissue.law), {"neo-hookean", "st-venant-kirchhoff"},
             "how the tissue's stress follows finite strains; no effect in the small model"),
      not_negative(CLEFT_MEMBER(foundation.stiffness), "N/mm^3", "springs under the bottom"),
      not_negative(CLEFT_MEMBER(foundation.side_stiffness), "N/mm^3", "springs on the four sides"),
  };
}

std::string range_text(const Parameter& p) {
  const std::string unit = p.unit.empty() ? "" : " " + p.unit;
  if (p.greatest == infinity)
    return std::string(p.open ? "greater than " : "at least ") + shortest(p.least) + unit;
  return (p.whole ? "a whole number between " : "between ") + shortest(p.least) + " and " +
         shortest(p.greatest) + unit;
}

}  // namespace

const std::vector<Parameter>& parameter_table() {
  static const std::vector<Parameter> table = make_table();
  return table;
}

std::vector<std::string> parameter_names() {
  std::vector<std::string> names;
  for (const Parameter& row : parameter_table()) names.push_back(row.name);
  return names;
}

const Parameter* find_parameter(const std::string& name) {
  static const auto rows = [] {
    std::map<std::string, const Parameter*> by_name;
    for (const Parameter& row : parameter_table()) by_name[row.name] = &row;
    return by_name;
  }();
  const auto found = rows.find(name);
  return found == rows.end() ? nullptr : found->second;
}

const Parameter& row_at(const Parameters& parameters, const void* address) {
  const std::vector<Parameter>& table = parameter_table();
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const Parameter& row) { return row.address(parameters) == address; });
  CLEFT_CHECK(found - table.begin(), <, std::ssize(table));
  return *found;
}

const Parameter& find_parameter(const std::string& name, const std::string& where) {
  if (const Parameter* row = find_parameter(name)) return *row;
  throw InputError(where + ": unknown parameter '" + name + "'" + did_you_mean(name, parameter_names()));
}

void check_value(const Parameter& parameter, const Value& value, const std::string& where) {
  const auto refuse = [&](const std::string& rule) {
    throw InputError(where + ": " + parameter.name + " = " + to_text(value) + ": must be " + rule);
  };
  if (parameter.is_text()) {
    std::string list;
    for (const std::string& choice : parameter.choices)
      list += (list.empty() ? "\"" : " or \"") + choice + "\"";
    const std::string* text = std::get_if<std::string>(&value);
    if (!text ||
        std::find(parameter.choices.begin(), parameter.choices.end(), *text) == parameter.choices.end())
      refuse(list);
    return;
  }
  const double* number = std::get_if<double>(&value);
  if (!number || !std::isfinite(*number)) refuse("a number");
  if (*number < parameter.least || *number > parameter.greatest ||
      (parameter.open && *number == parameter.least) || (parameter.whole && *number != std::round(*number)))
    refuse(range_text(parameter));
}

void set_parameter(Parameters& parameters, const std::string& name, const Value& value,
                   const std::string& where) {
  const Parameter& row = find_parameter(name, where);
  check_value(row, value, where);
  put_parameter(parameters, row, value);
}

void put_parameter(Parameters& parameters, const Parameter& row, const Value& value) {
  if (const auto* number = std::get_if<Parameter::Number>(&row.access)) {
    (*number)(parameters) = std::get<double>(value);
    return;
  }
  const std::size_t index =
      std::find(row.choices.begin(), row.choices.end(), std::get<std::string>(value)) - row.choices.begin();
  if (const auto* flag = std::get_if<Parameter::Switch>(&row.access))
    (*flag)(parameters) = index == 1;
  else
    std::get<Parameter::Choice>(row.access).set(parameters, index);
}

void set_from_text(Parameters& parameters, const std::string& assignment, const std::string& where) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos) throw InputError(where + " " + assignment + ": expected NAME=VALUE");
  const std::string name = assignment.substr(0, equals), text = assignment.substr(equals + 1);
  const bool is_text = find_parameter(name, where).is_text();
  set_parameter(parameters, name, is_text ? Value(text) : Value(parse_number(text, where + " " + name)),
                where);
}

Value get_parameter(const Parameters& parameters, const Parameter& row) {
  auto& readable = const_cast<Parameters&>(parameters);  // the accessors serve reading and writing alike
  if (const auto* number = std::get_if<Parameter::Number>(&row.access)) return (*number)(readable);
  if (const auto* flag = std::get_if<Parameter::Switch>(&row.access))
    return row.choices.at((*flag)(readable) ? 1 : 0);
  return row.choices.at(std::get<Parameter::Choice>(row.access).get(parameters));
}

std::string to_text(const Value& value) {
  const double* number = std::get_if<double>(&value);
  return number ? shortest(*number) : std::get<std::string>(value);
}

std::string parameter_help() {
  std::string text = "Parameters (defaults; lengths mm, stresses MPa):\n";
  for (const Parameter& row : parameter_table()) {
    std::string line = "  " + row.name + " = " + to_text(get_parameter(Parameters(), row)) + " " + row.unit;
    line.resize(std::max<std::size_t>(line.size() + 1, 40), ' ');
    text += line + row.help + "\n";
  }
  return text;
}

}  // namespace cleft
