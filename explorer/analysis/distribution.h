// How likely the values of a parameter are.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace OT {
class Distribution;
}

namespace cleft {

class InputDistribution {
 public:
  /// NAME=uniform(from, to), loguniform(from, to), normal(mean, deviation), triangular(from, peak, to), or
  /// NAME=FILE.csv: the values of its one column, or of the column of that name. Throws InputError with what
  /// is expected.
  explicit InputDistribution(const std::string& text);
  /// Uniform from `least` to `greatest`; in the logarithm where the greatest is ten times the least or more.
  InputDistribution(const std::string& name, double least, double greatest);

  const std::string& name() const { return name_; }
  const std::string& text() const { return text_; }  ///< "uniform(0.01, 0.04)"
  double quantile(double part) const;
  const OT::Distribution& law() const { return *law_; }

 private:
  std::string name_, text_;
  std::shared_ptr<const OT::Distribution> law_;
};

/// For each name the one that is given, or the default of its range. Throws InputError if a name is none of
/// these, or given twice.
struct RangeOfName {
  std::string name;
  double least, greatest;
};
std::vector<InputDistribution> distributions_of(const std::vector<RangeOfName>& ranges,
                                                const std::vector<std::string>& given);

}  // namespace cleft
