// The field of a cut in skin whose prestress varies along the cut: fields of the same canonical cut,
// superposed with weights that vary along the path.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "encoder/field/field.h"
#include "params/parameters/parameters.h"

namespace cleft {

/// A member of field.parameters. Throws InputError where it is not recorded.
double parameter_of(const Field& field, const double& member);

class VaryingField {
 public:
  /// One field along the whole path. Fields must outlive this object and its copies.
  VaryingField(const Field& field) : fields_{&field} {}  // NOLINT(google-explicit-constructor)

  /// weights[i][k] is that of fields[k] at stations[i], mm along the path; linear between them. Throws
  /// InputError if the fields are not of the same cut in the same patch.
  VaryingField(std::vector<const Field*> fields, std::vector<double> stations,
               std::vector<std::vector<double>> weights);

  /// The canonical cut, the patch and the parametrisation, which all fields have in common.
  const Field& shape() const { return *fields_.front(); }
  std::span<const Field* const> fields() const { return fields_; }
  double contraction_tolerance() const;

  /// Field::contract at s mm of the path. Memory of `out` is reused from call to call.
  void contract(const Vec3& uvw, Side side, double s, std::span<const double> stops, History& out) const;
  /// Field::displacement at s mm of the path.
  Vec3 displacement(const Vec3& uvw, Side side, double t, double s) const;
  /// Field::derivatives at s mm of the path.
  Derivatives derivatives(const Vec3& uvw, Side side, double t, double s) const;
  /// A component of the fields' prestresses at s mm of the path, superposed, MPa. Throws InputError where a
  /// field does not record it.
  double prestress(double Prestress::*component, double s) const;

 private:
  std::vector<double> weights_at(double s) const;

  std::vector<const Field*> fields_;
  std::vector<double> stations_;
  std::vector<std::vector<double>> weights_;  // none: one field, as it is
};

}  // namespace cleft
