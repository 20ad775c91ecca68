#include "explorer/wound/ipv.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "base/stations.h"

namespace cleft {

namespace {

/// Next to the patch, where the field knows nothing, displacements fall to nothing over this part of its
/// width.
constexpr double margin = 1. / 4;
/// Of the path's length: a place nearer to the blade's surface than this is on it, but for rounding.
constexpr double rounding = 1e-9;
/// The tilt of the line between the lips over the tilt of the blade, and over how many depths of the cut it
/// falls by a factor of e across it: what the solver's tilted cuts show (tests/truth). The tilt is a mean
/// along the cut, with weights that fall by a factor of e over `tilt_mean` depths: lips of simulated cuts
/// whose tilt waves along them, by 8 degrees over 60 to 7 mm, rise and sink so to 0.03 of what they do under
/// an even tilt.
constexpr double lips_tilt = 2. / 3, tilt_reach = 1.5, tilt_mean = 0.42;
/// Of that distance: weights further away are left out.
constexpr double tilt_farthest = 5;
/// Radians: simulations of tilted cuts end at 60 degrees (cut.tilt). Where the skin under the blade turns
/// away further, the lips are lifted as at 60; the tangent would grow without bound at 135.
constexpr double most_tilt = 60 * std::numbers::pi / 180;
/// Of the path's length: the skin's normal is a mean over at least this much of it, however shallow the cut.
constexpr double least_mean = 1e-3;
/// Directions of the path in the length of the way that each is a mean of, at most, and places that it is
/// taken of on each side.
constexpr double directions_a_mean = 8, most_directions = 4096;
constexpr int mean_samples = 8;
/// Depths of a cut that begins or ends in another: so far from its start it opens as in its field; nearer, as
/// there; and so far beyond its end.
constexpr double opens_on_depths = 1;
/// And so near to there it begins, or ends.
constexpr double end_depths = 0.1;
/// The weight of a station's own normal where it is the only one within reach.
constexpr double own_normal = 1e-9;

/// How far beside the patch, mm, displacements fall to nothing.
double margin_of(const Field& field) { return (field.domain(1).back - field.domain(1).front) * margin; }

/// Of a complete cut, mesh units.
double length_of(const Incision& cut) { return cut.extended_to() > 0 ? cut.tip() : cut.path().length(); }

}  // namespace

double reach_of(const Field& field, double scale) {
  const Interval u = field.domain(0), v = field.domain(1);
  return (std::max({-v.front, v.back, field.cut().start - u.front,
                    u.back - field.cut().start - field.cut().length}) +
          margin_of(field)) /
         scale;
}

IncisionVolume::IncisionVolume(const Incision& incision, const VaryingField& field, double scale)
    : incision_(incision),
      field_(field.shape()),
      scale_(scale),
      margin_(margin_of(field_)),
      room_(incision, field, scale) {
  labels_ = incision.surroundings().labels();
  std::vector<int> later(incision.mesh().vertices().size());
  std::iota(later.begin(), later.end(), 0);
  later.erase(later.begin(),
              later.begin() + static_cast<std::ptrdiff_t>(std::min(labels_.size(), later.size())));
  update(later);
  find_normals();
  find_directions();
  find_tilts();
}

void IncisionVolume::follow_path() {
  const auto& found = incision_.surroundings().labels();
  labels_.resize(std::max(labels_.size(), found.size()));
  for (const int v : incision_.surroundings().relabelled()) labels_[v] = found[v];
  find_normals();
  find_directions();
  find_tilts();
  room_.follow_path(incision_);
}

void IncisionVolume::opened_by(const VaryingField& field) {
  family_.reset();
  if (field.follows_shape()) family_ = field;
  room_ = WoundRoom(incision_, field, scale_);
}

/// Cuts that are shorter than deep open on in proportion: as half of one that is twice as long.
void IncisionVolume::opens_into(const Incision& earlier, bool at_end) {
  const double length = incision_.path().length();
  double opens_on = std::min(
      {opens_on_depths * field_.cut().depth, field_.cut().length / 2, scale_ * length_of(earlier) / 2});
  if (!(incision_.extended_to() > 0)) opens_on = std::min(opens_on, scale_ * length);
  const double way = std::min(opens_on / scale_, length);
  const auto beside = [&](double s) { return earlier.path().coordinates(incision_.path().at(s).position).v; };
  double end = at_end ? length : 0, inside = at_end ? length - way : way;
  const bool right = beside(inside) > 0;
  constexpr int halvings = 40;
  if ((beside(end) > 0) != right)
    for (int i = 0; i < halvings; ++i) {
      const double middle = (end + inside) / 2;
      ((beside(middle) > 0) == right ? inside : end) = middle;
    }
  mouths_[at_end] = Mouth{&earlier, end * scale_, opens_on, right};
}

/// Whether the cut is complete, and the mesh has a bridge of skin where it should have come to the other one.
bool IncisionVolume::stops_before_mouth() const {
  if (!mouths_[1] || incision_.is_short_of_end()) return false;
  const auto& chain = incision_.chain();
  const double from = (mouths_[1]->s - end_depths * field_.cut().depth) / scale_;
  for (auto c = chain.rbegin(); c != chain.rend() && c->s >= from; ++c)
    if (incision_.mesh().vertex(c->left).cut == mouths_[1]->earlier->cut()) return false;
  return true;
}

double IncisionVolume::Mouth::part(const Vec3& place, Side beside, double scale) const {
  const ScalpelPath& path = earlier->path();
  const PathCoordinates at = path.coordinates(place);
  const double length = length_of(*earlier), v = beside == Side::both ? at.v : 0,
               inside = std::min(at.s, length - at.s);
  const bool to_right = beside == Side::both ? v > 0 : beside == Side::right;
  const double from_end = std::hypot(v, inside);
  // As the lips of a crack, which come together around its ends.
  const double apart = (inside >= 0 ? (to_right ? 1 : -1) : v / from_end) *
                       std::sqrt(std::min(1., from_end * scale / opens_on));
  return (1 + (right ? apart : -apart)) / 2;
}

CanonicalPlace IncisionVolume::canonical(const Place& at) const {
  const double s = at.s * scale_, length = incision_.path().length() * scale_;
  CanonicalPlace place =
      canonical_place(s, mouths_[1] ? mouths_[1]->s + mouths_[1]->opens_on : length, field_.cut());
  if (const auto& start = mouths_[0]) {
    const double part = start->part(at.place, at.beside[0], scale_),
                 here = part * std::max(0., start->opens_on - s),
                 beyond = (1 - part) * std::max(0., start->opens_on + s);
    place.u += here - beyond, place.time_offset += here;
  }
  if (const auto& end = mouths_[1]) {
    const double part = end->part(at.place, at.beside[1], scale_), here = part * std::max(0., s - end->s),
                 beyond = (1 - part) * std::max(0., end->opens_on + end->s - s);
    place.u += beyond - here, place.time_offset -= (1 - part) * end->opens_on;
  }
  return place;
}

double IncisionVolume::part_held_back(double s, Side side) const {
  const PathFrame frame = incision_.path().at(s);
  const auto& stations = incision_.surroundings().stations();
  const auto next = std::partition_point(stations.begin(), stations.end(),
                                         [s](const auto& station) { return station.s < s; });
  const double height = next == stations.end() ? 0 : next->height;
  return 1 - room_.weight({frame.position + height * frame.outward, s, 0, 0, side});
}

void IncisionVolume::update(const std::vector<int>& vertices) {
  const CutMesh& mesh = incision_.mesh();
  labels_.resize(std::max(mesh.vertices().size(), incision_.surroundings().labels().size()));
  for (const int v : vertices) {
    if (static_cast<std::size_t>(v) < incision_.surroundings().labels().size()) continue;
    labels_[v] = Surroundings::of_parents(mesh, v, labels_);
  }
}

/// The skin's normal along the path, at rest, even where its triangles are not: a mean over the triangles
/// under it, as far along as the cut is deep. The blade may be tilted against it; the field is not.
void IncisionVolume::find_normals() {
  const auto& stations = incision_.surroundings().stations();
  station_.clear(), normal_.clear();
  const double reach = std::max(field_.cut().depth / scale_, least_mean * incision_.path().length());
  for (const auto& at : stations) {
    Vec3 sum = own_normal * at.length * at.normal;
    const auto from = std::partition_point(stations.begin(), stations.end(),
                                           [&](const auto& other) { return other.s < at.s - reach; });
    for (auto other = from; other != stations.end() && other->s < at.s + reach; ++other)
      sum += (1 - std::abs(other->s - at.s) / reach) * other->length * other->normal;
    const Vec3 blade = incision_.path().at(at.s).outward;
    station_.push_back(at.s);
    normal_.push_back(dot(sum, blade) > 0 ? normalized(sum) : blade);
  }
}

/// The path's direction at even distances, a mean over as much of it, equally far to both sides: lips that
/// each bend of a hand's tremor turned would move into each other.
void IncisionVolume::find_directions() {
  const ScalpelPath& path = incision_.path();
  const double reach = std::max(field_.cut().depth / scale_, least_mean * path.length());
  const int pieces =
      static_cast<int>(std::clamp(directions_a_mean * path.length() / reach, 1., most_directions));
  along_.clear();
  for (int i = 0; i <= pieces; ++i) {
    const double s = path.length() * i / pieces, within = std::min({reach, s, path.length() - s});
    Vec3 sum;
    for (int k = 1 - mean_samples; k < mean_samples; ++k) {
      const double part = static_cast<double>(k) / mean_samples;
      sum += (1 - std::abs(part)) * path.at(s + part * within).along;
    }
    along_.push_back(norm(sum) > 0 ? normalized(sum) : path.at(s).along);
  }
}

/// The blade's tilt at the places of along_.
void IncisionVolume::find_tilts() {
  const ScalpelPath& path = incision_.path();
  const double pieces = static_cast<double>(along_.size() - 1), step = path.length() / pieces;
  std::vector<double> tilt;
  tilt.reserve(along_.size());
  for (std::size_t i = 0; i < along_.size(); ++i) {
    const double s = step * static_cast<double>(i);
    const PathFrame skin = frame_along(s, std::nullopt);
    const Vec3 blade = path.at(s).outward;
    tilt.push_back(
        std::clamp(std::atan2(-dot(blade, skin.across), dot(blade, skin.outward)), -most_tilt, most_tilt));
  }
  const double reach = tilt_mean * field_.cut().depth / (scale_ * step);
  std::vector<double> weight;  // by the number of places between
  for (double away = 0; away <= std::min(tilt_farthest * reach, pieces); ++away)
    weight.push_back(std::exp(-away / reach));
  tilt_.clear();
  for (std::size_t i = 0; i < tilt.size(); ++i) {
    double sum = weight[0] * tilt[i], weights = weight[0];
    for (std::size_t away = 1; away < weight.size(); ++away) {
      if (away <= i) sum += weight[away] * tilt[i - away], weights += weight[away];
      if (i + away < tilt.size()) sum += weight[away] * tilt[i + away], weights += weight[away];
    }
    tilt_.push_back(sum / weights);
  }
}

/// Between which of along_ a place is, and how far from the first to the next.
std::pair<std::size_t, double> IncisionVolume::place_along(double s) const {
  const double place =
      std::clamp(s / incision_.path().length(), 0., 1.) * static_cast<double>(along_.size() - 1);
  const std::size_t before = std::min(static_cast<std::size_t>(place), along_.size() - 2);
  return {before, place - static_cast<double>(before)};
}

PathFrame IncisionVolume::skin_frame(double s) const {
  return frame_along(s, family_ ? family_->along(s * scale_) : std::nullopt);
}

PathFrame IncisionVolume::frame_along(double s, const std::optional<Vec3>& along) const {
  PathFrame frame = incision_.path().at(s);
  const auto [before, after] = place_along(s);
  frame.along = lerp(along_[before], along_[before + 1], after);
  if (!station_.empty()) {
    const auto [a, b, part] = between(station_, s);
    frame.outward = normalized(lerp(normal_[a], normal_[b], part));
  }
  if (along) frame.along = *along;
  frame.along = normalized(frame.along - dot(frame.along, frame.outward) * frame.outward);
  frame.across = cross(frame.outward, frame.along);
  return frame;
}

/// Of which side of this wound a vertex is that is not its own: by the walls around it, else by the lips
/// among its neighbours on the skin, which lies on one side of the wound.
IncisionVolume::WoundSide IncisionVolume::side_of_wound(int v) const {
  const CutMesh& mesh = incision_.mesh();
  bool left = false, right = false;
  int more_right = 0;
  for (const int t : mesh.fan(v)) {
    const CutMesh::Triangle& triangle = mesh.triangle(t);
    if (triangle.sheet >= 0) {
      if (mesh.sheets()[triangle.sheet].cut == incision_.cut())
        (triangle.region == Region::left_wall ? left : right) = true;
      continue;
    }
    for (const int other : triangle.vertex)
      if (mesh.vertex(other).cut == incision_.cut()) {
        const Side side = cleft::side_of(mesh.vertex(other).kind);
        more_right += (side == Side::right) - (side == Side::left);
      }
  }
  if (left != right) return {left ? Side::left : Side::right, true};
  return {more_right == 0 ? Side::both : more_right > 0 ? Side::right : Side::left, left};
}

/// A later vertex was made from others that may have become lips since, of either side: where it is reached
/// straight from the path, its place tells the side.
Side IncisionVolume::side_on_skin(int v, double straight) const {
  const bool later = static_cast<std::size_t>(v) >= incision_.surroundings().labels().size();
  const Side side = later && labels_[v].detour == 0 ? Side::both : labels_[v].side;
  return side == Side::both ? side_of(straight) : side;
}

/// Where a cut begins in another one, or ends in it, that place of it is on the lip beyond, which stays
/// whole.
std::array<Side, 2> IncisionVolume::beside_ends(const CutMesh::Vertex& vertex) const {
  std::array<Side, 2> beside{Side::both, Side::both};
  if (side_of(vertex.kind) != Side::both) return beside;
  for (const bool at_end : {false, true}) {
    const double away = at_end ? incision_.path().length() - vertex.s : vertex.s;
    if (mouths_[at_end] && away * scale_ <= end_depths * field_.cut().depth)
      beside[at_end] = mouths_[at_end]->right ? Side::left : Side::right;
  }
  return beside;
}

std::optional<IncisionVolume::Place> IncisionVolume::place_of(int v) const {
  const CutMesh::Vertex& vertex = incision_.mesh().vertex(v);
  if (vertex.cut == incision_.cut())  // lips, walls and closed ends know where they are
    return Place{vertex.position,      vertex.s, 0, -vertex.depth_fraction * field_.cut().depth,
                 side_of(vertex.kind), true,     0, beside_ends(vertex)};
  const Surroundings::Label& label = labels_[v];
  if (!label.reached) return std::nullopt;
  const PathCoordinates at = incision_.path().coordinates(vertex.position);
  const double straight = std::abs(at.v) <= rounding * incision_.path().length() ? 0 : at.v;
  const auto [wound, on_wall] = side_of_wound(v);
  const Side side = wound == Side::both ? side_on_skin(v, straight) : wound;
  std::array<Side, 2> beside{Side::both, Side::both};
  for (const bool at_end : {false, true})
    if (mouths_[at_end] && vertex.cut == mouths_[at_end]->earlier->cut())
      beside[at_end] = side_of(vertex.kind);
  return Place{vertex.position,
               incision_.path().steady_place(vertex.position, at),
               Surroundings::across(straight, label.detour, side),
               -vertex.depth * scale_,
               side,
               on_wall,
               straight,
               beside};
}

std::optional<ActiveVertex> IncisionVolume::locate(int vertex) const {
  const std::optional<Place> at = place_of(vertex);
  return at ? activate(vertex, *at) : std::nullopt;
}

std::optional<ActiveVertex> IncisionVolume::locate_below(const Vec3& place, double depth, int nearest,
                                                         Side side, std::array<Side, 2> beside) const {
  const Surroundings::Label& label = labels_[nearest];
  if (!label.reached) return std::nullopt;
  const PathCoordinates at = incision_.path().coordinates(place);
  const double straight = std::abs(at.v) <= rounding * incision_.path().length() ? 0 : at.v;
  if (side == Side::both) side = side_of(straight);
  // As deep as the blade is as deep as the canonical cut; below, depths differ by the same.
  const double own = incision_.path().depth(at.s) * scale_, canonical = field_.cut().depth;
  const double w = depth < own ? -depth / own * canonical : own - depth - canonical;
  return activate(-1, {place, incision_.path().steady_place(place, at),
                       Surroundings::across(straight, label.detour, side), w, side, false, straight, beside});
}

std::optional<ActiveVertex> IncisionVolume::activate(int vertex, const Place& at) const {
  CanonicalPlace place = canonical(at);
  const double v = at.across * scale_;
  // At the cut's start, but for rounding, the tip passes at once; next to it, the history would be endless.
  const double from_start = place.u - field_.cut().start;
  if (std::abs(from_start) <= rounding * field_.cut().length) place.u = field_.cut().start;
  const double u_in = std::clamp(place.u, field_.domain(0).front, field_.domain(0).back);
  const double v_in = std::clamp(v, field_.domain(1).front, field_.domain(1).back);
  const double outside = std::hypot(place.u - u_in, v - v_in) / margin_;
  const double weight = outside < 1 ? (1 - outside * outside * (3 - 2 * outside)) *
                                          room_.weight({at.place, at.s, at.across, at.straight, at.side}) *
                                          room_.of_short_cut()
                                    : 0;
  if (weight <= 0) return std::nullopt;
  const PathFrame frame = skin_frame(at.s);
  const double lift = lift_of_tilted_blade(at.s, std::abs(v));
  return ActiveVertex{
      vertex,        {u_in, v_in, at.w}, at.side,           frame.along, frame.across + lift * frame.outward,
      frame.outward, at.s * scale_,      place.time_offset, weight,      at.on_cut,
      opened_to()};
}

/// Under a tilted blade the thinner lip rises and the thicker one sinks: the line between them turns by two
/// thirds of the tilt, as the solver's tilted cuts show (tests/truth), and the more the nearer to the cut. A
/// family's displacements are those under a blade whose tilt is smoothed far along the cut. Lips of a cut
/// that is shorter than deep are held by its ends.
double IncisionVolume::lift_of_tilted_blade(double s, double v) const {
  const auto [before, after] = place_along(s);
  const double tilt = std::lerp(tilt_[before], tilt_[before + 1], after),
               known = family_ ? family_->tilt(s * scale_) * std::numbers::pi / 180 : 0;
  const double depth = field_.cut().depth,
               held_by_ends =
                   incision_.extended_to() > 0 ? 1 : std::min(1., incision_.path().length() * scale_ / depth);
  return held_by_ends * (std::tan(lips_tilt * tilt) - std::tan(lips_tilt * known)) *
         std::exp(-v / (tilt_reach * depth));
}

std::vector<ActiveVertex> IncisionVolume::active() const {
  CLEFT_CHECK(incision_.mesh().vertices().size(), <=, labels_.size());
  std::vector<ActiveVertex> active;
  for (std::size_t v = 0; v < incision_.mesh().vertices().size(); ++v)
    if (const auto one = locate(static_cast<int>(v))) active.push_back(*one);
  return active;
}

}  // namespace cleft
