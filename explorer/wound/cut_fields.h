// The fields that open the cuts in a skin: one case's field for all directions of a cut; fields of three
// prestresses, superposed as the skin's tension turns against each path; or a family, whose fields follow the
// shape of the skin and the blade too.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "explorer/wound/family_fields.h"
#include "explorer/wound/prestress_fields.h"
#include "explorer/wound/wound.h"

namespace cleft {

class CutFields {
 public:
  explicit CutFields(std::shared_ptr<const Field> one) : one_(std::move(one)) {}
  /// Without `tension`, each path must have its own prestresses.
  CutFields(std::shared_ptr<const PrestressFields> three, const std::optional<SkinTension>& tension)
      : three_(std::move(three)), tension_(tension) {}
  /// Without `tension` that of the default case along the first path (default_tension), for all cuts that
  /// this object and its copies open.
  CutFields(std::shared_ptr<const FamilyFields> family, const std::optional<SkinTension>& tension)
      : family_(std::move(family)), tension_(tension) {}

  const Field& shape() const { return one_ ? *one_ : three_ ? three_->shape() : family_->shape(); }
  /// Whether the fields turn with the tension.
  bool turning() const { return !one_; }
  /// Whether they follow the shape of the skin and the blade.
  bool following_shape() const { return family_ != nullptr; }

  /// The same fields over bone: a family that has cases on bone follows it.
  CutFields above_bone(TissueAboveBone tissue) const;

  /// The same fields in this tension, if they turn with it.
  CutFields in_tension(const SkinTension& tension) const;

  /// The wound of a cut whose surroundings are known; neither the cut nor this must end before it. `own`:
  /// prestresses along its path that override the tension. Throws InputError if a tension is given for one
  /// field, or none for three.
  Wound wound(const Incision& cut, double scale, const std::optional<PathPrestress>& own = {}) const {
    return wound(cut, scale, own, std::numeric_limits<double>::infinity());
  }
  /// The same of a path that is found as the blade moves, of which `known` mm are known: follow_shape().
  Wound growing_wound(const Incision& cut, double scale, double known) const {
    return wound(cut, scale, {}, known);
  }
  /// Follows the shape of a growing path to where the wound's volume knows it: one station at most.
  void follow_shape(Wound& wound) const;

 private:
  Wound wound(const Incision& cut, double scale, const std::optional<PathPrestress>& own, double known) const;
  Wound opened(const Incision& cut, double scale, const std::optional<PathPrestress>& own,
               double known) const;
  SkinTension tension_of(const Incision& cut, bool grows) const;

  std::shared_ptr<const Field> one_;
  std::shared_ptr<const PrestressFields> three_;
  std::shared_ptr<const FamilyFields> family_;
  std::optional<SkinTension> tension_;
  TissueAboveBone tissue_;
  std::shared_ptr<std::optional<SkinTension>> of_first_ = std::make_shared<std::optional<SkinTension>>();
};

/// The wound of a cut in skin under one tension, which turns against the path; the fields must outlive it.
Wound wound_in_tension(const Incision& cut, const PrestressFields& fields, const SkinTension& tension,
                       double scale);

/// The fields of a field file, of a study.dffd of three cases with different prestress, or of a family, in
/// this tension. Throws InputError if a tension is given for one case's field.
CutFields read_cut_fields(const std::string& file, const std::optional<SkinTension>& tension);

}  // namespace cleft
