// A study on disk: attempts/<case>/<token>/ while a case runs, cases/<case>/ once it is published.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "params/study.h"

namespace cleft {

enum class CaseState { published, running, failed, missing };
std::string to_text(CaseState state);

struct CaseStatus {
  CaseState state = CaseState::missing;
  std::string reason;  ///< of a failure
};

/// A file that is locked while its owner lives, so that a killed run is told from a running one.
class Lock {
 public:
  explicit Lock(const std::string& path);
  ~Lock();
  Lock(Lock&& other) noexcept : file_(other.file_) { other.file_ = -1; }
  Lock& operator=(Lock&&) = delete;
  static bool is_held(const std::string& path);

 private:
  int file_;
};

/// A case on its way: a folder of its own, that becomes the published one or stays behind with its logs.
struct Attempt {
  std::string folder, token;
  Lock lock;
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
  nlohmann::ordered_json manifest(const std::string& hash) const;
  CaseStatus status(const std::string& hash) const;

  Attempt begin(const std::string& hash) const;
  /// Leaves the attempt's folder with its logs, and the reason of the failure.
  void fail(const Attempt& attempt, const std::string& reason) const;
  /// Writes the manifest (with sizes and SHA-256 of `files`), flushes all, and renames the attempt to its
  /// published name: exactly one writer can win. False where another one had won before; the attempt is then
  /// removed.
  bool publish(const Attempt& attempt, const std::string& hash, nlohmann::ordered_json manifest,
               const std::vector<std::string>& files) const;

  /// Folders of published cases by the identity of what their solver saw: their snapshots serve again.
  std::map<std::string, std::string> solved_cases() const;

  /// Recomputes sizes and checksums of a published case; throws FileError at the first that differs.
  void verify(const std::string& hash) const;

 private:
  std::string path_;
};

}  // namespace cleft
