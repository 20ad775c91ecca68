#include "explorer/io/mesh_checks.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

void check_stl(const std::string& path) {
  const std::string bytes = read_text_file(path);
  // VTK takes it for binary where a twentieth of its first 256 bytes is no text.
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 256));
  const auto odd = std::count_if(
      bytes.begin(), end, [](char c) { return (c < 32 || c > 126) && c != '\n' && c != '\r' && c != '\t'; });
  const bool text = 20 * odd < end - bytes.begin();
  if (text && bytes.starts_with("solid") && bytes.find("facet") != std::string::npos) return;
  std::uint32_t count = 0;
  if (bytes.size() >= 84) std::memcpy(&count, bytes.data() + 80, 4);
  const std::size_t promised = 84 + 50 * static_cast<std::size_t>(count);
  if (bytes.size() < promised)
    throw FileError(path, "is no whole .stl file: " + std::to_string(bytes.size()) +
                              " bytes, where its header promises " + std::to_string(promised));
}

void check_obj(const std::string& path) {
  std::ifstream file(path);
  long count[3] = {0, 0, 0};  // of v, vt, vn so far; a face may name later ones, so it is checked afterwards
  struct Face {
    long line;
    std::string text;
  };
  std::vector<Face> faces;
  std::string line;
  for (long number = 1; std::getline(file, line); ++number) {
    while (!line.empty() && line.back() == '\\' && !file.eof()) {  // continues in the next line
      std::string more;
      std::getline(file, more);
      line.pop_back();
      line += more;
    }
    std::istringstream in(line);
    std::string word;
    in >> word;
    const char* const kinds[3] = {"v", "vt", "vn"};
    for (int k = 0; k < 3; ++k) count[k] += word == kinds[k];
    if (word == "f" || word == "l" || word == "p") faces.push_back({number, line});
  }
  const char* const what[3] = {"point", "texture coordinate", "normal"};
  for (const Face& face : faces) {
    std::istringstream in(face.text);
    std::string corner;
    for (in >> corner; in >> corner;) {
      const char* at = corner.c_str();
      for (int k = 0; k < 3; ++k) {
        char* end = nullptr;
        const long number = std::strtol(at, &end, 10);
        const bool left_out = end == at;
        if (left_out && k == 0) break;  // a comment, perhaps: VTK's own business
        if (!left_out && (number == 0 || std::abs(number) > count[k]))
          throw FileError(path, "line " + std::to_string(face.line) + " names " + what[k] + " " +
                                    std::to_string(number) + " in '" + corner + "'; the file has " +
                                    std::to_string(count[k]));
        if (*end != '/') break;
        at = end + 1;
      }
    }
  }
}

}  // namespace cleft
