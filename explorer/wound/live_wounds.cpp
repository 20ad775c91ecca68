#include "explorer/wound/live_wounds.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace cleft {

namespace {
/// mm of a cut, after which the relief is found anew: little against the distance over which a cut's tension
/// falls, and long against the way that a blade makes between two frames.
constexpr double relieved_each = 1;
}  // namespace

void LiveWounds::add(Wound wound, std::size_t most_entering) {
  scale_ = wound.scale();
  replays_.emplace_back(Wounds::add(std::move(wound)), most_entering);
  now_ = relief(size() - 1).at(1);
  if (size() > 1) cross(size() - 1);
}

void LiveWounds::reopen_newest(Wound wound, std::size_t most_entering) {
  replays_.pop_back();
  remove_newest();
  add(std::move(wound), most_entering);
  complete_newest();
  relieved_at_ = 0;
}

/// The first `count` wounds are complete.
void LiveWounds::cross(std::size_t count) {
  set_crossings(crossings_of(first(count)));
  for (std::size_t k = 0; k < count; ++k) replays_[k].cross(k, first(count), crossings());
}

void LiveWounds::follow(std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) replays_[k].follow();
  if (guard().empty()) return;
  const CutMesh& mesh = (*this)[0].incision->mesh();
  for (const int t : mesh.changed())
    if (static_cast<std::size_t>(t) < mesh.triangles().size())
      for (const int v : mesh.triangle(t).vertex) forget_guard(v);
}

void LiveWounds::move_to_tips() {
  for (std::size_t k = 0; k < size(); ++k) replays_[k].move_to((*this)[k].incision->tip() * scale_);
}

void LiveWounds::complete_newest() {
  if (!empty()) replays_.back().move_to((*this)[size() - 1].complete());
}

double LiveWounds::length() const {
  double length = 0;
  for (std::size_t k = 0; k < size(); ++k) length += scale_ * (*this)[k].incision->tip();
  return length;
}

bool LiveWounds::wants_guard() const { return length() != guarded_at_ && !are_entering(); }

bool LiveWounds::are_entering() const {
  return std::any_of(replays_.begin(), replays_.end(), [](const LiveReplay& r) { return r.late() > 0; });
}

bool LiveWounds::guard_skin() {
  if (!wants_guard()) return false;
  take_guard(find_guard({}));
  return true;
}

void LiveWounds::take_guard(Guard guard) {
  guarded_at_ = length();
  set_guard(std::move(guard));
}

Guard LiveWounds::find_guard(const std::function<void()>& poll) const {
  std::vector<std::pair<int, Vec3>> moved;
  return found_guard(
      [&](const Blade& blade) {
        moved.clear();
        const LiveReplay& replay = replays_[blade.cut];
        replay.displacements(blade.s, moved);
        std::vector<Moved> found;
        found.reserve(moved.size());
        for (const auto& [v, d] : moved) found.push_back({v, replay.beside(v), d});
        return found;
      },
      [&](int vertex, const Blade& blade) { return replays_[blade.cut].displacement(vertex, blade.s); },
      false, poll);
}

bool LiveWounds::relieve() {
  if (size() < 2) return false;
  const double length = this->length();
  const std::size_t last = size() - 1;
  const Incision& newest = *(*this)[last].incision;
  const bool complete = newest.extended_to() == 0 && !newest.is_short_of_end() && length > relieved_at_;
  const bool known = relief(last).cuts() == size();
  if (known && length < relieved_at_ + relieved_each && !complete) return false;
  std::vector<Amplitude> amplitudes;
  try {
    amplitudes = std::move(mutual_relief(first(size()), {scale_ * newest.tip()}).front());
  } catch (const InputError&) {  // the field does not tell the tension: they add
    amplitudes.assign(size(), {{0}, {1}});
  }
  set_relief(last, Relief(std::move(amplitudes)));
  if (complete) cross(size());
  now_ = relief(last).at(1);
  relieved_at_ = length;
  return true;
}

}  // namespace cleft
