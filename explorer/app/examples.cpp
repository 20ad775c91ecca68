#include "explorer/app/examples.h"

#include <QCoreApplication>
#include <QStandardPaths>
#include <filesystem>

#include "base/process.h"
#include "explorer/session/command_table.h"

namespace cleft {

namespace {

struct Texts {
  Q_DECLARE_TR_FUNCTIONS(Examples)
};

/// As a shell takes it.
std::string shell_word(const std::string& path) {
  return path.find_first_of(" \t'\"$&;()#*?<>|\\`!") == std::string::npos ? path : quoted(path);
}

}  // namespace

std::string examples_folder() {
  return (std::filesystem::path(executable_folder()) / "../share/cleft/examples").lexically_normal().string();
}

std::string computed_examples_folder() {
  const QString data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
  return (std::filesystem::path(data.toStdString()) / "cleft/examples").string();
}

std::vector<Example> examples_in(const std::string& folder, const std::string& computed) {
  namespace fs = std::filesystem;
  const auto there = [](const std::string& path) {
    std::error_code none;
    return fs::is_regular_file(path, none);
  };
  const std::string study = folder + "/demo.dffd", head = folder + "/head.stl", path = folder + "/path.csv",
                    family = folder + "/demo_family.toml", result = computed + "/family/study.dffd";
  const std::vector<std::string> cut{"mesh " + quoted(head), "cut-file " + quoted(path)};
  std::vector<Example> all;
  if (there(study))
    all.push_back(
        {"example_study",
         Texts::tr("A study"),
         Texts::tr("Four cases of soft and firm tissue under a light and a strong tension of the skin."),
         {"open " + quoted(study)},
         ""});
  if (there(study) && there(head) && there(path))
    all.push_back(
        {"example_head",
         Texts::tr("A head"),
         Texts::tr("A curved cut on a cheek, which the study opens. Press C and drag to cut further."),
         {"open " + quoted(study), cut[0], cut[1]},
         ""});
  if (there(family) && there(head) && there(path)) {
    Example example{
        "example_family",
        Texts::tr("A family"),
        Texts::tr("The same cut, which opens at each place by the bend, tilt and depth of the blade and "
                  "by the curvature of the skin."),
        {},
        ""};
    if (there(result))
      example.lines = {"open " + quoted(result), cut[0], cut[1]};
    else
      example.command = QString::fromStdString("cleft run " + shell_word(family) + " --out " +
                                               shell_word(computed + "/family"));
    all.push_back(example);
  }
  return all;
}

}  // namespace cleft
