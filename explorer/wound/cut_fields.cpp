#include "explorer/wound/cut_fields.h"

#include <algorithm>

#include "base/error.h"
#include "base/h5/h5.h"
#include "encoder/field/file/field_file.h"

namespace cleft {

namespace {
constexpr const char* three_cases =
    "a study.dffd of three cases that differ in skin.prestress_u, _v and _uv alone";
}

VaryingField CutFields::along(const Incision& cut, double scale,
                              const std::optional<PathPrestress>& own) const {
  if (one_ && own)
    throw InputError(std::string("the path has prestresses along it: they need ") + three_cases);
  if (one_) return *one_;
  if (own) return three_->along(*own);
  if (!tension_)
    throw InputError(
        "the field file holds several cases: give --tension and --prestress, or the path columns "
        "skin.prestress_u, _v, _uv, or one case.dffd");
  const IncisionVolume volume(cut, shape(), scale);
  return three_->along(prestress_along(volume, cut.path().length(), *tension_));
}

CutFields read_cut_fields(const std::string& file, const std::vector<double>& direction,
                          const std::vector<double>& prestresses) {
  if (format_of(file) != "cleft-study") {
    if (!direction.empty())
      throw InputError(std::string("--tension needs ") + three_cases + "; " + file + " is one case");
    return CutFields(std::make_shared<const Field>(read_field(file)));
  }
  std::optional<SkinTension> tension;
  if (!direction.empty())
    tension = SkinTension{{direction[0], direction[1], direction[2]},
                          std::max(prestresses[0], prestresses[1]),
                          std::min(prestresses[0], prestresses[1])};
  return {std::make_shared<const PrestressFields>(file), tension};
}

}  // namespace cleft
