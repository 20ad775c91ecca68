#include "params/run/study_folder.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "base/error.h"
#include "base/output_file.h"
#include "base/sealed_json.h"
#include "base/text.h"
#include "params/hash.h"
#include "params/run/leftovers.h"

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

std::string shared_memory_of(const std::string& token) { return "/dev/shm/cleft-" + token; }

constexpr const char *failed_file = "/failed.txt", *again_file = "/again.txt", *field_file = "/case.dffd";

/// Removes what killed and failed runs left, never what another process works in; the folder too when it is
/// empty. In a Moment of the study.
void clear(const std::string& attempts) {
  std::error_code ignored;
  for (const std::string& token : folders_in(attempts)) {
    if (Lock::is_held(attempts + "/" + token + "/lock")) continue;
    fs::remove_all(shared_memory_of(token), ignored);  // first: the attempt's name is what leads to it
    fs::remove_all(attempts + "/" + token, ignored);
  }
  fs::remove(attempts, ignored);
}

/// Anything but what create() makes, which a run that failed at once may have left.
bool holds_others_files(const std::string& path) {
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    const std::string name = entry.path().filename().string();
    const bool ours = name == "cases" || name == "attempts" || name == ".lock" ||
                      name.rfind(".probe.", 0) == 0 || name.rfind(".study.", 0) == 0;
    if (!ours) return true;
  }
  return false;
}

Attempt new_attempt(const std::string& attempts) {
  const std::string token = new_token(), folder = attempts + "/" + token;
  clear(attempts);
  const fs::path all = fs::path(attempts).parent_path();
  make_shared_folder(all.parent_path(), all.filename());  // empty, a copy of the study may lack it
  make_shared_folder(all, fs::path(attempts).filename());
  make_shared_folder(attempts, token);
  return {folder, token, Lock(folder + "/lock")};
}

/// The state of a case by its attempts; needs a Moment of the study.
CaseStatus status_of_attempts(const std::string& attempts) {
  CaseStatus status;
  for (const std::string& token : folders_in(attempts)) {
    const std::string attempt = attempts + "/" + token;
    if (Lock::is_held(attempt + "/lock")) return {CaseState::running, "", false};
    for (const char* name : {failed_file, again_file})
      if (fs::exists(attempt + name))
        status = {CaseState::failed, read_text_file(attempt + name), name == again_file};
  }
  return status;
}

}  // namespace

std::string Attempt::shared_memory() const {
  return access("/dev/shm", W_OK | X_OK) == 0 ? shared_memory_of(token) : "";
}

std::string to_text(CaseState state) {
  switch (state) {
    case CaseState::published:
      return "published";
    case CaseState::running:
      return "running";
    case CaseState::failed:
      return "failed";
    case CaseState::damaged:
      return "damaged";
    default:
      return "missing";
  }
}

namespace {

/// Another body makes other cases; those of the former remain.
void keep_body(const std::string& path, const Case& base) {
  const std::string kept = path + "/" + kept_body;
  if (base.body.empty() || (fs::exists(kept) && sha256_of_file(kept) == base.body_digest)) return;
  write_text_file(kept, read_text_file(base.body));
}

}  // namespace

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
  if (fs::is_directory(path) && !fs::exists(path + "/study.toml") && holds_others_files(path))
    throw InputError("--out " + path +
                     ": the folder holds other files; give a new one, or the folder of a study");
  try {
    fs::create_directories(path);
    for (const char* name : {"cases", "attempts"}) make_shared_folder(path, name);
  } catch (const fs::filesystem_error& e) {
    throw InputError("--out " + path + ": could not be created: " + e.code().message());
  }
  sweep_leftovers(path);
  check_file_system(path);
  keep_body(path, study.base);
  const std::string file = path + "/study.toml";
  if (!fs::exists(file) || read_text_file(file) != study.text) write_text_file(file, study.text);
  return StudyFolder(path);
}

std::vector<std::string> StudyFolder::published_cases() const { return folders_in(path_ + "/cases"); }

Json StudyFolder::manifest(const std::string& hash) const {
  return read_sealed(published(hash) + "/manifest.json");
}

bool StudyFolder::is_published(const std::string& hash) const {
  return fs::exists(published(hash) + "/manifest.json");
}

CaseStatus StudyFolder::status(const std::string& hash) const {
  if (is_published(hash)) return {CaseState::published, "", false};
  const Moment moment = Moment::to_look(path_);
  return status_of_attempts(path_ + "/attempts/" + hash);
}

std::vector<CaseStatus> StudyFolder::status(const std::vector<Case>& cases,
                                            const std::map<std::string, IndexedCase>& published) const {
  std::map<std::string, CaseStatus> attempted;
  {
    const Moment moment = Moment::to_look(path_);
    for (const std::string& hash : folders_in(path_ + "/attempts"))
      attempted[hash] = status_of_attempts(path_ + "/attempts/" + hash);
  }
  std::vector<CaseStatus> list;
  for (const Case& one : cases) {
    const std::string hash = one.hash();
    if (published.contains(hash) || is_published(hash))
      list.push_back({CaseState::published, "", false});
    else if (const auto found = attempted.find(hash); found != attempted.end())
      list.push_back(found->second);
    else
      list.push_back({});
  }
  return list;
}

std::optional<Attempt> StudyFolder::begin(const std::string& hash, Retry retry, CaseStatus& status) const {
  const std::string attempts = path_ + "/attempts/" + hash;
  const Moment moment(path_);
  status = is_published(hash) ? CaseStatus{CaseState::published, "", false} : status_of_attempts(attempts);
  const bool failed = status.state == CaseState::failed && !status.again && retry == Retry::never;
  if (status.state == CaseState::published || status.state == CaseState::running || failed) return {};
  return new_attempt(attempts);
}

Attempt StudyFolder::begin(const std::string& hash) const {
  const Moment moment(path_);
  return new_attempt(path_ + "/attempts/" + hash);
}

void StudyFolder::fail(const Attempt& attempt, const std::string& reason, bool again) const {
  write_text_file(attempt.folder + (again ? again_file : failed_file), reason);
}

void StudyFolder::abandon(const Attempt& attempt) const {
  const Moment moment(path_);
  std::error_code ignored;
  fs::remove_all(attempt.folder, ignored);
  fs::remove(fs::path(attempt.folder).parent_path(), ignored);
}

void StudyFolder::remove_abandoned() const {
  const Moment moment(path_);
  for (const std::string& hash : folders_in(path_ + "/attempts")) {
    const std::string attempts = path_ + "/attempts/" + hash;
    if (is_published(hash) || status_of_attempts(attempts).state == CaseState::missing) clear(attempts);
  }
}

bool StudyFolder::publish(const Attempt& attempt, const std::string& hash, Json manifest,
                          const std::vector<std::string>& files) const {
  for (const std::string& name : files) {
    const std::string file = attempt.folder + "/" + name;
    flush_to_disk(file);
    manifest["files"][name] = {{"bytes", fs::file_size(file)}, {"sha256", sha256_of_file(file)}};
  }
  manifest["token"] = attempt.token;
  write_text_file(attempt.folder + "/manifest.json", sealed_text(std::move(manifest)));
  for (const auto& entry : fs::directory_iterator(attempt.folder)) {
    const std::string name = entry.path().filename().string();
    const bool keep = name == "manifest.json" || name == "lock" ||
                      std::find(files.begin(), files.end(), name) != files.end();
    if (!keep) fs::remove_all(entry.path());
  }
  flush_to_disk(attempt.folder);
  const Moment moment(path_);  // within it, no operation relies on rename failing for an existing folder
  std::error_code taken;
  bool won = !is_published(hash);
  if (won) {
    fs::rename(attempt.folder, published(hash), taken);
    if (taken && !is_published(hash))
      throw std::runtime_error(published(hash) + ": could not be published: " + taken.message());
    won = !taken;
  }
  flush_to_disk(path_ + "/cases");
  if (won) fs::remove(published(hash) + "/lock");
  if (!won) fs::remove_all(attempt.folder);
  clear(path_ + "/attempts/" + hash);
  return won;
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

std::optional<std::string> StudyFolder::damage(const std::string& hash, bool at_a_glance) const {
  const std::string folder = published(hash);
  if (!fs::exists(folder + "/manifest.json")) return "manifest.json is missing";
  if (at_a_glance)
    return fs::exists(folder + field_file) ? std::nullopt : std::optional("case.dffd is missing");
  Json listed;
  try {
    listed = manifest(hash);
  } catch (const FileError&) {
    return "manifest.json is damaged";
  }
  const Json entry = listed.value("files", Json::object()).value(field_file + 1, Json());
  if (entry.is_null()) return {};
  std::error_code none;
  const auto bytes = fs::file_size(folder + field_file, none);
  if (none) return "case.dffd is missing";
  if (bytes != entry.value("bytes", std::uintmax_t{0}) ||
      sha256_of_file(folder + field_file) != entry.value("sha256", ""))
    return "case.dffd differs from its manifest (size or SHA-256)";
  return {};
}

std::vector<StudyFolder::SetAside> StudyFolder::set_damaged_aside() const {
  std::vector<SetAside> list;
  for (const std::string& hash : published_cases()) {
    if (!damage(hash)) continue;
    const Moment moment(path_);
    const auto why = damage(hash);  // another run may have been quicker
    if (!why || !fs::exists(published(hash))) continue;
    const std::string folder = path_ + "/damaged/" + hash + "." + new_token();
    make_shared_folder(path_, "damaged");
    fs::rename(published(hash), folder);
    list.push_back({hash, *why, folder});
  }
  return list;
}

}  // namespace cleft
