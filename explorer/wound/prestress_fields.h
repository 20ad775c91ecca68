// A cut in skin whose tension turns against the path: fields of one cut that differ in the skin's prestress
// alone, superposed at every place of the path for the prestress there.
#pragma once

#include <string>
#include <vector>

#include "explorer/study/study.h"
#include "explorer/wound/ipv.h"
#include "explorer/wound/varying_field.h"
#include "params/parameters/recorded.h"

namespace cleft {

/// The skin's prestress in the path's own frame: along it, across it, and shear.
struct PathPrestress {
  std::vector<double> stations;  ///< mm along the path, increasing
  std::vector<Prestress> values;
};

/// Principal prestresses of the skin, MPa, and the direction of the larger in the mesh's space, which is
/// projected to the skin.
struct SkinTension {
  Vec3 direction;
  double larger = 0, smaller = 0;
};

/// A case's prestress, MPa; components that are not recorded are 0.
Prestress prestress_of(const RecordedParameters& parameters);

/// In the frame of the skin under the path. Throws InputError where the direction stands upright on the skin.
PathPrestress prestress_along(const IncisionVolume& volume, double length, const SkinTension& tension);

class PrestressFields {
 public:
  /// Cases of a study that differ from case `like` in skin.prestress_u, _v and _uv alone. Throws InputError
  /// where there are no three of them whose prestresses are independent.
  PrestressFields(const PublishedStudy& study, int like);
  /// A study.dffd. Throws InputError too where its cases differ in anything else.
  explicit PrestressFields(const std::string& study_file);

  const Field& shape() const { return fields_.front(); }
  /// Reads this object's fields: must not outlive it.
  VaryingField along(const PathPrestress& prestress) const;

 private:
  std::vector<Field> fields_;
  Vec3 inverse_[3];  // rows: weights of the three fields for (uu, vv, uv)
};

}  // namespace cleft
