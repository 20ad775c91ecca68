#include "explorer/study/study.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/h5/h5.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"

namespace cleft {

namespace fs = std::filesystem;

PublishedStudy::PublishedStudy(const std::string& path) : path_(path) {
  if (!fs::exists(path))
    throw InputError(path + ": no such file or folder (give a study folder, a study.dffd or a case.dffd)");
  if (fs::is_regular_file(path) && format_of(path) == "cleft-study") {
    packed_.emplace(path);
    for (int i = 0; i < packed_->size(); ++i)
      cases_.push_back({packed_->name(i), "", packed_->name(i), packed_->parameters(i), i});
    if (cases_.empty()) throw InputError(path + ": holds no case; run `cleft pack` again");
    name_and_sort();
    return;
  }
  folder_ = fs::is_directory(path);
  const std::string of_study = fs::exists(fs::absolute(path).parent_path() / "manifest.json")
                                   ? fs::absolute(path).parent_path().filename().string()
                                   : "";
  for (const StudyCase& one :
       folder_ ? published_study_cases(path, &older_, &damaged_) : std::vector<StudyCase>{{of_study, path}}) {
    const bool several = pieces_in(one.field_file) > 0;
    Case& added = cases_.emplace_back(
        Case{one.field_file, "", one.name,
             several ? RecordedParameters{} : read_field_parameters(one.field_file), -1, several});
    for (const auto& [name, value] : one.choices.texts()) added.parameters.set(name, value);
  }
  name_and_sort();
}

void PublishedStudy::name_and_sort() {
  for (const auto& [name, value] : cases_.front().parameters.numbers()) {
    const auto differs = [&name = name, value = value](const Case& c) {
      return c.parameters.number(name) != value;
    };
    if (std::any_of(cases_.begin(), cases_.end(), differs)) varying_.push_back(name);
  }
  const auto values = [this](const Case& c) {
    std::vector<double> row;
    for (const std::string& name : varying_) row.push_back(c.parameters.number(name).value_or(-HUGE_VAL));
    return row;
  };
  std::stable_sort(cases_.begin(), cases_.end(),
                   [&](const Case& a, const Case& b) { return values(a) < values(b); });
  for (Case& c : cases_) {
    for (const std::string& name : varying_)
      if (const auto value = c.parameters.number(name))
        c.name += (c.name.empty() ? "" : " ") + name + "=" + shortest(*value);
    const fs::path file(c.file);
    if (c.name.empty())
      c.name = (cases_.size() > 1 && !packed_ ? file.parent_path() : file).filename().string();
  }
}

std::vector<std::string> PublishedStudy::left_out() const {
  std::vector<std::string> sentences;
  if (!older_.empty()) sentences.push_back(path_ + ": " + note_of_older(path_, older_));
  if (!damaged_.empty()) sentences.push_back(path_ + ": " + note_of_damaged(path_, damaged_));
  return sentences;
}

std::string PublishedStudy::snapshot(int i) const {
  const fs::path opened(path_);
  return (packed_ ? opened.parent_path() / "cases" / file(i) : fs::path(file(i)).parent_path()) / "case.h5";
}

FitReport PublishedStudy::report(int i) const {
  const Case& wanted = cases_.at(i);
  if (wanted.several) return read_pieces(wanted.file).front().field.report;
  return packed_ ? packed_->report(wanted.packed) : read_field_report(wanted.file);
}

Field PublishedStudy::read(int i) const {
  const Case& wanted = cases_.at(i);
  if (wanted.several) return std::move(read_pieces(wanted.file).front().field);
  return packed_ ? packed_->field(wanted.packed) : read_field(wanted.file);
}

std::shared_ptr<const Field> PublishedStudy::field(int i) {
  const auto found =
      std::find_if(recent_.begin(), recent_.end(), [i](const auto& r) { return r.first == i; });
  if (found != recent_.end()) {
    recent_.splice(recent_.begin(), recent_, found);
  } else {
    recent_.emplace_front(i, std::make_shared<const Field>(read(i)));
    if (recent_.size() > kept) recent_.pop_back();
  }
  return recent_.front().second;
}

}  // namespace cleft
