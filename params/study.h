// Study and case files (TOML), and their cases.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "params/parameters/table.h"

namespace cleft {

/// [encode]: how a case is fitted.
struct EncodeSettings {
  std::string parametrization = "front";  ///< or "tip" or "fixed"
  double tolerance = 0.01;  ///< largest error at any node and frame over the largest displacement
  std::optional<std::array<int, 4>>
      control_points;                    ///< along u, v (both sides together), w, t, instead of the tolerance
  std::optional<double> regularisation;  ///< with these control points; else as strong as the data allow

  /// The options of cleft encode: --parametrization, and --tolerance, or --control-points and perhaps
  /// --regularisation.
  std::vector<std::string> arguments() const;
};

/// One case, resolved.
struct Case {
  Parameters parameters;
  EncodeSettings encode;
  std::vector<std::string> sensitivities = {};  ///< parameters to differentiate the series by
  std::string body = {};         ///< [body]: the body file that is solved in place of a patch; empty: a patch
  std::string body_digest = {};  ///< SHA-256 of that file

  /// Identity of the snapshot: solve_hash(parameters), the body, and the sensitivities that it holds.
  std::string snapshot_hash() const;
  /// Identity of the encoded case, which includes that of the snapshot.
  std::string hash() const;
};

/// A range of one parameter, in its unit.
struct Range {
  double from, to;
  bool logarithmic = false;  ///< scale = "log": equal steps are equal factors
  /// alone = true: varied from the case's own value, while all others are in their middle.
  bool alone = false;
  /// shares = NAME: where both this and the other range are varied, each goes half as far from its middle;
  /// it is empty else.
  std::string shares = {};
  /// with = { ... }: further values of the cases that are varied alone.
  std::vector<std::pair<std::string, Value>> with = {};
  /// alone = "NAME": varied with the others of that name, while all but these are in their middle; else
  /// empty.
  std::string group = {};
  /// not_with = ["NAME", ...]: other ranges, in whose middle it is varied alone.
  std::vector<std::string> not_with = {};

  /// The value `part` of `whole` steps along it; the ends exactly.
  double at(double part, double whole) const;
};

/// The variation of one parameter: values in the order of the file, or a range if the sampling method draws.
struct Variation {
  std::string name;
  std::vector<Value> values;
  std::optional<Range> range;
};

/// [sampling]: how variations become cases. Count, seed and level are those of methods that draw from ranges.
struct SamplingSettings {
  std::string method = "grid";
  std::size_t count = 0;
  std::uint64_t seed = 0;
  int level = 0;  ///< of a sparse grid
  /// Each case three times, in skin whose tension is a unit along the cut, across it, or both with shear:
  /// every other tension is a sum of these.
  bool unit_tensions = false;
  /// Of adaptive sampling: the first cases are `count`; further ones are chosen a batch at a time, until the
  /// estimated error of the figure `of`, over its largest value, is below `error` everywhere in the ranges,
  /// or there are `most` cases.
  bool adapts = false;
  double error = 0;
  std::size_t most = 0, batch = 8;
  std::string of = "field";
  /// The file names no sensitivities: adaptive sampling takes those by its ranges, as far as there are any.
  bool differentiates = false;
};

/// The name under which the folder of a study keeps the body of its cases.
inline constexpr const char* kept_body = "body.h5";

/// [slurm]: the requests of jobs; entries that are empty or 0 are left to the site.
struct SlurmSettings {
  std::string partition, account, time;  ///< time: a limit as sbatch takes it, "2:30:00"
  std::vector<std::string> options;      ///< further options of sbatch
  int cases_per_task = 0;                ///< solved one after another in a task of the array
};

/// Throws InputError "<where>: ..." unless the text is one long option, with its value behind "=": anything
/// else sbatch may take for the script that it is to run.
void check_sbatch_option(const std::string& option, const std::string& where);

struct Study {
  std::string name = "study";
  bool keep_snapshots = true;   ///< keep_snapshots = "all"; "none" drops each once its field is published
  double pack_error = 0;        ///< of study.dffd at the end of a run, as cleft pack --modes; 0: none
  bool estimate_errors = true;  ///< of mesh and patch, by coarser ones; "none": as cleft solve --no-estimate
  SlurmSettings slurm;
  Case base;
  std::vector<std::string> given;  ///< names of the parameters that [case] sets
  std::vector<Variation> vary;
  SamplingSettings sampling;
  std::string text;  ///< the file as read
};

/// Reads a study or case file. All mistakes are reported at once, each with file, line and, for unknown
/// names, the nearest one: throws InputError.
Study read_study(const std::string& path);

/// The one case of a file without [vary]; `assignments` are NAME=VALUE from --set. Throws InputError if the
/// file has [vary].
Case read_case(const std::string& path, const std::vector<std::string>& assignments);

/// The cases of a study by its sampling method, each checked for consistency; throws InputError naming every
/// case's mistake.
std::vector<Case> cases_of(const Study& study);

/// Whether a study, or a list of NAME=VALUE, tells tissue.formulation.
bool tells_formulation(const Study& study);
bool tells_formulation(const std::vector<std::string>& assignments);
/// That of a case by its tilt, where the study does not tell it (params/parameters/lip_formulation.h).
void settle_formulation(const Study& study, Case& one);

/// The ranges of a study that draws from them, sorted by name: the spelling of a name in the file (dotted or
/// quoted) changes their order in the study and must not change the drawn values.
std::vector<Variation> ranges_by_name(const Study& study);

/// Text of a case file that read_case resolves to the same case: every parameter, with its unit.
std::string case_file_text(const Case& a_case);

/// The study's file with other values of some parameters of its [case] and another tolerance; comments are
/// lost.
std::string with_settings(const Study& study, const std::vector<std::pair<std::string, Value>>& values,
                          double tolerance);

}  // namespace cleft
