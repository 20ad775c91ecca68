#include "explorer/io/ply_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

struct Type {
  const char* names[2];
  std::size_t bytes;
  enum { integer, natural, real } kind;
};
constexpr Type types[] = {{{"char", "int8"}, 1, Type::integer},   {{"uchar", "uint8"}, 1, Type::natural},
                          {{"short", "int16"}, 2, Type::integer}, {{"ushort", "uint16"}, 2, Type::natural},
                          {{"int", "int32"}, 4, Type::integer},   {{"uint", "uint32"}, 4, Type::natural},
                          {{"float", "float32"}, 4, Type::real},  {{"double", "float64"}, 8, Type::real}};

const Type* type_of(const std::string& name) {
  for (const Type& type : types)
    if (name == type.names[0] || name == type.names[1]) return &type;
  return nullptr;
}

struct Property {
  std::string name;
  const Type* type;
  const Type* length = nullptr;  // of a list
};

struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties;

  std::size_t least_bytes() const {
    std::size_t bytes = 0;
    for (const Property& p : properties) bytes += p.length ? p.length->bytes : p.type->bytes;
    return bytes;
  }
};

struct Header {
  enum Form { text, little, big } form = text;
  std::vector<Element> elements;
  std::size_t bytes = 0;  // of the file, until the body begins
};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

class HeaderReader {
 public:
  HeaderReader(const std::string& path, const std::string& text) : path_(path), text_(text) {}

  Header read() {
    std::string line = next_line();
    if (line != "ply") throw FileError(path_, "has no header of a .ply file");
    bool has_form = false;
    while ((line = next_line()) != "end_header") {
      const std::vector<std::string> words = words_of(line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "format")
        has_form = take_form(words);
      else if (words[0] == "element")
        take_element(words);
      else if (words[0] == "property")
        take_property(words);
      else
        refuse();
    }
    if (!has_form) throw FileError(path_, "has no line 'format' in its header");
    header_.bytes = at_;
    return header_;
  }

 private:
  [[noreturn]] void refuse() const {
    throw FileError(path_, "line " + std::to_string(number_) + " is none of a .ply file's header: '" +
                               line_.substr(0, 60) + "'");
  }
  const std::string& next_line() {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string::npos || end - at_ > longest_line)
      throw FileError(path_,
                      number_ == 0 ? "has no header of a .ply file" : "has a header without 'end_header'");
    line_ = text_.substr(at_, end - at_);
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    at_ = end + 1, ++number_;
    return line_;
  }
  bool take_form(const std::vector<std::string>& words) {
    if (words.size() != 3 || !header_.elements.empty()) refuse();
    if (words[1] == "ascii")
      header_.form = Header::text;
    else if (words[1] == "binary_little_endian")
      header_.form = Header::little;
    else if (words[1] == "binary_big_endian")
      header_.form = Header::big;
    else
      refuse();
    return true;
  }
  void take_element(const std::vector<std::string>& words) {
    if (words.size() != 3 || words[2].empty() || words[2].size() > most_digits ||
        !std::all_of(words[2].begin(), words[2].end(), [](char c) { return c >= '0' && c <= '9'; }))
      refuse();
    header_.elements.push_back({words[1], std::stoull(words[2]), {}});
  }
  void take_property(const std::vector<std::string>& words) {
    if (header_.elements.empty()) refuse();
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) refuse();
    const Type* length = list ? type_of(words[2]) : nullptr;
    const Type* type = type_of(words[list ? 3 : 1]);
    if (!type || (list && (!length || length->kind == Type::real))) refuse();
    header_.elements.back().properties.push_back({words.back(), type, length});
  }

  static constexpr std::size_t longest_line = 4096;
  static constexpr std::size_t most_digits = 12;  // of a count: a file of so many bytes does not exist
  const std::string& path_;
  const std::string& text_;
  std::size_t at_ = 0;
  int number_ = 0;
  std::string line_;
  Header header_;
};

/// The numbers of the body, one after another.
class Body {
 public:
  Body(const std::string& path, const std::string& text, const Header& header)
      : path_(path), at_(text.data() + header.bytes), end_(text.data() + text.size()), form_(header.form) {}

  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  double next(const Type& type) { return form_ == Header::text ? next_word() : next_binary(type); }
  /// A list of `count` numbers takes so many bytes at least: with fewer left the count is wrong.
  void expect(std::size_t count, std::size_t bytes) {
    if (form_ == Header::text ? 2 * count > left() + 1 : count * bytes > left()) ends_early();
  }
  void in(const std::string& element, std::size_t number) { element_ = &element, number_ = number; }
  [[noreturn]] void refuse(const std::string& what) const {
    throw FileError(path_, "its " + *element_ + " " + std::to_string(number_) + " " + what);
  }
  [[noreturn]] void ends_early() const {
    throw FileError(path_, "ends before the elements its header promises: in " + *element_ + " " +
                               std::to_string(number_));
  }

 private:
  double next_word() {
    while (at_ != end_ && std::isspace(static_cast<unsigned char>(*at_))) ++at_;
    const char* const begin = at_;
    while (at_ != end_ && !std::isspace(static_cast<unsigned char>(*at_))) ++at_;
    if (begin == at_) ends_early();
    const std::string word(begin, at_);
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (*end) refuse("holds '" + word.substr(0, 40) + "', which is no number");
    return number;
  }
  double next_binary(const Type& type) {
    if (left() < type.bytes) ends_early();
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t from = form_ == Header::little ? type.bytes - 1 - i : i;
      bits = bits << 8 | static_cast<unsigned char>(at_[from]);
    }
    at_ += type.bytes;
    if (type.kind == Type::real)
      return type.bytes == 8 ? std::bit_cast<double>(bits)
                             : double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
    const bool negative = type.kind == Type::integer && (bits & sign) != 0;
    return static_cast<double>(bits) - (negative ? 2 * static_cast<double>(sign) : 0);
  }

  const std::string& path_;
  const char *at_, *end_;
  Header::Form form_;
  const std::string* element_ = &path_;
  std::size_t number_ = 0;
};

int property_index(const Element& element, std::initializer_list<const char*> names, bool list) {
  for (std::size_t i = 0; i < element.properties.size(); ++i)
    for (const char* name : names)
      if (element.properties[i].name == name && (element.properties[i].length != nullptr) == list)
        return static_cast<int>(i);
  return -1;
}

/// One element: the numbers of its scalar properties, and those of the list `kept`.
void read_element(Body& body, const Element& element, int kept, std::vector<double>& scalars,
                  std::vector<double>& list) {
  scalars.assign(element.properties.size(), 0);
  list.clear();
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Property& property = element.properties[i];
    if (!property.length) {
      scalars[i] = body.next(*property.type);
      continue;
    }
    const double length = body.next(*property.length);
    if (!(length >= 0 && length < 4294967296. && length == std::floor(length)))
      body.refuse("has a list of " + shortest(length) + " numbers");
    body.expect(static_cast<std::size_t>(length), property.type->bytes);
    for (double k = 0; k < length; ++k) {
      const double value = body.next(*property.type);
      if (static_cast<int>(i) == kept) list.push_back(value);
    }
  }
}

/// Where an element has its colours; -1: it has none. Refuses types that are no colours.
std::array<int, 3> color_indices(const std::string& path, const Element& element) {
  const std::array<int, 3> indices{property_index(element, {"red", "diffuse_red"}, false),
                                   property_index(element, {"green", "diffuse_green"}, false),
                                   property_index(element, {"blue", "diffuse_blue"}, false)};
  for (const int i : indices)
    if (i < 0) return {-1, -1, -1};
  for (const int i : indices) {
    const Property& property = element.properties[static_cast<std::size_t>(i)];
    if (property.type->kind == Type::integer ||
        (property.type->kind == Type::natural && property.type->bytes > 2))
      throw FileError(path, "its colours '" + property.name + "' are of type " + property.type->names[0] +
                                "; uchar, ushort, float and double are read");
  }
  return indices;
}

/// 0 to 1.
float color_part(const Body& body, const Property& property, double value) {
  const double whole = property.type->kind == Type::real ? 1 : property.type->bytes == 1 ? 255 : 65535;
  if (!(value >= 0 && value <= whole))
    body.refuse("has the " + property.name + " " + shortest(value) + "; from 0 to " + shortest(whole) +
                " are colours");
  return static_cast<float>(value / whole);
}

}  // namespace

MeshPolygons read_ply(const std::string& path) {
  const std::string text = read_text_file(path);
  const Header header = HeaderReader(path, text).read();
  Body body(path, text, header);
  MeshPolygons result;
  bool has_points = false, has_faces = false;
  std::vector<double> scalars, list;
  for (const Element& element : header.elements) {
    body.in(element.name, 0);
    if (!element.properties.empty()) body.expect(element.count, element.least_bytes());
    const bool points = element.name == "vertex", faces = element.name == "face";
    const int x = property_index(element, {"x"}, false), y = property_index(element, {"y"}, false),
              z = property_index(element, {"z"}, false),
              corners = property_index(element, {"vertex_indices", "vertex_index"}, true);
    const std::array<int, 3> color = points ? color_indices(path, element) : std::array{-1, -1, -1};
    const bool known_points = points && x >= 0 && y >= 0 && z >= 0, known_faces = faces && corners >= 0;
    has_points = has_points || known_points, has_faces = has_faces || known_faces;
    for (std::size_t n = 0; n < element.count && !element.properties.empty(); ++n) {
      body.in(element.name, n);
      read_element(body, element, faces ? corners : -1, scalars, list);
      if (known_points) {
        const Vec3 place{scalars[x], scalars[y], scalars[z]};
        if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z))
          body.refuse("has a coordinate that is no finite number");
        result.points.push_back(place);
        if (color[0] >= 0) {
          PointColor& own = result.colors.emplace_back();
          for (std::size_t k = 0; k < own.size(); ++k) {
            const auto i = static_cast<std::size_t>(color[k]);
            own[k] = color_part(body, element.properties[i], scalars[i]);
          }
        }
      }
      if (!known_faces) continue;
      std::vector<int>& polygon = result.polygons.emplace_back();
      for (const double corner : list) {
        if (!(corner >= 0 && corner < 2147483648. && corner == std::floor(corner)))
          body.refuse("names point " + shortest(corner));
        polygon.push_back(static_cast<int>(corner));
      }
    }
  }
  if (!has_points || !has_faces)
    throw FileError(path, "needs elements 'vertex' with x, y, z and 'face' with a list vertex_indices");
  for (std::size_t n = 0; n < result.polygons.size(); ++n)
    for (const int corner : result.polygons[n])
      if (static_cast<std::size_t>(corner) >= result.points.size())
        throw FileError(path, "its face " + std::to_string(n) + " names point " + std::to_string(corner) +
                                  "; it has " + std::to_string(result.points.size()) + " points");
  return result;
}

}  // namespace cleft
