// The histories of many vertices over one grid of times, in the order of memory in which a frame reads them:
// the pieces of all vertices for one span of time are contiguous, so that a frame streams through those of
// its span. Where one cubic is not sufficient (the tip passes), a short list of exceptions holds several.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

/// A grid of times for the histories of sums of fields of the same cut: the coarsest that divides the fields'
/// knots evenly, up to eight parts each, on which one cubic a span keeps nearly all of those of a sample of
/// places to `tolerance` mm.
std::vector<double> replay_times(std::span<const Field* const> fields, double tolerance);

class ReplayPieces {
 public:
  /// Allocates the histories over `times` (the first and last of the field included) of vertices whose own
  /// time is the blade's plus their offset, clamped. `offsets` never decrease. Bounds are for positions of
  /// the blade from 0 to `reach`.
  ReplayPieces(std::vector<double> times, std::vector<double> offsets, std::vector<int> vertices,
               double reach = std::numeric_limits<double>::infinity());

  /// The history of vertices[i], with breaks at all times of the grid. In the order of i.
  void append(const History& history);
  /// Two histories: `closed` until the blade is at s, `open` from there on.
  void append(const History& closed, const History& open, double s);

  /// out[vertices[i]] = rest[vertices[i]] + displacement, with the blade at s. Allocates no memory.
  void positions(double s, const Vec3* rest, Vec3* out) const {
    positions(s, 0, vertices_.size(), rest, out);
  }
  /// The same only for vertices that move while the blade goes from `before` to s; returns the range of their
  /// numbers i.
  std::pair<std::size_t, std::size_t> positions(double before, double s, const Vec3* rest, Vec3* out) const;

  /// The displacement of vertices[i] alone, with the blade at s. positions() may round it otherwise.
  Vec3 displacement(std::size_t i, double s) const;

  /// The histories of vertices[chosen[k]] only; `chosen` ascends.
  ReplayPieces of(const std::vector<std::size_t>& chosen) const;

  const std::vector<int>& vertices() const { return vertices_; }
  /// A bound of the displacement of vertices[i] with the blade within its reach: its longest control point.
  double bound(std::size_t i) const { return bounds_[i]; }
  /// From now on the displacement of vertices[i] is written to another vertex.
  void redirect(std::size_t i, int vertex) { vertices_[i] = vertex; }

  std::size_t exceptions() const { return exception_count_; }  ///< pairs of a vertex and a span of time
  const std::vector<PieceBlock>& blocks() const { return blocks_; }

 private:
  struct Piece {
    double begin, end;
    std::array<Vec3, 4> control;
  };
  /// Several pieces of one vertex in one span: those before the blade has passed `closed_until`, and others.
  struct Exception {
    std::size_t vertex;
    double closed_until;
    std::size_t first, open, last;  // in its span's pieces
  };

  std::size_t spans() const { return times_.size() - 1; }
  void positions(double s, std::size_t front, std::size_t last, const Vec3* rest, Vec3* out) const;
  void set(std::size_t span, const std::array<Vec3, 4>& control);
  void collect(const History& history, std::size_t span);
  void choose(const std::vector<std::size_t>& chosen, std::size_t span, ReplayPieces& out) const;
  Vec3 displacement(const Exception& exception, const std::vector<Piece>& pieces, double s) const;

  std::vector<double> times_, offsets_;
  std::vector<int> vertices_;
  std::vector<double> bounds_;
  double reach_;
  std::size_t blocks_a_span_, next_ = 0, exception_count_ = 0;
  std::vector<PieceBlock> blocks_;  // [span][vertex / 4]
  /// Of one span of time, both in the order of vertices.
  struct Divided {
    std::vector<Exception> exceptions;
    std::vector<Piece> pieces;
  };
  std::vector<Divided> divided_;
  const KernelTable* kernels_ = &kernel_table(available_kernels().back());
};

}  // namespace cleft
