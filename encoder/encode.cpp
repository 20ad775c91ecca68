#include "encoder/encode.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/stopwatch.h"
#include "encoder/between_nodes.h"
#include "encoder/field/file/coded_points.h"
#include "encoder/field/unknowns.h"
#include "encoder/knot_search.h"
#include "encoder/lips.h"
#include "encoder/measure.h"
#include "encoder/parameter_derivatives.h"
#include "encoder/quantities.h"
#include "encoder/series_fit.h"
#include "encoder/supported_rungs.h"
#include "encoder/tolerance_shares.h"

namespace cleft {

namespace {

constexpr double share_of_space = 0.9;      // of the tolerance, for fits of single frames
constexpr int most_tries = 6;               // of finer knots, where frames between the probes are off
constexpr double worth_of_more = 0.75;      // what kinks and denser knots must make of an error
constexpr double greatest_condition = 1e6;  // of what nodes determine well; mostly 1e3 to 1e5
constexpr std::size_t most_fewer = 2;       // rungs, for a better condition

// Tolerances on close knots: of a frame that is fitted alone, beyond which no fit keeps one, and of the fit.
constexpr double most_on_close_knots = 3, share_of_close_fit = 0.8;
constexpr double most_to_keep = 1.5;                      // of a fit on the ladder's knots
constexpr double least_volume = 0.5, hardly_less = 0.05;  // volumes that no one need mind
constexpr std::size_t of_residual = 350;                  // bytes of a file, beside the code

/// How steps of coefficients are chosen. Rounding seldom costs as much as large ones may, nor do lips.
struct Steps {
  double share = share_of_steps;  // of the tolerance, for rounding in the worst case
  double smaller = 1.5;           // each is, than the one before
  bool with_lips = false;         // whether the lips' distance follows them
};
constexpr Steps close_steps = {share_of_close_steps, 1.2, true};
constexpr int most_steps = 12;  // that are tried beside the first

/// Of a file, those that depend on how the displacement is encoded.
std::size_t bytes_of(const Encoded& encoded) {
  const Field& field = encoded.field;
  const std::array<BSplineBasis, 4> bases{field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
  const ControlTies ties = ties_of(field.parametrization().name(), bases);
  const std::size_t bytes = coded_points(field.coefficients(), ties, bases, field.quantum).bytes.size();
  return encoded.residual ? bytes + encoded.residual->bytes() + of_residual : bytes;
}

/// What there is ahead of the front, far from it: little, or something that wants knots there.
enum class Ahead { at_rest, moving };

class Encoder {
 public:
  Encoder(const Series& series, const EncodeOptions& options,
          const std::function<void(const std::string&)>& progress, std::shared_ptr<FitStore> store,
          SeriesFit::Start start = SeriesFit::Start::zero, const std::string& name = "displacement",
          Ahead ahead = Ahead::at_rest)
      : series_(series),
        options_(options),
        progress_(progress),
        store_(std::move(store)),
        start_(start),
        ahead_(ahead) {
    parametrization_ = store_->parametrization();
    scale_ = series.largest_displacement > 0 ? series.largest_displacement : 1;
    limit_ = options.tolerance_of(name).limit(scale_);
  }

  /// The smallest rung whose spline alone keeps the tolerance; the largest there is where none does.
  Rung smallest_rung() const {
    const std::vector<Rung> rungs = supported_rungs();
    std::size_t i = sufficient(rungs);
    while (i + 1 < rungs.size() && fit_of(rungs[i]).misfit(limit_).beyond > 0) ++i;
    return rungs[std::min(i, rungs.size() - 1)];
  }

  /// The number of the rung that the search finds, if its spline is off by at most `bound`, mm.
  std::optional<std::size_t> rung_within(double bound) const {
    const std::vector<Rung> rungs = supported_rungs();
    const std::size_t rung = sufficient(rungs);
    if (fit_of(rungs[rung]).misfit(limit_).largest > bound) return std::nullopt;
    return rung;
  }

  /// On the rung of this number at least.
  Encoded run(std::size_t least = 0) const {
    if (options_.rung) {
      const SeriesFit fit = fit_of(*options_.rung);
      return {with_derivatives(with_steps(fit, above(fit.misfit(0)), {}), fit)};
    }
    const std::vector<Rung> rungs = supported_rungs();
    std::size_t rung = std::max(sufficient(rungs), std::min(least, rungs.size() - 1));
    progress_("fitting all frames");
    auto fitted = fitted_on(rungs[rung]);
    // Where knots next to the front are nearer to each other than nodes, the spline is free between them.
    // (Nodes in one plane determine no rung well.)
    for (std::size_t fewer = 1;
         fewer <= most_fewer && fewer <= rung && fitted->condition() > greatest_condition; ++fewer) {
      auto coarser = fitted_on(rungs[rung - fewer]);
      if (coarser->condition() > greatest_condition) continue;
      rung -= fewer, fitted = std::move(coarser);
      break;
    }
    Misfit misfit = fitted->misfit(share_of_fit * limit_);
    Rung chosen = rungs[rung];
    const auto try_instead = [&](const Rung& other, double worth) {
      auto another = fitted_on(other);
      const Misfit of_another = another->misfit(share_of_fit * limit_);
      if (!(of_another.largest < worth * misfit.largest)) return;
      fitted = std::move(another), misfit = of_another, chosen = other;
    };
    // What other arms do passes the ends of an arm in few frames, between those that the search for knots has
    // looked at; a single break may begin to open there, too.
    const bool single = !series_.arm && series_.middles_hold;
    for (int more = 0;
         (series_.arm || single) && more < most_tries && misfit.largest > limit_ && rung + 1 < rungs.size();
         ++more)
      try_instead(rungs[++rung], single ? worth_of_more : 1);
    if (!series_.kinks.empty() && parametrization_->moves() && misfit.largest > limit_) {
      Rung bent = chosen;
      bent.kinks = series_.kinks;
      try_instead(bent, worth_of_more);
    }
    if (series_.middles_hold && misfit.largest > far_off * limit_) {
      const std::vector<Rung> dense = supported_rungs(nodes_held_between);
      Rung denser = dense[sufficient(dense)];
      denser.kinks = chosen.kinks;
      try_instead(denser, worth_of_more);
    }
    Encoded encoded = coded(*fitted, misfit, {});
    if (misfit.largest > limit_ && misfit.largest <= most_to_keep * limit_) {
      fitted->keep(share_of_close_fit * limit_);
      if (const Misfit kept = fitted->misfit(share_of_fit * limit_); kept.largest <= limit_)
        if (Encoded other = coded(*fitted, kept, close_steps); is_better(other, encoded))
          encoded = std::move(other), misfit = kept;
    }
    if (auto close = on_close_knots(*fitted, misfit, chosen.kinks))
      if (Encoded other = coded(*close, close->misfit(share_of_fit * limit_), close_steps);
          is_better(other, encoded))
        encoded = std::move(other), fitted = std::move(close);
    encoded.field = with_derivatives(std::move(encoded.field), *fitted);
    return encoded;
  }

 private:
  /// The field of a fit, and what it leaves of the tolerance.
  Encoded coded(const SeriesFit& fit, const Misfit& misfit, const Steps& steps) const {
    Encoded encoded{with_steps(fit, misfit.beyond == 0 ? limit_ : above(misfit), steps)};
    if (encoded.field.report.spline_error * scale_ > limit_) {
      progress_("coding what the spline leaves");
      encoded.residual = residual_of(encoded.field, series_, limit_);
    }
    return encoded;
  }

  /// As `fit`, with knots beside the cut that are as close as nodes of coarse meshes, between which edges
  /// hold the spline; none if there are no such knots, or if they are no remedy.
  std::unique_ptr<SeriesFit> on_close_knots(const SeriesFit& fit, const Misfit& misfit,
                                            const std::vector<TimeKink>& kinks) const {
    if (misfit.largest <= limit_ || !parametrization_->resolves_front() || series_.middles.samples.empty())
      return nullptr;
    Rung rung =
        supported(close_rungs_of(ladder_of_series()), series_, *parametrization_, nodes_held_firmly).back();
    rung.kinks = kinks;
    const auto bases = bases_on(rung);
    const auto store = store_->firm();
    const std::size_t last = series_.times.size() - 1;
    progress_("trying knots");
    if (space_misfit(series_, *store, {bases[0], bases[1], bases[2]}, last, limit_).largest >
        most_on_close_knots * limit_)
      return nullptr;
    progress_("fitting all frames");
    auto close = std::make_unique<SeriesFit>(series_, store, bases, start_, fit.strength());
    close->keep(share_of_close_fit * limit_);
    return close->misfit(limit_).largest < worth_of_more * misfit.largest ? std::move(close) : nullptr;
  }

  /// Whether it needs no more bytes, and goes astray between the nodes no more than it may, or than the other
  /// does.
  bool is_better(const Encoded& other, const Encoded& encoded) const {
    return bytes_of(other) <= bytes_of(encoded) &&
           other.field.report.least_volume >=
               std::min(least_volume, encoded.field.report.least_volume - hardly_less) &&
           error_at_centres(other.field, series_) <=
               std::max(limit_, error_at_centres(encoded.field, series_));
  }

  std::array<BSplineBasis, 4> bases_on(const Rung& rung) const {
    return bases_of(rung, *parametrization_, static_cast<int>(series_.times.size()));
  }

  SeriesFit fit_of(const Rung& rung) const {
    return {series_, store_, bases_on(rung), start_, options_.regularisation};
  }

  std::unique_ptr<SeriesFit> fitted_on(const Rung& rung) const {
    return std::make_unique<SeriesFit>(fit_of(rung));
  }

  std::vector<Rung> supported_rungs(double nodes_at_front = enough_nodes) const {
    return supported(ladder_of(*parametrization_, ladder_of_series()), series_, *parametrization_,
                     nodes_at_front);
  }

  LadderOf ladder_of_series() const {
    const bool waiting = ahead_ == Ahead::moving || (!series_.kinks.empty() && waits(series_.geometry.tip));
    return {series_.round, waiting, series_.bends, series_.winds};
  }

  /// For single frames; if there is none, one that leaves little to a residual.
  std::size_t sufficient(const std::vector<Rung>& rungs) const {
    return sufficient_rung(share_of_space * limit_, rungs, series_, *store_, progress_);
  }

  Field with_derivatives(Field field, const SeriesFit& fit) const {
    if (!series_.derivatives.empty()) progress_("fitting derivatives");
    field.by_parameter = fit_derivatives(series_, fit);
    return field;
  }

  /// A bound, mm, slightly above the error of the fit.
  static double above(const Misfit& misfit) { return 1.02 * misfit.largest; }

  /// The field and its report, with steps of its coefficients that keep `bound`, mm.
  Field with_steps(const SeriesFit& fit, double bound, const Steps& steps) const {
    progress_("choosing the coefficients' steps");
    bound = std::max(bound, finest_bound * scale_);
    // Functions sum to 1: coefficients off by half a step each way put no point off by more than sqrt(3) / 2
    // steps.
    double step = steps.share * 2 / std::sqrt(3.) * bound_of_steps(bound, options_.rung ? 0 : limit_);
    const Field fitted = fit.field(fit.control_points());
    const auto apart = [&] { return with_lips_apart(fitted, series_, 2 * farthest_move * step, bound); };
    Field exact = apart();
    // At nodes that were not fitted the spline may be off by more.
    if (series_.all_nodes) bound = std::max(bound, above({scale_ * measure(exact, series_).spline_error, 0}));
    for (int tried = 0;; ++tried) {
      Field field = quantised(exact, step, farthest_move);
      field.report.condition = fit.condition();
      field.report.regularisation = options_.regularisation.value_or(0);
      progress_("measuring");
      field.report = measure(field, series_);
      if (field.report.spline_error * scale_ <= bound || tried == most_steps) return field;
      step /= steps.smaller;
      if (steps.with_lips) exact = apart();
    }
  }

  const Series& series_;
  const EncodeOptions& options_;
  const std::function<void(const std::string&)>& progress_;
  std::shared_ptr<FitStore> store_;
  SeriesFit::Start start_;
  Ahead ahead_;
  std::shared_ptr<const Parametrization> parametrization_;
  double scale_ = 1, limit_ = 0;
};

/// If nothing moves, the knots are those of the further quantities.
std::optional<Rung> rung_of_quantities(const Series& series, const EncodeOptions& options,
                                       const std::function<void(const std::string&)>& progress) {
  std::optional<Rung> largest;
  const auto size = [](const Rung& r) {
    return r.before + r.along + r.after + r.across + r.above + r.below + r.time;
  };
  for (const SeriesQuantity& quantity : series.quantities)
    for (int first = 0; first < quantity.frames.front().cols(); first += 3) {
      const Series part = series_of(series, quantity, first);
      const Rung rung =
          Encoder(part, options, progress, fit_store(part, options), SeriesFit::Start::any, quantity.name)
              .smallest_rung();
      if (!largest || size(rung) > size(*largest)) largest = rung;
    }
  return largest;
}

Encoded with_quantities(Encoded encoded, const Series& series, const EncodeOptions& options,
                        const std::function<void(const std::string&)>& progress) {
  for (int number = 0; number < static_cast<int>(series.quantities.size()); ++number) {
    const SeriesQuantity& data = series.quantities[number];
    progress("fitting " + data.name);
    std::optional<double> limit;
    if (!options.rung) limit = options.tolerance_of(data.name).limit(scale_of(data));
    FittedQuantity fitted = fit_quantity(series, number, encoded.field, limit, progress);
    encoded.field.quantities.push_back(std::move(fitted.quantity));
    encoded.of_quantities.push_back(std::move(fitted.residual));
  }
  return encoded;
}

/// By how many tolerances the spline of a quantity is off.
double off_by(const Encoded& encoded, const Series& series, const EncodeOptions& options, std::size_t q) {
  const double scale = scale_of(series.quantities[q]);
  return encoded.field.quantities[q].spline_error * scale /
         options.tolerance_of(series.quantities[q].name).limit(scale);
}

double most_off(const Encoded& encoded, const Series& series, const EncodeOptions& options) {
  double largest = 0;
  for (std::size_t q = 0; q < series.quantities.size(); ++q)
    largest = std::max(largest, off_by(encoded, series, options, q));
  return largest;
}

/// The number of the rung that follows quantities far better than the displacement's knots do, of those that
/// are far off; 0 where there is none.
std::size_t rung_of_quantities_off(const Encoded& encoded, const Series& series, const EncodeOptions& options,
                                   const std::function<void(const std::string&)>& progress) {
  std::size_t wanted = 0;
  for (std::size_t q = 0; q < series.quantities.size(); ++q) {
    const SeriesQuantity& quantity = series.quantities[q];
    const double off = off_by(encoded, series, options, q);
    if (off <= far_off) continue;
    const double limit = options.tolerance_of(quantity.name).limit(scale_of(quantity));
    for (int first = 0; first < quantity.frames.front().cols(); first += 3) {
      const Series part = series_of(series, quantity, first);
      const Encoder encoder(part, options, progress, fit_store(part, options), SeriesFit::Start::any,
                            quantity.name, Ahead::moving);
      wanted = std::max(wanted, encoder.rung_within(worth_of_denser * off * limit).value_or(0));
    }
  }
  return wanted;
}

}  // namespace

std::shared_ptr<FitStore> fit_store(const Series& series, const EncodeOptions& options, double bytes) {
  const bool cut = series.geometry.cut.length > 0;
  return std::make_shared<FitStore>(
      series, make_parametrization(cut ? options.parametrization : "fixed", series.geometry), bytes);
}

Encoded encode(const Series& series, const EncodeOptions& options,
               const std::function<void(const std::string&)>& progress, std::shared_ptr<FitStore> store) {
  const Stopwatch watch;
  if (!store) store = fit_store(series, options);
  EncodeOptions chosen = options;
  if (series.largest_displacement == 0 && !options.rung)
    chosen.rung = rung_of_quantities(series, options, progress);
  Encoded encoded =
      with_quantities(Encoder(series, chosen, progress, store).run(), series, options, progress);
  if (const std::size_t rung = chosen.rung ? 0 : rung_of_quantities_off(encoded, series, options, progress);
      rung > 0) {
    const Encoder encoder(series, chosen, progress, store, SeriesFit::Start::zero, "displacement",
                          Ahead::moving);
    Encoded denser = with_quantities(encoder.run(rung), series, options, progress);
    if (most_off(denser, series, options) <= worth_of_denser * most_off(encoded, series, options))
      encoded = std::move(denser);
  }
  encoded.field.report.fit_seconds = watch.seconds();
  return encoded;
}

}  // namespace cleft
