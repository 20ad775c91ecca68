// What is done for a case: solve, encode, check, publish, each by the command of that name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/process.h"
#include "params/run/study_folder.h"

namespace cleft {

/// Why a case was not published.
struct Failure {
  std::string reason;
  bool again = false;  ///< by no fault of its own: another run may try it without being asked to
};

/// A case on its way.
struct CaseOnItsWay {
  std::size_t number;  ///< among the study's cases
  const Case* one;
  std::string hash;
  Attempt attempt;
  nlohmann::ordered_json manifest = {};
  double seconds = 0, memory = 0;  ///< bytes that its solver held at most
  std::optional<Failure> failure = {};

  std::string file(const std::string& name) const { return attempt.folder + "/" + name; }
};

/// Thrown where the run is asked to stop.
struct Interrupted {};

class CaseWork {
 public:
  struct Settings {
    int ranks = 1, threads = 1;             ///< of each process
    std::vector<std::string> mpi_launcher;  ///< what starts the ranks, its options for their number included
  };
  CaseWork(const StudyFolder& folder, const Study& study, Settings settings, const StopCount& stop);

  /// To snapshots, all in one process where they are several: they share a stiffness. Sets `failure` of those
  /// that have none at the end.
  void solve(const std::vector<CaseOnItsWay*>& cases) const;
  void encode(CaseOnItsWay& one) const;
  void check(const std::vector<CaseOnItsWay*>& cases) const;
  /// False where another run has published it first.
  bool publish(CaseOnItsWay& one) const;

  /// Takes a published snapshot of what the solver would see again, where there is a sound one, as the same
  /// file, or as a copy where links are not possible.
  bool reuse(CaseOnItsWay& one, const std::string& published) const;

 private:
  ProcessResult child(const std::string& command, const std::vector<std::string>& arguments,
                      const CaseOnItsWay& teller, const std::string& name) const;
  Failure failure_of(const std::string& command, const ProcessResult& result, const std::string& log) const;
  void solve_together(const std::vector<CaseOnItsWay*>& cases) const;

  const StudyFolder& folder_;
  const Study& study_;
  const Settings settings_;
  const StopCount& stop_;
  const std::string bin_;
};

}  // namespace cleft
