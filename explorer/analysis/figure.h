// A number that is asked of a study: by its name, of a field, or of displacements at a few places.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

/// gape: the widest opening of the lips, mm; gape(u) the opening at u along the cut, gape(u, t) when the
/// length t is cut. displacement: the largest of the skin, mm; displacement(u, v, w), displacement(u, v, w,
/// t) that of a point, u(...), v(...), w(...) its components likewise. Where no t is given all is cut. A
/// point with v = 0 is of the right lip.
/// field: all of the skin, when half and all is cut; its number is the largest displacement, and it differs
/// from another by the largest distance of any of its points.
class Figure {
 public:
  /// Throws InputError with the names that there are.
  explicit Figure(const std::string& text);

  const std::string& text() const { return text_; }
  const std::string& unit() const { return unit_; }

  /// Places whose displacements make the figure, in a body of this geometry: always of one number.
  std::vector<Place> places(const FieldGeometry& geometry) const;
  /// The figure of their displacements, x, y, z of one after another.
  double of(const Eigen::Ref<const Eigen::VectorXd>& displacements) const;
  double of(const Field& field) const;
  /// What is linear in them and makes the figure, a column for each of theirs: openings, a component, or all
  /// displacements; and the figure of such a column.
  Eigen::MatrixXd linear_part(const Eigen::Ref<const Eigen::MatrixXd>& displacements) const;
  double of_linear_part(const Eigen::Ref<const Eigen::VectorXd>& part) const;
  /// The displacements of the field at its places, as of() takes them.
  Eigen::VectorXd displacements(const Field& field) const;
  /// Whether it is the field, of which distance() counts.
  bool is_field() const { return kind_ == Kind::field; }
  /// The largest distance between displacements of the same places.
  static double distance(const Eigen::Ref<const Eigen::VectorXd>& a,
                         const Eigen::Ref<const Eigen::VectorXd>& b);

 private:
  enum class Kind { widest, opening, largest, distance, component, field };
  std::string text_, unit_ = "mm";
  Kind kind_ = Kind::widest;
  int component_ = 0;
  std::vector<double> at_;
};

}  // namespace cleft
