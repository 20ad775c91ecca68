#include "tests/wound/stress/opening_stress.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iomanip>
#include <memory>
#include <random>
#include <sstream>

#include "base/error.h"
#include "explorer/incision/near_ends.h"

namespace cleft::stress {

namespace {

constexpr double slow = 10;  // s

/// s, of the processor: a busy machine makes no group slow.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Cuts in one mesh at a time, opened together.
class Opening {
 public:
  Opening(const Subject& subject, const FieldsOfGroup& fields, const FieldLimits& limits,
          const OpeningPlan& plan)
      : subject_(subject),
        fields_(fields),
        limits_(limits),
        plan_(plan),
        ground_(subject.mesh),
        random_(plan.seed + std::hash<std::string>{}(subject.name)) {
    for (std::size_t t = 0; t < subject.mesh.triangles.size(); ++t)
      mean_edge_ +=
          ground_.edge_length(static_cast<int>(t)) / static_cast<double>(subject.mesh.triangles.size());
  }

  OpeningTally run() {
    while (tally_.cuts < plan_.cuts) group();
    return tally_;
  }

 private:
  void group() {
    const int count =
        plan_.crossing ? 2 : 1 + static_cast<int>(random_() % static_cast<unsigned>(plan_.cuts_at_once));
    std::mt19937_64 own(random_());
    const double size =
        std::exp(std::uniform_real_distribution(std::log(plan_.least_edge), std::log(plan_.most_edge))(own));
    const double scale = plan_.crossing ? 1 : size / mean_edge_;
    const long first = tally_.cuts;
    const bool wanted = plan_.only.empty() || std::any_of(plan_.only.begin(), plan_.only.end(), [&](long c) {
                          return first <= c && c < first + count;
                        });
    CutMesh mesh(subject_.mesh);
    std::vector<ScalpelPath> paths;
    std::vector<bool> refined;
    std::optional<ScalpelPath> earlier;
    std::string kinds;
    PathKind kind{};
    const double begin = now();
    for (int i = 0; i < count; ++i) {
      kind = static_cast<PathKind>(own() % path_kinds);
      if (plan_.crossing)
        kind = earlier ? PathKind::across : static_cast<PathKind>(own() % 2);  // straight, wavy
      if (earlier && own() % 2 == 0) kind = PathKind::across;
      std::optional<ScalpelPath> path = random_path(ground_, kind, earlier, own);
      const bool refines = own() % 2 == 0;
      ++tally_.cuts;
      if (!path || !wanted) continue;
      kinds += (kinds.empty() ? "" : " + ") + name_of(kind);
      paths.push_back(*path), refined.push_back(refines);
      earlier = path;
    }
    // As all commands do.
    paths = with_near_ends_joined(std::move(paths), narrowest_bridge / scale).paths;
    std::vector<std::unique_ptr<Incision>> cuts;
    for (std::size_t i = 0; i < paths.size(); ++i)
      if (auto cut = make(mesh, paths[i], scale, refined[i])) cuts.push_back(std::move(cut));
    if (!wanted || cuts.empty() || (plan_.crossing && cuts.size() < 2)) return;
    ++tally_.groups, ++tally_.of[static_cast<std::size_t>(kind)];
    open(cuts, kind, scale, subject_.name + ", cut " + std::to_string(first) + " (" + kinds + ")", begin);
  }

  std::unique_ptr<Incision> make(CutMesh& mesh, const ScalpelPath& path, double scale, bool refined) {
    IncisionOptions options;
    if (!refined) options.max_edge = 0;
    options.reach = reach_of(fields_().shape(), scale);
    std::unique_ptr<Incision> cut;
    try {
      cut = std::make_unique<Incision>(mesh, path, options);
      cut->advance_to(path.length());
    } catch (const InputError&) {
      ++tally_.refused;
    }
    return cut;
  }

  void open(const std::vector<std::unique_ptr<Incision>>& cuts, PathKind kind, double scale,
            const std::string& label, double begin) {
    const CutFields fields = fields_();
    std::vector<Wound> wounds;
    try {
      for (const auto& cut : cuts) wounds.push_back(fields.wound(*cut, scale));
    } catch (const InputError&) {  // the tension stands upright on the skin
      tally_.refused += static_cast<long>(cuts.size()), --tally_.groups;
      --tally_.of[static_cast<std::size_t>(kind)];
      return;
    }
    const FieldLimits limits = fields.following_shape() ? FieldLimits(wounds) : limits_;
    const Opened opened = look_at_opened(ReplayedWounds(std::move(wounds)), limits, plan_.positions);
    tally_.sum.add(opened);
    const double seconds = now() - begin;
    tally_.slowest = std::max(tally_.slowest, seconds);
    tally_.unsound += !opened.sound(), tally_.unsound_of[static_cast<std::size_t>(kind)] += !opened.sound();
    if (!plan_.list || (opened.sound() && seconds < slow)) return;
    std::ostringstream line;
    line << std::setprecision(4) << label << ", " << seconds << " s, " << scale
         << " mm a unit: " << text_of(opened);
    tally_.listed.push_back(line.str());
  }

  const Subject& subject_;
  const FieldsOfGroup& fields_;
  const FieldLimits& limits_;
  const OpeningPlan& plan_;
  Ground ground_;
  std::mt19937_64 random_;
  double mean_edge_ = 0;
  OpeningTally tally_;
};

}  // namespace

void OpeningTally::add(const OpeningTally& o) {
  cuts += o.cuts, refused += o.refused, groups += o.groups, unsound += o.unsound;
  slowest = std::max(slowest, o.slowest);
  sum.add(o.sum);
  for (std::size_t i = 0; i < of.size(); ++i) of[i] += o.of[i], unsound_of[i] += o.unsound_of[i];
}

OpeningTally open_random_cuts(const Subject& subject, const FieldsOfGroup& fields, const FieldLimits& limits,
                              const OpeningPlan& plan) {
  return Opening(subject, fields, limits, plan).run();
}

}  // namespace cleft::stress
