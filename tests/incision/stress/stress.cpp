#include "tests/incision/stress/stress.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <memory>
#include <sstream>

#include "base/error.h"
#include "explorer/incision/incision.h"
#include "explorer/incision/triangle_quality.h"
#include "tests/incision/stress/blade_trace.h"
#include "tests/incision/stress/refusals.h"
#include "tests/incision/stress/soundness.h"
#include "tests/incision/stress/wedge.h"

namespace cleft::stress {

namespace {

/// A message without its numbers, to count messages of one kind.
std::string kind_of(const std::string& message) {
  std::string kind;
  for (const char c : message.substr(0, message.find(';')))
    if (!std::isdigit(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '+') kind += c;
  return kind.substr(0, 60);
}

bool same(const CutMesh& a, const CutMesh& b) {
  const auto equal = [](const CutMesh::Triangle& x, const CutMesh::Triangle& y) {
    return x.vertex == y.vertex && x.neighbor == y.neighbor && x.region == y.region && x.sheet == y.sheet;
  };
  const auto alike = [](const CutMesh::Vertex& x, const CutMesh::Vertex& y) {
    return x.position == y.position && x.triangle == y.triangle && x.kind == y.kind;
  };
  return std::equal(a.triangles().begin(), a.triangles().end(), b.triangles().begin(), b.triangles().end(),
                    equal) &&
         std::equal(a.vertices().begin(), a.vertices().end(), b.vertices().begin(), b.vertices().end(),
                    alike);
}

class Stress {
 public:
  Stress(const std::string& name, const SurfaceMesh& surface, const Plan& plan)
      : name_(name), plan_(plan), ground_(surface), mesh_(surface), soundness_(mesh_), random_(plan.seed) {
    worst_before_ = smallest_radius_ratio(mesh_);
    large_ = surface.triangles.size() > 100000;
  }

  Tally run() {
    const auto& only = plan_.only;
    const long last =
        only.empty() ? plan_.paths : std::min(plan_.paths, 1 + *std::max_element(only.begin(), only.end()));
    while (tally_.paths < last && Clock::now() < plan_.until) group();
    return tally_;
  }

 private:
  /// Some cuts in one mesh, then all undone.
  void group() {
    std::vector<std::unique_ptr<Incision>> cuts;
    std::optional<ScalpelPath> earlier;
    const int count = 1 + static_cast<int>(random_() % static_cast<unsigned>(plan_.cuts_at_once));
    idle_ = !plan_.only.empty() && std::none_of(plan_.only.begin(), plan_.only.end(), [&](long path) {
      return tally_.paths <= path && path < tally_.paths + count;
    });
    for (int i = 0; i < count; ++i) {
      const std::uint64_t seed = random_();
      std::mt19937_64 own(seed);
      PathKind kind = static_cast<PathKind>(own() % path_kinds);
      if (earlier && own() % 2 == 0) kind = PathKind::across;
      std::optional<ScalpelPath> path = random_path(ground_, kind, earlier, own);
      if (!path) continue;
      std::ostringstream label;
      label << name_ << ", seed " << plan_.seed << ", path " << tally_.paths << " (" << name_of(kind)
            << ", cut " << i << ")";
      label_ = label.str();
      ++tally_.paths;
      ++tally_.paths_of[static_cast<std::size_t>(kind)];
      auto cut = one(*path, kind, own);
      if (!cut) continue;
      cuts.push_back(std::move(cut));
      earlier = path;
    }
    for (; !cuts.empty(); cuts.pop_back()) take_back(*cuts.back());
    if (!large_ && !idle_ && !same(mesh_, ground_.mesh)) violation("undo has left something behind");
  }

  std::unique_ptr<Incision> one(const ScalpelPath& path, PathKind kind, std::mt19937_64& random) {
    const int euler = soundness_.euler();
    const long boundary = soundness_.boundary_edges();
    const double area = soundness_.skin_area();
    soundness_.forget_quality();
    lies_down_ = false;
    IncisionOptions options;
    if (random() % 4 != 0) options.max_edge = 0;
    if (options.max_edge)
      options.reach = 0;  // no field: what lies next to the path is looked at now and then
    std::unique_ptr<Incision> cut;
    const auto check = [&] {
      ++tally_.steps;
      if (const std::string wrong = soundness_.step(); !wrong.empty()) violation(wrong);
      if (soundness_.euler() != euler)
        violation("Euler characteristic " + std::to_string(soundness_.euler() - euler));
    };
    try {
      cut = std::make_unique<Incision>(mesh_, path, options);
      if (idle_) return cut;
      check();
      const int stops = 3 + static_cast<int>(random() % 40);
      for (int k = 1; k <= stops; ++k) {
        cut->advance_to(path.length() * k / stops);
        check();
      }
    } catch (const InputError& error) {
      ++tally_.refused;
      ++tally_.refused_of[static_cast<std::size_t>(kind)];
      refused(path, cut.get(), error.what());
      check();
    } catch (const std::exception& error) {
      violation(error.what());
      check();
      // A broken invariant may leave anything: start afresh.
      return nullptr;
    }
    if (!cut) return nullptr;
    after(*cut, kind, area, boundary);
    return cut;
  }

  void refused(const ScalpelPath& path, const Incision* cut, const std::string& why) {
    if (idle_) return;
    const std::string due =
        cut ? reason_to_refuse(ground_, path, mesh_.position(cut->chain().back().left), cut->tip(), mesh_)
            : reason_never_to_begin(ground_, path, mesh_);
    lies_down_ = due == lies_along;
    tally_.due += !due.empty();
    ++(due.empty() ? tally_.reasons[kind_of(why)] : tally_.due_reasons[due]);
    list("refused" + (due.empty() ? "" : " (" + due + ")") + ": " + why);
  }

  void after(Incision& cut, PathKind kind, double area, long boundary) {
    if (!large_ || tally_.paths % 100 == 0)
      if (const std::string wrong = soundness_.whole(); !wrong.empty()) violation(wrong);
    if (boundary == 0 && soundness_.boundary_edges() != 0) violation("the closed mesh has a boundary");
    double lip = 0;
    bool closed_again = false;
    const auto& chain = cut.chain();
    // Where it ended because the blade is parallel to the surface, its last piece climbs along the blade.
    const std::size_t upright = chain.size() - (lies_down_ ? 1 : 0);
    for (std::size_t i = 1; i < chain.size(); ++i) {
      if (i < upright) lip += norm(mesh_.position(chain[i].left) - mesh_.position(chain[i - 1].left));
      if (i + 1 < chain.size() && chain[i].left == chain[i].right && !closed_again)
        closed_again = chain.size() > 2;
      if (chain[i].s == chain[i - 1].s) ++tally_.crossings;
      if (!(mesh_.position(chain[i].left) == mesh_.position(chain[i].right))) violation("lips apart at rest");
    }
    if (closed_again) violation("a vertex of the lips without a pair");
    if (upright > 2) compare_lips(cut, lip, chain[upright - 1]);
    const int worst_triangle = soundness_.worst_new_triangle();
    const double worst = worst_triangle < 0 ? 1 : radius_ratio(mesh_, worst_triangle),
                 asked = 0.05 * std::min(worst_before_, 0.1);
    tally_.worst_quality = std::min(tally_.worst_quality, worst / asked);
    const bool poor = worst < asked;
    tally_.poor += poor;
    const bool squeezed = poor && (between_edges(worst_triangle, cut.cut()) ||
                                   best_between_lips(mesh_, worst_triangle, cut) < asked);
    tally_.squeezed += squeezed;
    if (poor)
      list("a triangle of " + std::to_string(worst / asked) + " of what is asked near " +
           place_of(mesh_.position(mesh_.triangle(worst_triangle).vertex[0])) +
           (squeezed ? ", squeezed" : ""));
    if (poor && !squeezed && plan_.good)
      violation("a triangle of " + std::to_string(worst / asked) + " of what is asked");
    tally_.poor_of[static_cast<std::size_t>(kind)] += poor;
    bool moved = cut.bent();
    for (const auto& c : chain) moved |= !(mesh_.vertex(c.left).original == mesh_.position(c.left));
    if (!moved) {
      const double change = std::abs(soundness_.skin_area() / area - 1);
      tally_.worst_area = std::max(tally_.worst_area, change);
      if (change > 1e-10) violation("the skin's area has changed by " + std::to_string(change));
    }
  }

  void compare_lips(Incision& cut, double lip, const Incision::ChainVertex& end) {
    const Vec3 first = mesh_.position(cut.chain().front().left), last = mesh_.position(end.left);
    const auto way_over = [&](const Ground& ground) {
      return blade_trace(ground, cut.path(), first, cut.start(), last, end.s);
    };
    // Of a path that was stopped a part is compared, and straight pieces stray by so much of the whole.
    const double stray =
        cut.left_mesh() || cut.tip() >= 0.99 * cut.path().length() ? 0 : cut.path().length() / 1000;
    const auto error_over = [&](double way) { return std::max(0., std::abs(lip - way) - stray) / way; };
    auto way = way_over(ground_);
    tally_.jumping += !way;
    if (!way) return;
    // Earlier cuts have moved the skin, by as much as they may stray.
    if (error_over(*way) > 0.01) way = way_over(Ground(skin_before(cut))).value_or(*way);
    const double error = error_over(*way);
    tally_.worst_lip_length = std::max(tally_.worst_lip_length, error);
    if (error <= 0.01) return;
    ++tally_.long_lips;
    const std::string what = "lips " + std::to_string(lip / *way) + " of the blade's way";
    list(what);
    if (plan_.good) violation(what);
  }

  /// The skin that the cut has met, with earlier wounds closed: vertices of lips on one place are the same.
  SurfaceMesh skin_before(Incision& cut) {
    cut.undo();
    soundness_.step();
    SurfaceMesh skin;
    std::map<std::array<double, 3>, int> known;
    for (const CutMesh::Triangle& t : mesh_.triangles()) {
      if (t.region != Region::skin) continue;
      std::array<int, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = mesh_.position(t.vertex[i]);
        const auto [at, fresh] = known.insert({{p.x, p.y, p.z}, static_cast<int>(skin.points.size())});
        if (fresh) skin.points.push_back(p);
        corners[i] = at->second;
      }
      skin.triangles.push_back(corners);
    }
    cut.redo();
    soundness_.step();
    return skin;
  }

  /// Whether a triangle, or a neighbour of it, touches the outline or another cut: where a path grazes these,
  /// the strip between them is as thin as it is.
  bool between_edges(int triangle, int cut) const {
    std::vector<int> triangles{triangle};
    for (const int n : mesh_.triangle(triangle).neighbor)
      if (n >= 0) triangles.push_back(n);
    for (const int t : triangles)
      for (const int v : mesh_.triangle(t).vertex) {
        const CutMesh::Vertex& x = mesh_.vertex(v);
        if (x.cut >= 0 && x.cut != cut) return true;
        if (mesh_.is_skin(x.triangle) && mesh_.on_boundary(v)) return true;
      }
    return false;
  }

  void take_back(Incision& cut) {
    if (random_() % 4 == 0 && !idle_) {  // there and back again
      const CutMesh before = large_ ? CutMesh(SurfaceMesh{}) : mesh_;
      cut.undo();
      soundness_.step();
      cut.redo();
      if (const std::string wrong = soundness_.step(); !wrong.empty()) violation("redo: " + wrong);
      if (!large_ && !same(before, mesh_)) violation("redo makes another mesh");
      ++tally_.undone;
    }
    cut.undo();
    if (const std::string wrong = soundness_.step(); !wrong.empty()) violation("undo: " + wrong);
  }

  void list(const std::string& what) {
    if (plan_.list) tally_.listed.push_back(label_ + ": " + what);
  }

  void violation(const std::string& what) {
    ++tally_.violations;
    if (tally_.first_violations.size() < 8) tally_.first_violations.push_back(label_ + ": " + what);
  }

  std::string name_, label_;
  Plan plan_;
  Ground ground_;
  CutMesh mesh_;
  Soundness soundness_;
  std::mt19937_64 random_;
  double worst_before_ = 1;
  bool lies_down_ = false;             // the last path ended where the blade is parallel to the surface
  bool large_ = false, idle_ = false;  // idle: on the way to a path that is asked for
  Tally tally_;
};

}  // namespace

void Tally::add(const Tally& o) {
  paths += o.paths, refused += o.refused, violations += o.violations, steps += o.steps,
      crossings += o.crossings;
  undone += o.undone, poor += o.poor, jumping += o.jumping, squeezed += o.squeezed, long_lips += o.long_lips;
  worst_quality = std::min(worst_quality, o.worst_quality);
  worst_lip_length = std::max(worst_lip_length, o.worst_lip_length);
  worst_area = std::max(worst_area, o.worst_area);
  due += o.due;
  for (const auto& [reason, count] : o.reasons) reasons[reason] += count;
  for (const auto& [reason, count] : o.due_reasons) due_reasons[reason] += count;
  first_violations.insert(first_violations.end(), o.first_violations.begin(), o.first_violations.end());
  for (std::size_t i = 0; i < paths_of.size(); ++i)
    paths_of[i] += o.paths_of[i], refused_of[i] += o.refused_of[i], poor_of[i] += o.poor_of[i];
}

Tally stress(const std::string& name, const SurfaceMesh& surface, const Plan& plan) {
  return Stress(name, surface, plan).run();
}

}  // namespace cleft::stress
