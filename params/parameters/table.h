// The table of parameters: a row for each number, switch and choice of Parameters, with its name in files,
// its unit, its range and its help.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "params/parameters/parameters.h"

namespace cleft {

/// A value as in files, commands and expressions: a number, or the text of a choice ("false" or "true" of a
/// switch).
using Value = std::variant<double, std::string>;

struct Parameter {
  using Number = double& (*)(Parameters&);
  using Switch = bool& (*)(Parameters&);
  struct Choice {  ///< an enumeration, whose values are the indices of `choices`
    std::size_t (*get)(const Parameters&);
    void (*set)(Parameters&, std::size_t);
  };

  std::string name;  ///< dotted, as in study files
  std::string unit;
  double least, greatest;            ///< range of a number; both ends are allowed unless `open`
  bool open;                         ///< the lower end itself is not allowed (a length must exceed 0)
  std::vector<std::string> choices;  ///< "false", "true" of a switch; none of a number
  std::string help;
  std::variant<Number, Switch, Choice> access;
  const void* (*address)(const Parameters&);  ///< of the member
  bool whole = false;                         ///< takes whole numbers only
  bool added_later = false;                   ///< files that do not record it have its default

  /// Whether its Value is a text.
  bool is_text() const { return access.index() != 0; }
};

/// All parameters, in the order in which they are shown.
const std::vector<Parameter>& parameter_table();

/// The row of a name; throws InputError "<where>: unknown parameter ... (did you mean ...?)".
const Parameter& find_parameter(const std::string& name, const std::string& where);

/// The same, or null if there is no such row.
const Parameter* find_parameter(const std::string& name);

/// The row of a member: row_of(p, p.skin.thickness). `address` is that of a member of `parameters`.
const Parameter& row_at(const Parameters& parameters, const void* address);
template <class Member>
requires(std::is_arithmetic_v<Member> ||
         std::is_enum_v<Member>) const Parameter& row_of(const Parameters& parameters, const Member& member) {
  return row_at(parameters, &member);
}

/// Names of the rows.
std::vector<std::string> parameter_names();

/// Checks type, range and choices; throws InputError "<where>: <name> = <value>: must be ...".
void check_value(const Parameter& parameter, const Value& value, const std::string& where);

/// check_value, then stores the value.
void set_parameter(Parameters& parameters, const std::string& name, const Value& value,
                   const std::string& where);

/// The same for a known row and a value that it accepts.
void put_parameter(Parameters& parameters, const Parameter& row, const Value& value);

/// "NAME=VALUE" as given to --set.
void set_from_text(Parameters& parameters, const std::string& assignment, const std::string& where);

Value get_parameter(const Parameters& parameters, const Parameter& row);

/// Text of a value, numbers in their shortest form.
std::string to_text(const Value& value);

/// The same for a member: text_of(p, p.cut.frames).
template <class Member>
std::string text_of(const Parameters& parameters, const Member& member) {
  return to_text(get_parameter(parameters, row_of(parameters, member)));
}

/// All parameters with defaults, units and help: one line each, for --help.
std::string parameter_help();

}  // namespace cleft
