// Where the skin of a wound needs a guard: found from the positions of its vertices at some times.
//
// A triangle of the skin is sound if it keeps its side and a part of its area, and no edge of it tears. The
// vertices of triangles that are not are moved to where the means of their neighbours' displacements have
// them, with weights that reproduce any linear displacement (Floater 2003, mean value coordinates): a
// harmonic map, which turns nothing over where its border does not. Where that does not suffice, or is not
// possible, as on lips, displacements are reduced there, and less so the further away. All vertices at rest
// are sound, so that the search succeeds on any mesh.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/wound/guard.h"

namespace cleft {

class GuardSearch {
 public:
  /// What the field does itself, in its own flat patch: that is no fault of the mesh. Times are numbers of
  /// calls of add(), from 0.
  struct ByField {
    std::function<bool(int triangle, std::size_t time)> turns;
    std::function<bool(int a, int b, double jump)> stretches;  ///< an edge; jump in mesh units
    std::function<bool(int left, std::size_t time)> closes;    ///< lips: moves them into each other
  };

  /// The mesh must outlive it. Neighbours may always move apart by `least_jump`, mesh units.
  GuardSearch(const CutMesh& mesh, double least_jump, ByField field)
      : mesh_(mesh), least_jump_(least_jump), field_(std::move(field)) {}

  /// The vertices that have moved at one time, each once, and their displacements, mesh units.
  void add(std::vector<std::pair<int, Vec3>> moved) { moved_.push_back(std::move(moved)); }
  /// Two vertices that lie on the left and the right lip of a cut; `across` it, of length 1. They must not
  /// pass each other by more than `least_jump`.
  void add_pair(int left, int right, const Vec3& across) { pairs_.push_back({{left, right}, across}); }
  /// The guard with which all triangles of the skin are sound at all these times; none where the field turns
  /// much of its own patch over. May be called again after further calls of add().
  Guard find();
  std::size_t times() const { return moved_.size(); }
  /// Whether a triangle of the skin is sound with these displacements of its corners, at any time for which
  /// ByField has an answer.
  bool is_sound(int triangle, const std::array<Vec3, 3>& moved, std::size_t time) const;
  /// Its area then, seen along its normal at rest, over that at rest; 1 where that is 0.
  double left_of(int triangle, const std::array<Vec3, 3>& moved) const;

 private:
  struct Part {
    int number;
    double part;
  };
  struct Pair {
    std::array<int, 2> vertex;
    Vec3 across;
  };

  void number_vertices();
  void find_neighbors();
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
  std::span<const int> corners(int one) const;
  bool offends(int one) const;
  bool is_passed(const Pair& pair, std::size_t time) const;
  bool hardly_moves(int triangle, const std::array<Vec3, 3>& moved) const;
  bool is_kept(int triangle, const std::array<Vec3, 3>& moved) const;
  bool is_torn(int triangle, const std::array<Vec3, 3>& moved) const;
  void check(const std::vector<int>& numbers);
  std::vector<int> all_numbers() const;
  void check_all();
  bool field_is_to_blame();
  bool is_free(int number) const;
  std::vector<Part> mean_of_ring(int number) const;
  void spread_means();
  bool tie(int triangle, std::vector<int>& group);
  bool grow(std::vector<int>& group);
  void solve(const std::vector<int>& group);
  void reduce();
  std::vector<int> even_out(std::vector<int> reduced);
  void renew(const std::vector<int>& numbers);
  Guard result() const;

  const CutMesh& mesh_;
  double least_jump_;
  ByField field_;
  std::vector<std::vector<std::pair<int, Vec3>>> moved_;  // [time]: vertices and their displacements

  std::vector<int> vertex_, number_;  // of the mesh by number, and back: -1 for what does not move
  std::vector<Vec3> own_, with_;      // [number][time]: displacements without and with the guard
  std::vector<double> factor_, largest_;
  std::vector<std::vector<Part>> mean_;  // [number]: none: its own displacement
  std::vector<bool> in_group_;
  std::vector<std::vector<Part>> tie_;  // [number]: of those that are tied to the ends of an edge
  /// [number]: triangles of the skin, and -1 - i for pair i; neighbours, over walls and across them, too.
  std::vector<std::vector<int>> around_, next_;
  std::vector<Pair> pairs_;
  /// [triangle]: mesh units, squared: corners that move by less against the first leave it sound.
  std::vector<double> harmless_;
  std::vector<int> offending_;  // sorted: triangles, and -1 - i for pair i
};

}  // namespace cleft
