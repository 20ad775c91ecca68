#include "tradeoff/advice.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "tradeoff/chain.h"
#include "tradeoff/frame_time.h"

namespace cleft {

namespace {

constexpr int grid = 48;                                             // samples along the cut and over time
constexpr double elements_along_cut[] = {8, 16, 32};                 // of the cheap meshes
constexpr double margins[] = {0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4, 6};  // over the cut's length
constexpr double least_tip_order = 0.5;  // of a square root that a mesh cannot follow
constexpr double widest = 12, cheap_margin = 0.5;
constexpr double tolerances[] = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};

template <class At>
std::vector<Vec3> sampled(double length, const At& at) {
  std::vector<Vec3> samples;
  for (int j = 1; j <= grid; ++j)
    for (int i = 1; i < grid; ++i) samples.push_back(at(length * i / grid, length * j / grid));
  return samples;
}

std::vector<Vec3> difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<Vec3> d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

double size_of(const std::vector<Vec3>& samples) {
  double most = 0;
  for (const Vec3& x : samples) most = std::max(most, norm(x));
  return most;
}

}  // namespace

Parameters applied(const Setting& setting, Parameters p) {
  p.mesh.element_size = setting.element_size, p.mesh.grading = advised_grading;
  p.patch.length = p.cut.length + 2 * setting.margin, p.patch.width = 2 * setting.margin;
  return p;
}

std::string Expectation::dominating() const {
  const double most = std::max({mesh, tip, patch, code});
  return most == patch ? "patch" : most == tip ? "tip" : most == mesh ? "mesh" : "code";
}

CaseModel::CaseModel(const Parameters& parameters, std::string work,
                     const std::function<void(const std::string&)>& progress)
    : parameters_(parameters), work_(std::move(work)), progress_(progress) {
  if (parameters.cut.radius != 0 || parameters.cut.tilt != 0 || parameters.cut.count != 1 ||
      parameters.cut.branch != 0)
    throw InputError(
        "cut.radius, cut.tilt, cut.count or cut.branch: advice is for one straight, upright cut, from which "
        "others are replayed");
  parameters_.mesh.cut_length = parameters_.mesh.cut_depth = 0;
  measure_meshes();
  measure_patches();
}

Parameters CaseModel::coarse(double elements, double margin) const {
  const double length = parameters_.cut.length;
  return applied({length / elements, margin * length, 0}, parameters_);
}

void CaseModel::measure_meshes() {
  const double length = parameters_.cut.length;
  std::optional<Opening> before;
  for (const double elements : elements_along_cut) {
    progress_("solving with " + shortest(elements) + " elements along the cut");
    const Chain chain(coarse(elements, cheap_margin), work_);
    const Opening opening = chain.opening();
    const auto at = [&](double s, double t) { return opening.at(s, t); };
    if (before) {
      const double coarser = size_of(mesh_);
      mesh_ = difference(sampled(length, [&](double s, double t) { return before->at(s, t); }),
                         sampled(length, at));
      mesh_size_ = 2 * length / elements;
      if (coarser > 0) mesh_order_ = std::clamp(std::log2(coarser / size_of(mesh_)), 0.7, 1.5);
    }
    before = opening;
    largest_ = opening.largest();
    const auto apart = [&](const Field& field) {
      return size_of(
          difference(sampled(length, [&](double s, double t) { return cleft::opening(field, s, t); }),
                     sampled(length, at)));
    };
    const double tightest = tolerances[std::size(tolerances) - 1];
    const Chain::Encoded tight = chain.encoded(tightest);
    tips_.emplace_back(length / elements, apart(tight.field));
    costs_.emplace_back(chain.nodes(), chain.solve_seconds() + tight.seconds);
    if (elements != elements_along_cut[std::size(elements_along_cut) - 1]) continue;
    frame_ms_ = 1e3 * frame_seconds(tight.field);
    for (const double tolerance : tolerances) {
      const Chain::Encoded encoded = tolerance == tightest ? tight : chain.encoded(tolerance);
      codes_.push_back({tolerance, std::max(0., apart(encoded.field) - tips_.back().second), encoded.bytes});
    }
  }
}

/// Straight in logarithms between the measured sizes.
double CaseModel::tip_error(double size) const {
  std::size_t i = 0;
  while (i + 2 < tips_.size() && size < tips_[i + 1].first) ++i;
  const auto& [coarse, coarse_error] = tips_[i];
  const auto& [fine, fine_error] = tips_[i + 1];
  const double order =
      std::max(least_tip_order, std::log(coarse_error / fine_error) / std::log(coarse / fine));
  return fine_error * std::pow(size / fine, order);
}

void CaseModel::measure_patches() {
  const double length = parameters_.cut.length;
  const auto samples = [&](double margin) {
    progress_("solving in a patch of " + shortest(margin) + " cut lengths around the cut");
    const Chain chain(coarse(elements_along_cut[0], margin), work_);
    const Opening opening = chain.opening();
    return sampled(length, [&](double s, double t) { return opening.at(s, t); });
  };
  const Samples wide = samples(widest);
  const double grown = size_of(wide) / largest_;
  for (const double margin : margins)
    patches_.emplace_back(margin * length, difference(samples(margin), wide));
  // Meshes were compared in a small patch: what they differ by goes with the opening.
  for (Vec3& x : mesh_) x *= grown;
  for (Code& code : codes_) code.error *= grown;
  for (auto& [size, error] : tips_) error *= grown;
  largest_ *= grown;
}

Expectation CaseModel::expectation(const Setting& setting) const {
  Expectation e;
  // Against one twice as fine: what is left there is 2^-order of it.
  const double share =
      std::pow(setting.element_size / mesh_size_, mesh_order_) / (1 - std::pow(2, -mesh_order_));
  const Samples* patch = nullptr;
  for (const auto& [margin, samples] : patches_)
    if (std::abs(margin - setting.margin) < 1e-9 * margin) patch = &samples;
  CLEFT_CHECK(patch != nullptr, ==, true);
  Samples sum = *patch;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += share * mesh_[i];
  e.mesh = share * size_of(mesh_) / largest_, e.patch = size_of(*patch) / largest_;
  e.tip = tip_error(setting.element_size) / largest_;
  for (const Code& code : codes_)
    if (code.tolerance == setting.tolerance) e.code = code.error / largest_, e.bytes = code.bytes;
  e.total = std::hypot(size_of(sum) / largest_, e.tip) + e.code;
  e.nodes = estimated_nodes(applied(setting, parameters_));
  const auto& [n0, s0] = costs_.front();
  const auto& [n1, s1] = costs_.back();
  const double exponent = std::clamp(std::log(s1 / s0) / std::log(n1 / n0), 1., 2.);
  e.seconds = s1 * std::pow(e.nodes / n1, e.nodes > n1 ? exponent : 1);
  return e;
}

std::vector<Setting> CaseModel::settings() const {
  std::vector<Setting> all;
  for (const double elements : {8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96})
    for (const auto& [margin, samples] : patches_)
      for (const Code& code : codes_)
        all.push_back({parameters_.cut.length / elements, margin, code.tolerance});
  return all;
}

Expectation expectation(const std::vector<CaseModel>& models, const Setting& setting) {
  Expectation all;
  for (const CaseModel& model : models) {
    const Expectation e = model.expectation(setting);
    for (double Expectation::*error : {&Expectation::mesh, &Expectation::tip, &Expectation::patch,
                                       &Expectation::code, &Expectation::total})
      all.*error = std::max(all.*error, e.*error);
    for (double Expectation::*cost : {&Expectation::nodes, &Expectation::seconds, &Expectation::bytes})
      all.*cost += e.*cost / static_cast<double>(models.size());
  }
  return all;
}

Setting advise(const std::vector<CaseModel>& models, const Goals& goals) {
  double frame = 0;
  for (const CaseModel& model : models) frame = std::max(frame, model.frame_ms());
  if (goals.frame_ms > 0 && frame > goals.frame_ms)
    throw InputError("--frame-ms " + shortest(goals.frame_ms) + ": a frame of 10,000 moving vertices takes " +
                     shortest(std::round(1e4 * frame) / 1e4) + " ms here, whatever the settings");
  std::optional<Setting> best;
  Expectation of_best, nearest;
  bool fits_at_all = false;
  for (const Setting& setting : models.front().settings()) {
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
                     " cases take more, whatever the tolerance");
  if (!best)
    throw InputError("--error " + shortest(goals.error) + ": out of reach; " +
                     shortest(std::round(1e4 * nearest.total) / 1e4) + " can be had, where the " +
                     nearest.dominating() + " dominates");
  return *best;
}

}  // namespace cleft
