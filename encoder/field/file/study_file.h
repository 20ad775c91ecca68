// The file study.dffd: the fields of all cases of a study, each readable by itself (docs/formats.md).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/file/field_record.h"

namespace cleft {

class StudyFile {
 public:
  /// Reads what is known of all cases, and no coefficients. Throws FileError where the file is damaged or is
  /// another.
  explicit StudyFile(const std::string& path);
  ~StudyFile();
  StudyFile(StudyFile&&) noexcept;

  int size() const;                            ///< cases
  const std::string& name(int i) const;        ///< of the case's folder
  std::string case_hash(int i) const;          ///< the snapshot's
  RecordedParameters parameters(int i) const;  ///< without switches and choices in older files
  /// Where the case is a sum of modes, node_error, spline_error and frame_error hold what that costs too.
  FitReport report(int i) const;
  std::size_t coefficient_bytes(int i) const;  ///< as coded
  /// Reads and decodes this case alone, and the modes if it is the first made of them; throws FileError where
  /// it is damaged. Not to be called by two threads at once.
  Field field(int i) const;
  int modes() const;  ///< that cases are sums of; 0: each stands by itself
  /// Of a case that is a sum of modes: how far it is off at most from the case's own field, over its largest
  /// displacement, wherever a mesh has nodes; else 0.
  double modes_error(int i) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A case that goes into a study file: the name of its folder, its field file, and its switches and
/// choices.
struct StudyCase {
  std::string name, field_file;
  RecordedParameters choices = {};
};

/// The published cases of a study folder, by name, without those whose fields are of an older format: their
/// names are added to `older`. Throws InputError where there is none, FileError where a manifest or a field
/// is damaged.
std::vector<StudyCase> published_study_cases(const std::string& study,
                                             std::vector<std::string>* older = nullptr);

/// What to do about cases of an older format; a sentence for users.
std::string note_of_older(const std::string& study, std::vector<std::string> older);

/// Fields in the unknowns of one set of control points, that cases are sums of: unknowns in multiples of a
/// quantum, mm, coded by encode_coefficients().
struct CodedModes {
  std::vector<double> quanta;
  std::vector<std::vector<std::uint8_t>> coefficients;
};

/// What a study file holds of a case. Where it is a sum of modes, its record is a header alone.
struct StudyRecord {
  std::string name;
  FieldRecord record;
  RecordedParameters choices = {};
  std::vector<double> weights =
      {};                  ///< of the modes, over its largest displacement; none: it stands by itself
  double modes_error = 0;  ///< see StudyFile
};

/// As they stand in the field files (residuals are left there). Throws FileError where one of them is
/// damaged.
std::vector<StudyRecord> study_records(const std::vector<StudyCase>& cases);

/// Writes the study file whole or not at all.
void write_study(const std::string& path, const std::vector<StudyRecord>& cases,
                 const CodedModes& modes = {});

}  // namespace cleft
