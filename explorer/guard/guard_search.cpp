#include "explorer/guard/guard_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace cleft {

namespace {

/// A triangle is sound with this part of its area and this cosine of its turn, a little more than a fifth and
/// a right angle: it is looked at at some times only.
constexpr double least_area = 0.25, least_cosine = 0.05;
/// Of its area: a triangle that keeps less counts as turned over.
constexpr double turned_area = 0.2;
/// Neighbours that move apart by more than this many times their distance are torn from each other.
constexpr double most_stretch = 1.5;
/// Likewise, beyond the least jump, unless the field of a single cut draws them apart itself.
constexpr double most_by_field = 3;
/// Of the least jump: neighbours nearer than this that move further apart than that are torn likewise. With a
/// least jump of 0.05 mm, those below 0.5 mm that move by 1 mm, or nearly.
constexpr double torn_length = 10, torn_jump = 19;
/// Of the triangles that move: a field that turns more of them in its own patch is left to do so.
constexpr double most_turned = 0.05;
/// Whatever part of those that move they are, as many are not much.
constexpr std::size_t few_turned = 5;
/// Of its area: a triangle with less is looked at between times, however little it moves from one to the
/// next.
constexpr double little = 0.6;
/// How often triangles whose corners have no means are joined.
constexpr int join_rounds = 4;

}  // namespace

bool is_turned_over(const std::array<Vec3, 3>& rest, const std::array<Vec3, 3>& now) {
  const Vec3 before = cross(rest[1] - rest[0], rest[2] - rest[0]),
             after = cross(now[1] - now[0], now[2] - now[0]);
  return dot(before, after) < 0 || norm(after) < turned_area * norm(before);
}

bool GuardSearch::find() {
  number_vertices();
  find_neighbors();
  measure_triangles();
  check_all();
  if (field_.alone && field_is_to_blame()) return false;
  find_delicate();
  find_means();
  only_lasting_ = true;
  std::erase_if(offending_, [this](int one) { return !offends(one); });
  if (!offending_.empty()) find_lasting_means();
  reduce();
  return true;
}

void GuardSearch::find_means() {
  spread_means();
  for (int round = 0; round < join_rounds && join(); ++round) {
    move_joined();
    spread_means();
  }
}

/// What moves as means for a moment's sake, as next to an end while the blade passes it, may tear triangles
/// for good, for which wounds would be held back.
void GuardSearch::find_lasting_means() {
  const std::vector<int> offended = offending_;
  const auto means = mean_, ties = tie_;
  const std::vector<int> leaders = leader_;
  leader_.assign(leader_.size(), -1);
  offending_.clear();
  move_joined();
  find_means();
  if (offending_.size() < offended.size()) return;
  mean_ = means, tie_ = ties, leader_ = leaders, offending_ = offended;
  renew(all_numbers());
}

bool GuardSearch::is_excused() const {
  return std::any_of(doubtful_.begin(), doubtful_.end(), [this](int one) { return offends_for_good(one); });
}

void GuardSearch::hold_excused() {
  excused_ = false;
  offending_ = doubtful_;
  check({});
  reduce();
}

std::vector<int> GuardSearch::doubtful() const {
  std::vector<int> ones = doubtful_;
  std::sort(ones.begin(), ones.end());
  ones.erase(std::unique(ones.begin(), ones.end()), ones.end());
  return ones;
}

std::vector<GuardSearch::Remaining> GuardSearch::remaining() const {
  std::vector<Remaining> found;
  const std::vector<int> ones = doubtful();
  for (std::size_t k = 0; k < times(); ++k)
    for (const int one : ones)
      if (!lasting_[k] && offends(one, k, false)) found.push_back({one, k});
  return found;
}

std::vector<GuardSearch::Remaining> GuardSearch::sudden() const {
  std::vector<Remaining> found;
  add_sudden_triangles(found);
  add_sudden_pairs(found);
  return found;
}

void GuardSearch::add_sudden_triangles(std::vector<Remaining>& found) const {
  for (std::size_t t = 0; t < harmless_.size(); ++t) {
    const int one = static_cast<int>(t);
    if (!mesh_.is_skin(one)) continue;
    const auto corner = corners(one);
    if (std::all_of(corner.begin(), corner.end(), [this](int v) { return number_[v] < 0; })) continue;
    std::array<Vec3, 3> before{};
    for (std::size_t k = 0; k < times(); ++k) {
      const std::array<Vec3, 3> now = moved(one, k);
      const std::array<Vec3, 3> change{now[0] - before[0], now[1] - before[1], now[2] - before[2]};
      if ((!hardly_moves(one, change) && !hardly_bends(one, change)) ||
          std::min(left_of(one, now), left_of(one, before)) < little)
        found.push_back({one, k});
      before = now;
    }
  }
}

void GuardSearch::add_sudden_pairs(std::vector<Remaining>& found) const {
  const double limit = part_passed * least_jump_ / 2;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const std::array<int, 2> n{number_[pairs_[i].vertex[0]], number_[pairs_[i].vertex[1]]};
    double before = 0;
    for (std::size_t k = 0; k < times(); ++k) {
      const auto moved = [&](int number) { return number < 0 ? Vec3{} : with(number, k); };
      const double now = past(pairs_[i], moved(n[0]), moved(n[1]));
      if (std::max(before, now) + std::abs(now - before) / 2 > limit)
        found.push_back({-1 - static_cast<int>(i), k});
      before = now;
    }
  }
}

void GuardSearch::number_vertices() {
  number_.assign(mesh_.vertices().size(), -1);
  for (const auto& moved : moved_)
    for (const auto& [v, d] : moved)
      if (d != Vec3{}) number_[v] = 0;
  for (std::size_t v = 0; v < number_.size(); ++v)
    if (number_[v] == 0) {
      number_[v] = static_cast<int>(vertex_.size());
      vertex_.push_back(static_cast<int>(v));
    }
  own_.assign(vertex_.size() * times(), {});
  for (std::size_t k = 0; k < times(); ++k)
    for (const auto& [v, d] : moved_[k])
      if (number_[v] >= 0) own_[static_cast<std::size_t>(number_[v]) * times() + k] = d;
  with_ = own_;
  factor_.assign(vertex_.size(), 1), mean_.resize(vertex_.size()), in_group_.resize(vertex_.size());
  tie_.resize(vertex_.size()), leader_.assign(vertex_.size(), -1);
}

void GuardSearch::find_neighbors() {
  around_.resize(vertex_.size()), next_.resize(vertex_.size());
  for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) {
    const auto& corner = mesh_.triangle(static_cast<int>(t)).vertex;
    for (int i = 0; i < 3; ++i) {
      const int n = number_[corner[i]];
      if (n < 0) continue;
      if (mesh_.is_skin(static_cast<int>(t))) around_[n].push_back(static_cast<int>(t));
      add_neighbor(n, corner[(i + 1) % 3]), add_neighbor(n, corner[(i + 2) % 3]);
      const int twin = mesh_.twin(static_cast<int>(t));
      if (twin < 0) continue;
      const int opposite = mesh_.triangle(twin).vertex[CutMesh::twin_corner(i)];
      if (opposite != corner[i]) add_neighbor(n, opposite);
    }
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    for (const int v : pairs_[i].vertex)
      if (number_[v] >= 0) around_[number_[v]].push_back(-1 - static_cast<int>(i));
}

void GuardSearch::add_neighbor(int n, int vertex) {
  const int other = number_[vertex];
  auto& all = next_[n];
  if (other < 0 ||
      std::any_of(all.begin(), all.end(), [other](const auto& one) { return one.number == other; }))
    return;
  all.push_back({other, norm(mesh_.position(vertex_[n]) - mesh_.position(vertex))});
}

/// With the edges a and b from the first corner, and corners that move against it by x at most, the cross
/// product of the edges changes by (|a| + |b|) x + x^2 at most. Where that is half of it, the triangle turns
/// by less than a right angle and keeps more than a quarter of its area, and no edge stretches by more than
/// half.
void GuardSearch::measure_triangles() {
  harmless_.resize(mesh_.triangles().size());
  for (std::size_t t = 0; t < harmless_.size(); ++t) {
    const auto& corner = mesh_.triangle(static_cast<int>(t)).vertex;
    const Vec3 a = mesh_.position(corner[1]) - mesh_.position(corner[0]),
               b = mesh_.position(corner[2]) - mesh_.position(corner[0]);
    const double sides = norm(a) + norm(b),
                 x = (std::sqrt(sides * sides + 2 * norm(cross(a, b))) - sides) / 2;
    harmless_[t] = x * x;
  }
}

std::array<Vec3, 3> GuardSearch::moved(int t, std::size_t time) const {
  std::array<Vec3, 3> result;
  for (int i = 0; i < 3; ++i)
    if (const int n = number_[mesh_.triangle(t).vertex[i]]; n >= 0) result[i] = with(n, time);
  return result;
}

std::array<Vec3, 3> GuardSearch::moved(int t, std::size_t first, double at) const {
  const std::size_t next = std::min(first + static_cast<std::size_t>(at), times() - 1);
  const double part = std::min(at - static_cast<double>(next - first), 1.);
  std::array<Vec3, 3> result = moved(t, next);
  for (Vec3& d : result) d *= part;
  if (next == 0) return result;
  const std::array<Vec3, 3> before = moved(t, next - 1);
  for (int i = 0; i < 3; ++i) result[i] += (1 - part) * before[i];
  return result;
}

bool GuardSearch::hardly_moves(int t, const std::array<Vec3, 3>& moved) const {
  return std::max(squared_norm(moved[1] - moved[0]), squared_norm(moved[2] - moved[0])) < harmless_[t];
}

/// Of slivers harmless_ is next to nothing, since it takes the corners' motion for one of any direction. With
/// the edges a and b from an end of the shortest one, which change by c and d, their cross product changes by
/// |c| |b| + |a| |d| + |c| |d| at most.
bool GuardSearch::hardly_bends(int t, const std::array<Vec3, 3>& moved) const {
  const auto& corner = mesh_.triangle(t).vertex;
  std::array<Vec3, 3> edge;  // from each corner to the next
  std::array<double, 3> length, change;
  for (std::size_t i = 0; i < 3; ++i) {
    edge[i] = mesh_.position(corner[(i + 1) % 3]) - mesh_.position(corner[i]);
    length[i] = norm(edge[i]), change[i] = norm(moved[(i + 1) % 3] - moved[i]);
    if (change[i] > length[i] / 2) return false;
  }
  const std::size_t a = static_cast<std::size_t>(std::min_element(length.begin(), length.end()) -
                                                 length.begin()),
                    b = (a + 1) % 3;
  return change[a] * length[b] + length[a] * change[b] + change[a] * change[b] <
         norm(cross(edge[a], edge[b])) / 2;
}

bool GuardSearch::is_kept(int t, const std::array<Vec3, 3>& moved) const {
  const auto& corner = mesh_.triangle(t).vertex;
  const Vec3 a = mesh_.position(corner[1]) - mesh_.position(corner[0]),
             b = mesh_.position(corner[2]) - mesh_.position(corner[0]);
  const Vec3 before = cross(a, b), after = cross(a + (moved[1] - moved[0]), b + (moved[2] - moved[0]));
  const double area = norm(before), area_now = norm(after);
  return area == 0 || (area_now >= least_area * area && dot(before, after) >= least_cosine * area * area_now);
}

bool GuardSearch::is_turned(int t, const std::array<Vec3, 3>& moved) const {
  std::array<Vec3, 3> rest, now;
  for (std::size_t i = 0; i < 3; ++i)
    rest[i] = mesh_.position(mesh_.triangle(t).vertex[i]), now[i] = rest[i] + moved[i];
  return is_turned_over(rest, now);
}

double GuardSearch::left_of(int t, const std::array<Vec3, 3>& moved) const {
  const auto& corner = mesh_.triangle(t).vertex;
  const Vec3 a = mesh_.position(corner[1]) - mesh_.position(corner[0]),
             b = mesh_.position(corner[2]) - mesh_.position(corner[0]);
  const Vec3 before = cross(a, b);
  const double area = squared_norm(before);
  return area > 0 ? dot(before, cross(a + (moved[1] - moved[0]), b + (moved[2] - moved[0]))) / area : 1;
}

bool GuardSearch::is_torn(int t, const std::array<Vec3, 3>& moved) const {
  const auto& corner = mesh_.triangle(t).vertex;
  for (int i = 0; i < 3; ++i) {
    const int a = corner[i], b = corner[(i + 1) % 3];
    const double jump = norm(moved[(i + 1) % 3] - moved[i]);
    const double length = norm(mesh_.position(b) - mesh_.position(a));
    const bool far = (jump > torn_jump * least_jump_ && length < torn_length * least_jump_) ||
                     jump > least_jump_ + most_by_field * length;
    if (far && !field_.draws_apart(a, b, jump)) return true;
    if (jump > least_jump_ && jump > most_stretch * length && !field_.stretches(a, b, jump / most_stretch))
      return true;
  }
  return false;
}

std::span<const int> GuardSearch::corners(int one) const {
  return one < 0 ? std::span<const int>(pairs_[-1 - one].vertex) : mesh_.triangle(one).vertex;
}

/// What the field does itself is excused, or not.
bool GuardSearch::offends(int one, std::size_t k, bool excused) const {
  if (one < 0) {
    const Pair& pair = pairs_[-1 - one];
    const auto moved = [&](int v) { return number_[v] < 0 ? Vec3{} : with(number_[v], k); };
    return is_passed(one, moved(pair.vertex[0]), moved(pair.vertex[1])) &&
           !(excused && field_.closes(pair.vertex[0], k));
  }
  const std::array<Vec3, 3> now = moved(one, k);
  if (hardly_moves(one, now) || hardly_bends(one, now)) return false;
  return is_torn(one, now) || (!is_kept(one, now) && !(excused && field_.turns(one, k)));
}

/// With the cuts complete, excused or not.
bool GuardSearch::offends_for_good(int one) const {
  for (std::size_t k = 0; k < times(); ++k)
    if (lasting_[k] && offends(one, k, false)) return true;
  return false;
}

bool GuardSearch::offends(int one) {
  if (poll_) poll_();
  for (std::size_t k = 0; k < times(); ++k) {
    if ((only_lasting_ && !lasting_[k]) || !offends(one, k, false)) continue;
    if (doubtful_.empty() || doubtful_.back() != one) doubtful_.push_back(one);
    if (!excused_ || offends(one, k, true)) return true;
  }
  return false;
}

std::vector<int> GuardSearch::all_numbers() const {
  std::vector<int> all(vertex_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void GuardSearch::check_all() { check(all_numbers()); }

/// Whether the field turns much of its own patch over: to keep it from that would be to close the wound. What
/// it does at single places, mostly next to the ends of a cut, is the error of its fit.
bool GuardSearch::field_is_to_blame() {
  std::vector<int> moving;
  for (const auto& around : around_)
    std::copy_if(around.begin(), around.end(), std::back_inserter(moving), [](int one) { return one >= 0; });
  std::sort(moving.begin(), moving.end());
  moving.erase(std::unique(moving.begin(), moving.end()), moving.end());
  std::size_t turned = 0;
  for (const int t : moving) {
    bool by_field = false;
    for (std::size_t k = 0; k < times() && !by_field; ++k) {
      const std::array<Vec3, 3> now = moved(t, k);
      by_field = !hardly_moves(t, now) && !is_kept(t, now) && field_.turns(t, k);
    }
    turned += by_field;
  }
  return turned > few_turned &&
         static_cast<double>(turned) > most_turned * static_cast<double>(moving.size());
}

/// Those that offended before, and those around the given vertices.
void GuardSearch::check(const std::vector<int>& numbers) {
  for (const int n : numbers) offending_.insert(offending_.end(), around_[n].begin(), around_[n].end());
  std::sort(offending_.begin(), offending_.end());
  offending_.erase(std::unique(offending_.begin(), offending_.end()), offending_.end());
  std::erase_if(offending_, [this](int t) { return !offends(t); });
}

void GuardSearch::renew(const std::vector<int>& numbers) {
  for (const int n : numbers)
    for (std::size_t k = 0; k < times(); ++k) {
      Vec3 d = mean_[n].empty() ? own(n, k) : Vec3{};
      for (const Part& p : mean_[n]) d += p.part * own(p.number, k);
      with(n, k) = factor_[n] * d;
    }
}

Guard GuardSearch::result() const {
  Guard guard;
  std::vector<Guard::Share> shares;
  for (std::size_t n = 0; n < vertex_.size(); ++n) {
    if (mean_[n].empty() && factor_[n] == 1) continue;
    double change = 0;
    for (std::size_t k = 0; k < times(); ++k)
      if (lasting_[k]) change = std::max(change, norm(with_[n * times() + k] - own_[n * times() + k]));
    shares.clear();
    if (mean_[n].empty()) shares.push_back({vertex_[n], factor_[n]});
    for (const Part& p : mean_[n]) shares.push_back({vertex_[p.number], factor_[n] * p.part});
    guard.replace(vertex_[n], shares, change);
  }
  guard.sort();
  return guard;
}

}  // namespace cleft
