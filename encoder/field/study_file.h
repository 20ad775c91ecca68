// The file study.dffd: the fields of all cases of a study, each readable by itself (docs/formats.md).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

class StudyFile {
 public:
  /// Reads what is known of all cases, and no coefficients. Throws FileError where the file is damaged or is
  /// another.
  explicit StudyFile(const std::string& path);
  ~StudyFile();
  StudyFile(StudyFile&&) noexcept;

  int size() const;                                       ///< cases
  const std::string& name(int i) const;                   ///< of the case's folder
  std::string case_hash(int i) const;                     ///< the snapshot's
  std::map<std::string, double> parameters(int i) const;  ///< numeric ones, by dotted name
  FitReport report(int i) const;                          ///<
  std::size_t coefficient_bytes(int i) const;             ///< as coded
  /// Reads and decodes this case alone; throws FileError where it is damaged.
  Field field(int i) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

/// A case that goes into a study file: its field file, and the name of its folder.
struct StudyCase {
  std::string name, field_file;
};

/// The published cases of a study folder, by name. Throws InputError where it has none.
std::vector<StudyCase> published_fields(const std::string& study);

/// Writes the study file whole or not at all, coefficients as they stand in the field files (residuals are
/// left there). Throws FileError where one of them is damaged.
void write_study(const std::string& path, const std::vector<StudyCase>& cases);

}  // namespace cleft
