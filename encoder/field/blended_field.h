// A body with several breaks: a field for the piece of the body around each, blended between them.
#pragma once

#include <span>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

/// The fields of all pieces, each with its source and extent. Their sum with weights (piece_weights) is as
/// exact as they are: weights are not negative and sum to 1. Points are (u, v, w) of the first piece, as they
/// lie (mm, without its map), and vectors are along its axes.
class BlendedField {
 public:
  /// Throws InputError where a piece lacks its source or extent, or has other quantities than the first.
  explicit BlendedField(std::vector<Field> pieces);
  BlendedField(BlendedField&&) = default;
  BlendedField(const BlendedField&) = delete;  // it refers to its pieces

  const std::vector<Field>& pieces() const { return pieces_; }
  const Field& first() const { return pieces_.front(); }

  /// Weights of the pieces at a point of the source's space.
  void weights(const Vec3& in_source, std::span<double> out) const {
    piece_weights(sources_, in_source, out);
  }
  Vec3 in_source(const Vec3& uvw) const;
  /// The point of the source's space in the coordinates of a piece. A point within rounding of v = 0 is on
  /// it, on the given side.
  Place place(std::size_t piece, const Vec3& in_source, Side side, double t) const;
  /// Values of a piece, point by point, along the axes of the first one.
  void turn_from(std::size_t piece, int components, std::span<double> values) const {
    turn(values, components, to_first_[piece]);
  }

  /// From frame 0. On a break `side` selects the lip by the break's own v; elsewhere it has no effect.
  Vec3 displacement(const Vec3& uvw, Side side, double t) const;
  /// Value of quantities[index].
  void quantity(std::size_t index, const Vec3& uvw, Side side, double t, std::span<double> out) const;

  /// Whether the piece that counts most at a point has it in its domain.
  bool is_inside(const Vec3& uvw) const;

 private:
  /// Calls with each piece that counts at the point, its weight and its place there.
  template <class Add>
  void add_up(const Vec3& uvw, Side side, double t, const Add& add) const;

  std::vector<Field> pieces_;
  std::vector<const FieldSource*> sources_;
  std::vector<AxesInSpace> to_first_;
};

/// The largest of the pieces' errors; what is no error is that of the first.
FitReport report_of(const std::vector<Field>& pieces);

}  // namespace cleft
