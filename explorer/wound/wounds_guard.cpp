// What the guard of all wounds is found from: positions of the blade.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "explorer/guard/guard_hold.h"
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
/// Likewise of triangles where moments begin and end; of the cut's length, places nearer to each other are
/// one.
constexpr int moment_rounds = 10;
constexpr double least_between = 1e-4;
/// What is left of a triangle that displacements between two looks show: where it is less it is looked at.
constexpr double near_limit = 0.5;
/// Of vertices, in all: more are not worth the time and the memory.
constexpr std::size_t most_moments = 1000000;
/// Of the largest opening, and mm: what a field turns itself in its own flat patch is not worth lips that are
/// held back by more than both for good, but of several cuts.
constexpr double worth_an_excuse = 0.02, worth_an_excuse_mm = GuardSearch::least_jump_mm;
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
        search_(mesh_, GuardSearch::least_jump_mm / wounds[0].scale(),
                {[this](int t, std::size_t time) { return wounds_.turned_by_field(t, blades_[time]); },
                 [this](int a, int b, double jump) { return wounds_.stretched_by_field(a, b, jump); },
                 [this](int a, int b, double jump) { return wounds_.drawn_apart_by_field(a, b, jump); },
                 [this](int left, std::size_t time) { return wounds_.closed_by_field(left, blades_[time]); },
                 wounds.size() == 1},
                poll),
        place_(mesh_.vertices().size(), -1) {
    for (std::size_t k = 0; k < wounds.size(); ++k) {
      const Wound& wound = wounds[k];
      for (const Incision::ChainVertex& c : wound.incision->chain())
        if (c.left != c.right) {
          search_.add_pair(c.left, c.right, wound.incision->path().at(c.s).across);
          lips_.push_back({c.left, c.right});
        }
      relief_.push_back(wounds.relief_while_cut(k));
      complete_.push_back(moved({k, wound.reached()}));
      number_.emplace_back(mesh_.vertices().size(), -1);
      std::vector<std::pair<int, double>> vertices;
      for (const Moved& one : complete_[k]) {
        number_[k][one.vertex] = static_cast<int>(vertices.size());
        vertices.emplace_back(one.vertex, one.at.s);
      }
      touched_.emplace_back();
      passages_.emplace_back(wound, vertices, wound.reached() / looks);
    }
  }
  GuardLooks(const GuardLooks&) = delete;
  GuardLooks& operator=(const GuardLooks&) = delete;

  Guard find(bool moments) {
    for (std::size_t k = 0; k < wounds_.size(); ++k)
      for (int i = 1; i <= looks; ++i)
        look({k, wounds_[k].reached() * (static_cast<double>(i) / looks)}, i == looks);
    Guard guard;
    if (search_.find()) {
      guard = search_.result();
      if (search_.is_excused()) {
        search_.hold_excused();
        Guard strict = search_.result();
        if (wounds_.size() > 1 || is_worth(strict, guard)) guard = std::move(strict);
      }
      if (moments) hold_for_moments(guard);
    } else if (moments) {
      only_named_ = true;
      hold_for_moments(guard);
    }
    name_unsound(guard);
    return guard;
  }

 private:
  void hold_for_moments(Guard& guard) {
    hold_remaining(guard);
    hold_sudden(guard);
    for (std::size_t k = 0; k < wounds_.size(); ++k) hold_passages(k, guard);
    for (std::size_t k = 0; k < wounds_.size(); ++k) hold_between_moments(k, guard);
    guard.sort();
  }

  /// What the field turns itself, and what could not be held back.
  void name_unsound(Guard& guard) {
    for (const int one : search_.doubtful())
      for (std::size_t k = 0; k < wounds_.size(); ++k) suspects_.push_back({one, {k, wounds_[k].reached()}});
    std::vector<bool> named(mesh_.triangles().size());
    for (const auto& [one, blade] : suspects_) {
      if (one < 0 || named[one]) continue;
      const std::array<Vec3, 3> moved = this->moved(one, blade, guard);
      const bool torn = search_.is_torn(one, moved);
      if (search_.is_sound(one, moved) || (!torn && !search_.is_turned(one, moved))) continue;
      named[one] = true;
      const auto& v = mesh_.triangle(one).vertex;
      guard.name({v[0], 1. / 3 * (mesh_.position(v[0]) + mesh_.position(v[1]) + mesh_.position(v[2])),
                  blade.cut, blade.s, torn});
    }
  }

  Relief::At relief_at(const Blade& blade) const { return relief_[blade.cut].at(wounds_.part_made(blade)); }

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
    for (const auto& [v, at, d] : some) {
      const Vec3 scaled = now.relieved(cut, at, d);
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
        if (is_unsound(one, {blade.cut, s}, guard)) hold(one, {blade.cut, s}, s - beside, s + beside, guard);
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
              for (const int touched : hold(one.triangle, {cut, s}, first, last, guard)) next[touched] = true;
            });
      }
      quiet = any ? 0 : quiet + 1;
      if (any) wanted = std::move(next);
    }
  }

  /// What is not sound where the moments of its corners begin, are full and end, and halfway between: there
  /// displacements turn from one course to another. Then what is around it.
  void hold_between_moments(std::size_t cut, Guard& guard) {
    std::vector<int> wanted = touched_[cut];
    for (int round = 0; round < moment_rounds && !wanted.empty(); ++round) {
      std::sort(wanted.begin(), wanted.end());
      wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
      std::vector<int> next;
      for (const int triangle : wanted) {
        const std::vector<double> turns = turns_of(triangle, cut, guard);
        for (std::size_t i = 1; i + 1 < turns.size(); ++i) {
          const double s = turns[i];
          if (!may_be_unsound(triangle, {cut, s}, guard) ||
              left(triangle, {cut, s}, guard) != GuardPassage::unsound)
            continue;
          const std::vector<int> touched =
              hold(triangle, {cut, s}, (turns[i - 1] + s) / 2, (s + turns[i + 1]) / 2, guard);
          next.insert(next.end(), touched.begin(), touched.end());
        }
      }
      wanted = std::move(next);
    }
  }

  /// From displacements that are linear between the even looks.
  bool may_be_unsound(int triangle, const Blade& blade, const Guard& guard) const {
    std::array<Vec3, 3> moved =
        search_.moved(triangle, blade.cut * looks, looks * blade.s / wounds_[blade.cut].reached());
    for (int i = 0; i < 3; ++i)
      moved[i] = guard.moments().part(mesh_.triangle(triangle).vertex[i], blade.cut, blade.s) * moved[i];
    return search_.left_of(triangle, moved) < near_limit || !search_.is_sound(triangle, moved);
  }

  /// Ascending, with both ends of the cut.
  std::vector<double> turns_of(int triangle, std::size_t cut, const Guard& guard) const {
    const double end = wounds_[cut].reached();
    std::vector<double> turns{0, end};
    for (const int v : mesh_.triangle(triangle).vertex) guard.moments().add_turns(v, cut, turns);
    std::sort(turns.begin(), turns.end());
    std::vector<double> all;
    for (const double s : turns) {
      if (!all.empty() && s < all.back() + least_between * end) continue;
      if (!all.empty()) all.push_back((all.back() + s) / 2);
      all.push_back(s);
    }
    return all;
  }

  /// What is not sound either when the cut is complete is left as it is: the field's doing, for which the
  /// wound is not held back.
  std::vector<int> hold(int one, const Blade& blade, double first, double last, Guard& guard) {
    const double end = wounds_[blade.cut].reached();
    suspects_.push_back({one, blade});
    if (only_named_ || guard.moments().count() > most_moments) return {};
    if (one >= 0 && left(one, {blade.cut, end}, guard) == GuardPassage::unsound) return {};
    const Relief::At now = relief_at(blade);
    const auto own = [&](int v) { return this->own(v, blade, now); };
    if (!hold_) hold_.emplace(search_);
    std::vector<int> touched =
        hold_->hold(one,
                    {blade.cut, blade.s, first, last, end, fade_part * passages_[blade.cut].near_tip(),
                     [&](int v) { return guard.displacement(v, own); }},
                    guard);
    std::erase_if(touched, [](int each) { return each < 0; });  // lips
    touched_[blade.cut].insert(touched_[blade.cut].end(), touched.begin(), touched.end());
    return touched;
  }

  /// The displacement of a vertex without the guard.
  Vec3 own(int v, const Blade& blade, const Relief::At& now) const {
    Vec3 sum;
    for (std::size_t k = 0; k <= blade.cut; ++k) {
      const int i = number_[k][v];
      if (i < 0) continue;
      const Moved& moved = complete_[k][i];
      sum += now.relieved(k, moved.at, k == blade.cut ? alone_(v, blade) : moved.displacement);
    }
    return sum;
  }

  /// The largest opening of the complete cuts, and how much a guard takes of any, mm.
  struct HeldBack {
    double opening = 0, taken = 0;
  };
  HeldBack held_back(const Guard& guard) const {
    const Blade end{wounds_.size() - 1, wounds_[wounds_.size() - 1].reached()};
    const Relief::At now = relief_at(end);
    const auto own = [&](int v) { return this->own(v, end, now); };
    HeldBack most;
    for (const auto& [left, right] : lips_) {
      const Vec3 open = own(right) - own(left),
                 held = guard.displacement(right, own) - guard.displacement(left, own);
      most.opening = std::max(most.opening, wounds_[0].scale() * norm(open));
      most.taken = std::max(most.taken, wounds_[0].scale() * norm(held - open));
    }
    return most;
  }

  bool is_worth(const Guard& strict, const Guard& excused) const {
    const auto [opening, taken] = held_back(excused);
    return held_back(strict).taken <= taken + std::max(worth_an_excuse * opening, worth_an_excuse_mm);
  }

  bool is_unsound(int one, const Blade& blade, const Guard& guard) const {
    if (one >= 0) return left(one, blade, guard) == GuardPassage::unsound;
    const std::span<const int> lips = search_.corners(one);
    const Relief::At now = relief_at(blade);
    return search_.is_passed(one, moved(lips[0], blade, now, guard), moved(lips[1], blade, now, guard));
  }

  /// GuardPassage::Left.
  double left(int triangle, const Blade& blade, const Guard& guard) const {
    const std::array<Vec3, 3> moved = this->moved(triangle, blade, guard);
    return search_.is_sound(triangle, moved) ? search_.left_of(triangle, moved) : GuardPassage::unsound;
  }

  /// The displacements of its corners.
  std::array<Vec3, 3> moved(int triangle, const Blade& blade, const Guard& guard) const {
    const Relief::At now = relief_at(blade);
    const auto& v = mesh_.triangle(triangle).vertex;
    return {moved(v[0], blade, now, guard), moved(v[1], blade, now, guard), moved(v[2], blade, now, guard)};
  }

  Vec3 moved(int vertex, const Blade& blade, const Relief::At& now, const Guard& guard) const {
    const auto own = [&](int v) { return this->own(v, blade, now); };
    return guard.moments().part(vertex, blade.cut, blade.s) * guard.displacement(vertex, own);
  }

  const Wounds& wounds_;
  const CutMesh& mesh_;
  const MovedAlone& moved_;
  const DisplacementAlone& alone_;
  const std::function<void()>& poll_;
  std::vector<Blade> blades_;  // of all looks
  GuardSearch search_;
  std::optional<GuardHold> hold_;
  std::vector<Relief> relief_;                // while each cut is made
  std::vector<std::vector<Moved>> complete_;  // by each cut
  std::vector<std::vector<int>> number_;      // of a vertex in that
  std::vector<GuardPassage> passages_;
  std::vector<std::vector<int>> touched_;  // by each cut: triangles with corners that moments hold back
  std::vector<std::array<int, 2>> lips_;   // left and right, of all cuts
  struct Suspect {
    int one;  // as in GuardSearch::Remaining
    Blade blade;
  };
  std::vector<Suspect> suspects_;          // all that was not sound, when it was found
  bool only_named_ = false;                // not held back, where the field is to blame
  std::vector<std::pair<int, Vec3>> sum_;  // of all cuts, at one look
  std::vector<int> place_;                 // of a vertex in that
};

Guard Wounds::found_guard(const MovedAlone& moved, const DisplacementAlone& alone, bool moments,
                          const std::function<void()>& poll) const {
  return GuardLooks(*this, moved, alone, poll).find(moments);
}

}  // namespace cleft
