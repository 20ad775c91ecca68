#include "explorer/study/wall_file.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/output_file.h"
#include "params/hash.h"

namespace cleft {

namespace {

std::string first_line(const std::string& look) { return "cleft-wall 1 " + look; }

}  // namespace

std::string wall_file_of(const PublishedStudy& study) {
  return study.is_folder() ? (std::filesystem::path(study.path()) / "study.wall").string()
                           : study.path() + ".wall";
}

WallPictures read_wall_file(const std::string& path, const std::string& look) {
  constexpr std::size_t most = 1 << 20;  // bytes of a small picture: what is larger is damage
  WallPictures pictures;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line) || line != first_line(look)) return pictures;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string hash, checksum;
    std::size_t size = 0;
    if (!(words >> hash >> size >> checksum) || size > most) break;
    std::string bytes(size, '\0');
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size)) || file.get() != '\n') break;
    if (sha256(bytes) != checksum) break;
    pictures[hash] = std::move(bytes);
  }
  return pictures;
}

void write_wall_file(const std::string& path, const std::string& look, const WallPictures& pictures) {
  std::string text = first_line(look) + "\n";
  for (const auto& [hash, bytes] : pictures)
    text += hash + " " + std::to_string(bytes.size()) + " " + sha256(bytes) + "\n" + bytes + "\n";
  write_text_file(path, text);
}

}  // namespace cleft
