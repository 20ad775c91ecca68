#include "explorer/wound/live_replay.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cleft {

namespace {
/// Vertices of the chain's end that every step looks at, whether their triangles have changed or not: the
/// tip, which is provisional, and the one before it, each of them two where the path crosses a wound.
constexpr std::size_t chain_end = 4;
}  // namespace

LiveReplay::LiveReplay(Wound& wound, std::size_t most_entering)
    : wound_(wound),
      incision_(*wound.incision),
      volume_(wound.volume),
      most_entering_(most_entering),
      undone_(true),
      contractor_(wound.field, wound.scale()),
      rest_(1),
      position_(1) {
  follow();
}

/// The corners of the triangles that changed, and the chain's last vertices: they become what they are before
/// any triangle changes. Sorted.
std::vector<int> LiveReplay::changed_vertices() {
  const CutMesh& mesh = incision_.mesh();
  std::vector<int> vertices = std::move(chain_end_);
  chain_end_.clear();
  const auto& chain = incision_.chain();
  for (std::size_t i = chain.size() - std::min(chain.size(), chain_end); i < chain.size(); ++i)
    for (const int v : {chain[i].left, chain[i].right}) chain_end_.push_back(v);
  vertices.insert(vertices.end(), chain_end_.begin(), chain_end_.end());
  for (const int t : incision_.changed_triangles())
    if (static_cast<std::size_t>(t) < mesh.triangles().size())
      vertices.insert(vertices.end(), mesh.triangle(t).vertex.begin(), mesh.triangle(t).vertex.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  while (!vertices.empty() && static_cast<std::size_t>(vertices.back()) >= mesh.vertices().size())
    vertices.pop_back();
  return vertices;
}

void LiveReplay::follow() {
  const std::size_t count = incision_.mesh().vertices().size();
  const bool begins = undone_ && !incision_.undone();
  undone_ = incision_.undone();
  touched_.clear();
  contracted_ = 0;
  shrink(count);
  std::vector<int> changed = changed_vertices();
  if (begins || undone_) {
    changed.resize(count);
    std::iota(changed.begin(), changed.end(), 0);
  }
  rest_.resize(count + 1), position_.resize(count + 1);
  slots_.resize(std::max(slots_.size(), count + 1));  // those of former vertices remember their versions
  beside_.resize(slots_.size());
  const bool extended = incision_.extended_to() > extended_to_;
  if (extended) volume_.follow_path();
  volume_.update(changed);
  for (const int v : changed) {
    const auto at = static_cast<std::size_t>(v) + 1;
    leave(v);
    rest_[at] = position_[at] = incision_.mesh().position(v);
    touched_.push_back(v);
    if (!undone_) place(v);
  }
  if (extended) follow_path(changed);
  extended_to_ = incision_.extended_to();
  follow_shape();
  enter();
}

/// Those beside the path's new piece that have lain elsewhere.
void LiveReplay::follow_path(const std::vector<int>& changed) {
  placed_.resize(std::max(placed_.size(), slots_.size()));
  for (const int v : incision_.surroundings().relabelled()) {
    if (std::binary_search(changed.begin(), changed.end(), v)) continue;
    const auto number = static_cast<std::size_t>(v) + 1;
    const auto at = volume_.locate(v);
    const Placed& was = placed_[number];
    if (at.has_value() == was.anywhere &&
        (!at || (at->side == was.side && std::hypot(at->s - was.s, at->uvw.y - was.across) < misplaced &&
                 norm(at->along - was.along) < turned && std::abs(at->weight - was.weight) < reweighted)))
      continue;
    leave(v);
    position_[number] = rest_[number];
    touched_.push_back(v);
    take_place(v, at);
  }
}

/// Those that were ahead of the shape that the field knew.
void LiveReplay::follow_shape() {
  for (; !ahead_.empty() && ahead_.top().enters <= contractor_.field().known_to(); ahead_.pop()) {
    const auto [s, v, version] = ahead_.top();
    const auto number = static_cast<std::size_t>(v) + 1;
    if (slots_[number].version != version) continue;
    leave(v);
    position_[number] = rest_[number];
    touched_.push_back(v);
    place(v);
  }
}

/// Vertices that a step took away are nobody's.
void LiveReplay::shrink(std::size_t vertices) {
  for (std::size_t v = vertices; v + 1 < slots_.size(); ++v) leave(static_cast<int>(v));
}

void LiveReplay::leave(int vertex) {
  Slot& slot = slots_[static_cast<std::size_t>(vertex) + 1];
  ++slot.version;
  if (slot.batch < 0) return;
  Batch& batch = batches_[slot.batch];
  batch.pieces.redirect(static_cast<std::size_t>(slot.index), 0);
  if (--batch.left == 0) batch.pieces = contractor_.contract({});
  slot.batch = -1;
  --active_;
}

void LiveReplay::place(int vertex) { take_place(vertex, volume_.locate(vertex)); }

void LiveReplay::take_place(int vertex, const std::optional<ActiveVertex>& at) {
  if (incision_.extended_to() > 0) {
    placed_.resize(std::max(placed_.size(), slots_.size()));
    placed_[static_cast<std::size_t>(vertex) + 1] =
        at ? Placed{true, at->side, at->s, at->uvw.y, at->weight, at->along} : Placed{};
  }
  if (!at) return;
  const std::uint32_t version = slots_[static_cast<std::size_t>(vertex) + 1].version;
  waiting_.push({-at->time_offset, vertex, version});
  if (at->s > contractor_.field().known_to()) ahead_.push({at->s, vertex, version});
}

/// Those whose own time has begun; what a step has just changed before those that are late.
void LiveReplay::enter() {
  entering_.clear();
  const auto take = [this](const Waiting& next) {
    if (slots_[static_cast<std::size_t>(next.vertex) + 1].version != next.version) return;
    if (const auto at = volume_.locate(next.vertex)) entering_.push_back(*at);
  };
  for (; !waiting_.empty() && waiting_.top().enters <= blade_; waiting_.pop())
    if (entering_.size() < most_entering_)
      take(waiting_.top());
    else
      late_.push_back(waiting_.top());
  for (; !late_.empty() && entering_.size() < most_entering_; late_.pop_front()) take(late_.front());
  if (entering_.empty()) return;
  Contractor::sort(entering_);
  for (std::size_t i = 0; i < entering_.size(); ++i) {
    Slot& slot = slots_[static_cast<std::size_t>(entering_[i].vertex) + 1];
    slot.batch = static_cast<int>(batches_.size());
    slot.index = static_cast<int>(i);
    beside_[static_cast<std::size_t>(entering_[i].vertex) + 1] = beside_of(entering_[i]);
    touched_.push_back(entering_[i].vertex);
  }
  batches_.push_back({contractor_.contract(entering_, 1), entering_.size()});
  batches_.back().pieces.positions(blade_, rest_.data(), position_.data());
  active_ += entering_.size();
  contracted_ += entering_.size();
}

BesideCut LiveReplay::beside_of(const ActiveVertex& vertex) const {
  BesideCut beside(vertex, wound_);
  beside.keep_with_own_piece(vertex, vertex.vertex, number_, cuts_, crossings_);
  return beside;
}

void LiveReplay::cross(std::size_t cut, std::vector<const Wound*> cuts, std::vector<Crossing> crossings) {
  number_ = cut, cuts_ = std::move(cuts), crossings_ = std::move(crossings);
  for (const int v : entered()) {
    BesideCut& beside = beside_[static_cast<std::size_t>(v) + 1];
    const bool near = std::any_of(crossings_.begin(), crossings_.end(), [&](const Crossing& one) {
      return one.cut == number_ && std::abs(beside.s - one.s) < one.reach();
    });
    if (!near) continue;
    if (const auto at = volume_.locate(v)) beside = beside_of(*at);
  }
}

std::vector<int> LiveReplay::entered() const {
  std::vector<int> vertices;
  vertices.reserve(active_);
  for (const Batch& batch : batches_)
    for (const int v : batch.pieces.vertices())
      if (v > 0) vertices.push_back(v - 1);
  return vertices;
}

void LiveReplay::displacements(double s, std::vector<std::pair<int, Vec3>>& out) const {
  std::vector<Vec3> moved(rest_.size());
  for (const Batch& batch : batches_) {
    batch.pieces.positions(volume_.opened_to()(s), rest_.data(), moved.data());
    for (const int v : batch.pieces.vertices())
      if (v > 0)
        out.emplace_back(v - 1, moved[static_cast<std::size_t>(v)] - rest_[static_cast<std::size_t>(v)]);
  }
}

void LiveReplay::move_to(double s) {
  touched_.clear();
  const double before = blade_;
  blade_ = volume_.opened_to()(s);
  for (const Batch& batch : batches_) {
    const auto [front, back] = batch.pieces.positions(before, blade_, rest_.data(), position_.data());
    for (std::size_t i = front; i < back; ++i)
      if (const int v = batch.pieces.vertices()[i]; v > 0) touched_.push_back(v - 1);
  }
  enter();
}

}  // namespace cleft
