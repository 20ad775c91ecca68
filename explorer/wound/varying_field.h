// The field of a cut that changes along its path: in skin whose prestress varies, fields of the same
// canonical cut, superposed with weights that vary along the path; in skin whose shape varies, the fields of
// a family for the shapes at stations of the path, linear between them.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "encoder/field/field.h"
#include "params/parameters/parameters.h"

namespace cleft {

/// A member of field.parameters. Throws InputError where it is not recorded.
double parameter_of(const Field& field, const double& member);

/// The field for the shape of the skin and the cut at a place of the path.
struct StationField {
  double s;  ///< mm along the path
  std::shared_ptr<const Field> field;
  Prestress prestress;  ///< MPa, along `along`, across it, and shear
  Vec3 along;           ///< unit, in space: the direction of u there
  double outside = 0;   ///< how far the shape is beyond those of the family, over half a range
  double tilt = 0;      ///< of the field's blade against the skin's normal, degrees
};

class VaryingField {
 public:
  /// One field along the whole path. Fields must outlive this object and its copies.
  VaryingField(const Field& field) : fields_{&field} {}  // NOLINT(google-explicit-constructor)

  /// weights[i][k] is that of fields[k] at stations[i], mm along the path; linear between them. Throws
  /// InputError if the fields are not of the same cut in the same patch.
  VaryingField(std::vector<const Field*> fields, std::vector<double> stations,
               std::vector<std::vector<double>> weights);

  /// Of a family: stations, at least one, in the order of s. Places are those of `shape`, whose canonical cut
  /// the fields have but for its depth. Throws InputError if they have another cut or patch.
  VaryingField(std::shared_ptr<const Field> shape, std::vector<StationField> stations);
  /// Of a family: a further station beyond the last one, of this object and its copies. Beyond the last
  /// station the field is as there.
  void extend(StationField station);
  /// mm along the path: where the last station is; infinite of fields that are no family's.
  double known_to() const {
    return along_ ? along_->stations.back() : std::numeric_limits<double>::infinity();
  }

  /// The canonical cut, the patch and the parametrisation, which all fields have in common.
  const Field& shape() const { return along_ ? *along_->shape : *fields_.front(); }
  /// Fields that change over time as all others do: of a family one, which stands for the others.
  std::vector<const Field*> typical() const {
    return along_ ? std::vector{along_->fields.front().get()} : fields_;
  }
  /// Whether the fields are for the local shape of the skin and the blade: its tilt is in their
  /// displacements.
  bool follows_shape() const { return along_ != nullptr; }
  /// Whether the tension is that of the skin at each place of the path, not that of the field's case.
  bool turns() const { return along_ || !weights_.empty(); }
  double contraction_tolerance() const;

  /// Field::contract at s mm of the path, to the last of the stops. Memory of `out` is reused from call to
  /// call.
  void contract(const Vec3& uvw, Side side, double s, std::span<const double> stops, History& out) const;
  /// Field::displacement at s mm of the path.
  Vec3 displacement(const Vec3& uvw, Side side, double t, double s) const;
  /// Field::derivatives at s mm of the path.
  Derivatives derivatives(const Vec3& uvw, Side side, double t, double s) const;
  /// A component of the fields' prestresses at s mm of the path, superposed, MPa. Throws InputError where a
  /// field does not record it.
  double prestress(double Prestress::*component, double s) const;
  /// The direction of u at s mm of the path, in space, unit; none where it is the path's own.
  std::optional<Vec3> along(double s) const;
  /// How far the shape at s mm of the path is beyond those of a family, over half their range.
  double outside(double s) const;
  /// The tilt of the blade that is in the displacements at s mm of the path, degrees; 0 but of a family.
  double tilt(double s) const;

 private:
  /// A field and its weight at a place.
  struct Part {
    const Field* field;
    double weight;
  };
  /// The stations of a family's fields.
  struct Along {
    std::shared_ptr<const Field> shape;
    std::vector<double> stations;
    std::vector<std::shared_ptr<const Field>> fields;
    std::vector<Prestress> prestress;
    std::vector<Vec3> direction;
    std::vector<double> outside, tilt;
    double contraction_tolerance = 0;
  };
  void parts_at(double s, std::vector<Part>& parts) const;
  Vec3 place_in(const Field& field, const Vec3& uvw) const;

  std::vector<const Field*> fields_;  // all but a family's
  std::vector<double> stations_;
  std::vector<std::vector<double>> weights_;  // of all fields at each station; none: one field, as it is
  std::shared_ptr<Along> along_;              // shared by all copies
};

}  // namespace cleft
