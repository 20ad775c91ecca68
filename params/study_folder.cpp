#include "params/study_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "params/hash.h"

namespace cleft {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

std::string new_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 8; ++i) token += "0123456789abcdef"[random() % 16];
  return token + "-" + std::to_string(getpid());
}

std::vector<std::string> folders_in(const std::string& path) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(path, none))
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Held for the moment in which attempts come, go or are looked at, by all processes of a study.
class Moment {
 public:
  explicit Moment(const std::string& study)
      : file_(open((study + "/.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    while (file_ >= 0 && flock(file_, LOCK_EX) != 0)
      if (errno != EINTR) break;
  }
  ~Moment() {
    if (file_ >= 0) close(file_);
  }
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;

 private:
  int file_;
};

/// Removes what killed and failed runs left, never what another process works in; the folder too when it is
/// empty. In a Moment of the study.
void remove_abandoned(const std::string& attempts) {
  std::error_code ignored;
  for (const std::string& token : folders_in(attempts))
    if (!Lock::is_held(attempts + "/" + token + "/lock")) fs::remove_all(attempts + "/" + token, ignored);
  fs::remove(attempts, ignored);
}

}  // namespace

std::string to_text(CaseState state) {
  switch (state) {
    case CaseState::published:
      return "published";
    case CaseState::running:
      return "running";
    case CaseState::failed:
      return "failed";
    default:
      return "missing";
  }
}

Lock::Lock(const std::string& path) : file_(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) != 0)
    throw std::runtime_error(path + ": could not be locked");
}

Lock::~Lock() {
  if (file_ >= 0) close(file_);
}

bool Lock::is_held(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool held = flock(file, LOCK_SH | LOCK_NB) != 0;
  close(file);
  return held;
}

StudyFolder::StudyFolder(std::string path) : path_(std::move(path)) {
  if (!fs::is_directory(path_))
    throw InputError(path_ + ": no such folder; cleft run STUDY.toml --out " + path_ + " makes one");
  if (!fs::is_regular_file(study_file()))
    throw InputError(path_ + ": is not a study folder (it has no study.toml); cleft run makes one");
}

StudyFolder StudyFolder::create(const std::string& path, const Study& study) {
  if (path.empty()) throw InputError("--out: give a folder");
  if (fs::exists(path) && !fs::is_directory(path))
    throw InputError("--out " + path + ": is a file; give a folder");
  if (fs::is_directory(path) && !fs::is_empty(path) && !fs::exists(path + "/study.toml"))
    throw InputError("--out " + path +
                     ": the folder holds other files; give a new one, or the folder of a study");
  std::error_code error;
  fs::create_directories(path + "/cases", error);
  if (!error) fs::create_directories(path + "/attempts", error);
  if (error) throw InputError("--out " + path + ": could not be created: " + error.message());
  write_text_file(path + "/study.toml", study.text);
  return StudyFolder(path);
}

std::vector<std::string> StudyFolder::published_cases() const { return folders_in(path_ + "/cases"); }

Json StudyFolder::manifest(const std::string& hash) const {
  const std::string file = published(hash) + "/manifest.json";
  try {
    Json listed = Json::parse(read_text_file(file));
    if (!listed.is_object()) throw FileError(file, "is not a manifest");
    return listed;
  } catch (const Json::exception& e) {
    throw FileError(file, std::string("is damaged: ") + e.what());
  }
}

CaseStatus StudyFolder::status(const std::string& hash) const {
  if (fs::exists(published(hash) + "/manifest.json")) return {CaseState::published, ""};
  const Moment moment(path_);
  CaseStatus status;
  const std::string attempts = path_ + "/attempts/" + hash;
  for (const std::string& token : folders_in(attempts)) {
    if (Lock::is_held(attempts + "/" + token + "/lock")) return {CaseState::running, ""};
    const std::string reason = attempts + "/" + token + "/failed.txt";
    if (fs::exists(reason)) status = {CaseState::failed, read_text_file(reason)};
  }
  return status;
}

Attempt StudyFolder::begin(const std::string& hash) const {
  const std::string attempts = path_ + "/attempts/" + hash, token = new_token();
  const Moment moment(path_);
  remove_abandoned(attempts);
  fs::create_directories(attempts + "/" + token);
  return {attempts + "/" + token, token, Lock(attempts + "/" + token + "/lock")};
}

void StudyFolder::fail(const Attempt& attempt, const std::string& reason) const {
  write_text_file(attempt.folder + "/failed.txt", reason);
}

bool StudyFolder::publish(const Attempt& attempt, const std::string& hash, Json manifest,
                          const std::vector<std::string>& files) const {
  for (const std::string& name : files) {
    const std::string file = attempt.folder + "/" + name;
    flush_to_disk(file);
    manifest["files"][name] = {{"bytes", fs::file_size(file)}, {"sha256", sha256_of_file(file)}};
  }
  manifest["token"] = attempt.token;
  write_text_file(attempt.folder + "/manifest.json", manifest.dump(2) + "\n");
  flush_to_disk(attempt.folder);
  std::error_code taken;
  fs::rename(attempt.folder, published(hash), taken);
  if (taken && !fs::exists(published(hash) + "/manifest.json"))
    throw std::runtime_error(published(hash) + ": could not be published: " + taken.message());
  flush_to_disk(path_ + "/cases");
  const Moment moment(path_);
  if (!taken) fs::remove(published(hash) + "/lock");
  if (taken) fs::remove_all(attempt.folder);
  remove_abandoned(path_ + "/attempts/" + hash);
  return !taken;
}

std::map<std::string, std::string> StudyFolder::solved_cases() const {
  std::map<std::string, std::string> solved;
  for (const std::string& hash : published_cases()) try {
      solved[manifest(hash).value("solve", "")] = published(hash);
    } catch (const FileError&) {  // no case of ours: cleft check says so
    }
  return solved;
}

void StudyFolder::verify(const std::string& hash) const {
  const Json listed = manifest(hash);
  if (listed.value("case", "") != hash || !listed.contains("files"))
    throw FileError(published(hash) + "/manifest.json", "is not the manifest of case " + hash);
  for (const auto& [name, entry] : listed["files"].items()) {
    const std::string file = published(hash) + "/" + name;
    if (!fs::exists(file))
      throw FileError(file, "is missing; delete the case's folder and run the study again");
    if (fs::file_size(file) != entry.value("bytes", std::uintmax_t{0}) ||
        sha256_of_file(file) != entry.value("sha256", ""))
      throw FileError(
          file,
          "differs from its manifest (size or SHA-256); delete the case's folder and run the study again");
  }
}

}  // namespace cleft
