#include "explorer/body/own_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "base/error.h"
#include "base/text.h"
#include "explorer/body/skin_coordinates.h"

namespace cleft {

namespace {

constexpr double beside_path = 0.5;  // of an edge: how far it may be from its path
constexpr double as_long = 0.02;  // of an edge: a path that ends so near to its walls is as long as they are

/// Assigns walls to paths.
class Assignment {
 public:
  Assignment(const OwnColumns& columns, const std::vector<ScalpelPath>& paths, const FrontParts& fronts,
             const std::string& name)
      : c_(columns), paths_(paths), fronts_(fronts), name_(name) {
    for (std::size_t n = 0; n < c_.place.size(); ++n) ++copies_[c_.place[n]];
  }

  std::vector<OwnCut> run() {
    for (const ScalpelPath& path : paths_) cuts_.push_back({path, {}, 0});
    std::map<std::pair<int, int>, std::vector<const OwnWall*>> by_edge;
    for (const OwnWall& wall : c_.walls) {
      const auto [a, b] = ends(wall, 0);
      by_edge[std::minmax(a, b)].push_back(&wall);
    }
    for (auto& [edge, walls] : by_edge) {
      std::sort(walls.begin(), walls.end(), [](auto* a, auto* b) { return a->layer < b->layer; });
      for (std::size_t k = 0; k < walls.size(); ++k)
        if (walls[k]->layer != static_cast<int>(k) || walls[k]->column != walls.front()->column)
          throw FileError(name_,
                          "the walls below the skin at " + place_text(c_.points[edge.first]) +
                              " mm do not go down from the skin without a gap; a cut begins at the skin");
      assign(*walls.front(), static_cast<int>(walls.size()));
    }
    for (std::size_t k = 0; k < cuts_.size(); ++k) finish(k);
    return std::move(cuts_);
  }

 private:
  /// The places of the ends of a wall's upper edge, seen from one of its columns.
  std::pair<int, int> ends(const OwnWall& wall, int side) const {
    const auto& t = c_.skin[wall.column[side]];
    return {c_.place[t[wall.edge[side]]], c_.place[t[(wall.edge[side] + 1) % 3]]};
  }

  void assign(const OwnWall& wall, int layers) {
    const auto [a, b] = ends(wall, 0);
    const Vec3 middle = 0.5 * (c_.points[a] + c_.points[b]);
    const double length = norm(c_.points[b] - c_.points[a]);
    std::size_t best = 0;
    double distance = std::numeric_limits<double>::infinity(), s = 0;
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      const PathCoordinates at = paths_[k].coordinates(middle);
      const double beyond = std::max({0., -at.s - length, at.s - paths_[k].length() - length});
      if (const double d = std::hypot(at.v, at.w, beyond); d < distance) distance = d, best = k, s = at.s;
    }
    if (!(distance <= beside_path * length))
      throw FileError(name_,
                      "walls with doubled nodes at " + place_text(middle) + " mm are " +
                          shortest(std::round(1e3 * distance) / 1e3) +
                          " mm from the nearest path: give the path of that cut (--path); where no cut "
                          "is meant, merge the nodes (gmsh: Coherence)");
    const ScalpelPath& path = paths_[best];
    const auto place = [&](int p) { return path.coordinates(c_.points[p], s - length, s + length).s; };
    OwnEdge edge{a, b, place(a), place(b), wall.column, {}, {}, layers};
    if (edge.s_from > edge.s_to) std::swap(edge.from, edge.to), std::swap(edge.s_from, edge.s_to);
    const auto& t = c_.skin[wall.column[0]];
    const Vec3 centroid = 1. / 3 * (c_.points[t[0]] + c_.points[t[1]] + c_.points[t[2]]);
    if (dot(centroid - middle, path.at(s).across) > 0) std::swap(edge.column[0], edge.column[1]);
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < 3; ++i) {
        const int at = c_.place[c_.skin[edge.column[side]][i]];
        if (at == edge.from) edge.corner[side] = i;
        if (at == edge.to) edge.corner_to[side] = i;
      }
    cuts_[best].edges.push_back(edge);
  }

  /// The path as long as its walls, but for the front's part of an element at ends that are closed.
  void finish(std::size_t number) {
    OwnCut& cut = cuts_[number];
    if (cut.edges.empty())
      throw FileError(name_, "has no walls with doubled nodes along path " + std::to_string(number + 1) +
                                 ": double the nodes on the surface of the cut (gmsh: Plugin(Crack))");
    std::sort(cut.edges.begin(), cut.edges.end(),
              [](const OwnEdge& a, const OwnEdge& b) { return a.s_from + a.s_to < b.s_from + b.s_to; });
    const OwnEdge &first = cut.edges.front(), &last = cut.edges.back();
    const auto part = [&](int place) { return copies_.at(place) > 1 ? 0 : fronts_.end; };
    double from = first.s_from + part(first.from) * (first.s_to - first.s_from);
    double to = last.s_to - part(last.to) * (last.s_to - last.s_from);
    if (std::abs(from) < as_long * (first.s_to - first.s_from)) from = 0;
    if (std::abs(to - cut.path.length()) < as_long * (last.s_to - last.s_from)) to = cut.path.length();
    if (from != 0 || to != cut.path.length()) {
      cut.path = stretched(cut.path, from, to, last.s_to - last.s_from);
      for (OwnEdge& edge : cut.edges) edge.s_from -= from, edge.s_to -= from;
    }
    for (const OwnEdge& edge : cut.edges)
      for (const int corner : {edge.corner[0], edge.corner_to[0]}) {
        const auto& column = c_.wedges[edge.column[0]];
        const auto& deepest = column[edge.layers - 1];
        const int lower = deepest[corner], upper = deepest[3 + corner];
        const double front = copies_.at(c_.place[lower]) > 1 ? 0 : fronts_.bottom;
        cut.depth = std::max(cut.depth, c_.depth[lower] - front * (c_.depth[lower] - c_.depth[upper]));
      }
  }

  const OwnColumns& c_;
  const std::vector<ScalpelPath>& paths_;
  const FrontParts& fronts_;
  const std::string& name_;
  std::map<int, int> copies_;  // by place: number of nodes
  std::vector<OwnCut> cuts_;
};

/// At a place, two nodes on either side of a wall that a visit of the blade opens.
struct Join {
  int left, right;
  int visit;
};

/// The blade is at a place of a cut. passed: the edge that ends there; ahead: the one that begins there;
/// null: none.
struct Visit {
  int cut;
  double s;
  const OwnEdge *passed, *ahead;
};

class Opening {
 public:
  Opening(const OwnColumns& columns, const std::vector<OwnCut>& cuts, const FrontParts& fronts,
          const std::vector<double>& release, const std::string& name, Body& body)
      : c_(columns), cuts_(cuts), fronts_(fronts), release_(release), name_(name), b_(body) {}

  void run() {
    list_visits();
    list_joins();
    find_pairs();
    release_.empty() ? open_along_paths() : open_by_array();
  }

 private:
  void list_visits() {
    for (int c = 0; c < static_cast<int>(cuts_.size()); ++c) {
      const auto& edges = cuts_[c].edges;
      const bool loop = edges.front().from == edges.back().to;
      for (std::size_t i = 0; i < edges.size(); ++i) {
        const OwnEdge* passed = i > 0 && edges[i - 1].to == edges[i].from ? &edges[i - 1] : nullptr;
        if (i > 0 && !passed) visits_.push_back({c, edges[i - 1].s_to, &edges[i - 1], nullptr});
        if (i > 0 || !loop) visits_.push_back({c, edges[i].s_from, passed, &edges[i]});
      }
      visits_.push_back({c, edges.back().s_to, &edges.back(), loop ? &edges.front() : nullptr});
    }
  }

  void list_joins() {
    for (int v = 0; v < static_cast<int>(visits_.size()); ++v) {
      if (const OwnEdge* e = visits_[v].passed) list_joins(v, *e, e->corner_to);
      if (const OwnEdge* e = visits_[v].ahead) list_joins(v, *e, e->corner);
    }
  }

  void list_joins(int visit, const OwnEdge& edge, const std::array<int, 2>& corner) {
    for (int level = 0; level <= edge.layers; ++level) {
      int node[2];
      for (int side = 0; side < 2; ++side)
        node[side] = level == 0 ? c_.skin[edge.column[side]][corner[side]]
                                : c_.wedges[edge.column[side]][level - 1][corner[side]];
      if (node[0] != node[1]) joins_[c_.place[node[0]]].push_back({node[0], node[1], visit});
    }
  }

  /// From the last visit to the first, nodes that a visit parts are joined again: each part of a place has
  /// one node that stands for it, that of its left part.
  void find_pairs() {
    std::map<int, std::vector<int>> copies;
    for (int n = 0; n < static_cast<int>(c_.place.size()); ++n) copies[c_.place[n]].push_back(n);
    for (auto& [place, nodes] : copies) {
      if (nodes.size() < 2) continue;
      std::vector<Join>& joins = joins_[place];
      std::stable_sort(joins.begin(), joins.end(), [](auto& a, auto& b) { return a.visit > b.visit; });
      std::map<int, int> stands;  // by node
      for (const int n : nodes) stands[n] = n;
      std::vector<std::pair<int, BodyPair>> found;
      for (const Join& join : joins) {
        const int a = stands[join.left], b = stands[join.right];
        if (a == b) continue;
        found.emplace_back(join.visit, pair_of(a, b, visits_[join.visit]));
        for (auto& [node, by] : stands)
          if (by == b) by = a;
      }
      for (const auto& [node, by] : stands)
        if (by != stands.begin()->second)
          throw FileError(name_, "nodes " + std::to_string(nodes[0]) + " and " + std::to_string(node) +
                                     " at " + place_text(c_.points[node]) +
                                     " mm have one place, and no wall of a cut parts them; merge them");
      std::reverse(found.begin(), found.end());
      pairs_.insert(pairs_.end(), found.begin(), found.end());
    }
    std::stable_sort(pairs_.begin(), pairs_.end(), [](auto& a, auto& b) {
      return std::pair(a.first, a.second.depth) < std::pair(b.first, b.second.depth);
    });
  }

  BodyPair pair_of(int left, int right, const Visit& visit) const {
    const ScalpelPath& path = cuts_[visit.cut].path;
    const double along = std::clamp(visit.s, 0., path.length()) - path.length() / 2;
    return {left, right, visit.cut, along, c_.depth[left], path.at(visit.s).across};
  }

  /// As bodies that are made below a surface: the tip is just inside the first node ahead that is closed.
  void open_along_paths() {
    begin();
    std::size_t next = 0;
    double before = 0;
    for (std::size_t v = 0; v < visits_.size(); ++v) {
      const Visit& visit = visits_[v];
      const double length = cuts_[visit.cut].path.length();
      const std::size_t had = b_.pairs.size();
      while (next < pairs_.size() && pairs_[next].first == static_cast<int>(v))
        b_.pairs.push_back(pairs_[next++].second);
      const bool last = v + 1 == visits_.size() || visits_[v + 1].cut != visit.cut;
      double tip = last ? length : visits_[v + 1].s - fronts_.end * (visits_[v + 1].s - visit.s);
      tip = std::clamp(tip, 0., length);
      if (b_.pairs.size() > had) {
        if (before + tip > b_.times.back() + 1e-9 * length)
          add_frame(before + tip, tip - length / 2);
        else if (b_.times.size() > 1)
          b_.released.back() = static_cast<int>(b_.pairs.size());
      }
      if (!last) continue;
      if (b_.released.back() < static_cast<int>(b_.pairs.size())) add_frame(before + length, length / 2);
      if (b_.times.back() > before) b_.times.back() = before + length, b_.position.back() = length / 2;
      before += length;
    }
  }

  void open_by_array() {
    std::vector<double> when;
    for (auto& [visit, pair] : pairs_) {
      const double at = release_[pair.left];
      if (!(at > 0) || !std::isfinite(at) || at != release_[pair.right])
        throw FileError(name_,
                        "nodes " + std::to_string(pair.left) + " and " + std::to_string(pair.right) + " at " +
                            place_text(c_.points[pair.left]) + " mm open at " + shortest(at) + " and " +
                            shortest(release_[pair.right]) +
                            ": the array of --release must have one number above 0 for both, the mm cut "
                            "when they part");
      when.push_back(at);
    }
    std::vector<std::size_t> order(pairs_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return when[a] < when[b]; });
    begin();
    for (const std::size_t n : order) {
      b_.pairs.push_back(pairs_[n].second);
      if (when[n] > b_.times.back())
        add_frame(when[n], place_of(when[n]));
      else
        b_.released.back() = static_cast<int>(b_.pairs.size());
    }
  }

  /// Of the tip along the cut that is made, from its middle.
  double place_of(double time) const {
    for (const OwnCut& cut : cuts_) {
      const double length = cut.path.length();
      if (time <= length || &cut == &cuts_.back()) return std::min(time, length) - length / 2;
      time -= length;
    }
    return 0;
  }

  void begin() { b_.released = {0}, b_.times = {0}, b_.position = {-cuts_.front().path.length() / 2}; }
  void add_frame(double time, double position) {
    b_.times.push_back(time), b_.position.push_back(position);
    b_.released.push_back(static_cast<int>(b_.pairs.size()));
  }

  const OwnColumns& c_;
  const std::vector<OwnCut>& cuts_;
  const FrontParts& fronts_;
  const std::vector<double>& release_;
  const std::string& name_;
  Body& b_;
  std::vector<Visit> visits_;
  std::map<int, std::vector<Join>> joins_;       // by place
  std::vector<std::pair<int, BodyPair>> pairs_;  // and the visit that parts them
};

}  // namespace

std::vector<OwnCut> cuts_of(const OwnColumns& columns, const std::vector<ScalpelPath>& paths,
                            const FrontParts& fronts, const std::string& name) {
  return Assignment(columns, paths, fronts, name).run();
}

void open_cuts(const OwnColumns& columns, const std::vector<OwnCut>& cuts, const FrontParts& fronts,
               const std::vector<double>& release, const std::string& name, Body& body) {
  Opening(columns, cuts, fronts, release, name, body).run();
}

}  // namespace cleft
