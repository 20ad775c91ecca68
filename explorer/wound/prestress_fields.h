// A cut in skin whose tension turns against the path: fields of one cut that differ in the skin's prestress
// alone, superposed at each place of the path for the prestress there.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explorer/incision/tension_lines.h"
#include "explorer/study/study.h"
#include "explorer/wound/ipv.h"
#include "explorer/wound/varying_field.h"
#include "params/parameters/recorded.h"

namespace cleft {

/// The skin's prestress in the path's own frame: along it, across it, and shear.
struct PathPrestress {
  std::vector<double> stations;  ///< mm along the path, increasing
  std::vector<Prestress> values;

  /// Linear between the stations, and as at the ends beyond them. There must be a station.
  Prestress at(double s) const;
};

/// Principal prestresses of the skin, MPa, and the direction of the larger in the mesh's space, which is
/// projected to the skin.
struct SkinTension {
  Vec3 direction;
  double larger = 0, smaller = 0;
  /// Lines that have been painted or read; where there are some the direction at a place is their mean
  /// (twice_angle_of), and `direction` is not used.
  std::shared_ptr<const std::vector<TensionLine>> lines = nullptr;
};

/// Of three numbers and of two prestresses, MPa, in either order; none where there is no direction.
std::optional<SkinTension> skin_tension(const std::vector<double>& direction,
                                        const std::vector<double>& prestresses);

/// The lines of a tension, of which there is one where it has one direction.
std::vector<TensionLine> lines_of(const SkinTension& tension);

/// A case's prestress, MPa; components that are not recorded are 0.
Prestress prestress_of(const RecordedParameters& parameters);

/// The prestress along and across two unit vectors, within the skin at s mm of the path, which is at `place`,
/// mm; MPa. Throws InputError if the direction is normal to the skin.
Prestress prestress_in(const std::array<Vec3, 2>& directions, const SkinTension& tension, double s,
                       const Vec3& place);

/// The same in the frame of the skin along all of a path, whose length is in mesh units.
PathPrestress prestress_along(const IncisionVolume& volume, double length, const SkinTension& tension);

class PrestressFields {
 public:
  /// Cases of a study that differ from case `like` in skin.prestress_u, _v and _uv alone. Throws InputError
  /// if there are no three of them with independent prestresses.
  PrestressFields(const PublishedStudy& study, int like);
  /// The cases of a study.dffd. Also throws InputError if its cases differ in anything else.
  explicit PrestressFields(const std::string& study_file);

  const Field& shape() const { return fields_.front(); }
  /// Refers to this object's fields, which must outlive it.
  VaryingField along(const PathPrestress& prestress) const;
  /// The prestress with which the straight cut of these fields opens at each place as all of a path, `length`
  /// mm long, does (path_opening.h).
  PathPrestress as_the_path_opens(const PathPrestress& prestress, const IncisionVolume& volume,
                                  double length) const;

 private:
  std::vector<Field> fields_;
  Vec3 inverse_[3];  // rows: weights of the three fields for (uu, vv, uv)
};

}  // namespace cleft
