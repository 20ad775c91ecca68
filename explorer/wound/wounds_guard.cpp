// What the guard of all wounds is found from: positions of the blade, and what the fields do themselves.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "explorer/wound/guard_passage.h"
#include "explorer/wound/wounds.h"

namespace cleft {

namespace {
/// At how many positions of the blade in each cut the guard looks at the skin.
constexpr int looks = 48;
/// In how many parts the way between two of these is divided for triangles that move very differently then.
constexpr int looks_between = 8;
/// How often triangles are looked at anew around which displacements were reduced for a moment, at other
/// positions each time: until nothing is found so many times.
constexpr int passage_rounds = 20, quiet_rounds = 2;
/// Of the way over which displacements next to the tip change quickly: a moment begins and ends in it.
constexpr double fade_part = 0.25;
/// Of the largest opening: what the field of a single cut turns itself in its own flat patch is not worth
/// lips that are held back by more for good.
constexpr double worth_an_excuse = 0.02;
/// Of its own flat patch a field that keeps less turns it over.
constexpr double least_area = 0.3;
/// Likewise of a triangle as it lies in the patch, as much as is called turned over on a mesh.
constexpr double least_triangle = 0.2;
/// Of the area of a triangle in space and in the patch, the less over the larger, where they are compared.
constexpr double least_alike = 0.7;
/// Of a triangle's shape, which is 1 if its sides are equal; and of the cut's depth: as far is the tip felt.
constexpr double well_shaped = 0.4, tip_part = 0.5;
/// Lengths in the patch and in space that are about the same.
constexpr double about = 1.25;
/// Of an edge's length in space, its length in a patch: where it is more, the patch is drawn apart there.
constexpr double most_drawn = 2;
/// mm: neighbours that move apart by no more are never torn.
constexpr double least_jump = 0.05;
/// Of that: a field that moves its own lips into each other by more does so on any mesh.
constexpr double part_closed = 0.4;
}  // namespace

/// The positions of the blade at which the skin is looked at: even ones of all the skin, and further ones of
/// each triangle next to the path, while the blade passes that very triangle.
class Wounds::GuardLooks {
 public:
  GuardLooks(const Wounds& wounds, const MovedAlone& moved, const DisplacementAlone& alone,
             const std::function<void()>& poll)
      : wounds_(wounds),
        mesh_(wounds[0].incision->mesh()),
        moved_(moved),
        alone_(alone),
        poll_(poll),
        search_(mesh_, least_jump / wounds[0].scale(),
                {[this](int t, std::size_t time) { return wounds_.turned_by_field(t, blades_[time]); },
                 [this](int a, int b, double jump) { return wounds_.stretched_by_field(a, b, jump); },
                 [this](int left, std::size_t time) { return wounds_.closed_by_field(left, blades_[time]); }},
                poll),
        place_(mesh_.vertices().size(), -1) {
    for (std::size_t k = 0; k < wounds.size(); ++k) {
      const Wound& wound = wounds[k];
      for (const Incision::ChainVertex& c : wound.incision->chain())
        if (c.left != c.right) {
          search_.add_pair(c.left, c.right, wound.incision->path().at(c.s).across);
          lips_.push_back({c.left, c.right});
        }
      relief_.push_back(wounds.relief_while_cut(k, wound.reached()));
      complete_.push_back(moved({k, wound.reached()}));
      number_.emplace_back(mesh_.vertices().size(), -1);
      std::vector<std::pair<int, double>> vertices;
      for (const Moved& one : complete_[k]) {
        number_[k][one.vertex] = static_cast<int>(vertices.size());
        vertices.emplace_back(one.vertex, one.s);
      }
      passages_.emplace_back(wound, vertices, wound.reached() / looks);
    }
  }
  GuardLooks(const GuardLooks&) = delete;
  GuardLooks& operator=(const GuardLooks&) = delete;

  Guard find(bool moments) {
    for (std::size_t k = 0; k < wounds_.size(); ++k)
      for (int i = 1; i <= looks; ++i)
        look({k, wounds_[k].reached() * (static_cast<double>(i) / looks)}, i == looks);
    if (!search_.find()) return {};
    Guard guard = search_.result();
    if (search_.is_excused()) {
      search_.hold_excused();
      Guard strict = search_.result();
      if (wounds_.size() > 1 || held_back(strict) <= held_back(guard) + worth_an_excuse)
        guard = std::move(strict);
    }
    if (!moments) return guard;
    hold_remaining(guard);
    hold_sudden(guard);
    for (std::size_t k = 0; k < wounds_.size(); ++k) hold_passages(k, guard);
    guard.sort();
    return guard;
  }

 private:
  Relief::At relief_at(const Blade& blade) const {
    const double reached = wounds_[blade.cut].reached();
    return relief_[blade.cut].at(reached > 0 ? blade.s / reached : 1);
  }

  /// All of the skin is looked at with the blade there.
  void look(const Blade& blade, bool lasting) {
    const Relief::At now = relief_at(blade);
    if (poll_) poll_();
    add(moved_(blade), now, blade.cut);
    for (std::size_t k = 0; k < blade.cut; ++k) add(complete_[k], now, k);
    for (const auto& [v, d] : sum_) place_[v] = -1;
    search_.add(std::exchange(sum_, {}), lasting);
    blades_.push_back(blade);
  }

  void add(const std::vector<Moved>& some, const Relief::At& now, std::size_t cut) {
    for (const auto& [v, s, d] : some) {
      const Vec3 scaled = now.amplitude(cut, s) * d;
      if (place_[v] < 0)
        place_[v] = static_cast<int>(sum_.size()), sum_.emplace_back(v, scaled);
      else
        sum_[place_[v]].second += scaled;
    }
  }

  /// What is not sound at the even looks, for the moment.
  void hold_remaining(Guard& guard) {
    for (const auto& [one, time] : search_.remaining()) {
      const Blade& blade = blades_[time];
      const double beside = wounds_[blade.cut].reached() / (2 * looks);
      hold(one, blade, blade.s - beside, blade.s + beside, guard);
    }
  }

  /// What is not sound between two even looks.
  void hold_sudden(Guard& guard) {
    for (const auto& [one, time] : search_.sudden()) {
      const Blade& blade = blades_[time];
      const double before = time > 0 && blades_[time - 1].cut == blade.cut ? blades_[time - 1].s : 0;
      for (int i = 1; i < looks_between; ++i) {
        const double s = before + (blade.s - before) * i / looks_between,
                     beside = (blade.s - before) / (2 * looks_between);
        if (left(one, {blade.cut, s}, guard) == GuardPassage::unsound)
          hold(one, {blade.cut, s}, s - beside, s + beside, guard);
      }
    }
  }

  /// What is not sound while the blade passes it, and then what is around it.
  void hold_passages(std::size_t cut, Guard& guard) {
    std::vector<bool> wanted(mesh_.triangles().size(), true);
    for (int round = 0, quiet = 0; round < passage_rounds && quiet < quiet_rounds; ++round) {
      std::vector<bool> next(wanted.size());
      bool any = false;
      for (const GuardPassage::Beside& one : passages_[cut].beside()) {
        if (!wanted[one.triangle]) continue;
        any |= passages_[cut].look(
            one, round,
            [&](int triangle, double s) {
              return left(triangle, {cut, s}, guard);
            },
            [&](double s, double first, double last) {
              for (const int touched : hold(one.triangle, {cut, s}, first, last, guard))
                if (touched >= 0) next[touched] = true;
            });
      }
      quiet = any ? 0 : quiet + 1;
      if (any) wanted = std::move(next);
    }
  }

  std::vector<int> hold(int one, const Blade& blade, double first, double last, Guard& guard) {
    const Relief::At now = relief_at(blade);
    const auto own = [&](int v) { return this->own(v, blade, now); };
    return search_.hold_for_a_moment(
        {one},
        {blade.cut, blade.s, first, last, wounds_[blade.cut].reached(),
         fade_part * passages_[blade.cut].near_tip(), [&](int v) { return guard.displacement(v, own); }},
        guard);
  }

  /// The displacement of a vertex without the guard.
  Vec3 own(int v, const Blade& blade, const Relief::At& now) const {
    Vec3 sum;
    for (std::size_t k = 0; k <= blade.cut; ++k) {
      const int i = number_[k][v];
      if (i < 0) continue;
      const Moved& moved = complete_[k][i];
      sum += now.amplitude(k, moved.s) * (k == blade.cut ? alone_(v, blade) : moved.displacement);
    }
    return sum;
  }

  /// Of the largest opening of the complete cuts, how much a guard takes of any.
  double held_back(const Guard& guard) const {
    if (guard.empty()) return 0;
    const Blade end{wounds_.size() - 1, wounds_[wounds_.size() - 1].reached()};
    const Relief::At now = relief_at(end);
    const auto own = [&](int v) { return this->own(v, end, now); };
    double largest = 0, taken = 0;
    for (const auto& [left, right] : lips_) {
      const Vec3 open = own(right) - own(left);
      largest = std::max(largest, norm(open));
      taken = std::max(taken, norm(guard.displacement(right, own) - guard.displacement(left, own) - open));
    }
    return largest > 0 ? taken / largest : 0;
  }

  /// GuardPassage::Left.
  double left(int triangle, const Blade& blade, const Guard& guard) const {
    const Relief::At now = relief_at(blade);
    const auto own = [&](int v) { return this->own(v, blade, now); };
    std::array<Vec3, 3> displacements;
    for (int i = 0; i < 3; ++i) {
      const int v = mesh_.triangle(triangle).vertex[i];
      displacements[i] = guard.moments().part(v, blade.cut, blade.s) * guard.displacement(v, own);
    }
    return search_.is_sound(triangle, displacements) ? search_.left_of(triangle, displacements)
                                                     : GuardPassage::unsound;
  }

  const Wounds& wounds_;
  const CutMesh& mesh_;
  const MovedAlone& moved_;
  const DisplacementAlone& alone_;
  const std::function<void()>& poll_;
  std::vector<Blade> blades_;  // of all looks
  GuardSearch search_;
  std::vector<Relief> relief_;                // while each cut is made
  std::vector<std::vector<Moved>> complete_;  // by each cut
  std::vector<std::vector<int>> number_;      // of a vertex in that
  std::vector<GuardPassage> passages_;
  std::vector<std::array<int, 2>> lips_;   // left and right, of all cuts
  std::vector<std::pair<int, Vec3>> sum_;  // of all cuts, at one look
  std::vector<int> place_;                 // of a vertex in that
};

Guard Wounds::found_guard(const MovedAlone& moved, const DisplacementAlone& alone, bool moments,
                          const std::function<void()>& poll) const {
  return GuardLooks(*this, moved, alone, poll).find(moments);
}

/// Whether the fields turn their own flat patches over at a triangle's corner, or nearly so: each of them, or
/// what they change of the area together.
bool Wounds::turned_by_field(int triangle, const Blade& blade) const {
  for (const int v : wounds_.front().incision->mesh().triangle(triangle).vertex) {
    double together = 1;
    for (std::size_t k = 0; k <= blade.cut; ++k) {
      const Wound& wound = wounds_[k];
      const double s = k == blade.cut ? blade.s : wound.complete();
      const auto at = wound.volume.locate(v);
      if (!at) continue;
      const Side side = at->on_cut && at->s >= s ? Side::both : at->side;
      const double t = std::clamp(s + at->time_offset, 0., wound.field.shape().cut().length);
      const Derivatives d = wound.field.derivatives(at->uvw, side, t, at->s);
      const double area = cross(Vec3{1, 0, 0} + d.by_u, Vec3{0, 1, 0} + d.by_v).z;
      together += amplitude(k, at->s, blade) * (area - 1);
      if (std::min(area, together) < least_area) return true;
    }
  }
  return turned_between_corners(triangle, blade);
}

/// The same for a triangle next to the tip as it lies in the flat patch of the cut, moved by the field at its
/// corners: a fit oscillates at the tip while it passes, between corners whose derivatives show nothing.
/// Where the mesh lies in the patch as in space. Slivers are the mesh's fault.
bool Wounds::turned_between_corners(int triangle, const Blade& blade) const {
  const CutMesh& mesh = wounds_.front().incision->mesh();
  const auto& corners = mesh.triangle(triangle).vertex;
  const auto twice_area = [](const std::array<Vec3, 3>& p) { return cross(p[1] - p[0], p[2] - p[0]); };
  const Wound& wound = wounds_[blade.cut];
  std::array<Vec3, 3> space, rest, moved;
  double part = 1;  // the least: that displacements are held back from corner to corner is not the field's
  for (int i = 0; i < 3; ++i) {
    const auto at = wound.volume.locate(corners[i]);
    if (!at || !(std::abs(at->s - blade.s) < tip_part * wound.field.shape().cut().depth)) return false;
    const Side side = at->on_cut && at->s >= blade.s ? Side::both : at->side;
    const double t = std::clamp(blade.s + at->time_offset, 0., wound.field.shape().cut().length);
    space[i] = wound.scale() * mesh.position(corners[i]);
    rest[i] = {at->s, at->uvw.y, 0};
    moved[i] = amplitude(blade.cut, at->s, blade) * wound.field.displacement(at->uvw, side, t, at->s);
    part = std::min(part, at->weight);
  }
  std::array<Vec3, 3> now = rest;
  for (int i = 0; i < 3; ++i) now[i] += part * moved[i];
  const Vec3 before = twice_area(rest), after = twice_area(now);
  const double area = norm(before), area_now = norm(after), alike = area / norm(twice_area(space));
  const double sides =
      squared_norm(rest[1] - rest[0]) + squared_norm(rest[2] - rest[1]) + squared_norm(rest[0] - rest[2]);
  if (!(alike > least_alike && alike < 1 / least_alike)) return false;
  if (2 * std::sqrt(3.) * area < well_shaped * sides) return false;
  return area_now < least_triangle * area || dot(before, after) < 0;
}

/// Whether two vertices that move apart by more than `jump`, mesh units, are nearer to each other in the flat
/// patches of all cuts: the fields stretch the skin between them, and not that the patches are drawn apart.
bool Wounds::stretched_by_field(int a, int b, double jump) const {
  const CutMesh& mesh = wounds_.front().incision->mesh();
  const double length = norm(mesh.position(b) - mesh.position(a));
  const auto apart = [](Side x, Side y) { return x != y && x != Side::both && y != Side::both; };
  bool moved = false;
  for (const Wound& wound : wounds_) {
    const auto from = wound.volume.locate(a), to = wound.volume.locate(b);
    if (!from || !to) continue;
    moved = true;
    // By s and not by u: between the halves of a path longer than the canonical cut u does not change.
    const Vec3 between{to->s - from->s, to->uvw.y - from->uvw.y, to->uvw.z - from->uvw.z};
    if (apart(from->side, to->side) || !(norm(between) < about * jump * wound.scale())) return false;
    if (norm(between) > most_drawn * wound.scale() * length) return false;
  }
  return moved;
}

/// Whether the field of a cut moves its lips into each other.
bool Wounds::closed_by_field(int lip, const Blade& blade) const {
  for (std::size_t k = 0; k <= blade.cut; ++k) {
    const Wound& wound = wounds_[k];
    const double s = k == blade.cut ? blade.s : wound.complete();
    const auto at = wound.volume.locate(lip);
    if (!at || !at->on_cut || at->s >= s) continue;
    const double t = std::clamp(s + at->time_offset, 0., wound.field.shape().cut().length);
    const auto moved = [&](Side side) {
      return wound.field.displacement({at->uvw.x, 0, at->uvw.z}, side, t, at->s).y;
    };
    if (moved(Side::right) - moved(Side::left) < -least_jump * part_closed) return true;
  }
  return false;
}

}  // namespace cleft
