// The work for a case: solve, encode, check, publish, each by the command of that name.
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
  bool again = false;  ///< not by its own fault: the next run tries it again
};

/// A case that is being made.
struct CaseOnItsWay {
  std::size_t number;  ///< index among the study's cases
  const Case* one;
  std::string hash;
  Attempt attempt;
  nlohmann::ordered_json manifest = {};
  double seconds = 0, memory = 0;  ///< largest number of bytes that its solver held
  std::optional<Failure> failure = {};

  std::string file(const std::string& name) const { return attempt.folder + "/" + name; }
};

/// Thrown if the run is requested to stop.
struct Interrupted {};

class CaseWork {
 public:
  struct Settings {
    int ranks = 1, threads = 1;  ///< of each process
    std::vector<std::string>
        mpi_launcher;  ///< the command that starts the ranks, with the option for their number
  };
  CaseWork(const StudyFolder& folder, const Study& study, Settings settings, const StopCount& stop);

  /// Solves cases with the same stiffness matrix in one process. Sets `failure` of those that have no
  /// snapshot afterwards.
  void solve(const std::vector<CaseOnItsWay*>& cases) const;
  /// Encodes cases with the same options in one process.
  void encode(const std::vector<CaseOnItsWay*>& cases) const;
  void check(const std::vector<CaseOnItsWay*>& cases) const;
  /// False if another run has published it first.
  bool publish(CaseOnItsWay& one) const;

  /// Reuses an intact published snapshot with the same solver input, if there is one, by a hard link or a
  /// copy.
  bool reuse(CaseOnItsWay& one, const std::string& published) const;

 private:
  ProcessResult child(const std::string& command, const std::vector<std::string>& arguments,
                      const CaseOnItsWay& teller, const std::string& name) const;
  Failure failure_of(const std::string& command, const ProcessResult& result, const std::string& log) const;
  void solve_together(const std::vector<CaseOnItsWay*>& cases) const;
  bool encode_together(const std::vector<CaseOnItsWay*>& cases) const;
  void encode_alone(CaseOnItsWay& one) const;

  const StudyFolder& folder_;
  const Study& study_;
  const Settings settings_;
  const StopCount& stop_;
  const std::string bin_;
};

}  // namespace cleft
