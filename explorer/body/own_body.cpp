#include "explorer/body/own_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "base/wedge.h"
#include "explorer/body/own_cuts.h"
#include "explorer/body/skin_coordinates.h"

namespace cleft {

namespace {

/// Throws where no cell has one of the numbers of regions: it is most likely another one. `what` says whose
/// they are.
void check_numbers(const std::vector<int>& numbers, bool of_face, const OwnBodyRequest& request,
                   const std::string& what) {
  std::set<int> known;
  for (std::size_t c = 0; c < request.mesh.regions.size(); ++c) {
    const std::size_t nodes = request.mesh.nodes[c].size();
    if (of_face ? nodes == 3 || nodes == 4 : nodes >= 6) known.insert(request.mesh.regions[c]);
  }
  const auto unknown =
      std::find_if_not(numbers.begin(), numbers.end(), [&](int n) { return known.contains(n); });
  if (unknown == numbers.end()) return;
  std::string list;
  for (const int one : known) list += (list.empty() ? "" : ", ") + std::to_string(one);
  throw InputError(what + std::to_string(*unknown) + ", and no " + (of_face ? "face" : "cell of tissue") +
                   " of " + request.mesh.name + " has this number of '" + request.regions_name +
                   "' (there are " + (list.empty() ? "none" : list) + "): correct it, or leave it out");
}

OwnFaces faces_of(const OwnBodyRequest& request) {
  OwnFaces faces;
  if (!request.regions || !request.regions->faces) return faces;
  if (request.mesh.regions.empty())
    throw FileError(request.mesh.name,
                    "has no array of the cells that numbers their regions, as [faces] needs; "
                    "name it (--regions)");
  const FaceRegions& named = *request.regions->faces;
  for (const auto& [numbers, name] :
       {std::pair{&named.skin, "skin"}, {&named.bone, "bone"}, {&named.free, "free"}})
    check_numbers(*numbers, true, request, std::string("[faces]: ") + name + " = ");
  faces.all_skin = named.skin.empty();
  faces.skin = {named.skin.begin(), named.skin.end()};
  faces.bone = {named.bone.begin(), named.bone.end()};
  faces.free = {named.free.begin(), named.free.end()};
  return faces;
}

class OwnBodyMaker {
 public:
  explicit OwnBodyMaker(const OwnBodyRequest& request) : r_(request), name_(request.mesh.name) {}

  Body make(OwnBodyReport* report) {
    c_ = columns_of(r_.mesh, faces_of(r_));
    set_regions();
    const FrontParts fronts = front_parts(r_.parameters);
    cuts_ = cuts_of(c_, r_.paths, fronts, name_);
    open_cuts(c_, cuts_, fronts, r_.release, name_, body_);
    body_.length = cuts_.front().path.length(), body_.depth = cuts_.front().depth;
    add_nodes();
    add_elements();
    check_regions();
    set_coordinates();
    if (report) fill(*report);
    check_body(body_, name_);
    body_.hash = hash_of(body_);
    return std::move(body_);
  }

 private:
  /// Which material each region's number stands for.
  void set_regions() {
    if (!r_.regions) return;
    const auto& sections = r_.regions->sections;
    for (std::size_t s = 0; s < sections.size(); ++s) {
      const RegionSection& section = sections[s];
      body_.materials.push_back(section.material);
      if (section.to_depth)
        throw InputError(section.where + ": to_depth is of layers below a surface; the cells of " + name_ +
                         " have regions: say region = NUMBER");
      if (section.regions.empty() && sections.size() > 1)
        throw InputError(section.where + ": [" + section.material.name +
                         "] says not which cells it is of: region = NUMBER");
      for (const int number : section.regions)
        if (!material_of_.emplace(number, s).second)
          throw InputError(section.where + ": region " + std::to_string(number) + " has two materials");
    }
    if (r_.mesh.regions.empty() && !material_of_.empty())
      throw FileError(name_, "has no array of the cells that numbers their regions; name it (--regions)");
  }

  void check_regions() const {
    if (!r_.regions) return;
    for (const RegionSection& section : r_.regions->sections)
      check_numbers(section.regions, false, r_,
                    section.where + ": [" + section.material.name + "]: region = ");
  }

  std::uint8_t material(int cell) const {
    if (material_of_.empty()) return 0;
    const int number = r_.mesh.regions[cell];
    const auto found = material_of_.find(number);
    if (found == material_of_.end()) {
      int cells = 0;
      for (std::size_t c = 0; c < r_.mesh.regions.size(); ++c)
        cells += r_.mesh.regions[c] == number && r_.mesh.nodes[c].size() >= 6;
      throw FileError(name_, "region " + std::to_string(number) + " of '" + r_.regions_name + "' (" +
                                 std::to_string(cells) + " cells, one at " +
                                 place_text(c_.points[r_.mesh.nodes[cell].front()]) +
                                 " mm) has no material; add region = " + std::to_string(number) +
                                 " to a section of the file of --materials");
    }
    return static_cast<std::uint8_t>(found->second);
  }

  /// Without those that no wedge has; left nodes hang from left ones.
  void add_nodes() {
    std::vector<bool> used(c_.points.size(), false), right(c_.points.size(), false);
    for (const auto& column : c_.wedges)
      for (const auto& w : column)
        for (const int n : w) used[n] = true;
    number_.assign(c_.points.size(), -1);
    for (std::size_t n = 0; n < used.size(); ++n) {
      if (!used[n]) continue;
      number_[n] = static_cast<int>(body_.points.size());
      body_.points.push_back(c_.points[n]);
      node_.push_back(static_cast<int>(n));
    }
    for (BodyPair& pair : body_.pairs) {
      right[pair.right] = true;
      pair.left = number_[pair.left], pair.right = number_[pair.right];
    }
    std::vector<int> above = c_.above;
    for (const auto& column : c_.wedges)
      for (const auto& w : column)
        for (int i = 0; i < 3; ++i)
          if (right[above[w[i]]] && !right[w[3 + i]]) above[w[i]] = w[3 + i];
    for (int n : node_) {
      while (above[n] >= 0) n = above[n];
      body_.skin_above.push_back(number_[n]);
    }
  }

  template <std::size_t K>
  std::array<int, K> numbered(std::array<int, K> nodes) const {
    for (int& n : nodes) n = number_[n];
    return nodes;
  }

  /// Layer after layer, so that the first wedges are those below the skin.
  void add_elements() {
    std::size_t layers = 0;
    for (const auto& column : c_.wedges) layers = std::max(layers, column.size());
    for (std::size_t k = 0; k < layers; ++k)
      for (std::size_t c = 0; c < c_.wedges.size(); ++c) {
        if (k >= c_.wedges[c].size()) continue;
        body_.wedges.push_back(numbered(c_.wedges[c][k]));
        if (r_.regions) body_.region.push_back(material(c_.cells[c][k]));
      }
    for (const auto& t : c_.skin) body_.skin.push_back(numbered(t));
    for (const auto& t : c_.bottom) body_.bottom.push_back(numbered(t));
    for (const bool bone : c_.on_bone) body_.support.push_back(bone ? Support::bone : Support::springs);
    for (const auto& q : c_.sides) body_.sides.push_back(numbered(q));
  }

  /// Of the closed skin: its points are the places.
  void set_coordinates() {
    SurfaceMesh closed;
    std::map<int, int> point_of;  // by place
    for (const auto& t : c_.skin) {
      auto& corners = closed.triangles.emplace_back();
      for (int i = 0; i < 3; ++i) {
        const auto [at, added] = point_of.emplace(c_.place[t[i]], static_cast<int>(closed.points.size()));
        if (added) closed.points.push_back(c_.points[t[i]]);
        corners[i] = at->second;
      }
    }
    std::vector<bool> on_a_cut(closed.points.size(), false);
    std::set<int> on_first;
    for (const OwnCut& cut : cuts_)
      for (const OwnEdge& edge : cut.edges)
        for (const int place : {edge.from, edge.to}) {
          on_a_cut[point_of.at(place)] = true;
          if (&cut == &cuts_.front()) on_first.insert(point_of.at(place));
        }
    const ScalpelPath& path = cuts_.front().path;
    body_.tension = directions_within(closed, r_.paths.front(), r_.tension, on_a_cut);
    const SkinCoordinates on_skin = coordinates_on(closed, path, on_first);
    for (std::size_t n = 0; n < body_.points.size(); ++n) {
      const int p = point_of.at(c_.place[node_[body_.skin_above[n]]]);
      body_.canonical.push_back({on_skin.canonical[p].x, on_skin.canonical[p].y, -c_.depth[node_[n]]});
      body_.frames.push_back(on_skin.frames[p]);
    }
  }

  void fill(OwnBodyReport& report) const {
    for (std::size_t m = 0; m < body_.materials.size(); ++m)
      report.regions.push_back({body_.materials[m].name,
                                static_cast<int>(std::count(body_.region.begin(), body_.region.end(), m))});
    for (const OwnCut& cut : cuts_) report.cuts.push_back({cut.path.length(), cut.depth});
    report.on_bone = static_cast<int>(std::count(c_.on_bone.begin(), c_.on_bone.end(), true));
    report.least_determinant = 1;
    for (const auto& w : body_.wedges) {
      double least = std::numeric_limits<double>::infinity(), sum = 0;
      for (const double j : corner_determinants([&](int i) { return body_.points[w[i]]; }))
        least = std::min(least, j), sum += j / 6;
      report.least_determinant = std::min(report.least_determinant, least / sum);
    }
  }

  const OwnBodyRequest& r_;
  const std::string& name_;
  OwnColumns c_;
  std::map<int, std::size_t> material_of_;  // by number of a region
  std::vector<OwnCut> cuts_;
  Body body_;
  std::vector<int> number_;  // in the body, by node of the mesh
  std::vector<int> node_;    // of the mesh, by node of the body
};

}  // namespace

Body own_body(const OwnBodyRequest& request, OwnBodyReport* report) {
  return OwnBodyMaker(request).make(report);
}

}  // namespace cleft
