// A study on disk: attempts/<case>/<token>/ while a case runs, cases/<case>/ once it is published.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "params/run/lock.h"
#include "params/run/study_index.h"
#include "params/study.h"

namespace cleft {

enum class CaseState { published, running, failed, missing, damaged };
std::string to_text(CaseState state);

struct CaseStatus {
  CaseState state = CaseState::missing;
  std::string reason;  ///< of a failure
  bool again = false;  ///< it did not fail by its own fault (a killed process, a full disk): it is run again
};

/// An attempt to make a case: a folder that becomes the published one or remains with its logs.
struct Attempt {
  std::string folder, token;
  Lock lock;

  /// A folder in this machine's memory for what the case's processes share; to be made by the one that needs
  /// it, and removed with the attempt at the latest. None where the machine has no such place.
  std::string shared_memory() const;
};

class StudyFolder {
 public:
  /// Throws InputError where `path` is no folder of a study; create() makes one and keeps the study file as
  /// run.
  explicit StudyFolder(std::string path);
  static StudyFolder create(const std::string& path, const Study& study);

  const std::string& path() const { return path_; }
  std::string study_file() const { return path_ + "/study.toml"; }
  std::string published(const std::string& hash) const { return path_ + "/cases/" + hash; }

  /// Hashes of all published cases, those of earlier versions of the study included.
  std::vector<std::string> published_cases() const;
  /// What is known of them at a glance, by hash.
  std::map<std::string, IndexedCase> index() const { return study_index(path_); }
  nlohmann::ordered_json manifest(const std::string& hash) const;
  bool is_published(const std::string& hash) const;
  CaseStatus status(const std::string& hash) const;
  /// The states of many cases, at the cost of one look at the folder. `index`: as of just now.
  std::vector<CaseStatus> status(const std::vector<Case>& cases,
                                 const std::map<std::string, IndexedCase>& index) const;

  /// An attempt of a case that is neither published nor run by another process; none where it is, or where
  /// it failed and is not to be tried again. What killed and failed attempts left is removed.
  enum class Retry { never, failed };
  std::optional<Attempt> begin(const std::string& hash, Retry retry, CaseStatus& status) const;
  Attempt begin(const std::string& hash) const;
  /// Leaves the attempt's folder with its logs, and the reason of the failure. `again`: the next run may try
  /// it without being asked to.
  void fail(const Attempt& attempt, const std::string& reason, bool again = false) const;
  /// Removes an attempt that is given up.
  void abandon(const Attempt& attempt) const;
  /// Removes what killed runs left, of any case.
  void remove_abandoned() const;

  /// Writes the manifest (with sizes and SHA-256 of `files`), flushes all, and renames the attempt to its
  /// published name: exactly one writer can win. False where another one had won before; the attempt is then
  /// removed. Files of the attempt that are not listed are removed.
  bool publish(const Attempt& attempt, const std::string& hash, nlohmann::ordered_json manifest,
               const std::vector<std::string>& files) const;

  /// Recomputes sizes and checksums of a published case; throws FileError at the first that differs.
  void verify(const std::string& hash) const;

  /// Whether the manifest or the field of a published case is gone or damaged: why, else nothing. With
  /// `at_a_glance` nothing is read. (Raw data may be deleted by hand; verify() looks at them too.)
  std::optional<std::string> damage(const std::string& hash, bool at_a_glance = false) const;
  /// Moves every such case to DIR/damaged/, so that a run makes it again.
  struct SetAside {
    std::string hash, why, folder;
  };
  std::vector<SetAside> set_damaged_aside() const;

 private:
  std::string path_;
};

}  // namespace cleft
