#include "params/run/study_index.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "base/error.h"
#include "base/sealed_json.h"
#include "base/unfinished.h"

namespace cleft {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int version = 3;

/// Stamp and size of a case's manifest; whether it has one.
bool look_at_manifest(int cases, const std::string& hash, IndexedCase& entry) {
  struct stat seen;
  if (fstatat(cases, (hash + "/manifest.json").c_str(), &seen, 0) != 0 || !S_ISREG(seen.st_mode))
    return false;
  entry.stamp = std::int64_t{1'000'000'000} * seen.st_mtim.tv_sec + seen.st_mtim.tv_nsec;
  entry.manifest_bytes = static_cast<std::uint64_t>(seen.st_size);
  return true;
}

void read_manifest(const std::string& file, IndexedCase& entry) {
  const Json manifest = read_sealed(file);
  entry.solve = manifest.value("solve", "");
  entry.seconds = manifest.value("seconds", 0.);
  entry.bytes = static_cast<double>(entry.manifest_bytes);
  entry.snapshot = false;
  const Json files = manifest.value("files", Json::object());
  for (const auto& [name, listed] : files.items()) {
    entry.bytes += listed.value("bytes", 0.);
    if (name == "case.h5") entry.snapshot = true;
  }
  const Json size = manifest.value("size", Json::object());
  entry.nodes = size.value("nodes", 0.), entry.columns = size.value("columns", 0.);
  entry.memory = size.value("memory", 0.);
  const Json encoder = manifest.value("encoder", Json::object());
  entry.node_error = encoder.value("node_error", 0.);
  entry.largest_displacement = encoder.value("largest_displacement_mm", 0.);
}

Json row_of(const std::string& hash, const IndexedCase& e) {
  return Json::array({hash, e.stamp, e.manifest_bytes, e.solve, e.seconds, e.bytes, e.nodes, e.columns,
                      e.memory, e.node_error, e.largest_displacement, e.snapshot});
}

IndexedCase entry_of(const Json& row) {
  return {row.at(1), row.at(2), row.at(3), row.at(4),  row.at(5), row.at(6),
          row.at(7), row.at(8), row.at(9), row.at(10), row.at(11)};
}

std::map<std::string, IndexedCase> written_index(const std::string& file) {
  std::map<std::string, IndexedCase> index;
  if (!fs::exists(file)) return index;
  try {
    const Json read = read_sealed(file);
    if (read.at("format") != "cleft-index" || read.at("version") != version) return {};
    for (const Json& row : read.at("cases")) index[row.at(0)] = entry_of(row);
  } catch (const std::exception&) {  // damaged, or of another version: it is made again
    return {};
  }
  return index;
}

void write_index(const std::string& file, const std::map<std::string, IndexedCase>& index) {
  Json cases = Json::array();
  for (const auto& [hash, entry] : index) cases.push_back(row_of(hash, entry));
  const std::string part = file + "." + std::to_string(getpid()) + ".part";
  const Unfinished unfinished(part);
  std::ofstream out(part, std::ios::binary);
  out << sealed_text({{"format", "cleft-index"}, {"version", version}, {"cases", cases}});
  out.close();
  std::error_code ignored;  // a study may be read where it cannot be written
  if (out) fs::rename(part, file, ignored);
  if (!out || ignored) fs::remove(part, ignored);
}

}  // namespace

std::map<std::string, IndexedCase> study_index(const std::string& study) {
  const std::string cases = study + "/cases", file = study + "/index.json";
  std::map<std::string, IndexedCase> index;
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir(cases.c_str()), closedir);
  if (!folder) return index;
  const std::map<std::string, IndexedCase> written = written_index(file);
  bool changed = false;
  while (const dirent* one = readdir(folder.get())) {
    const std::string hash = one->d_name;
    IndexedCase entry;
    if (hash.front() == '.' || !look_at_manifest(dirfd(folder.get()), hash, entry)) continue;
    const auto known = written.find(hash);
    if (known != written.end() && known->second.stamp == entry.stamp &&
        known->second.manifest_bytes == entry.manifest_bytes) {
      index.insert(*known);
      continue;
    }
    try {
      read_manifest(cases + "/" + hash + "/manifest.json", entry);
      index[hash] = entry;
      changed = true;
    } catch (const std::exception&) {  // cleft check reports it
    }
  }
  if (changed || index.size() != written.size()) write_index(file, index);
  return index;
}

}  // namespace cleft
