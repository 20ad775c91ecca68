// The file study.dffd: the fields of all cases of a study, each readable by itself (docs/formats.md).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/file/field_record.h"

namespace cleft {

/// Modes that cases are sums of: unknowns in multiples of a quantum, mm, coded by encode_coefficients().
struct CodedModes {
  std::vector<double> quanta;
  std::vector<std::vector<std::uint8_t>> coefficients;
};

class StudyFile {
 public:
  /// Reads the data of all cases without coefficients. Throws FileError if the file is damaged or has another
  /// format.
  explicit StudyFile(const std::string& path);
  ~StudyFile();
  StudyFile(StudyFile&&) noexcept;

  int size() const;                            ///< cases
  const std::string& name(int i) const;        ///< of the case's folder
  std::string case_hash(int i) const;          ///< the snapshot's
  RecordedParameters parameters(int i) const;  ///< without switches and choices in older files
  /// If the case is not as its own file has it, node_error, spline_error and frame_error include its error.
  FitReport report(int i) const;
  std::size_t coefficient_bytes(int i) const;  ///< as coded
  /// Reads and decodes this case only, and the modes when they are first needed; throws FileError if it is
  /// damaged. Not thread-safe.
  Field field(int i) const;
  /// The case as it is stored: if it is a sum of modes, a header with their weights, and no bytes. Throws
  /// FileError if it is damaged.
  FieldRecord record(int i) const;
  const CodedModes& coded_modes() const;
  int modes() const;  ///< number of modes that cases are sums of; 0: none
  /// For a case that is a sum of modes, or has coarser steps: the largest distance from the case's own field
  /// (of a sum: at nodes), relative to its largest displacement; else 0.
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
/// names are added to `older`; and, where `damaged` is given, without those whose field or manifest is gone
/// or damaged: every field is then read once. Throws InputError if none is left, FileError if a manifest or a
/// field is damaged and `damaged` is not given.
std::vector<StudyCase> published_study_cases(const std::string& study,
                                             std::vector<std::string>* older = nullptr,
                                             std::vector<std::string>* damaged = nullptr);

/// The remedy for cases of an older format, and for damaged ones, for messages.
std::string note_of_older(const std::string& study, std::vector<std::string> older);
std::string note_of_damaged(const std::string& study, std::vector<std::string> damaged);

/// The data of a case in a study file. If it is a sum of modes, its record is a header without bytes.
struct StudyRecord {
  std::string name;
  FieldRecord record;
  RecordedParameters choices = {};
  std::vector<double> weights =
      {};                  ///< of the modes, over its largest displacement; empty: not a sum of modes
  double modes_error = 0;  ///< see StudyFile
};

/// The records of the field files, without residuals. Throws FileError if one of them is damaged.
std::vector<StudyRecord> study_records(const std::vector<StudyCase>& cases);

/// Writes the study file, completely or not at all.
void write_study(const std::string& path, const std::vector<StudyRecord>& cases,
                 const CodedModes& modes = {});

}  // namespace cleft
