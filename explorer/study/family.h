// A family: a study whose cases differ in the shape of the skin and of the cut in it.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

class Family {
 public:
  /// A parameter that differs among the cases, and its range there.
  struct Range {
    double least, greatest;
  };

  /// Reads a study folder or a study.dffd: some seconds for 100 cases. Throws InputError if it is none by
  /// describes(), with the reason, or if the study cannot be interpolated.
  explicit Family(const std::string& study);
  ~Family();
  Family(const Family&) = delete;
  Family& operator=(const Family&) = delete;

  /// Whether cases that differ in these parameters are a family: in shapes of the skin and the cut that
  /// change along a path (cut.curvature, cut.curvature_rate, cut.tilt, cut.depth, skin.curvature_u, _v and
  /// _uv, patch.height with bone below, and patch.bottom), and in all three components of the skin's
  /// prestress, but in nothing else.
  static bool describes(const std::vector<std::string>& varying);

  /// The shapes that differ among the cases, by name.
  const std::map<std::string, Range>& shapes() const { return shapes_; }
  /// The shape in the middle, 0 or the mean of each range, under the cases' largest tension across the cut.
  const Field& middle() const { return *middle_; }
  std::shared_ptr<const Field> shared_middle() const { return middle_; }

  /// Whether bone below the skin changes the field.
  bool knows_bone() const { return on_bone_; }
  /// The height of the tissue where there is no bone, mm, of a family that knows bone.
  double whole_height() const { return whole_height_; }
  /// The field for values of all shapes() and the prestress, MPa, in milliseconds. The height is that of the
  /// tissue above bone: where some cases are on springs, as these from their height on. Values beyond the
  /// cases' are taken as the nearest of theirs; `outside` tells how far beyond they are, over half the range.
  struct Member {
    std::shared_ptr<const Field> field;
    double outside;
  };
  Member at(std::map<std::string, double> shapes, const Prestress& prestress) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
  std::map<std::string, Range> shapes_;
  bool on_bone_ = false;     // some cases are on bone, and
  double whole_height_ = 0;  // this is the others' patch.height, mm
  std::shared_ptr<const Field> middle_;
};

}  // namespace cleft
