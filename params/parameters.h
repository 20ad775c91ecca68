// The parameters of a case: what the solver is told. Each is stated once, here and in the
// table.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace cleft {

struct Parameters {
  struct Patch {
    double length = 60, width = 40, height = 8;
  } patch;
  struct Cut {
    double length = 30, depth = 3;
    std::string contact = "false";
    double radius = 0, tilt = 0, count = 1, spacing = 5, branch = 0;
    std::string frames = "column";
  } cut;
  struct Mesh {
    double element_size = 1, grading = 1;
    double cut_length = 0, cut_depth = 0;
  } mesh;
  struct Skin {
    double thickness = 1.5, young_modulus = 0.13, poisson_ratio = 0.4;
    double prestress_u = 0.01, prestress_v = 0.03, prestress_uv = 0;
    std::string initial_stress_stiffness = "false";
  } skin;
  struct Tissue {
    double young_modulus = 0.02, poisson_ratio = 0.4;
    std::string formulation = "displacement";
  } tissue;
  struct Foundation {
    double stiffness = 0.005, side_stiffness = 0.005;
  } foundation;
};

/// One row of the table. A value is a number, or one of `choices`; a switch is "false" or "true".
struct Parameter {
  using Access = std::variant<double& (*)(Parameters&), std::string& (*)(Parameters&)>;
  std::string name;  ///< dotted, as in study files
  std::string unit;
  double least, greatest;  ///< range of a number; both ends are allowed unless `open`
  bool open;               ///< the lower end itself is not allowed (a length must exceed 0)
  std::vector<std::string> choices;
  std::string help;
  Access access;
  bool whole = false;  ///< takes whole numbers only

  bool is_text() const { return access.index() == 1; }
};

/// All parameters, in the order in which they are shown.
const std::vector<Parameter>& parameter_table();

/// The row of a name; throws InputError "<where>: unknown parameter ... (did you mean ...?)".
const Parameter& find_parameter(const std::string& name, const std::string& where);

/// Names of the rows.
std::vector<std::string> parameter_names();

using Value = std::variant<double, std::string>;

/// Checks type, range and choices; throws InputError "<where>: <name> = <value>: must be ...".
void check_value(const Parameter& parameter, const Value& value, const std::string& where);

/// check_value, then stores the value.
void set_parameter(Parameters& parameters, const std::string& name, const Value& value,
                   const std::string& where);

/// "NAME=VALUE" as given to --set.
void set_from_text(Parameters& parameters, const std::string& assignment, const std::string& where);

/// All parameters with defaults, units and help: a line each, for --help.
std::string parameter_help();

Value get_parameter(const Parameters& parameters, const Parameter& row);

/// Text of a value, numbers in their shortest form.
std::string to_text(const Value& value);

/// What no single range can say: the cut lies within the patch. Throws InputError naming both values.
void check_consistency(const Parameters& parameters, const std::string& where);

/// Nodes of the mesh, about, before it is made. Throws InputError as check_consistency() does.
double estimated_nodes(const Parameters& parameters);

/// Identity of what the solver sees: a hash (16 hexadecimal digits) of every parameter as resolved, and of
/// the snapshot format's version.
std::string solve_hash(const Parameters& parameters);

}  // namespace cleft
