// From a snapshot to its field: the fit and its error report. Paper, sections 3.2 and 3.3.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "encoder/field/encoded.h"
#include "encoder/fit_store.h"
#include "encoder/ladder.h"
#include "encoder/series.h"

namespace cleft {

/// A bound of errors: relative to a field's scale (of the displacement: its largest), or in its own unit.
struct FieldTolerance {
  double value = 0.01;
  bool absolute = false;
  std::string unit = {};  ///< that was given with it, if absolute

  double limit(double scale) const { return absolute ? value : value * scale; }
};

struct EncodeOptions {
  std::string parametrization = "front";
  /// Bound of node_error: the largest error at any node and frame, relative to the largest displacement. The
  /// encoder takes the fewest knots and the coarsest quanta that satisfy it.
  double tolerance = 0.01;
  /// Instead of `tolerance`, by the name of a field; the displacement's is "displacement".
  std::map<std::string, FieldTolerance> tolerances = {};

  FieldTolerance tolerance_of(const std::string& field) const {
    const auto found = tolerances.find(field);
    return found == tolerances.end() ? FieldTolerance{tolerance, false} : found->second;
  }
  /// Instead of a tolerance: spans of the bases. Rounding of the coefficients then costs about a hundredth of
  /// the error.
  std::optional<Rung> rung;
  /// The strength of the regularisation on that rung (SeriesFit); by default the one that the data allow.
  std::optional<double> regularisation = {};
};

/// Fits cubic B-splines over a parametrisation of (u, v, w, t), with a break across the cut, to the
/// displacements from frame 0, by regularised least squares over all frames. Coefficients are multiples of
/// field.quantum. Further quantities of the series are fitted on the knots of the displacement, on even ones
/// of their own where one is off by more than twice its tolerance and halves that with them, or else on
/// denser ones for all fields; if nothing moves, on those that they need; the tolerance bounds each relative
/// to its own largest value. Derivatives by parameters are fitted on the same knots, without a bound. Without
/// a cut there is no break, and the parametrisation is "fixed". `progress` is called with the current step.
/// `store`: made with the same options for series of these places and times, so that what depends on them
/// alone is computed once.
Encoded encode(const Series& series, const EncodeOptions& options,
               const std::function<void(const std::string&)>& progress,
               std::shared_ptr<FitStore> store = nullptr);

/// Matrices for series of the same places and times as this one, which must live as long; at most `bytes` of
/// factors are kept.
std::shared_ptr<FitStore> fit_store(const Series& series, const EncodeOptions& options, double bytes = 0);

}  // namespace cleft
