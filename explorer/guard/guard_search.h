// Where the skin of a wound needs a guard: found from the positions of its vertices at some times.
//
// A triangle of the skin is sound if it keeps its side and a part of its area, and no edge of it tears. The
// vertices of triangles that are not are moved to where the means of their neighbours' displacements have
// them, with weights that reproduce any linear displacement (Floater 2003, mean value coordinates): a
// harmonic map, which turns nothing over where its border does not. Where that does not suffice, or is not
// possible, as on lips, displacements are reduced there, and less so the further away: for good where a
// triangle is not sound with its cuts complete, and otherwise for the moment. All vertices at rest are sound,
// so that the search succeeds on any mesh.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "explorer/guard/guard.h"
#include "explorer/incision/cut_mesh.h"

namespace cleft {

/// Whether the normal of a triangle turns by more than a right angle or its area falls below a fifth.
bool is_turned_over(const std::array<Vec3, 3>& rest, const std::array<Vec3, 3>& now);

class GuardSearch {
 public:
  /// What the field does itself, in its own flat patch: that is no fault of the mesh, and wounds are not held
  /// back for it for good. Times are numbers of calls of add(), from 0.
  struct ByField {
    std::function<bool(int triangle, std::size_t time)> turns;
    std::function<bool(int a, int b, double jump)> stretches;    ///< an edge; jump in mesh units
    std::function<bool(int a, int b, double jump)> draws_apart;  ///< by nearly as much, where it lies alike
    std::function<bool(int left, std::size_t time)> closes;      ///< lips: moves them into each other
    bool alone = true;  ///< of one cut: what several turn together no field turns in its own patch
  };

  /// mm: neighbours that move apart by no more are never torn, and lips pass each other by no more.
  static constexpr double least_jump_mm = 0.05;

  /// The mesh must outlive it. Neighbours may always move apart by `least_jump`, mesh units. `poll`, if any,
  /// is called for each triangle that is looked at.
  GuardSearch(const CutMesh& mesh, double least_jump, ByField field, std::function<void()> poll = {})
      : mesh_(mesh), least_jump_(least_jump), field_(std::move(field)), poll_(std::move(poll)) {}

  /// The vertices that have moved at one time, each once, and their displacements, mesh units. `lasting`:
  /// with the cuts complete.
  void add(std::vector<std::pair<int, Vec3>> moved, bool lasting) {
    moved_.push_back(std::move(moved));
    lasting_.push_back(lasting);
  }
  /// Two vertices that lie on the left and the right lip of a cut; `across` it, of length 1. They must not
  /// pass each other by more than `least_jump`.
  void add_pair(int left, int right, const Vec3& across) { pairs_.push_back({{left, right}, across}); }
  /// Finds the guard with which all triangles of the skin are sound at all lasting times, but for those that
  /// the field turns itself. Means are found for all times. False where the field turns much of its own patch
  /// over: then it needs none.
  bool find();
  /// Whether triangles are left that the field turns itself, with the cuts complete; and holds these back
  /// too.
  bool is_excused() const;
  void hold_excused();
  Guard result() const;
  std::size_t times() const { return moved_.size(); }

  /// A triangle of the skin, or -1 - i for pair i of lips, that is not sound at a time with the guard found.
  struct Remaining {
    int one;
    std::size_t time;
  };
  /// Those at times that are not lasting, by times; that the field turns them is no excuse.
  std::vector<Remaining> remaining() const;
  /// Triangles, and pairs, that move so differently at a time and the one before (at rest before the first)
  /// that they may not be sound in between, with the guard found and without moments.
  std::vector<Remaining> sudden() const;
  /// Whether a triangle of the skin is sound with these displacements of its corners; that the field turns it
  /// is no excuse.
  bool is_sound(int triangle, const std::array<Vec3, 3>& moved) const {
    return hardly_moves(triangle, moved) || (!is_torn(triangle, moved) && is_kept(triangle, moved));
  }

  /// The corners of a triangle, or the vertices of pair i if `one` is -1 - i: left and right.
  std::span<const int> corners(int one) const;
  /// Whether a pair's lips pass each other by more than `least_jump` with these displacements.
  bool is_passed(int one, const Vec3& left, const Vec3& right) const {
    return past(pairs_[-1 - one], left, right) > part_passed * least_jump_;
  }

  /// The displacements of its corners at a time between two calls of add(), linear from one to the next: `at`
  /// from 0, before the call numbered `first`, where nothing moves if that is 0.
  std::array<Vec3, 3> moved(int triangle, std::size_t first, double at) const;

  /// Whether it is_turned_over(); and whether an edge tears.
  bool is_turned(int triangle, const std::array<Vec3, 3>& moved) const;
  bool is_torn(int triangle, const std::array<Vec3, 3>& moved) const;
  /// Triangles of the skin, and pairs of lips, that ever were not sound, sorted.
  std::vector<int> doubtful() const;

  /// Its area then, seen along its normal at rest, over that at rest; 1 where that is 0.
  double left_of(int triangle, const std::array<Vec3, 3>& moved) const;

 private:
  friend class GuardHold;
  struct Part {
    int number;
    double part;
    friend bool operator==(const Part&, const Part&) = default;
  };
  struct Neighbor {
    int number;
    double length;  // of the edge at rest, mesh units
  };
  struct Pair {
    std::array<int, 2> vertex;
    Vec3 across;
  };

  void number_vertices();
  void find_neighbors();
  void add_neighbor(int number, int vertex);
  void measure_triangles();
  Vec3& with(int number, std::size_t time) {
    return with_[static_cast<std::size_t>(number) * times() + time];
  }
  const Vec3& with(int number, std::size_t time) const {
    return with_[static_cast<std::size_t>(number) * times() + time];
  }
  const Vec3& own(int number, std::size_t time) const {
    return own_[static_cast<std::size_t>(number) * times() + time];
  }
  std::array<Vec3, 3> moved(int triangle, std::size_t time) const;
  bool offends(int one);
  bool offends(int one, std::size_t time, bool excused) const;
  bool offends_for_good(int one) const;
  /// By how much its lips pass each other; less than 0 where they are open.
  static double past(const Pair& pair, const Vec3& left, const Vec3& right) {
    return dot(left - right, pair.across);
  }
  void add_sudden_triangles(std::vector<Remaining>& found) const;
  void add_sudden_pairs(std::vector<Remaining>& found) const;
  bool hardly_moves(int triangle, const std::array<Vec3, 3>& moved) const;
  bool hardly_bends(int triangle, const std::array<Vec3, 3>& moved) const;
  bool is_kept(int triangle, const std::array<Vec3, 3>& moved) const;
  void check(const std::vector<int>& numbers);
  std::vector<int> all_numbers() const;
  void check_all();
  bool field_is_to_blame();
  bool is_free(int number) const;
  bool join();
  void move_joined();
  std::vector<Part> mean_of_ring(int number) const;
  void find_means();
  void find_lasting_means();
  void spread_means();
  void move_as_means(const std::vector<int>& group);
  bool tie(int triangle, std::vector<int>& group);
  bool bends(int triangle) const;
  void find_delicate();
  bool grow(std::vector<int>& group);
  void solve(const std::vector<int>& group, const std::vector<std::vector<Part>>& means);
  void reduce();
  void reduce(double strain);
  double taken_for_good() const;
  std::vector<int> even_out(std::vector<int> reduced, double strain);
  void renew(const std::vector<int>& numbers);

  /// Of the least jump: lips that pass each other by more are held back. The rest is for what they do between
  /// two looks.
  static constexpr double part_passed = 0.75;

  const CutMesh& mesh_;
  double least_jump_;
  ByField field_;
  std::function<void()> poll_;
  std::vector<std::vector<std::pair<int, Vec3>>> moved_;  // [time]: vertices and their displacements
  std::vector<bool> lasting_;                             // [time]
  bool only_lasting_ = false, excused_ = true;            // what offends

  std::vector<int> vertex_, number_;  // of the mesh by number, and back: -1 for what does not move
  std::vector<Vec3> own_, with_;      // [number][time]: displacements without and with the guard
  std::vector<double> factor_, largest_;
  std::vector<std::vector<Part>> mean_;  // [number]: none: its own displacement
  std::vector<bool> in_group_;
  std::vector<std::vector<Part>> tie_;  // [number]: of those that are tied to the ends of an edge
  std::vector<int> leader_;             // [number]: that moves like it; itself; -1: none
  /// [number]: triangles of the skin, and -1 - i for pair i; neighbours, over walls and across them, too.
  std::vector<std::vector<int>> around_;
  std::vector<std::vector<Neighbor>> next_;
  std::vector<Pair> pairs_;
  /// [triangle]: mesh units, squared: corners that move by less against the first leave it sound.
  std::vector<double> harmless_;
  std::vector<int> offending_;  // sorted: triangles, and -1 - i for pair i
  std::vector<int> delicate_;   // slivers that are not sound between two times, if not at these
  std::vector<int> doubtful_;   // likewise, not sorted: all that ever were not sound, excused or not
};

}  // namespace cleft
