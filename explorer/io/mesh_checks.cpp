#include "explorer/io/mesh_checks.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

bool is_ply_type(const std::string& word) {
  static const char* known[] = {"char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
                                "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
  return std::find(std::begin(known), std::end(known), word) != std::end(known);
}

/// Whether a line of a .ply's header is one that VTK's reader survives; counts the elements it announces.
bool is_ply_line(const std::string& line, std::size_t& elements) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  if (words.empty()) return false;
  if (words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "format") return elements == 0 && words.size() == 3;
  if (words[0] == "element" && words.size() == 3) {
    std::size_t count = 0;
    const bool number = static_cast<bool>(std::istringstream(words[2]) >> count);
    elements += count;
    return number && count < std::size_t{1} << 31;
  }
  if (words[0] != "property" || elements == 0) return false;
  if (words.size() == 3) return is_ply_type(words[1]);
  return words.size() == 5 && words[1] == "list" && is_ply_type(words[2]) && is_ply_type(words[3]);
}

/// The rows of a text .ply's body as its header announces them, each a line of words enough.
void check_ply_rows(const std::string& path, const std::string& header, const std::string& body) {
  std::istringstream announced(header), rows(body);
  struct Element {
    std::size_t count;
    std::vector<bool> lists;
  };
  std::vector<Element> elements;
  for (std::string line; std::getline(announced, line);) {
    std::istringstream in(line);
    std::string word, second;
    in >> word >> second;
    if (word == "element") in >> elements.emplace_back().count;
    if (word == "property") elements.back().lists.push_back(second == "list");
  }
  std::string line;
  std::getline(rows, line);  // what follows end_header
  for (const Element& element : elements)
    for (std::size_t row = 0; row < element.count; ++row) {
      std::getline(rows, line);
      std::istringstream in(line);
      double number = 0;
      for (const bool list : element.lists) {
        in >> number;
        if (list && in && !(number >= 0 && number < 1e6)) in.setstate(std::ios::failbit);
        for (double left = list ? number : 0, x = 0; in && left > 0; --left) in >> x;
      }
      if (!in || !rows)
        throw FileError(path, "has a row that is none of its elements: '" + line.substr(0, 60) + "'");
    }
}

}  // namespace

void check_ply(const std::string& path) {
  const std::string text = read_text_file(path);
  const auto end = text.find("end_header");
  if (!text.starts_with("ply") || end == std::string::npos)
    throw FileError(path, "has no header of a .ply file");
  std::istringstream header(text.substr(0, end));
  std::size_t elements = 0;
  std::string line;
  std::getline(header, line);
  for (int number = 2; std::getline(header, line); ++number)
    if (!is_ply_line(line, elements))
      throw FileError(path, "line " + std::to_string(number) + " is none of a .ply file's header: '" +
                                line.substr(0, 60) + "'");
  // The names that VTK's reader knows, in the elements that it expects them in; it crashes without.
  const auto face = std::min(text.find("element face "), end);
  const auto has = [&](const std::string& property, std::size_t from, std::size_t to) {
    const auto at = text.find(property, from);
    return at < to && std::isspace(static_cast<unsigned char>(text[at + property.size()]));
  };
  const bool points = has(" x", 0, face) && has(" y", 0, face) && has(" z", 0, face);
  const bool corners = has(" vertex_indices", face, end) || has(" vertex_index", face, end);
  if (!points || !corners || text.find("element vertex ") > face)
    throw FileError(path, "needs elements 'vertex' with x, y, z and then 'face' with a list vertex_indices");
  // Every element takes a line of text, or a byte at least and usually many more.
  const bool ascii = text.find("format ascii") < end;
  const std::size_t there = ascii ? static_cast<std::size_t>(std::count(
                                        text.begin() + static_cast<std::ptrdiff_t>(end), text.end(), '\n'))
                                  : text.size() - end;
  if (elements == 0 || there < elements)
    throw FileError(path, "ends before the elements its header promises");
  if (ascii) check_ply_rows(path, text.substr(0, end), text.substr(end));
}

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
