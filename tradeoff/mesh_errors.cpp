#include "tradeoff/mesh_errors.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr double linear_along_cut[] = {8, 16, 32}, quadratic_along_cut[] = {8, 16};  // elements
// By comparison of both kinds, of the same and of other sizes: the opening of that node over the one which
// nodes further away tell, as the root of the distance from the front. Largest over the frames.
constexpr double first_node_of_linear = 0.1, first_node_of_quadratic = 0.02;
constexpr double least_tip_order = 0.5;  // of a square root that a mesh cannot follow

std::span<const double> along_cut(ElementOrder elements) {
  if (elements == ElementOrder::quadratic) return quadratic_along_cut;
  return linear_along_cut;
}

}  // namespace

MeshErrors::MeshErrors(const Parameters& parameters, ElementOrder elements, double margin,
                       const std::string& work, const std::function<void(const std::string&)>& progress)
    : elements_(elements), kept_(std::make_shared<ScratchFolder>("advise")) {
  const double length = parameters.cut.length;
  const std::span<const double> counts = along_cut(elements);
  for (const double count : counts) {
    progress("solving with " + shortest(count) + (elements == ElementOrder::quadratic ? " quadratic" : "") +
             " elements along the cut");
    finest_ =
        Chain(coarse(parameters, elements, count, margin), count == counts.back() ? kept_->path() : work);
    const Opening opening = finest_->opening();
    const Samples before =
        std::exchange(finest_samples_, sampled(length, [&](double s, double t) { return opening.at(s, t); }));
    if (!before.empty()) difference_ = difference(before, finest_samples_);
    largest_ = opening.largest(), size_ = length / count;
    first_opening_ = norm(opening.node(opening.times().size() - 1, 1));
    const Chain::Encoded tight = finest_->encoded(tightest_tolerance);
    field_ = tight.field;
    tips_.emplace_back(size_, apart(tight.field));
    costs_.push_back({finest_->nodes(), finest_->solve_seconds() + tight.seconds});
    codes_ = {{tightest_tolerance, code_of(tight)}};
  }
}

Samples MeshErrors::apart(const Field& field) const {
  const double length = field.cut().length;
  return difference(sampled(length, [&](double s, double t) { return opening(field, s, t); }),
                    finest_samples_);
}

MeshErrors::Code MeshErrors::code_of(const Chain::Encoded& encoded) const {
  const Field& field = encoded.field;
  return {std::max(0., size_of(apart(field)) - size_of(tips_.back().second)),
          encoded.bytes,
          {field.basis(0).size(), field.basis(1).size(), field.basis(2).size(), field.basis(3).size()}};
}

Samples MeshErrors::mesh(double size) const {
  const double order = elements_ == ElementOrder::quadratic ? 1.5 : 1;
  // Of the difference from one twice as coarse, what is left in the finest.
  const double factor = std::pow(size / size_, order) / (std::pow(2, order) - 1);
  Samples samples = difference_;
  for (Vec3& x : samples) x *= factor;
  return samples;
}

double MeshErrors::first_node(double size) const {
  return (elements_ == ElementOrder::quadratic ? first_node_of_quadratic : first_node_of_linear) *
         first_opening_ * std::sqrt(size / size_);
}

Samples MeshErrors::tip(double size) const {
  std::size_t i = 0;
  while (i + 2 < tips_.size() && size < tips_[i + 1].first) ++i;
  const auto& [coarse, coarse_samples] = tips_[i];
  const auto& [fine, fine_samples] = tips_[i + 1];
  const double fine_error = size_of(fine_samples);
  const double order =
      std::max(least_tip_order, std::log(size_of(coarse_samples) / fine_error) / std::log(coarse / fine));
  Samples samples = size * size > coarse * fine ? coarse_samples : fine_samples;
  const double factor = fine_error * std::pow(size / fine, order) / size_of(samples);
  for (Vec3& x : samples) x *= factor;
  return samples;
}

double MeshErrors::seconds(double nodes) const { return expected_seconds(costs_, nodes); }

const MeshErrors::Code& MeshErrors::code(double tolerance) const {
  if (const auto found = codes_.find(tolerance); found != codes_.end()) return found->second;
  return codes_[tolerance] = code_of(finest_->encoded(tolerance));
}

double expected_seconds(const std::vector<ChainCost>& costs, double nodes) {
  const auto& [n0, s0] = costs.front();
  const auto& [n1, s1] = costs.back();
  const double exponent = std::clamp(std::log(s1 / s0) / std::log(n1 / n0), 1., 2.);
  return s1 * std::pow(nodes / n1, nodes > n1 ? exponent : 1);
}

Parameters coarse(const Parameters& parameters, ElementOrder elements, double count, double margin) {
  const double length = parameters.cut.length;
  return applied({.element_size = length / count,
                  .margin = margin * length,
                  .model = Model::small,
                  .elements = elements,
                  .grading = advised_grading(elements, 1)},
                 parameters);
}

}  // namespace cleft
