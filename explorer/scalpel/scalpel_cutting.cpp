#include "explorer/scalpel/scalpel_cutting.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"
#include "explorer/incision/near_ends.h"

namespace cleft {

namespace {
constexpr double beside = 5;           // mm: a scalpel farther from the path does not follow it
constexpr double ahead = 10;           // mm: how far ahead of the tip the path is looked at
constexpr double least_motion = 2e-3;  // mm: smaller motions of the skin are imperceptible
constexpr double piece = 0.7;          // mm, of a way that is found as the scalpel goes
constexpr double sharpest = 0.5;       // cosine of the turn from one piece to the next: an edge cuts ahead
constexpr double least_depth = 0.5;    // mm, of a cut as deep as the scalpel is
/// The cosine of the angle between the blade and the skin's normal, at least: a blade that lies flatter would
/// meet the skin that is felt at a place far from its tip.
constexpr double least_upright = 0.2;
/// How much of its deviation from the way so far the path takes up in one piece.
constexpr double taken_up = 0.5;
/// mm: a cut that ends, or begins, so near to the wound of another one comes to it, and so far over its path.
constexpr double next_to = 1, over_wound = 0.01;
constexpr std::size_t most_entering = 2000;  // vertices that a cut begins to move in a step
constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
constexpr double far = 30;  // mm, how far ahead a cut without a field is taken to go
}  // namespace

ScalpelCutting::ScalpelCutting(const SurfaceMesh& mesh, Setup setup)
    : setup_(std::move(setup)),
      mesh_(mesh),
      original_points_(static_cast<int>(mesh.points.size())),
      own_colors_(mesh.colors) {
  if (!own_colors_.empty()) places_.emplace(mesh);
  for (const ScalpelPath& path : setup_.made) {
    add_cut(path, {}, all);
    cuts_.back()->advance_to(path.length());
    wounds_.follow();
    wounds_.complete_newest();
  }
  made_ = cuts_.size();
  wounds_.guard_skin();
  if (setup_.path) add_cut(*setup_.path, {}, most_entering);
  wounds_.follow(std::min(made_, wounds_.size()));
  displacements_.resize(mesh_.vertices().size());
  wounds_.relieve();
  if (setup_.opened) take_simulation();
  SurfaceMesh felt = mesh_.surface();
  for (std::size_t v = 0; v < felt.points.size(); ++v) {
    displacements_[v] = displacement(static_cast<int>(v));
    felt.points[v] = setup_.scale * felt.points[v] + displacements_[v];
  }
  ContactSurfaceOptions options;
  for (std::size_t v = 0; setup_.firmness && v < felt.points.size(); ++v)
    options.firmness.push_back(firmness_at(static_cast<int>(v)));
  surface_ = std::make_unique<ContactSurface>(felt.points, felt.triangles, options);
  for (std::size_t t = 0; t < felt.triangles.size(); ++t)
    if (mesh_.is_wall(static_cast<int>(t)))
      changed_.push_back({static_cast<int>(t), {felt.triangles[t], true}});
  if (!changed_.empty()) surface_->update({}, changed_);
  reader_.emplace(*surface_);
  if (setup_.fields) finder_.start();
}

void ScalpelCutting::add_cut(const ScalpelPath& path, const IncisionOptions& options, std::size_t entering) {
  auto cut = std::make_unique<Incision>(mesh_, path, options);
  const bool grows = std::isfinite(options.refined);
  if (setup_.fields)
    wounds_.add(grows ? setup_.fields->growing_wound(*cut, setup_.scale, options.refined * setup_.scale)
                      : setup_.fields->wound(*cut, setup_.scale),
                entering);
  cuts_.push_back(std::move(cut));
}

void ScalpelCutting::take_simulation() {
  std::vector<const Incision*> made;
  for (std::size_t k = 0; k < made_; ++k) made.push_back(cuts_[k].get());
  std::vector<Vec3> beyond = setup_.opened(made);
  for (std::size_t v = 0; v < beyond.size(); ++v) beyond[v] -= wounds_.displacement(static_cast<int>(v));
  beyond_fields_ = CarriedVectors(mesh_, std::move(beyond));
}

/// As ContactSurface::Moved has it.
float ScalpelCutting::firmness_at(int vertex) const {
  return setup_.firmness ? static_cast<float>(setup_.firmness(setup_.scale * mesh_.position(vertex))) : 0;
}

double ScalpelCutting::cut_length() const {
  double length = 0;
  for (std::size_t k = made_; k < cuts_.size(); ++k)
    length += setup_.scale * (cuts_[k]->tip() - cuts_[k]->start());
  return length;
}

std::vector<PointColor> ScalpelCutting::colors() {
  return places_ ? places_->carried(mesh_, own_colors_) : std::vector<PointColor>{};
}

std::vector<Validity> ScalpelCutting::validity() const {
  return wounds_.empty() ? std::vector<Validity>{} : wounds_.validity(setup_.fields->turning());
}

void ScalpelCutting::step(TickQueue<HapticState>& ticks) {
  take_guard(setup_.wait_for_guard);
  HapticState scalpel;
  bool any = false;
  for (; ticks.pop(scalpel); any = true)
    setup_.path ? follow_path(scalpel, piece / setup_.scale) : follow_scalpel(scalpel);
  if (any && setup_.path) follow_path(scalpel, 0);
  open();
}

void ScalpelCutting::step(const HapticState& scalpel) {
  take_guard(setup_.wait_for_guard);
  setup_.path ? follow_path(scalpel, 0) : follow_scalpel(scalpel);
  open();
}

/// Along the path that was given, by more than `least`.
void ScalpelCutting::follow_path(const HapticState& scalpel, double least) {
  const double s = reached(scalpel);
  if (s > incision()->tip() + least && figures_.stopped.empty()) cut([&] { cuts_.back()->advance_to(s); });
}

/// Arc length of the path, mesh units, that the blade has come to; 0 where it does not cut.
double ScalpelCutting::reached(const HapticState& scalpel) const {
  if (scalpel.phase != Phase::cutting || !scalpel.pose.cutting) return 0;
  const double tip = incision()->tip(), scale = setup_.scale;
  const PathCoordinates at =
      incision()->path().coordinates(1 / scale * scalpel.pose.tip, tip - ahead / scale, tip + ahead / scale);
  return std::abs(at.v) * scale < beside ? at.s : 0;
}

/// Where the blade passes the skin, pulled back through the triangle there to the surface at rest; none where
/// it is in a wound.
std::optional<ScalpelPath::Point> ScalpelCutting::contact(const HapticState& scalpel) {
  const Vec3& axis = scalpel.pose.axis;
  const double upright = std::max(least_upright, dot(axis, scalpel.normal));
  const Vec3 skin = scalpel.pose.tip + scalpel.depth / upright * axis;
  const ContactLook look(*reader_);
  const SurfaceHit hit = reader_->first_contact(skin + beside * axis, skin - beside * axis, Facing::front);
  if (!hit || hit.wall || !mesh_.is_skin(hit.triangle)) return std::nullopt;
  const auto& corner = mesh_.triangle(hit.triangle).vertex;
  const Vec3 moved = surface_->position(corner[0]), rest = mesh_.position(corner[0]);
  const Vec3 a = surface_->position(corner[1]) - moved, b = surface_->position(corner[2]) - moved;
  const Vec3 a0 = mesh_.position(corner[1]) - rest, b0 = mesh_.position(corner[2]) - rest;
  const Vec3 normal = cross(a, b);
  // What a direction is made of, of the two edges and the normal.
  const auto pulled_back = [&](const Vec3& d, double height) {
    const double area = squared_norm(normal);
    return dot(cross(d, b), normal) / area * a0 + dot(cross(a, d), normal) / area * b0 +
           height * normalized(cross(a0, b0));
  };
  const Vec3 outward =
      pulled_back(axis - dot(axis, hit.normal) * hit.normal, dot(axis, hit.normal) / setup_.scale);
  const double depth = setup_.depth > 0 ? setup_.depth : std::max(least_depth, scalpel.depth / upright);
  return ScalpelPath::Point{rest + pulled_back(hit.position - moved, 0), normalized(outward),
                            depth / setup_.scale};
}

void ScalpelCutting::follow_scalpel(const HapticState& scalpel) {
  if (scalpel.phase != Phase::cutting || !scalpel.pose.cutting) return end_cut();
  if (entered_ && !cutting_ && !figures_.stopped.empty()) return;  // until the blade is out
  if (const auto at = contact(scalpel)) cut_on_to(*at);
}

void ScalpelCutting::end_cut() {
  cutting_ = false;
  entered_.reset();
  end_path();
}

void ScalpelCutting::cut_at(const ScalpelPath::Point& place) {
  take_guard(setup_.wait_for_guard);
  cut_on_to(place);
  open();
}

void ScalpelCutting::cut_on_to(const ScalpelPath::Point& at) {
  if (!entered_) {
    entered_ = at;
    figures_.stopped.clear();
    return;
  }
  if (!cutting_ && setup_.scale * norm(at.position - entered_->position) >= piece) {
    end_path();
    cut([&] { begin_cut(*entered_, at); });
    if (cutting_) cut([&] { extend(at); });
  } else if (cutting_ && leads_on(at)) {
    cut([&] { extend(at); });
  } else if (cutting_ &&
             setup_.scale * norm(at.position - incision()->path().at(incision()->extended_to()).position) >
                 beside) {
    end_cut();  // it has turned back, or leapt: that is another cut
    entered_ = at;
  }
}

/// Half of what the scalpel is beside the way so far: at the tip the skin is torn aside, and which lip the
/// blade meets there is chance. From piece to piece a lasting deviation is halved.
void ScalpelCutting::extend(ScalpelPath::Point next) {
  Incision& incision = *cuts_.back();
  const PathFrame end = incision.path().at(incision.extended_to());
  next.position -= (1 - taken_up) * dot(next.position - end.position, end.across) * end.across;
  next.outward = normalized(next.outward + end.outward);
  // The field moves vertices from half its cut's length ahead of the blade on.
  const double beyond = (setup_.fields ? setup_.fields->shape().cut().length / 2 : far) / setup_.scale;
  if (setup_.fields) wounds_.follow_shape(*setup_.fields);
  incision.extend(next, beyond);
  free_cuts_.back().push_back(next);
}

/// How far an end of a path has to go straight on into the wound of one of the first `earlier` cuts that is
/// next to it: between the last place of a path that is found and the lip the blade has moved on by less than
/// a piece.
std::optional<double> ScalpelCutting::way_into_wound(const ScalpelPath& path, bool start,
                                                     std::size_t earlier) const {
  std::optional<double> least;
  for (std::size_t k = 0; k < earlier; ++k) {
    const auto way = way_over(path, start, cuts_[k]->path().until(cuts_[k]->tip()), next_to / setup_.scale,
                              over_wound / setup_.scale);
    if (way && (!least || *way < *least)) least = way;
  }
  return least;
}

/// The path of the newest cut is known when the blade has left it.
void ScalpelCutting::end_path() {
  if (free_cuts_.empty() || cutting_ || !(incision()->extended_to() > 0)) return;
  Incision& incision = *cuts_.back();
  const ScalpelPath way = incision.path().until(incision.extended_to());
  if (const auto on = way_into_wound(way, false, cuts_.size() - 1)) {
    const PathFrame end = way.at(way.length());
    const ScalpelPath::Point last{end.position + *on * end.along, end.outward, way.depth(way.length())};
    cut([&] { incision.extend(last, next_to / setup_.scale); });
    free_cuts_.back().push_back(last);
  }
  cut([&] { incision.end_path(); });
  opens_anew_ = setup_.fields.has_value();
}

/// The wound of the newest cut, whose path has ended, is found on a thread of its own, and taken when it has
/// been found and no motion is left to pass on; `wait`: at once.
void ScalpelCutting::open_anew(bool wait) {
  if (std::exchange(opens_anew_, false))
    known_ = std::async(std::launch::async,
                        [&incision = *cuts_.back(), fields = *setup_.fields, scale = setup_.scale] {
                          incision.search_again();
                          return fields.wound(incision, scale);
                        });
  if (!known_.valid()) return;
  const bool found = known_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (!wait && (!found || !pending_.empty())) return;
  try {
    Wound wound = known_.get();
    const std::vector<int> moved = wounds_.replays().back().entered();
    moved_before_.insert(moved_before_.end(), moved.begin(), moved.end());
    wounds_.reopen_newest(std::move(wound), most_entering);
    tell_touched();
  } catch (const InputError& e) {
    figures_.stopped = e.what();
  }
}

void ScalpelCutting::begin_cut(ScalpelPath::Point first, const ScalpelPath::Point& next) {
  const ScalpelPath straight({first, next});
  if (const auto back = way_into_wound(straight, true, cuts_.size()))
    first.position -= *back * straight.at(0).along;
  const double length = (setup_.fields ? setup_.fields->shape().cut().length : far) / setup_.scale;
  ScalpelPath::Point end = next;
  end.position = first.position + length * normalized(next.position - first.position);
  IncisionOptions options;
  options.reach = setup_.fields ? reach_of(setup_.fields->shape(), setup_.scale) : 0;
  options.refined = norm(next.position - first.position);
  add_cut(ScalpelPath({first, end}), options, most_entering);
  free_cuts_.push_back({first});
  cutting_ = true;
}

bool ScalpelCutting::leads_on(const ScalpelPath::Point& next) const {
  const Incision& incision = *cuts_.back();
  const PathFrame end = incision.path().at(incision.extended_to());
  const Vec3 way = next.position - end.position;
  const double distance = setup_.scale * norm(way);
  return distance >= piece && distance < beside && dot(way, end.along) >= sharpest * norm(way);
}

/// One change of the newest incision, passed on to the surface and the wounds.
template <class Change>
void ScalpelCutting::cut(const Change& change) {
  finder_.give_up();  // it is found anew when this cut ends
  open_anew(true);
  Stopwatch watch;
  try {
    change();
  } catch (const InputError& e) {
    figures_.stopped = e.what();
    cutting_ = false;
  }
  figures_.cut.add(watch.lap());
  collect_changes();
  wounds_.follow();
  tell_touched();
}

void ScalpelCutting::collect_changes() {
  displacements_.resize(mesh_.vertices().size());
  for (const int v : beyond_fields_.follow(mesh_)) displacements_[v] = beyond_fields_.at(v);
  changed_.clear(), vertices_.clear(), moved_.clear();
  for (const int t : mesh_.changed()) {
    if (static_cast<std::size_t>(t) >= mesh_.triangles().size()) {
      changed_.push_back({t, {}});
      continue;
    }
    const CutMesh::Triangle& now = mesh_.triangle(t);
    changed_.push_back({t, {now.vertex, now.region != Region::skin}});
    vertices_.insert(vertices_.end(), now.vertex.begin(), now.vertex.end());
  }
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  for (const int v : vertices_)
    moved_.push_back({v, setup_.scale * mesh_.position(v) + displacements_[v], firmness_at(v)});
  Stopwatch watch;
  surface_->update(moved_, changed_);
  figures_.update.add(watch.lap());
  ++figures_.cuts;
  figures_.triangles_cut += changed_.size();
}

void ScalpelCutting::open() {
  ++figures_.steps;
  end_path();
  surface_->prepare();
  if (wounds_.empty()) return;
  Stopwatch watch;
  open_anew(setup_.wait_for_guard);
  if (!finder_.busy() && !known_.valid()) {  // else nothing has changed since it began
    wounds_.move_to_tips();
    tell_touched();
    if (!wounds_.are_entering()) tell(std::exchange(moved_before_, {}));
    if (wounds_.relieve())
      for (const LiveReplay& replay : wounds_.replays()) tell(replay.entered());
    if (!is_under_way() && wounds_.wants_guard()) finder_.begin(wounds_);
  }
  moved_.clear();
  for (; !pending_.empty() && moved_.size() < most_moved; pending_.pop_front()) {
    const int v = pending_.front();
    is_pending_[v] = false;
    if (static_cast<std::size_t>(v) >= mesh_.vertices().size()) continue;
    Vec3& d = displacements_[v];
    d = displacement(v);
    moved_.push_back({v, setup_.scale * mesh_.position(v) + d});
  }
  figures_.waiting = pending_.size();
  if (!moved_.empty()) surface_->update(moved_, {});
  figures_.open.add(watch.lap());
}

/// Those whose displacements it replaces are told, and those whose displacements it no longer does.
void ScalpelCutting::take_guard(bool wait) {
  if (!finder_.busy()) return;
  std::optional<Guard> guard = finder_.take(wait);
  if (!guard) return;
  vertices_.clear();
  for (const Guard* one : {&wounds_.guard(), &std::as_const(*guard)})
    for (const Guard::Change& change : one->changes()) vertices_.push_back(change.vertex);
  wounds_.take_guard(std::move(*guard));
  ++figures_.guards;
  tell(vertices_);
}

void ScalpelCutting::settle() {
  do {
    take_guard(true);
    open_anew(true);
    open();
  } while (finder_.busy() || known_.valid() || wounds_.are_entering() || !pending_.empty());
}

/// Whether the newest cut goes on: no part of it is at its end yet.
bool ScalpelCutting::is_under_way() const {
  if (!setup_.path) return cutting_;
  return figures_.stopped.empty() && incision()->tip() < incision()->path().length() &&
         !incision()->left_mesh();
}

void ScalpelCutting::tell_touched() {
  for (const LiveReplay& replay : wounds_.replays()) tell(replay.touched());
}

/// Takes note of those that have moved so far that it can be felt.
void ScalpelCutting::tell(const std::vector<int>& vertices) {
  is_pending_.resize(std::max(is_pending_.size(), displacements_.size()));
  for (const int v : vertices) {
    const std::size_t i = v;
    if (is_pending_[i] || squared_norm(displacement(v) - displacements_[i]) <= least_motion * least_motion)
      continue;
    is_pending_[i] = true;
    pending_.push_back(v);
  }
}

}  // namespace cleft
