// The field of a cut from a family, for the shape of the skin and the blade at each place of the path.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "explorer/study/family.h"
#include "explorer/wound/path_shape.h"
#include "explorer/wound/prestress_fields.h"
#include "explorer/wound/varying_field.h"
#include "explorer/wound/wound.h"

namespace cleft {

/// The skin's tension where none is given: that of the default case, with its u along the line from the
/// path's start to its end (of a loop, or a path that grows: along its start), as a simulation of the body
/// has it.
SkinTension default_tension(const ScalpelPath& path, bool grows);

struct OwnCut;

class FamilyFields {
 public:
  /// `tissue`: above bone, where there is any.
  explicit FamilyFields(std::shared_ptr<const Family> family, TissueAboveBone tissue = {})
      : family_(std::move(family)), tissue_(std::move(tissue)) {}

  const Field& shape() const { return family_->middle(); }
  const Family& family() const { return *family_; }
  std::shared_ptr<const Family> shared_family() const { return family_; }
  Followed followed() const;

  /// The fields at stations of the path, between which its shape changes linearly and by at most a tenth of
  /// the family's ranges. A case of the family has one curvature all along its cut, in skin of one tension
  /// and one curvature in space. At u of its cut the path has turned against both by its curvature times the
  /// way from the middle: so what is found at a place of the path is turned by as much. `prestress` is in the
  /// frame of `volume`, which is one without a family's field yet. Of a path that grows, only the first
  /// `known` mm are known.
  VaryingField along(const Incision& incision, const IncisionVolume& volume, const PathPrestress& prestress,
                     double known = std::numeric_limits<double>::infinity()) const;

  /// Whether a path that is found as the blade moves has come so far beyond the field's last station that
  /// there is another one; its place, mm.
  std::optional<double> next_station(const Incision& incision, double scale, const VaryingField& field) const;
  /// Adds that station.
  void extend(VaryingField& field, const Incision& incision, double scale, double s,
              const SkinTension& tension) const;

 private:
  Smoothing smoothing() const;
  LocalShape known_to_family(LocalShape local, const Incision& incision, double scale, double s) const;

  /// Values at stations of a path, linear between them.
  struct AlongPath {
    std::vector<double> stations, values;
    double at(double s) const;
  };
  AlongPath ease(const PathShape& shapes, double t) const;
  OwnCut own_cut(const LocalShape& local, double u_from_middle) const;
  double known_tilt(const LocalShape& local) const;

  std::shared_ptr<const Family> family_;
  TissueAboveBone tissue_;
};

}  // namespace cleft
