// Dimensionless features of the parameters, by dimensional analysis.
//
// The solver's model is linear, and of the skin it knows thickness t times Young's modulus E_s and t times
// prestress alone (a membrane: docs/formats.md). With the tissue's modulus E, the cut's length L and the
// springs' k, dimensional analysis (Buckingham's theorem) leaves
//
//     d / L = q / (E L) f(E_s t / (E L), k L / E, lengths / L, Poisson's ratios; direction of q),    q = t
//     sigma0
//
// linear in q where neither contact nor the prestress's own stiffness enters. Stiffness ratios and lengths
// span decades, and displacements follow powers of them: their logarithms are the features.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "params/parameters/recorded.h"

namespace cleft {

/// How the prestress enters: its components superpose, or they are features like others.
enum class Loading { superposed, general };

class Features {
 public:
  /// Features of cases that all have the same parameters. Parameters that are not the solver's (imported
  /// data) are features themselves, or their logarithms if all values are positive.
  Features(const std::vector<RecordedParameters>& cases, Loading loading);

  int size() const { return static_cast<int>(chosen_.size()); }
  const std::vector<std::string>& names() const { return names_; }
  Loading loading() const { return loading_; }

  /// Features of a case, from -1 to 1 in the study. Of features that follow linearly from one another in
  /// all cases only the first are kept.
  Eigen::VectorXd at(const RecordedParameters& parameters) const;
  /// Distance of the features that were left out from their linear dependence on those kept, in halves of
  /// their range.
  double off(const RecordedParameters& parameters) const;
  /// Components of the prestress over its norm; (1) if it does not superpose.
  Eigen::VectorXd load(const RecordedParameters& parameters) const;
  /// Derivatives of these by a parameter; `leaves`: off() grows with it.
  struct Slope {
    Eigen::VectorXd features, load;  ///< of at() and load(), per unit of the parameter
    double log_scale = 0;            ///< of the logarithm of scale()
    bool leaves = false;
    double step = 0;  ///< step of the finite difference, units of the parameter
  };
  Slope slope(const RecordedParameters& parameters, const std::string& name) const;
  /// mm: q / E, or 1 for imported data.
  double scale(const RecordedParameters& parameters) const;

  /// What at(), load() and scale() are computed from (docs/formats.md, "Page for browsers").
  nlohmann::ordered_json data() const;

 private:
  /// A product of parameters over another.
  struct Ratio {
    std::string name;
    std::vector<std::string> over, under;  ///< names of parameters
    bool logarithm;
  };
  std::vector<Ratio> ratios_of(const RecordedParameters& parameters) const;
  std::vector<double> raw(const RecordedParameters& parameters) const;
  /// All of raw() from -1 to 1.
  Eigen::VectorXd normalised(const RecordedParameters& parameters) const;

  Loading loading_;
  bool ours_ = false;                            // parameters of the solver
  std::vector<std::string> varying_;             // parameters
  std::vector<double Prestress::*> components_;  // of the prestress
  std::vector<Ratio> ratios_;                    // of raw()
  std::vector<bool> positive_;                   // of raw(), in all cases: a logarithm exists
  Eigen::VectorXd middle_, half_;
  std::vector<int> chosen_, left_out_;
  Eigen::MatrixXd follows_;  // left out = follows_ * (1, chosen)
  std::vector<std::string> names_;
};

/// Whether `member` is the address of a component of these parameters' prestress.
bool is_prestress(const RecordedParameters& p, const void* member);
/// Whether a parameter of this name is one.
bool is_prestress(const RecordedParameters& p, const std::string& name);

/// Names of the parameters in which cases differ, sorted.
std::vector<std::string> varying_parameters(const std::vector<RecordedParameters>& cases);

}  // namespace cleft
