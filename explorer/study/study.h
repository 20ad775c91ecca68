// The published cases of a study; the coefficients of a case are read when it is shown.
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/file/study_file.h"

namespace cleft {

class PublishedStudy {
 public:
  /// `path` is a study folder (every published case: cases/<case>/manifest.json and case.dffd), a study file
  /// or a single field file. Reads the parameters of all cases, and no coefficients. Throws InputError if
  /// there is no published case, FileError if a field file is damaged.
  explicit PublishedStudy(const std::string& path);

  int size() const { return static_cast<int>(cases_.size()); }

  /// The parameters in which the cases differ, "skin.prestress_v=0.03 tissue.young_modulus=0.02", in the
  /// order of the cases; the case's folder or file if they do not differ.
  const std::string& name(int i) const { return cases_.at(i).name; }
  /// Names of the parameters in which the cases differ.
  const std::vector<std::string>& varying() const { return varying_; }
  /// With switches and choices, if the study records them.
  const RecordedParameters& parameters(int i) const { return cases_.at(i).parameters; }
  /// The identity of a published case, by which `cleft status` and the folder cases/ name it; empty for a
  /// field file that belongs to no study.
  const std::string& hash(int i) const { return cases_.at(i).hash; }
  /// To follow the number of a case in a text: a space and its hash in brackets; nothing where it has none.
  std::string hash_behind(int i) const { return hash(i).empty() ? "" : " (" + hash(i) + ")"; }
  /// The report of its fit, without its coefficients.
  FitReport report(int i) const;
  const std::string& file(int i) const { return cases_.at(i).file; }
  /// The path of its simulation, if that was kept.
  std::string snapshot(int i) const;
  /// Whether it is of a body with several breaks; its field is then that of the first.
  bool has_several_breaks(int i) const { return cases_.at(i).several; }
  /// Cases that were left out because their fields have an older format.
  const std::vector<std::string>& older() const { return older_; }
  /// Cases that were left out because a file of theirs is gone or damaged.
  const std::vector<std::string>& damaged() const { return damaged_; }
  /// What was left out, and the remedy, a sentence each.
  std::vector<std::string> left_out() const;
  bool is_folder() const { return folder_; }

  /// The field of a case, read from its file when requested; the last ones are kept.
  std::shared_ptr<const Field> field(int i);
  static constexpr std::size_t kept = 16;  ///< cases, some MB each once decoded

  /// The same without keeping it, for loops over all cases.
  Field read(int i) const;
  /// Of a study.dffd whose cases are sums of modes: the file, and the number of a case in it. Else null.
  const StudyFile* sums() const { return packed_ && packed_->modes() > 0 ? &*packed_ : nullptr; }
  int number_in_file(int i) const { return cases_.at(i).packed; }

  const std::string& path() const { return path_; }  ///< as given

 private:
  struct Case {
    std::string file, name, hash;
    RecordedParameters parameters;
    int packed = -1;  // its number in the study file
    bool several = false;
  };
  void name_and_sort();

  std::string path_;
  std::vector<Case> cases_;
  std::vector<std::string> varying_, older_, damaged_;
  bool folder_ = false;
  std::list<std::pair<int, std::shared_ptr<const Field>>> recent_;  // the last one first
  std::optional<StudyFile> packed_;
};

}  // namespace cleft
