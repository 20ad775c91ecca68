#include "encoder/import/break_plane.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "encoder/import/both_ends.h"
#include "encoder/import/boundary.h"
#include "encoder/import/break_components.h"
#include "encoder/import/break_surface.h"

namespace cleft {

namespace {

constexpr double loosely_given = 1e-3;  // of the diagonal: a plane typed with a few digits

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// To three digits, for messages.
double rounded(double x) {
  const double unit = x > 0 ? std::pow(10, std::floor(std::log10(x)) - 2) : 1;
  return std::round(x / unit) * unit;
}

using Distance = std::function<double(const Vec3&)>;  // of a point from the break, with a sign

/// Corners that are nearer to a break are in it. A surface through places is as near to others of the break
/// as its curvature between them lets it be.
double near_break(const Break& found, double tolerance) { return (found.curved ? 100 : 1) * tolerance; }

/// Of the nodes of groups: the sum of their cells' centroids' distances from the break. Where arms meet,
/// cells between other arms are on no side of this one.
std::vector<double> sides(const SourceMesh& mesh, const Groups& groups, const Break& found, double tolerance,
                          const std::vector<char>& kept = {}) {
  std::vector<char> asked(mesh.points.size());
  for (const auto& group : groups)
    for (const std::int32_t node : group) asked[node] = 1;
  std::vector<double> side(mesh.points.size()), distances;
  FacesInBreak faces(mesh, asked);
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    const auto* first = mesh.connectivity.data() + mesh.cell_offsets[c];
    const auto* last = mesh.connectivity.data() + mesh.cell_offsets[c + 1];
    if (std::none_of(first, last, [&](std::int64_t i) { return asked[i]; })) continue;
    if (!kept.empty() && !std::all_of(first, last, [&](std::int64_t i) { return kept[i]; })) continue;
    distances.clear();
    for (const auto* i = first; i != last; ++i) distances.push_back(found.distance(mesh.points[*i]));
    if (faces.take(c, distances, near_break(found, tolerance))) continue;
    const double centroid =
        std::accumulate(distances.begin(), distances.end(), 0.) / static_cast<double>(last - first);
    if (std::abs(centroid) <= tolerance) continue;  // an interface element, between the two sides
    const auto is = [&](InArm part) { return [&, part](std::int64_t i) { return found.in_arm[i] == part; }; };
    const bool beside = found.in_arm.empty() || std::any_of(first, last, is(InArm::between_junctions));
    for (const auto* i = first; i != last; ++i)
      if (beside || !is(InArm::at_junction)(*i)) side[*i] += centroid;
  }
  faces.spread(side);
  return side;
}

/// Nodes at one place of a break; those without cells are on no side.
struct NodesBySide {
  std::vector<std::int32_t> left, right;

  NodesBySide(const std::vector<std::int32_t>& group, const std::vector<double>& side) {
    for (const std::int32_t node : group)
      if (side[node] != 0) (side[node] < 0 ? left : right).push_back(node);
  }
  /// Each left node with a right one.
  std::vector<NodePair> pairs() const {
    std::vector<NodePair> list;
    if (left.empty() || right.empty()) return list;
    for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i)
      list.push_back({left[std::min(i, left.size() - 1)], right[std::min(i, right.size() - 1)]});
    return list;
  }
};

class Search {
 public:
  Search(const ImportedSeries& series, const std::optional<Vec3>& flat)
      : series_(series), mesh_(series.mesh()), flat_(flat), tolerance_(in_plane(mesh_)) {
    groups_ = coincident_groups(mesh_.points, same_place(mesh_));
    asked_.assign(groups_.size(), 1);
  }

  const Groups& groups() const { return groups_; }

  /// Breaks that do not touch, and arms of those that branch or grow both ways; none where all is one break.
  std::vector<BreakComponent> components() const {
    if (groups_.empty()) return {};
    auto list = split_at_middle(
        mesh_, groups_, partings_,
        break_components(mesh_, groups_, partings_, static_cast<std::int32_t>(series_.frames())));
    if (list.size() < 2) list.clear();
    return list;
  }

  /// Looks at the groups of one of them from now on, and at those that part in no frame.
  void look_at(const BreakComponent& component) {
    const auto frames = static_cast<std::int32_t>(series_.frames());
    std::vector<char> parts(mesh_.points.size());
    for (std::size_t p = 0; p < partings_.pairs.size(); ++p)
      if (partings_.first_frame[p] < frames) parts[partings_.pairs[p][0]] = parts[partings_.pairs[p][1]] = 1;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      asked_[g] =
          std::none_of(groups_[g].begin(), groups_[g].end(), [&](std::int32_t n) { return parts[n]; });
    for (const std::size_t g : component.groups) asked_[g] = 1;
  }
  /// Of all nodes, where the component has junctions.
  std::vector<InArm> in_arm(const BreakComponent& component) const {
    if (component.junctions.empty()) return {};
    std::vector<InArm> parts(mesh_.points.size(), InArm::no);
    for (const auto& [groups, part] : {std::pair(&component.groups, InArm::between_junctions),
                                       std::pair(&component.junctions, InArm::at_junction)})
      for (const std::size_t g : *groups)
        for (const std::int32_t node : groups_[g]) parts[node] = part;
    return parts;
  }
  std::vector<Vec3> places_of(const std::vector<std::size_t>& groups) const {
    std::vector<Vec3> places;
    places.reserve(groups.size());
    for (const std::size_t g : groups) places.push_back(place_of(groups_[g]));
    return places;
  }

  void watch(const std::optional<OpenAt>& open_at, std::vector<std::string>& notes,
             const std::function<void(std::size_t)>& progress) {
    if (groups_.empty()) return;
    partings_ = partings(series_, groups_, open_at, progress);
    if (!partings_.because.empty())
      notes.push_back("pairs count as open from a jump of " + shortest(rounded(partings_.open_at)) + " in '" +
                      series_.fields()[telling_field(series_)].name + "' on (the largest is " +
                      shortest(rounded(partings_.largest_jump)) + "): " + partings_.because +
                      "; --open-at sets it");
  }

  /// The plane of the nodes that part; none where there are none.
  std::optional<Plane> found(std::vector<std::string>& notes) const {
    const std::vector<Vec3> parting = parting_places();
    std::vector<Vec3> all;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (asked_[g]) all.push_back(place_of(groups_[g]));
    if (all.empty()) return {};
    if (parting.empty()) {
      notes.push_back(counted(nodes_in_groups(), "coincident node") + " never part in '" +
                      series_.fields()[telling_field(series_)].name +
                      "': taken for a seam of the mesh, not for a break; --break takes them for one");
      return {};
    }
    if (const auto plane = common_plane(parting, tolerance_, flat_)) return plane;
    if (const auto plane = common_plane(all, tolerance_, flat_)) return plane;
    return upright_on_shell(parting);
  }

  /// The pairs of a break that is no plane, and its best plane: over it, the break is a surface.
  void pair_on_surface(Break& found, std::vector<std::string>& notes) const {
    const std::vector<Vec3> parting = parting_places();
    if (parting.empty()) return;
    const Spread spread = spread_of(parting);
    const Vec3 u = flat_ ? normalized(spread.axis[0] - dot(spread.axis[0], *flat_) * *flat_) : spread.axis[0];
    const Vec3 v = flat_ ? cross(*flat_, u) : spread.axis[2], w = cross(u, v);
    if (spread.deviation[flat_ ? 0 : 1] <= tolerance_) refuse_scattered(parting);
    const auto local = [&](const Vec3& p) {
      const Vec3 x = p - spread.centre;
      return Vec3{dot(u, x), dot(v, x), dot(w, x)};
    };
    BreakPlaces places{{}, {}, {}, {}, {}, tolerance_};
    for (const Vec3& p : parting) places.pairs.push_back(local(p));
    std::vector<Vec3> all;
    for (const Vec3& p : mesh_.points) all.push_back(local(p));
    places.u = range_of(all, 0), places.w = range_of(all, 2);
    double farthest = 0;
    const BreakMap surface = surface_through(places, farthest);
    if (farthest > folded * std::sqrt(squared_norm(local(parting.front()) - local(parting.back()))))
      refuse_scattered(parting);
    found.plane = Plane{forward(v), dot(forward(v), spread.centre)};
    found.curved = true;
    const double sign = dot(forward(v), v);
    const Vec3 centre = spread.centre;
    pair_where(
        found,
        [=](const Vec3& p) {
          const Vec3 x = p - centre;
          return sign * surface.canonical({dot(u, x), dot(v, x), dot(w, x)}).y;
        },
        notes);
  }

  /// The given plane, or a nearby one that contains the coincident nodes exactly.
  Plane given(const std::string& text) const {
    Plane plane = parse_plane(text);
    if (flat_) plane = upright(plane, text);
    refuse_one_sided(plane, text);
    if (groups_.empty()) return plane;
    const double loose = loosely_given * diagonal(mesh_.points);
    std::vector<Vec3> near;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& group : groups_) {
      const double distance = std::abs(plane.distance(place_of(group)));
      nearest = std::min(nearest, distance);
      if (distance <= loose) near.push_back(place_of(group));
    }
    if (near.empty())
      throw InputError("--break '" + text + "': none of the " +
                       counted(nodes_in_groups(), "coincident node") + " lies in this plane, the nearest " +
                       shortest(nearest) + " away; correct it, or leave it out to have it found");
    if (auto exact = common_plane(near, tolerance_, flat_); exact && dot(exact->normal, plane.normal) != 0) {
      if (dot(exact->normal, plane.normal) < 0) exact = Plane{-exact->normal, -exact->offset};
      if (std::abs(dot(exact->normal, plane.normal)) > 1 - loosely_given) return *exact;
    }
    return plane;
  }

  /// Pairs each left node of a place in the plane with a right one.
  void pair_in_plane(Break& found, std::vector<std::string>& notes) const {
    pair_where(
        found, [plane = *found.plane](const Vec3& p) { return plane.distance(p); }, notes);
  }

 private:
  static constexpr double folded = 0.02;  // of the break's extent

  std::vector<Vec3> parting_places() const {
    std::vector<Vec3> parting;
    const auto frames = static_cast<std::int32_t>(series_.frames());
    std::vector<char> node_asked(mesh_.points.size());
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const std::int32_t node : groups_[g]) node_asked[node] = asked_[g];
    for (std::size_t p = 0; p < partings_.pairs.size(); ++p)
      if (partings_.first_frame[p] < frames && node_asked[partings_.pairs[p][0]])
        parting.push_back(place_of(partings_.pairs[p]));
    return parting;
  }

  /// The plane through a straight slit in a shell that is no plane, upright on it.
  std::optional<Plane> upright_on_shell(const std::vector<Vec3>& slit) const {
    if (flat_ || slit.size() < 2 || spread_of(slit).deviation[1] > tolerance_) return {};
    std::vector<char> on_slit(mesh_.points.size());
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const std::int32_t node : groups_[g]) on_slit[node] = asked_[g];
    const auto normal = normal_of_shell(mesh_, on_slit);
    return normal ? common_plane(slit, tolerance_, normal) : std::nullopt;
  }

  void pair_where(Break& found, Distance distance, std::vector<std::string>& notes) const {
    found.distance = std::move(distance);
    const std::vector<double> side = sides(mesh_, groups_, found, tolerance_);
    const double near = near_break(found, tolerance_);
    for (std::size_t p = 0; p < partings_.pairs.size(); ++p)
      found.parting[partings_.pairs[p]] = partings_.first_frame[p];
    std::size_t elsewhere = 0, one_sided = 0, crowded = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const auto& group = groups_[g];
      if (!asked_[g]) continue;
      if (std::abs(found.distance(place_of(group))) > near) {
        elsewhere += group.size();
        continue;
      }
      const NodesBySide nodes(group, side);
      if (nodes.left.empty() || nodes.right.empty()) {
        one_sided += group.size();
        continue;
      }
      if (group.size() > 2) ++crowded;
      for (const auto& [l, r] : nodes.pairs()) {
        found.pairs.push_back({l, r});
        found.first_frame.push_back(found.parting.at({std::min(l, r), std::max(l, r)}));
      }
    }
    const bool is_one = std::find(asked_.begin(), asked_.end(), 0) == asked_.end();
    if (elsewhere > 0 && is_one)
      notes.push_back(counted(elsewhere, "coincident node") +
                      " lie outside the break's plane: left as they are");
    if (one_sided > 0)
      notes.push_back(counted(one_sided, "coincident node") +
                      " in the break's plane have cells on one side only: not paired");
    if (crowded > 0 && is_one)
      notes.push_back("more than two nodes at " + counted(crowded, "place") +
                      " of the break: each left one is paired with a right one");
    if (found.pairs.empty())
      notes.push_back("no nodes are doubled in the break's plane: the snapshot has no pairs");
  }

  template <class Nodes>
  Vec3 place_of(const Nodes& nodes) const {
    return mesh_.points[*nodes.begin()];
  }

  std::size_t nodes_in_groups() const {
    std::size_t count = 0;
    for (const auto& group : groups_) count += group.size();
    return count;
  }

  [[noreturn]] void refuse_scattered(const std::vector<Vec3>& parting) const {
    const Spread spread = spread_of(parting);
    const bool many = spread.deviation[flat_ ? 0 : 1] <= tolerance_;
    double farthest = 0;
    for (const Vec3& p : parting)
      farthest = std::max(farthest, std::abs(dot(spread.axis[flat_ ? 1 : 2], p - spread.centre)));
    throw InputError(
        series_.path() + ": " + counted(nodes_in_groups(), "coincident node") + " at " +
        counted(groups_.size(), "place") +
        (many ? std::string(flat_ ? " are a point" : " are on a line") + ", through which many planes go"
              : " lie in no common plane (up to " + shortest(farthest) +
                    " from the best one), nor on one surface over it") +
        "; say which plane with --break nx,ny,nz,offset, or --break none");
  }

  /// The plane through the same line of a flat mesh, upright on it.
  Plane upright(const Plane& plane, const std::string& text) const {
    const Vec3 inside = plane.normal - dot(plane.normal, *flat_) * *flat_;
    if (norm(inside) < 1e-6)
      throw InputError("--break '" + text + "': is parallel to the plane of the mesh, and cannot divide it");
    const Vec3 normal = snapped(normalized(inside));
    const Vec3 on_mesh = mesh_.points.front();
    const Vec3 on_both = on_mesh - (plane.distance(on_mesh) / norm(inside)) * normal;
    return {normal, dot(normal, on_both)};
  }

  void refuse_one_sided(const Plane& plane, const std::string& text) const {
    double low = 0, high = 0;
    for (const Vec3& p : mesh_.points)
      low = std::min(low, plane.distance(p)), high = std::max(high, plane.distance(p));
    if (low < -tolerance_ && high > tolerance_) return;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& p : mesh_.points) nearest = std::min(nearest, std::abs(plane.distance(p)));
    throw InputError("--break '" + text + "': all nodes lie on one side of this plane, the nearest " +
                     shortest(nearest) + " and the farthest " + shortest(std::max(-low, high)) +
                     " away; the plane is that of the points x with n . x = offset");
  }

  const ImportedSeries& series_;
  const SourceMesh& mesh_;
  std::optional<Vec3> flat_;
  double tolerance_;
  Groups groups_;
  std::vector<char> asked_;  // of each group: whether it is looked at
  Partings partings_;
};

}  // namespace

Breaks find_breaks(ImportedSeries& series, const std::optional<std::string>& given,
                   const std::optional<OpenAt>& open_at, const std::optional<Vec3>& flat,
                   const std::function<void(std::size_t)>& progress) {
  Breaks result{std::vector<Break>(1), {}};
  const Groups groups = coincident_groups(series.mesh().points, same_place(series.mesh()));
  const bool in_pieces = series.in_pieces();
  if (in_pieces || is_unwelded(series.mesh(), groups)) {
    const std::size_t before = series.mesh().points.size(), gone = weld(series, groups);
    result.notes.push_back(
        std::string(in_pieces ? "the mesh comes in pieces" : "nearly every cell has nodes of its own") +
        ": " + std::to_string(gone) + " of " + counted(before, "node") +
        " that agree with another at their place in all fields and frames were welded");
  }
  if (given == "none") return result;
  Search search(series, flat);
  search.watch(open_at, result.notes, progress);
  const auto find = [&](Break& found) {
    found.plane = given ? search.given(*given) : search.found(result.notes);
    if (found.plane)
      search.pair_in_plane(found, result.notes);
    else
      search.pair_on_surface(found, result.notes);
  };
  const std::vector<BreakComponent> components = given ? std::vector<BreakComponent>() : search.components();
  if (components.empty()) {
    find(result.list.front());
    return result;
  }
  result.list.resize(components.size());
  for (std::size_t i = 0; i < components.size(); ++i) {
    search.look_at(components[i]);
    result.list[i].in_arm = search.in_arm(components[i]);
    find(result.list[i]);
    result.list[i].junctions = search.places_of(components[i].junctions);
  }
  // The longest one gives the body its axes.
  std::stable_sort(result.list.begin(), result.list.end(),
                   [](const Break& a, const Break& b) { return a.pairs.size() > b.pairs.size(); });
  return result;
}

void pair_among(Break& found, const SourceMesh& mesh, const std::vector<char>& kept) {
  std::vector<std::int32_t> nodes;
  for (const auto& [left, right] : found.pairs)
    for (const std::int32_t node : {left, right})
      if (kept[node]) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<Vec3> places;
  places.reserve(nodes.size());
  for (const std::int32_t node : nodes) places.push_back(mesh.points[node]);
  Groups groups = coincident_groups(places, same_place(mesh));
  for (auto& group : groups)
    for (std::int32_t& node : group) node = nodes[node];
  const std::vector<double> side = sides(mesh, groups, found, in_plane(mesh), kept);
  found.pairs.clear(), found.first_frame.clear();
  for (const auto& group : groups)
    for (const auto& [l, r] : NodesBySide(group, side).pairs()) {
      found.pairs.push_back({l, r});
      found.first_frame.push_back(found.parting.at({std::min(l, r), std::max(l, r)}));
    }
}

}  // namespace cleft
