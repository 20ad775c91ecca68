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

constexpr double margins[] = {0.25, 0.5, 0.75, 1, 1.5, 2, 3, 4, 6, 8};  // over the cut's length
constexpr double elements_in_patches = 16;                              // of the meshes of patches
constexpr double widest = 16;
constexpr double safety = 1.1;          // measured errors were up to a tenth above estimates
constexpr double most_of_patch = 0.05;  // its error, where meshes are compared
// Tolerance over the error. Of displacements, about half of the opening, it bounds the error at nodes; what
// coarse meshes show for a looser one does not hold in others, where other knots satisfy it.
constexpr double loosest = 0.5;
constexpr double details[] = {0, 0.01, 0.02, 0.05, 0.1, 0.25};  // over the error and the opening

}  // namespace

Parameters applied(const Setting& setting, Parameters p) {
  p.model = setting.model.value_or(p.model);
  p.mesh.element_size = setting.element_size, p.mesh.grading = setting.grading;
  p.mesh.elements = setting.elements;
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
                     const std::function<void(const std::string&)>& progress, ModelKnowledge models,
                     bool quadratic)
    : parameters_(parameters), models_(std::move(models)), work_(std::move(work)), progress_(progress) {
  check_advisable(parameters);
  CLEFT_CHECK(models_.error || (!models_.choose && parameters.model == Model::small), ==, true);
  parameters_.mesh.cut_length = parameters_.mesh.cut_depth = 0;
  measure_patches();
  measure_meshes(quadratic && quadratic_elements_serve());
}

bool CaseModel::quadratic_elements_serve() const {
  if (!models_.choose && parameters_.model == Model::finite) return false;
  try {
    check_consistency(coarse(parameters_, ElementOrder::quadratic, elements_in_patches, 1), "case");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void CaseModel::measure_patches() {
  const double length = parameters_.cut.length;
  const auto samples = [&](double margin) {
    progress_("solving in a patch of " + shortest(margin) + " cut lengths around the cut");
    const Chain chain(coarse(parameters_, ElementOrder::linear, elements_in_patches, margin), work_);
    const Opening opening = chain.opening();
    return sampled(length, [&](double s, double t) { return opening.at(s, t); });
  };
  const Samples wide = samples(widest);
  largest_ = size_of(wide);
  for (const double margin : margins)
    patches_.emplace_back(margin * length, difference(samples(margin), wide));
}

void CaseModel::measure_meshes(bool quadratic) {
  const auto like = std::find_if(patches_.begin(), patches_.end(), [&](const auto& patch) {
    return size_of(patch.second) <= most_of_patch * largest_;
  });
  const double margin = (like == patches_.end() ? patches_.back() : *like).first / parameters_.cut.length;
  meshes_.emplace_back(parameters_, ElementOrder::linear, margin, work_, progress_);
  if (quadratic) meshes_.emplace_back(parameters_, ElementOrder::quadratic, margin, work_, progress_);
  // Against a patch in which this much opens.
  const double largest = meshes_.front().largest_opening();
  for (auto& [narrow, samples] : patches_)
    for (Vec3& x : samples) x *= largest / largest_;
  largest_ = largest;
}

double CaseModel::frame_ms(double detail) const {
  return 1e3 * frame_seconds(meshes_.front().field(), detail);
}

Expectation CaseModel::expectation(const Setting& setting) const {
  Expectation e;
  const MeshErrors& meshes = *meshes_of(setting.elements);
  const Samples* patch = nullptr;
  for (const auto& [margin, samples] : patches_)
    if (std::abs(margin - setting.margin) < 1e-9 * margin) patch = &samples;
  CLEFT_CHECK(patch != nullptr, ==, true);
  const Samples mesh = meshes.mesh(setting.element_size), tip = meshes.tip(setting.element_size);
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
    sum[i] = scale * (sum[i] + mesh[i]);
    if (small && e.model_counts) sum[i] += models_.error->error[i];
    all[i] = scale * all[i] + sum[i];
  }
  e.mesh = scale * size_of(mesh), e.patch = scale * size_of(*patch);
  e.tip = scale * std::max(size_of(tip), meshes.first_node(setting.element_size));
  if (setting.tolerance > 0) {
    const MeshErrors::Code& code = meshes.code(setting.tolerance);
    e.code = scale * code.error, e.bytes = code.bytes;
  }
  e.detail = 2 * setting.detail / right;  // of both lips
  e.total = safety * std::max({size_of(all), std::hypot(size_of(sum), e.tip), e.model_counts ? e.model : 0}) +
            e.code + e.detail;
  e.frames = std::round(parameters_.cut.length / setting.element_size);
  e.nodes = estimated_nodes(applied(setting, parameters_));
  e.seconds = small ? meshes.seconds(e.nodes) : expected_seconds(models_.error->finite, e.nodes);
  return e;
}

std::vector<Setting> CaseModel::settings() const {
  const std::vector<std::optional<Model>> models =
      models_.choose ? std::vector<std::optional<Model>>{Model::small, Model::finite}
                     : std::vector<std::optional<Model>>{std::nullopt};
  std::vector<Setting> all;
  for (const MeshErrors& meshes : meshes_)
    for (const std::optional<Model> model : models)
      for (const double count : {8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96})
        for (const auto& [margin, samples] : patches_) {
          const Setting setting{.element_size = parameters_.cut.length / count,
                                .margin = margin,
                                .model = model,
                                .elements = meshes.elements()};
          if (serves(setting)) all.push_back(setting);
        }
  return all;
}

const MeshErrors* CaseModel::meshes_of(ElementOrder elements) const {
  const auto meshes = std::find_if(meshes_.begin(), meshes_.end(),
                                   [&](const MeshErrors& one) { return one.elements() == elements; });
  return meshes == meshes_.end() ? nullptr : &*meshes;
}

bool CaseModel::serves(const Setting& setting) const {
  const bool finite = setting.model.value_or(parameters_.model) == Model::finite;
  return meshes_of(setting.elements) && !(finite && setting.elements == ElementOrder::quadratic);
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
  const double most_tolerance = std::max(loosest * goals.error, tightest_tolerance);
  std::vector<std::pair<Setting, Expectation>> meshes;  // without code
  for (Setting setting : models.front().settings()) {
    if (goals.model && setting.model != goals.model) continue;
    const auto serves = [&](const CaseModel& model) { return model.serves(setting); };
    if (!std::all_of(models.begin(), models.end(), serves)) continue;
    setting.detail = detail, setting.grading = advised_grading(setting.elements, goals.error);
    meshes.emplace_back(setting, expectation(models, setting));
  }
  std::stable_sort(meshes.begin(), meshes.end(),
                   [](const auto& a, const auto& b) { return a.second.seconds < b.second.seconds; });
  std::optional<Setting> best;
  Expectation of_best, nearest;
  bool fits_at_all = false;
  // Of a mesh with its tolerances, the loosest first, that which keeps the goals.
  const auto take = [&](Setting setting) {
    for (const double tolerance : tolerances) {
      if (tolerance > most_tolerance) continue;
      setting.tolerance = tolerance;
      const Expectation e = expectation(models, setting);
      if (goals.megabytes > 0 && 1e-6 * goals.cases * e.bytes > goals.megabytes) continue;
      if (!fits_at_all || e.total < nearest.total) nearest = e;
      fits_at_all = true;
      if (e.total > goals.error) continue;
      if (!best || e.bytes < of_best.bytes) best = setting, of_best = e;
      return;
    }
  };
  // The cheapest first. No field makes up for what a mesh is off, so nothing is encoded for too coarse ones.
  for (const auto& [setting, e] : meshes) {
    if (best && e.seconds > of_best.seconds) break;
    if (e.total <= goals.error) take(setting);
  }
  if (best) return *best;
  for (const auto& [setting, e] : meshes) take(setting);
  if (!fits_at_all)
    throw InputError("--mb " + shortest(goals.megabytes) + ": " + shortest(goals.cases) +
                     " cases take more, with tolerances of half the error and tighter");
  throw InputError("--error " + shortest(goals.error) + ": out of reach; " +
                   shortest(std::round(1e4 * nearest.total) / 1e4) + " can be had, where the " +
                   nearest.dominating() + " dominates");
}

}  // namespace cleft
