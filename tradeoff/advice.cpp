#include "tradeoff/advice.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "params/consistency.h"
#include "tradeoff/chain.h"
#include "tradeoff/replays/frame_time.h"

namespace cleft {

namespace {

constexpr double elements_along_cut[] = {8, 16, 32};                    // of the cheap meshes
constexpr double margins[] = {0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4, 6, 8};  // over the cut's length
constexpr double elements_in_patches = 16;                              // of the meshes of patches
constexpr double least_tip_order = 0.5;  // of a square root that a mesh cannot follow
constexpr double widest = 16;
constexpr double safety = 1.05;         // measured errors were up to 8 % above estimates
constexpr double most_of_patch = 0.05;  // its error, where meshes are compared
// Tolerance over the error. Of displacements, about half of the opening, it bounds the error at nodes; what
// coarse meshes show for a looser one does not hold in others, where other knots satisfy it.
constexpr double loosest = 0.5;
constexpr double details[] = {0, 0.01, 0.02, 0.05, 0.1, 0.25};  // over the error and the opening
constexpr double tolerances[] = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};

/// Of a mesh of so many nodes, from those of coarse ones.
double expected_seconds(const std::vector<ChainCost>& costs, double nodes) {
  const auto& [n0, s0] = costs.front();
  const auto& [n1, s1] = costs.back();
  const double exponent = std::clamp(std::log(s1 / s0) / std::log(n1 / n0), 1., 2.);
  return s1 * std::pow(nodes / n1, nodes > n1 ? exponent : 1);
}

}  // namespace

Parameters applied(const Setting& setting, Parameters p) {
  p.model = setting.model.value_or(p.model);
  p.mesh.element_size = setting.element_size, p.mesh.grading = setting.grading;
  p.mesh.elements = ElementOrder::linear;  // whose errors are known here
  // A frame for every pair costs 1.2 to 2.2 times as much, and takes 3 to 9 % off the error: a finer mesh
  // takes off more.
  p.cut.frames = FrameEvery::column;
  p.patch.length = p.cut.length + 2 * setting.margin, p.patch.width = 2 * setting.margin;
  return p;
}

std::string Expectation::dominating() const {
  const double most = std::max({mesh, tip, patch, code, detail, model_counts ? model : 0});
  return most == detail                  ? "detail"
         : model_counts && most == model ? "model"
         : most == patch                 ? "patch"
         : most == tip                   ? "tip"
         : most == mesh                  ? "mesh"
                                         : "code";
}

void check_advisable(const Parameters& parameters) {
  if (parameters.cut.radius != 0 || parameters.cut.tilt != 0 || parameters.cut.count != 1 ||
      parameters.cut.branch != 0)
    throw InputError(
        "cut.radius, cut.tilt, cut.count or cut.branch: advice is for one straight, upright cut, from which "
        "others are replayed");
}

CaseModel::CaseModel(const Parameters& parameters, std::string work,
                     const std::function<void(const std::string&)>& progress, ModelKnowledge models)
    : parameters_(parameters), models_(std::move(models)), work_(std::move(work)), progress_(progress) {
  check_advisable(parameters);
  CLEFT_CHECK(models_.error || (!models_.choose && parameters.model == Model::small), ==, true);
  parameters_.mesh.cut_length = parameters_.mesh.cut_depth = 0;
  measure_patches();
  measure_meshes();
}

Parameters CaseModel::coarse(double elements, double margin) const {
  const double length = parameters_.cut.length;
  return applied({.element_size = length / elements, .margin = margin * length, .model = Model::small},
                 parameters_);
}

void CaseModel::measure_patches() {
  const double length = parameters_.cut.length;
  const auto samples = [&](double margin) {
    progress_("solving in a patch of " + shortest(margin) + " cut lengths around the cut");
    const Chain chain(coarse(elements_in_patches, margin), work_);
    const Opening opening = chain.opening();
    return sampled(length, [&](double s, double t) { return opening.at(s, t); });
  };
  const Samples wide = samples(widest);
  largest_ = size_of(wide);
  for (const double margin : margins)
    patches_.emplace_back(margin * length, difference(samples(margin), wide));
}

void CaseModel::measure_meshes() {
  const double length = parameters_.cut.length;
  const auto like = std::find_if(patches_.begin(), patches_.end(), [&](const auto& patch) {
    return size_of(patch.second) <= most_of_patch * largest_;
  });
  const double margin = (like == patches_.end() ? patches_.back() : *like).first / length;
  std::optional<Opening> before;
  double largest = 0;
  for (const double elements : elements_along_cut) {
    progress_("solving with " + shortest(elements) + " elements along the cut");
    const Chain chain(coarse(elements, margin), work_);
    const Opening opening = chain.opening();
    const auto at = [&](double s, double t) { return opening.at(s, t); };
    if (before)
      mesh_ = difference(sampled(length, [&](double s, double t) { return before->at(s, t); }),
                         sampled(length, at));
    before = opening;
    largest = opening.largest();
    const auto apart = [&](const Field& field) {
      return difference(sampled(length, [&](double s, double t) { return cleft::opening(field, s, t); }),
                        sampled(length, at));
    };
    const double tightest = tolerances[std::size(tolerances) - 1];
    const Chain::Encoded tight = chain.encoded(tightest);
    tips_.emplace_back(length / elements, apart(tight.field));
    costs_.push_back({chain.nodes(), chain.solve_seconds() + tight.seconds});
    if (elements != elements_along_cut[std::size(elements_along_cut) - 1]) continue;
    mesh_size_ = 2 * length / elements;
    field_ = tight.field;
    for (const double tolerance : tolerances) {
      const Chain::Encoded encoded = tolerance == tightest ? tight : chain.encoded(tolerance);
      const Field& field = encoded.field;
      codes_.push_back(
          {tolerance,
           std::max(0., size_of(apart(field)) - size_of(tips_.back().second)),
           encoded.bytes,
           {field.basis(0).size(), field.basis(1).size(), field.basis(2).size(), field.basis(3).size()}});
    }
  }
  // Against a patch in which this much opens.
  for (auto& [narrow, samples] : patches_)
    for (Vec3& x : samples) x *= largest / largest_;
  largest_ = largest;
}

/// Of a measured size that is near, as large as it is at this size: straight in logarithms between them.
Samples CaseModel::tip_samples(double size) const {
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

std::array<int, 4> CaseModel::control_points(double tolerance) const {
  const auto code =
      std::find_if(codes_.begin(), codes_.end(), [&](const Code& one) { return one.tolerance == tolerance; });
  CLEFT_CHECK(code != codes_.end(), ==, true);
  return code->control_points;
}

double CaseModel::frame_ms(double detail) const { return 1e3 * frame_seconds(*field_, detail); }

Expectation CaseModel::expectation(const Setting& setting) const {
  Expectation e;
  // Against one twice as fine, the same is left there.
  const double share = 2 * setting.element_size / mesh_size_;
  const Samples* patch = nullptr;
  for (const auto& [margin, samples] : patches_)
    if (std::abs(margin - setting.margin) < 1e-9 * margin) patch = &samples;
  CLEFT_CHECK(patch != nullptr, ==, true);
  const Samples tip = tip_samples(setting.element_size);
  const bool small = setting.model.value_or(parameters_.model) == Model::small;
  e.model_counts = setting.model.has_value();
  if (small && models_.error) e.model = size_of(models_.error->error);
  // The largest opening: of the model that is right, and of that in which mesh, tip and patch were measured
  // over that of the one they stand for.
  const double ratio = models_.error ? models_.error->ratio : 1,
               right = e.model_counts || !small ? ratio * largest_ : largest_,
               scale = 1 / (small ? right : largest_);
  Samples sum = *patch, all = tip;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = scale * (sum[i] + share * mesh_[i]);
    if (small && e.model_counts) sum[i] += models_.error->error[i];
    all[i] = scale * all[i] + sum[i];
  }
  e.mesh = share * scale * size_of(mesh_), e.patch = scale * size_of(*patch), e.tip = scale * size_of(tip);
  for (const Code& code : codes_)
    if (code.tolerance == setting.tolerance) e.code = scale * code.error, e.bytes = code.bytes;
  e.detail = 2 * setting.detail / right;  // of both lips
  e.total = safety * std::max({size_of(all), std::hypot(size_of(sum), e.tip), e.model_counts ? e.model : 0}) +
            e.code + e.detail;
  e.frames = std::round(parameters_.cut.length / setting.element_size);
  e.nodes = estimated_nodes(applied(setting, parameters_));
  e.seconds = expected_seconds(small ? costs_ : models_.error->finite, e.nodes);
  return e;
}

std::vector<Setting> CaseModel::settings() const {
  const std::vector<std::optional<Model>> models =
      models_.choose ? std::vector<std::optional<Model>>{Model::small, Model::finite}
                     : std::vector<std::optional<Model>>{std::nullopt};
  std::vector<Setting> all;
  for (const std::optional<Model> model : models)
    for (const double elements : {8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96})
      for (const auto& [margin, samples] : patches_)
        for (const Code& code : codes_)
          all.push_back({parameters_.cut.length / elements, margin, code.tolerance, 0, model});
  return all;
}

Expectation expectation(const std::vector<CaseModel>& models, const Setting& setting) {
  Expectation all;
  for (const CaseModel& model : models) {
    const Expectation e = model.expectation(setting);
    all.model_counts = all.model_counts || e.model_counts;
    for (double Expectation::*error :
         {&Expectation::mesh, &Expectation::tip, &Expectation::patch, &Expectation::code,
          &Expectation::detail, &Expectation::model, &Expectation::total})
      all.*error = std::max(all.*error, e.*error);
    for (double Expectation::*cost :
         {&Expectation::nodes, &Expectation::seconds, &Expectation::bytes, &Expectation::frames})
      all.*cost += e.*cost / static_cast<double>(models.size());
  }
  return all;
}

namespace {

/// The least detail that replays need to keep their time.
double detail_for(const std::vector<CaseModel>& models, const Goals& goals) {
  double least = models.front().largest_opening(), frame = 0;
  for (const CaseModel& model : models) least = std::min(least, model.largest_opening());
  for (const double share : details) {
    const double detail = share * goals.error * least;
    frame = 0;
    for (const CaseModel& model : models) frame = std::max(frame, model.frame_ms(detail));
    if (frame <= goals.frame_ms) return detail;
  }
  throw InputError("--frame-ms " + shortest(goals.frame_ms) + ": a frame of 10,000 vertices takes " +
                   shortest(std::round(1e4 * frame) / 1e4) +
                   " ms here, without those that move less than a " + "quarter of the error too");
}

}  // namespace

Setting advise(const std::vector<CaseModel>& models, const Goals& goals) {
  const double detail = goals.frame_ms > 0 ? detail_for(models, goals) : 0;
  const double most_tolerance = std::max(loosest * goals.error, tolerances[std::size(tolerances) - 1]);
  std::optional<Setting> best;
  Expectation of_best, nearest;
  bool fits_at_all = false;
  for (Setting setting : models.front().settings()) {
    if (setting.tolerance > most_tolerance || (goals.model && setting.model != goals.model)) continue;
    setting.detail = detail, setting.grading = advised_grading(goals.error);
    const Expectation e = expectation(models, setting);
    if (goals.megabytes > 0 && 1e-6 * goals.cases * e.bytes > goals.megabytes) continue;
    if (!fits_at_all || e.total < nearest.total) nearest = e;
    fits_at_all = true;
    if (e.total > goals.error) continue;
    if (!best || e.seconds < of_best.seconds || (e.seconds == of_best.seconds && e.bytes < of_best.bytes))
      best = setting, of_best = e;
  }
  if (!fits_at_all)
    throw InputError("--mb " + shortest(goals.megabytes) + ": " + shortest(goals.cases) +
                     " cases take more, with tolerances of half the error and tighter");
  if (!best)
    throw InputError("--error " + shortest(goals.error) + ": out of reach; " +
                     shortest(std::round(1e4 * nearest.total) / 1e4) + " can be had, where the " +
                     nearest.dominating() + " dominates");
  return *best;
}

}  // namespace cleft
