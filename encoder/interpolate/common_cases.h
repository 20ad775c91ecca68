// The cases of a study on common knots: their control points can be added up.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/file/study_file.h"

namespace cleft {

/// A case as read: its field, whose parameters hold switches and choices too (unknown for imported data).
struct StudyMember {
  std::string name;
  Field field;
};

/// The published cases of a study folder, or the fields of a study.dffd. Throws InputError if there are none,
/// FileError if one is damaged.
std::vector<StudyMember> read_members(const std::string& study);

/// The name of a number, 0 or 1, that stands for patch.bottom = "bone" where a study has cases on bone and on
/// springs: nothing lies between, but what is added from one to the other can be interpolated.
inline constexpr const char* on_bone_name = "patch.on_bone";
/// Of the parameters of a case of such a study: with the choice in place of the number again.
void name_bottom(RecordedParameters& parameters);

/// Called repeatedly with the completed part of the work, 0 to 1; an exception from it ends the work.
using ReportPart = std::function<void(double part)>;

/// The parameters of a field's case. The cut ends at nodes: where the mesh was made for another cut, not
/// where it was asked to.
RecordedParameters parameters_as_solved(const Field& field);

/// Data of a case besides its control points.
struct CommonCase {
  std::string name;
  /// cut.length and cut.depth are those of the cut in the mesh, if the mesh was made for another cut.
  RecordedParameters parameters;
  FieldGeometry geometry;
  FitReport report;
};

/// A derivative of a case's displacement by a parameter.
struct CommonDerivative {
  int of;  ///< case
  std::string parameter;
  double error;  ///< mm per unit: largest at any node and frame
};

class CommonCases {
 public:
  /// Raises all cases to bases that contain the knots of each. Of cases with equal parameters the one with
  /// the least error is used. Those of cut.mirrored stand for their mirror images too. Throws InputError if
  /// fewer than two remain, if parametrisations or choices differ, or if one cut reaches an edge of the patch
  /// that another does not.
  explicit CommonCases(const std::vector<StudyMember>& members);
  /// The same for a study folder or a study.dffd, of which one field at a time is in memory.
  static CommonCases of_study(const std::string& study, const ReportPart& report = {});
  /// The same for the records of a study.dffd, without mirror images.
  static CommonCases of_records(const std::vector<const StudyRecord*>& records);

  const std::vector<CommonCase>& cases() const { return cases_; }
  int size() const { return static_cast<int>(cases_.size()); }
  const std::string& parametrization() const { return parametrization_; }
  /// Whether all of them are fitted on the same knots with the same given regularisation: what nodes leave
  /// free then changes smoothly from case to case.
  bool fitted_alike() const { return fitted_alike_; }

  /// Bases in parameters that are the same in all cases: "fixed" has them scaled to -1 .. 1 across and 0
  /// .. 1.
  const std::array<BSplineBasis, 4>& bases() const { return bases_; }
  /// Control points of a case on bases(), mm: [point * 3 + component]. Single precision is 1e4 times finer
  /// than any fit.
  std::span<const float> control_points(int i) const { return points_[i]; }
  std::vector<Vec3> points(int i) const;  ///< the same
  /// Of all cases; their control points likewise, mm per unit.
  const std::vector<CommonDerivative>& derivatives() const { return derivatives_; }
  std::span<const float> derivative_points(std::size_t d) const { return derivative_points_[d]; }
  /// The field of a sum of control points, in a body of this geometry; and the bases it has there.
  Field field_of(const std::vector<Vec3>& points, FieldGeometry geometry) const;
  std::array<BSplineBasis, 4> bases_in(const FieldGeometry& geometry) const;

 private:
  struct Own;  // a case on its own knots
  explicit CommonCases(std::vector<Own> all);
  static Own own_of(const StudyMember& member);
  static std::vector<Own> own_of(const std::vector<StudyMember>& members);
  static void check_alike(const Own& a, const Own& b);
  static Own mirror_image_of(const Own& own);
  static std::vector<Own> with_mirror_images(std::vector<Own> all);
  static std::vector<Own> made_alike(std::vector<Own> all);
  static std::array<BSplineBasis, 4> common_bases(const std::vector<Own>& all);
  static std::vector<bool> distinct(const std::vector<Own>& all);

  std::vector<CommonCase> cases_;
  std::string parametrization_;
  bool fitted_alike_ = true;
  std::array<BSplineBasis, 4> bases_;
  std::vector<std::vector<float>> points_;
  std::vector<CommonDerivative> derivatives_;
  std::vector<std::vector<float>> derivative_points_;
};

/// The same control points in double precision.
std::vector<Vec3> points_of(std::span<const float> flat);

/// A sum of control points as those of CommonCases, all of one number. Added up in one order: points that are
/// the same in all summands stay the same, bit for bit.
struct Summand {
  double weight;
  std::span<const float> values;
};
std::vector<Vec3> sum_of(const std::vector<Summand>& summands);

}  // namespace cleft
