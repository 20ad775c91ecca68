#include "params/parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "params/hash.h"

namespace cleft {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int hash_version =
    3;  // raise when the same parameters no longer give the same snapshot, or its format changes

#define CLEFT_NUMBER(path) +[](Parameters& p) -> double& { return p.path; }
#define CLEFT_TEXT(path) +[](Parameters& p) -> std::string& { return p.path; }

std::vector<Parameter> make_table() {
  const auto positive = [](std::string name, std::string unit, std::string help, Parameter::Access access) {
    return Parameter{std::move(name), std::move(unit), 0, infinity, true, {}, std::move(help), access};
  };
  const auto not_negative = [](std::string name, std::string unit, std::string help,
                               Parameter::Access access) {
    return Parameter{std::move(name), std::move(unit), 0, infinity, false, {}, std::move(help), access};
  };
  const auto stress = [](std::string name, std::string help, Parameter::Access access) {
    return Parameter{std::move(name), "MPa", -infinity, infinity, false, {}, std::move(help), access};
  };
  const auto poisson = [](std::string name, double greatest, std::string help, Parameter::Access access) {
    return Parameter{std::move(name), "", 0, greatest, false, {}, std::move(help), access};
  };
  const auto choice = [](std::string name, std::vector<std::string> choices, std::string help,
                         Parameter::Access access) {
    return Parameter{std::move(name), "", 0, 0, false, std::move(choices), std::move(help), access};
  };
  const auto between = [](std::string name, std::string unit, double least, double greatest, std::string help,
                          Parameter::Access access) {
    return Parameter{std::move(name), std::move(unit), least, greatest, false, {}, std::move(help), access};
  };
  const auto whole_between = [&](std::string name, std::string unit, double least, double greatest,
                                 std::string help, Parameter::Access access) {
    Parameter row = between(std::move(name), std::move(unit), least, greatest, std::move(help), access);
    row.whole = true;
    return row;
  };
  const std::vector<std::string> no_or_yes = {"false", "true"};
  return {
      positive("patch.length", "mm", "length of the tissue patch along the cut (u)",
               CLEFT_NUMBER(patch.length)),
      positive("patch.width", "mm", "width of the patch across the cut (v)", CLEFT_NUMBER(patch.width)),
      positive("patch.height", "mm", "height of the patch below the skin (w)", CLEFT_NUMBER(patch.height)),
      positive("cut.length", "mm", "length of the cut (an arc: along it), centred on the patch",
               CLEFT_NUMBER(cut.length)),
      positive("cut.depth", "mm", "depth of the cut below the skin", CLEFT_NUMBER(cut.depth)),
      choice("cut.contact", no_or_yes, "true: the lips of the cut press on each other, without friction",
             CLEFT_TEXT(cut.contact)),
      not_negative("cut.radius", "mm", "radius of a cut that curves toward +v; 0: straight",
                   CLEFT_NUMBER(cut.radius)),
      between("cut.tilt", "degrees", -60, 60, "tilt of the blade: the cut's bottom lies toward +v",
              CLEFT_NUMBER(cut.tilt)),
      whole_between("cut.count", "", 1, 100, "parallel cuts, made one after the other from -v to +v",
                    CLEFT_NUMBER(cut.count)),
      positive("cut.spacing", "mm", "distance between parallel cuts (v)", CLEFT_NUMBER(cut.spacing)),
      not_negative("cut.branch", "mm",
                   "length of a second cut, from the middle of the first toward +v, made after it; 0: none",
                   CLEFT_NUMBER(cut.branch)),
      choice("cut.frames", {"column", "pair"},
             "a frame for every released column of node pairs, or for every pair", CLEFT_TEXT(cut.frames)),
      positive("mesh.element_size", "mm", "largest edge of an element along u, v and w, at the cut",
               CLEFT_NUMBER(mesh.element_size)),
      between("mesh.grading", "", 1, 2, "growth from one element to the next away from the cut; 1: none",
              CLEFT_NUMBER(mesh.grading)),
      not_negative(
          "mesh.cut_length", "mm",
          "longest cut the mesh is made for: the case's own ends at its nearest nodes; 0: the case's own",
          CLEFT_NUMBER(mesh.cut_length)),
      not_negative("mesh.cut_depth", "mm", "deepest cut the mesh is made for; 0: the case's own",
                   CLEFT_NUMBER(mesh.cut_depth)),
      positive("skin.thickness", "mm", "thickness of the skin membrane", CLEFT_NUMBER(skin.thickness)),
      positive("skin.young_modulus", "MPa", "Young's modulus of the skin", CLEFT_NUMBER(skin.young_modulus)),
      poisson("skin.poisson_ratio", 0.5, "Poisson's ratio of the skin (plane stress)",
              CLEFT_NUMBER(skin.poisson_ratio)),
      stress("skin.prestress_u", "prestress of the skin along the cut", CLEFT_NUMBER(skin.prestress_u)),
      stress("skin.prestress_v", "prestress of the skin across the cut", CLEFT_NUMBER(skin.prestress_v)),
      stress("skin.prestress_uv", "shear prestress of the skin", CLEFT_NUMBER(skin.prestress_uv)),
      choice("skin.initial_stress_stiffness", no_or_yes,
             "true: the prestress stiffens the skin against bending and stretching (geometric stiffness)",
             CLEFT_TEXT(skin.initial_stress_stiffness)),
      positive("tissue.young_modulus", "MPa", "Young's modulus of the tissue below the skin",
               CLEFT_NUMBER(tissue.young_modulus)),
      poisson("tissue.poisson_ratio", 0.4999, "Poisson's ratio of the tissue",
              CLEFT_NUMBER(tissue.poisson_ratio)),
      choice("tissue.formulation", {"displacement", "mean-dilatation"},
             "mean-dilatation: the volume of an element changes as a whole, for nearly incompressible tissue",
             CLEFT_TEXT(tissue.formulation)),
      not_negative("foundation.stiffness", "N/mm^3", "springs under the bottom",
                   CLEFT_NUMBER(foundation.stiffness)),
      not_negative("foundation.side_stiffness", "N/mm^3", "springs on the four sides",
                   CLEFT_NUMBER(foundation.side_stiffness)),
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

const Parameter& find_parameter(const std::string& name, const std::string& where) {
  for (const Parameter& row : parameter_table())
    if (row.name == name) return row;
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
  if (row.is_text())
    std::get<1>(row.access)(parameters) = std::get<std::string>(value);
  else
    std::get<0>(row.access)(parameters) = std::get<double>(value);
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
  if (row.is_text()) return std::get<1>(row.access)(readable);
  return std::get<0>(row.access)(readable);
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

std::string solve_hash(const Parameters& parameters) {
  std::string text = "cleft case " + std::to_string(hash_version) + "\n";
  for (const Parameter& row : parameter_table())
    text += row.name + "=" + to_text(get_parameter(parameters, row)) + "\n";
  return sha256(text).substr(0, 16);
}

}  // namespace cleft
