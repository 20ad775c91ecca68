// Several cuts in one mesh, made one after the other: each opens as its field predicts, in the tension that
// the others leave. The displacements of vertices are evaluated in two ways: `ReplayedWounds` at any time of
// cuts that are all known, `LiveWounds` at their tips while they are made.
#pragma once

#include <deque>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "explorer/guard/guard_search.h"
#include "explorer/wound/mutual_relief.h"
#include "explorer/wound/validity.h"
#include "explorer/wound/wound.h"

namespace cleft {

class Wounds {
 public:
  Wounds(const Wounds&) = delete;
  Wounds& operator=(const Wounds&) = delete;

  std::size_t size() const { return wounds_.size(); }
  bool empty() const { return wounds_.empty(); }
  /// In the order in which they were made.
  const Wound& operator[](std::size_t cut) const { return wounds_[cut]; }

  /// The blade is at `s` mm of the path of `cut`; earlier cuts are complete, later ones not begun.
  struct Blade {
    std::size_t cut;
    double s;
  };
  /// The amplitude of a cut at s mm of its path with the given blade: its opening relative to that without
  /// other cuts.
  double amplitude(std::size_t cut, double s, const Blade& blade) const;

  /// The displacement of a place below the skin by all cuts, mesh units. `nearest` is a vertex of the skin,
  /// `depth` in mm, and sides[k] is its side of cut k if it is on its surface.
  Vec3 displacement_below(const Vec3& place, double depth, int nearest, std::span<const Side> sides,
                          const Blade& blade) const;

  /// What keeps the skin from turning over where the fields alone would turn it, in all cuts that are
  /// complete.
  const Guard& guard() const { return guard_; }

  /// The validity of each cut. `turned`: whether the fields follow the tension.
  std::vector<Validity> validity(bool turned) const { return validity_of(first(size()), turned, guard_); }

 protected:
  Wounds() = default;
  ~Wounds() = default;

  /// Adds a wound; earlier ones keep their addresses. Until its own relief is known, that of the wound before
  /// it holds.
  Wound& add(Wound wound);
  Wound& newest() { return wounds_.back(); }
  void remove_newest() { wounds_.pop_back(), relief_.pop_back(); }
  std::vector<const Wound*> first(std::size_t count) const;
  const Relief& relief(std::size_t newest) const { return relief_[newest]; }
  void set_relief(std::size_t newest, Relief relief) { relief_[newest] = std::move(relief); }
  /// The amplitudes at a position of the blade; valid until a wound is added or a relief is set.
  Relief::At relief_at(const Blade& blade) const;

  /// Where complete cuts meet; none while a cut is made.
  void set_crossings(std::vector<Crossing> crossings) { crossings_ = std::move(crossings); }
  const std::vector<Crossing>& crossings() const { return crossings_; }

  /// A vertex that a cut moves, and its displacement by this cut alone, mesh units.
  struct Moved {
    int vertex;
    BesideCut at;
    Vec3 displacement;
  };
  /// The vertices that a cut moves alone, each once, with the blade at the given place of it; and the
  /// displacement of one of them.
  using MovedAlone = std::function<std::vector<Moved>(const Blade&)>;
  using DisplacementAlone = std::function<Vec3(int vertex, const Blade&)>;
  /// The guard of all wounds as far as they are cut; with the moments while they are cut, or without. `poll`
  /// is called all the while: what it throws ends the search. May be called on another thread, as long as
  /// nothing of the wounds and their mesh changes.
  Guard found_guard(const MovedAlone& moved, const DisplacementAlone& alone, bool moments,
                    const std::function<void()>& poll = {}) const;
  void set_guard(Guard guard) { guard_ = std::move(guard); }
  void forget_guard(int vertex) { guard_.forget(vertex); }

 private:
  class GuardLooks;
  Vec3 changed_by_guard(int vertex, const Blade& blade) const;
  /// A displacement by one cut alone, mm, as the others leave it. `nearest` is a vertex of the same skin.
  Vec3 relieved(std::size_t cut, const ActiveVertex& at, int nearest, const Vec3& alone,
                const Blade& blade) const;
  double part_made(const Blade& blade) const;
  Relief relief_while_cut(std::size_t newest) const;
  bool turned_by_field(int triangle, const Blade& blade) const;
  bool turned_between_corners(int triangle, const Blade& blade) const;
  bool stretched_by_field(int a, int b, double jump) const;
  bool drawn_apart_by_field(int a, int b, double jump) const;
  bool closed_by_field(int lip, const Blade& blade) const;

  std::deque<Wound> wounds_;
  std::vector<Relief> relief_;  // while wound k is the newest
  std::vector<Crossing> crossings_;
  Guard guard_;
};

}  // namespace cleft
