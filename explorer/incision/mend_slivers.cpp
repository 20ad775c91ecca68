#include "explorer/incision/mend_slivers.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "explorer/incision/incision_tolerances.h"
#include "explorer/incision/triangle_quality.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

struct Quad {
  int a, b, c, d;  // triangles (a, b, c) and (b, a, d)
};

Quad quad_at(const CutMesh& mesh, int t, int i) {
  const CutMesh::Triangle &x = mesh.triangle(t), &y = mesh.triangle(x.neighbor[i]);
  const int b = x.vertex[(i + 1) % 3];
  return {x.vertex[i], b, x.vertex[(i + 2) % 3], y.vertex[(y.corner(b) + 2) % 3]};
}

/// Changes triangles one by one for better shapes.
class Mender {
 public:
  Mender(CutMesh& mesh, double target, double bend, const KeptEdge& kept)
      : mesh_(mesh), target_(target), bend_(bend), kept_(kept) {}

  /// By changes each of which is itself for the better.
  void mend(const std::vector<int>& triangles) {
    std::deque<int> work(triangles.begin(), triangles.end());  // taken from the back, put before the front
    for (std::size_t changes = 0,
                     most = Limits::changes_per_sliver * triangles.size() + Limits::further_changes;
         !work.empty() && changes < most;) {
      const int t = work.back();
      work.pop_back();
      if (!is_sliver(t)) continue;
      const std::size_t first_new = mesh_.triangles().size();
      const auto neighbors = mesh_.triangle(t).neighbor;
      const std::vector<int> across = across_wounds(t);
      if (!flip_best(t) && !split_longest(t)) continue;
      ++changes;
      work.insert(work.begin(), neighbors.begin(), neighbors.end());
      work.insert(work.begin(), across.begin(), across.end());
      work.push_front(t);
      for (std::size_t n = first_new; n < mesh_.triangles().size(); ++n) work.push_front(static_cast<int>(n));
    }
  }

  /// By splits that are for the better only with the changes that follow.
  void mend_by_trials(const std::vector<int>& triangles) {
    std::vector<int> work = triangles;
    for (int changes = 0, failures = 0;
         !work.empty() && changes < Limits::trial_changes && failures < Limits::trial_failures;) {
      const int t = work.back();
      work.pop_back();
      if (!is_sliver(t)) continue;
      const CutMesh::Checkpoint since = mesh_.checkpoint();
      if (!split_best(t)) {
        ++failures;
        continue;
      }
      ++changes;
      const std::vector<int> changed = mesh_.changed_since(since);
      work.insert(work.end(), changed.begin(), changed.end());
    }
  }

  bool bent() const { return bent_; }

 private:
  bool is_sliver(int t) const { return mesh_.is_skin(t) && radius_ratio(mesh_, t) < target_; }
  bool is_kept(int a, int b) const {
    return (a == kept_[0] && b == kept_[1]) || (a == kept_[1] && b == kept_[0]);
  }

  /// The smaller radius ratio of the two triangles after flipping edge i of t; 0 where it must not be
  /// flipped.
  double ratio_after_flip(int t, int i, double bend) const {
    const int other = mesh_.triangle(t).neighbor[i];
    if (!mesh_.is_skin(other)) return 0;
    const Quad q = quad_at(mesh_, t, i);
    if (is_kept(q.a, q.b)) return 0;
    const Vec3 &a = mesh_.position(q.a), &b = mesh_.position(q.b), &c = mesh_.position(q.c),
               &d = mesh_.position(q.d);
    const Vec3 n = cross(d - c, b - a);  // of the quadrilateral, by its diagonals
    const double size = norm(n);
    const double plane = Limits::flat * std::max(norm(b - a), norm(d - c)),
                 apart = size > 0 ? std::abs(dot(n, a - c)) / size
                                  : std::numeric_limits<double>::infinity();  // between the diagonals
    if (apart > std::max(bend, plane)) return 0;
    if (apart > plane && turns(a, b, c, d)) return 0;
    if (dot(cross(d - a, c - a), n) <= 0 || dot(cross(b - d, c - d), n) <= 0) return 0;  // not convex
    if (mesh_.any_triangle_with(q.c, q.d) >= 0 || mesh_.any_triangle_with(q.d, q.c) >= 0) return 0;
    return std::min(radius_ratio(a, d, c), radius_ratio(d, b, c));
  }

  /// Whether flipping the edge a b would turn a face away from those that were there, as it can where these
  /// are narrow however little it moves them: the blade might see it from behind.
  static bool turns(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto unit = [](const Vec3& p, const Vec3& q, const Vec3& r) {
      return normalized(cross(q - p, r - p));
    };
    const Vec3 old[] = {unit(a, b, c), unit(b, a, d)};
    const double least = std::min(Limits::turned_cosine, dot(old[0], old[1])) - Limits::turned_slack;
    for (const Vec3& fresh : {unit(a, d, c), unit(d, b, c)})
      if (std::min(dot(fresh, old[0]), dot(fresh, old[1])) < least) return true;
    return false;
  }

  bool flip_best(int t) {
    int best = -1;
    double most = 0;
    for (int i = 0; i < 3; ++i) {
      const double after = ratio_after_flip(t, i, bend_);
      if (after <= 0) continue;
      const double before =
          std::min(radius_ratio(mesh_, t), radius_ratio(mesh_, mesh_.triangle(t).neighbor[i]));
      if (after > Limits::better * before && after > most) most = after, best = i;
    }
    if (best < 0) return false;
    if (bend_ > 0 && ratio_after_flip(t, best, 0) <= 0) bent_ = true;
    mesh_.flip_edge(t, best);
    return true;
  }

  /// The longest edge of t: a new vertex at the foot of its height, or in its middle.
  bool split_longest(int t) {
    const CutMesh::Triangle x = mesh_.triangle(t);
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (length(x, i) > length(x, longest)) longest = i;
    if (!may_split(x, longest)) return false;
    const int c = x.vertex[(longest + 2) % 3],
              d = mesh_.is_skin(x.neighbor[longest]) ? quad_at(mesh_, t, longest).d : -1;
    const Vec3 &from = mesh_.position(x.vertex[longest]), &to = mesh_.position(x.vertex[(longest + 1) % 3]);
    const auto ratio = [&](const Vec3& a, const Vec3& b) {  // of the triangles on the edge a b
      const double first = radius_ratio(a, b, mesh_.position(c));
      return d < 0 ? first : std::min(first, radius_ratio(b, a, mesh_.position(d)));
    };
    const double before = ratio(from, to), at_foot = foot(x, longest);
    const bool near_end = at_foot < Limits::foot_from_end || at_foot > Limits::foot_to_end;
    for (const double part : {near_end ? 0.5 : at_foot, at_foot}) {
      if (!far_from_ends(part)) continue;
      const Vec3 place = lerp(from, to, part);
      if (std::min(ratio(from, place), ratio(place, to)) < Limits::better * before) continue;
      mesh_.split_edge(t, longest, place);
      return true;
    }
    return false;
  }

  /// The skin's triangles across wounds from t, which splits of its edges there split too.
  std::vector<int> across_wounds(int t) const {
    std::vector<int> found;
    const CutMesh::Triangle& x = mesh_.triangle(t);
    for (int i = 0; i < 3; ++i) {
      if (!mesh_.is_wall(x.neighbor[i])) continue;
      const int edge = mesh_.triangle(x.neighbor[i]).corner(x.vertex[(i + 1) % 3]);
      found.push_back(mesh_.triangle(mesh_.twin(x.neighbor[i])).neighbor[CutMesh::twin_edge(edge)]);
    }
    return found;
  }

  /// The split of one of its edges, or of a neighbour's, that with what it makes possible leaves the best
  /// triangles; none where that is no better.
  bool split_best(int t) {
    const CutMesh::Triangle x = mesh_.triangle(t);
    const double before = radius_ratio(mesh_, t),
                 shortest = std::min({length(x, 0), length(x, 1), length(x, 2)});
    Split best{-1, -1, 0};
    double most = Limits::better * before;
    for (const auto& [owner, i] : edges_around(t)) {
      const CutMesh::Triangle y = mesh_.triangle(owner);
      if (!may_split(y, i)) continue;
      const double rung = Limits::needle_rung * shortest / length(y, i);  // beside the short edge of a needle
      for (const double part : {0.5, foot(y, i), rung, 1 - rung, rung / Limits::needle_rung_parts,
                                1 - rung / Limits::needle_rung_parts}) {
        if (!far_from_ends(part)) continue;
        const double after = ratio_after({owner, i, part}, t);
        if (after > most) most = after, best = {owner, i, part};
      }
    }
    if (best.triangle < 0) return false;
    make(best, t);
    return true;
  }

  struct Split {
    int triangle, edge;
    double part;
  };

  /// The edges of t and of its neighbours on the skin, each once.
  std::vector<std::array<int, 2>> edges_around(int t) const {
    std::vector<std::array<int, 2>> edges;
    for (int i = 0; i < 3; ++i) {
      edges.push_back({t, i});
      const int across = mesh_.triangle(t).neighbor[i];
      if (across < 0 || !mesh_.is_skin(across)) continue;
      for (int k = 0; k < 3; ++k)
        if (mesh_.triangle(across).neighbor[k] != t) edges.push_back({across, k});
    }
    return edges;
  }

  /// The smallest radius ratio of t and of the triangles that the split, with what follows, would make.
  /// (Others beside them may be worse, and stay so.)
  double ratio_after(const Split& split, int t) {
    const CutMesh::Checkpoint since = mesh_.checkpoint();
    const bool bent = bent_;
    make(split, t);
    double least = radius_ratio(mesh_, t);
    std::vector<std::pair<int, double>> worse;
    for (const int changed : mesh_.changed_since(since))
      if (const double ratio = mesh_.is_skin(changed) ? radius_ratio(mesh_, changed) : 1; ratio < least)
        worse.emplace_back(changed, ratio);
    mesh_.roll_back(since);
    bent_ = bent;
    const auto there = [&](int n) { return n < static_cast<int>(mesh_.triangles().size()); };
    for (const auto& [changed, ratio] : worse)
      if (!there(changed) || radius_ratio(mesh_, changed) != ratio) least = std::min(least, ratio);
    return least;
  }

  void make(const Split& split, int t) {
    const CutMesh::Checkpoint since = mesh_.checkpoint();
    const auto& v = mesh_.triangle(split.triangle).vertex;
    const Vec3 &from = mesh_.position(v[split.edge]), &to = mesh_.position(v[(split.edge + 1) % 3]);
    mesh_.split_edge(split.triangle, split.edge, lerp(from, to, split.part));
    std::vector<int> triangles = mesh_.changed_since(since);
    triangles.push_back(t);
    mend(triangles);
  }

  bool may_split(const CutMesh::Triangle& x, int i) const {
    return x.neighbor[i] != CutMesh::non_manifold && !is_kept(x.vertex[i], x.vertex[(i + 1) % 3]);
  }
  static bool far_from_ends(double part) {
    return part > Limits::split_from_end && part < Limits::split_to_end;
  }
  double length(const CutMesh::Triangle& x, int i) const {
    return norm(mesh_.position(x.vertex[(i + 1) % 3]) - mesh_.position(x.vertex[i]));
  }
  /// Where on edge i the height stands, from 0 to 1.
  double foot(const CutMesh::Triangle& x, int i) const {
    const Vec3 &a = mesh_.position(x.vertex[i]), &b = mesh_.position(x.vertex[(i + 1) % 3]);
    return dot(mesh_.position(x.vertex[(i + 2) % 3]) - a, b - a) / squared_norm(b - a);
  }

  CutMesh& mesh_;
  double target_, bend_;
  KeptEdge kept_;
  bool bent_ = false;
};

}  // namespace

bool mend_slivers(CutMesh& mesh, const std::vector<int>& triangles, double target, double bend,
                  const KeptEdge& kept) {
  Mender mender(mesh, target, bend, kept);
  mender.mend(triangles);
  return mender.bent();
}

bool mend_needles(CutMesh& mesh, const std::vector<int>& triangles, double target, double bend,
                  const KeptEdge& kept) {
  Mender mender(mesh, target, bend, kept);
  mender.mend_by_trials(triangles);
  return mender.bent();
}

}  // namespace cleft
