// A small study, what an undisturbed run of it publishes, and whether another run has come to the same.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/process.h"

namespace cleft::faults {

/// What went wrong with a promise; the program ends with it.
struct Broken : std::runtime_error {
  using std::runtime_error::runtime_error;
};
inline void promise(bool kept, const std::string& what) {
  if (!kept) throw Broken(what);
}

class StudyUnderFault {
 public:
  /// Runs the study undisturbed in `place`/reference.
  StudyUnderFault(std::string place, int ranks);

  const std::string& place() const { return place_; }
  std::string reference() const { return place_ + "/reference"; }
  /// The command line of cleft run into a folder.
  std::vector<std::string> command(const std::string& folder) const;
  /// Runs it to its end; its words go to FOLDER.log.
  ProcessResult run(const std::string& folder, const std::vector<std::string>& before = {}) const;
  /// Runs it until it has finished, a few times at most, and compares.
  void finish(const std::string& folder) const;

  /// By the names of published cases, their manifests' tokens: who has won.
  std::map<std::string, std::string> published(const std::string& folder) const;
  /// Breaks off where a file differs from the undisturbed run's, manifests (times, hosts) aside, where cleft
  /// check finds a fault, or an attempt is left.
  void expect_as_undisturbed(const std::string& folder) const;

 private:
  std::string place_;
  int ranks_;
  std::map<std::string, std::string> undisturbed_;  // bytes of all published files by their place
};

}  // namespace cleft::faults
