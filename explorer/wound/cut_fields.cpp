#include "explorer/wound/cut_fields.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/h5/h5.h"
#include "encoder/field/file/field_file.h"

namespace cleft {

namespace {
constexpr const char* three_cases =
    "a study.dffd of three cases that differ in skin.prestress_u, _v and _uv alone";

/// A path of which less is known than all opens as that of the fields' own cut.
Wound in_prestress(const Incision& cut, const PrestressFields& fields, const PathPrestress& prestress,
                   IncisionVolume volume, double known) {
  const double length = cut.path().length() * volume.scale();
  VaryingField field =
      fields.along(length <= known ? fields.as_the_path_opens(prestress, volume, length) : prestress);
  return {cut, std::move(field), std::move(volume)};
}

}  // namespace

CutFields CutFields::above_bone(TissueAboveBone tissue) const {
  CutFields result = *this;
  result.tissue_ = std::move(tissue);
  if (family_)
    result.family_ = std::make_shared<const FamilyFields>(family_->shared_family(), result.tissue_);
  return result;
}

CutFields CutFields::in_tension(const SkinTension& tension) const {
  CutFields result = *this;
  if (turning()) result.tension_ = tension;
  return result;
}

Wound CutFields::wound(const Incision& cut, double scale, const std::optional<PathPrestress>& own,
                       double known) const {
  Wound wound = opened(cut, scale, own, known);
  wound.tissue = tissue_;
  if (family_) wound.followed = family_->followed();
  return wound;
}

Wound CutFields::opened(const Incision& cut, double scale, const std::optional<PathPrestress>& own,
                        double known) const {
  if (one_ && own)
    throw InputError(std::string("the path has prestresses along it: they need ") + three_cases);
  if (one_) return {cut, *one_, scale};
  if (family_) {
    IncisionVolume volume(cut, family_->shape(), scale);
    const SkinTension tension = tension_of(cut, std::isfinite(known));
    VaryingField field = family_->along(
        cut, volume, own ? *own : prestress_along(volume, cut.path().length(), tension), known);
    return {cut, std::move(field), std::move(volume)};
  }
  if (!own && !tension_)
    throw InputError(
        "the field file holds several cases: give --tension and --prestress, or the path columns "
        "skin.prestress_u, _v, _uv, or one case.dffd");
  IncisionVolume volume(cut, three_->shape(), scale);
  const PathPrestress prestress = own ? *own : prestress_along(volume, cut.path().length(), *tension_);
  return in_prestress(cut, *three_, prestress, std::move(volume), known);
}

SkinTension CutFields::tension_of(const Incision& cut, bool grows) const {
  if (tension_) return *tension_;
  if (!*of_first_) *of_first_ = default_tension(cut.path(), grows);
  return **of_first_;
}

void CutFields::follow_shape(Wound& wound) const {
  if (!family_) return;
  const Incision& cut = *wound.incision;
  if (const auto s = family_->next_station(cut, wound.scale(), wound.field))
    family_->extend(wound.field, cut, wound.scale(), *s, tension_of(cut, true));
}

Wound wound_in_tension(const Incision& cut, const PrestressFields& fields, const SkinTension& tension,
                       double scale) {
  IncisionVolume volume(cut, fields.shape(), scale);
  const PathPrestress prestress = prestress_along(volume, cut.path().length(), tension);
  return in_prestress(cut, fields, prestress, std::move(volume), std::numeric_limits<double>::infinity());
}

CutFields read_cut_fields(const std::string& file, const std::optional<SkinTension>& tension) {
  if (format_of(file) != "cleft-study") {
    if (tension)
      throw InputError(std::string("--tension needs ") + three_cases + "; " + file + " is one case");
    return CutFields(std::make_shared<const Field>(read_field(file)));
  }
  if (Family::describes(PublishedStudy(file).varying()))
    return {std::make_shared<const FamilyFields>(std::make_shared<const Family>(file)), tension};
  return {std::make_shared<const PrestressFields>(file), tension};
}

}  // namespace cleft
