// Regression of many quantities at once on few parameters, by kernels. Every method here is linear in the
// data: a prediction is a weighted sum of the cases. Leaving a case out then costs nothing (Dubrule 1983;
// Rasmussen and Williams, Gaussian Processes for Machine Learning, 5.4.2): with the covariance matrix K of
// the cases and their data Y, the data of case i differ from the prediction of all others by
//
//     r_i = (Y K^-1)_i / (K^-1)_ii        with variance 1 / (K^-1)_ii
// Derivatives of the data (Hermite data) are further rows of K, whose covariances are derivatives of the
// kernel (Solak et al., Derivative observations in Gaussian process models, 2003); a case left out takes its
// derivatives with it, and the quotient becomes a solution with its block of K^-1.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace cleft {

/// Of the root mean square of all cases' data: smaller ones are compared with this. A cut along the tension
/// does not open, and what is left out of nothing tells nothing about a method.
inline constexpr double least_size = 0.2;

/// The n cases of a regression. Without gram there are no leave-one-out errors.
struct TrainingCases {
  Eigen::MatrixXd features;  ///< n x d, from -1 to 1
  Eigen::MatrixXd loads;     ///< n x k: data are linear in them
  Eigen::MatrixXd gram;      ///< n + q: inner products of the data of the cases, followed by the slopes
  /// q derivatives of cases' data, along directions in which features and load change as given.
  struct Slopes {
    std::vector<Eigen::Index> of;     ///< case
    Eigen::MatrixXd features, loads;  ///< q x d, q x k
  } slopes = {};
  /// Whether the data of cases are without noise of their own: what a fit leaves of them is a smooth function
  /// of the parameters.
  bool fitted_alike = false;
};

/// k(x, y) = load_x . load_y (trend (1 + x . y)^degree + correlation(|(x - y) / lengths|)), and on
/// the diagonal `nugget` k(0, 0). Without correlation: least squares by polynomials of a total degree.
struct Covariance {
  enum class Correlation { none, gaussian, matern };  ///< Matern's of 5/2
  std::string name;
  int degree = 1;
  Correlation correlation = Correlation::none;
  double trend = 1, nugget = 1e-9;
  Eigen::VectorXd lengths;
  double slope_nugget = 1e-6;  ///< the same of slopes

  double operator()(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const;
  /// Of each row of x with y, without the loads.
  Eigen::ArrayXd of_rows(const Eigen::MatrixXd& x, const Eigen::RowVectorXd& y) const;

  /// Without the loads, of each row of x with y: the value, its derivatives as x moves along the row of dx
  /// and as y moves along dy, and that as both do.
  struct Jets {
    Eigen::ArrayXd value, by_x, by_y, by_both;
  };
  Jets along_rows(const Eigen::MatrixXd& x, const Eigen::MatrixXd& dx, const Eigen::VectorXd& y,
                  const Eigen::VectorXd& dy) const;
};

class KernelRegression {
 public:
  KernelRegression(const TrainingCases& cases, Covariance covariance);

  const Covariance& covariance() const { return covariance_; }
  Eigen::Index rows() const { return matrix_.rows(); }  ///< cases and slopes
  struct LeftOut {
    Eigen::MatrixXd weights;     ///< column i: of all cases (and slopes behind them) whose sum of data is r_i
    Eigen::VectorXd deviations;  ///< standard deviation of r_i
  };
  LeftOut left_out() const;
  /// K^-1, of the cases and the slopes behind them.
  Eigen::MatrixXd inverse() const;
  /// sqrt of the mean of |r_i|^2 / |y_i|^2 (least_size).
  double left_out_error() const { return left_out_error_; }
  /// The root of what the likelihood of m rows of data y, of unknown size, goes as the power -m of:
  /// sum y^T K^-1 y |K|^(1/m) (Rasmussen and Williams, 5.4.1). `gram`: that of the cases.
  double by_likelihood(const Eigen::MatrixXd& gram) const;

  /// Predictions at features under loads, m x d and m x k.
  struct Weights {
    Eigen::MatrixXd of_rows;     ///< a column for each: weights of the cases, followed by the slopes
    Eigen::VectorXd deviations;  ///< standard deviations, in the unit of LeftOut::deviations
  };
  Weights weights(const Eigen::MatrixXd& features, const Eigen::MatrixXd& loads) const;
  /// Predictions of r quantities, r x m, at once: data * weights = coefficients * covariances with the rows,
  /// so that coefficients which are solved for once make a prediction cost n r, where weights cost n^2.
  /// data: r x rows().
  Eigen::MatrixXd coefficients(const Eigen::MatrixXd& data) const;
  Eigen::MatrixXd sums(const Eigen::MatrixXd& coefficients, const Eigen::MatrixXd& features,
                       const Eigen::MatrixXd& loads) const;
  /// Covariances of the errors of predictions, m x m, in the square of that unit.
  Eigen::MatrixXd covariance_between(const Eigen::MatrixXd& features, const Eigen::MatrixXd& loads) const;
  nlohmann::ordered_json data() const;  ///< see Features

 private:
  Eigen::MatrixXd against(const Eigen::MatrixXd& features, const Eigen::MatrixXd& loads) const;

  TrainingCases cases_;     // without the gram matrix
  Eigen::MatrixXd matrix_;  // without the nugget
  Covariance covariance_;
  double nugget_;
  Eigen::VectorXd nuggets_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
  double left_out_error_ = 0;
};

/// All methods, with lengths and nuggets of least left_out_error(): polynomials, radial basis functions, and
/// a Gaussian process with a length for each feature, of which the likelihood counts too where there are six
/// scattered cases a feature. Of cases on a sparse grid that are fitted alike there is one, a process with
/// lengths of whole ranges that passes through all of them. If there are slopes, all methods use them.
std::vector<KernelRegression> all_methods(const TrainingCases& cases);

}  // namespace cleft
