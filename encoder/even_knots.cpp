#include "encoder/even_knots.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "encoder/frame_fit.h"
#include "encoder/supported_rungs.h"

namespace cleft {

namespace {

constexpr double denser = 1.4;           // times as many spans, at each step
constexpr double worth = 0.95;           // what more control points must make of an error
constexpr double most_in_vain = 6;       // times as many of them, without that
constexpr double held = 1, free = 2;     // nodes for each control point, where edges hold the spline and else
constexpr int most_spans = 200;          // on an axis
constexpr double most_points = 10000;    // control points in space
constexpr std::size_t even_probes = 4;   // frames that represent all, and the last
constexpr double of_even_search = 1e-6;  // strength of the regularisation

class EvenSearch {
 public:
  EvenSearch(const std::vector<Series>& parts, std::shared_ptr<const Parametrization> parametrization,
             double limit)
      : parts_(parts),
        parametrization_(std::move(parametrization)),
        limit_(limit),
        places_(places_on_axes(parts.front(), *parametrization_)) {
    const FieldGeometry& geometry = parametrization_->geometry();
    const bool follows = parametrization_->moves();
    const double start = geometry.cut.start, tip = geometry.tip.positions.back(),
                 depth = std::min(geometry.cut.depth, -geometry.domain[2].front);
    const auto& domain = geometry.domain;
    const auto length = [](const Interval& i) { return i.back - i.front; };
    lengths_ = follows ? Lengths{start - domain[0].front, tip - start, domain[0].back - tip, 0, depth,
                                 -domain[2].front - depth}
                       : Lengths{0, length(domain[0]), 0, 0, length(domain[2]), 0};
    lengths_[3] = geometry.cut.length > 0 ? std::max(-domain[1].front, domain[1].back) : length(domain[1]);
    for (int axis = 0; axis < 3; ++axis) distance_[axis] = length(domain[axis]);
    const std::size_t frames = parts.front().times.size();
    for (std::size_t i = 0; i < even_probes; ++i)
      frames_.push_back((frames - 1) * (2 * i + 1) / (2 * even_probes));
    frames_.push_back(frames - 1);
    frames_.erase(std::unique(frames_.begin(), frames_.end()), frames_.end());
  }

  EvenSpans run(const std::function<void(const std::string&)>& progress) {
    Tried now = tried(spans_of(distance_)), best = now;
    while (best.largest > limit_ && now.points < most_in_vain * best.points) {
      progress("trying knots");
      std::optional<Tried> next;
      Distances of_next{};
      for (int axis = 0; axis < 3; ++axis) {
        Distances distances = distance_;
        const auto spans = denser_on(axis, distances);
        if (!spans) continue;
        const Tried one = tried(*spans);
        if (!next || one.gain_from(now) > next->gain_from(now)) next = one, of_next = distances;
      }
      if (!next) break;
      now = *next, distance_ = of_next;
      if (now.largest < worth * best.largest) best = now;
    }
    return best.spans;
  }

 private:
  /// What fits of the frames leave at the nodes: the largest, and the root of the sum of squares.
  struct Tried {
    EvenSpans spans;
    double points = 0, largest = 0, all = 0;

    /// For its control points.
    double gain_from(const Tried& before) const {
      return std::log(before.all / std::max(all, 1e-300)) / std::log(points / before.points);
    }
  };
  using Distances = std::array<double, 3>;
  using Lengths = std::array<double, 6>;
  struct Member {
    int EvenSpans::*spans;
    int axis;
  };
  static constexpr Member members[] = {{&EvenSpans::before, 0}, {&EvenSpans::along, 0},
                                       {&EvenSpans::after, 0},  {&EvenSpans::across, 1},
                                       {&EvenSpans::above, 2},  {&EvenSpans::below, 2}};

  std::array<BSplineBasis, 3> in_space(const EvenSpans& spans) const {
    const auto bases = even_bases(spans, *parametrization_, static_cast<int>(parts_.front().times.size()));
    return {bases[0], bases[1], bases[2]};
  }

  /// With knots at these distances, or more where nodes determine no more.
  EvenSpans spans_of(const Distances& distances) const {
    EvenSpans spans;
    for (std::size_t m = 0; m < std::size(members); ++m) {
      const auto [member, axis] = members[m];
      const double wanted = std::round(lengths_[m] / distances[axis]);
      for (spans.*member = static_cast<int>(std::clamp<double>(wanted, 1, most_spans)); spans.*member > 1;
           --(spans.*member))
        if (determined(in_space(spans)[axis], places_[axis])) break;
    }
    return spans;
  }

  /// Control points; an axis on which all nodes have one place counts as one.
  double points_of(const EvenSpans& spans) const {
    const auto bases = in_space(spans);
    double points = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (places_[axis].size() > 1) points *= bases[axis].size();
    return points;
  }

  bool are_enough(const EvenSpans& spans) const {
    const double control_points = points_of(spans);
    const Series& series = parts_.front();
    return control_points <= most_points &&
           control_points * (series.middles_hold ? held : free) <= static_cast<double>(series.samples.size());
  }

  /// The next denser knots on an axis that differ, whose distances are set.
  std::optional<EvenSpans> denser_on(int axis, Distances& distances) const {
    const EvenSpans before = spans_of(distances);
    for (int step = 0; step < 8; ++step) {
      distances[axis] /= denser;
      const EvenSpans spans = spans_of(distances);
      const bool same = std::all_of(std::begin(members), std::end(members),
                                    [&](const Member& m) { return spans.*m.spans == before.*m.spans; });
      if (same) continue;
      if (!are_enough(spans)) return std::nullopt;
      return spans;
    }
    return std::nullopt;
  }

  /// Of frames that are fitted alone: with one matrix, as nothing moves.
  Tried tried(const EvenSpans& spans) const {
    const FrameFit fit(parts_.front(), *parametrization_, in_space(spans), FrameFit::Hold::slight);
    const SpaceFit::Factor factor = fit.space().factorize(fit.normal(frames_.back(), of_even_search));
    Eigen::VectorXd largest(frames_.size() * parts_.size()), all = largest;
    parallel_for(static_cast<int>(largest.size()), [&](int i) {
      const Series& part = parts_[static_cast<std::size_t>(i) % parts_.size()];
      const std::size_t frame = frames_[static_cast<std::size_t>(i) / parts_.size()];
      Eigen::MatrixX3d left =
          fit.values(factor.solve(fit.project(frame, part.frames[frame])), frame) - part.frames[frame];
      part.frames.forget(frame);
      for (const std::int32_t sample : part.beside_jumps) left.row(sample).setZero();
      const Eigen::VectorXd squares =
          left.topRows(static_cast<Eigen::Index>(part.nodes)).rowwise().squaredNorm();
      largest(i) = squares.maxCoeff(), all(i) = squares.sum();
    });
    return {spans, points_of(spans), std::sqrt(largest.maxCoeff()), std::sqrt(all.sum())};
  }

  const std::vector<Series>& parts_;
  std::shared_ptr<const Parametrization> parametrization_;
  double limit_;
  std::array<std::vector<double>, 3> places_;  // of nodes, on each axis
  Lengths lengths_{};                          // mm, of members
  Distances distance_{};                       // mm, between knots on each axis
  std::vector<std::size_t> frames_;
};

}  // namespace

std::shared_ptr<const Parametrization> standing(const Parametrization& parametrization) {
  return make_parametrization(parametrization.moves() ? "tip" : parametrization.name(),
                              standing(parametrization.geometry()));
}

EvenSpans even_spans(const std::vector<Series>& parts, std::shared_ptr<const Parametrization> parametrization,
                     double limit, int time, const std::function<void(const std::string&)>& progress) {
  EvenSpans spans = EvenSearch(parts, std::move(parametrization), limit).run(progress);
  spans.time = time;
  return spans;
}

}  // namespace cleft
