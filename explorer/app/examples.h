// The examples that come with an installation: a study, a head to cut, a family.
#pragma once

#include <QString>
#include <string>
#include <vector>

namespace cleft {

struct Example {
  QString name;                    ///< of its button
  QString title, help;             ///< what it is called, and what one sees
  std::vector<std::string> lines;  ///< that open it; none: it is computed first
  QString command;                 ///< for a terminal, which computes it; empty where nothing has to be
};

/// Where the files of examples are beside the program that runs: in a build, and where it is installed.
std::string examples_folder();
/// Where the results of examples that are computed first are looked for, in the user's data.
std::string computed_examples_folder();

/// Those whose files are in `folder`; results are looked for in `computed`.
std::vector<Example> examples_in(const std::string& folder, const std::string& computed);

}  // namespace cleft
