// The published cases of a study, opened at once and read when they are looked at.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/study_file.h"

namespace cleft {

class PublishedStudy {
 public:
  /// `path` is a study folder (every published case: cases/<case>/manifest.json beside case.dffd), a study
  /// file or a single field file. Reads the parameters of all cases, and no coefficients. Throws InputError
  /// where there is no published case, FileError where a field file is damaged.
  explicit PublishedStudy(const std::string& path);

  int size() const { return static_cast<int>(cases_.size()); }

  /// The parameters in which the cases differ, "skin.prestress_v=0.03 tissue.young_modulus=0.02", in the
  /// order of the cases; the case's folder or file where they do not differ.
  const std::string& name(int i) const { return cases_.at(i).name; }
  const std::map<std::string, double>& parameters(int i) const { return cases_.at(i).parameters; }
  const std::string& file(int i) const { return cases_.at(i).file; }

  /// Read from its file at the first call, then kept. The reference lives as long as the study.
  const Field& field(int i);

 private:
  struct Case {
    std::string file, name;
    std::map<std::string, double> parameters;
    std::optional<Field> field;
    int packed = -1;  // its number in the study file
  };
  void name_and_sort();

  std::vector<Case> cases_;
  std::optional<StudyFile> packed_;
};

}  // namespace cleft
