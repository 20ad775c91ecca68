#include "encoder/import/components.h"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"

namespace cleft {

namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream all(text);
  for (std::string part; std::getline(all, part, separator);) parts.push_back(part);
  return parts;
}

/// "a", "b" and "c" of "a+b+c"; none if one of them is empty.
std::vector<std::string> terms_of(const std::string& source) {
  std::vector<std::string> terms = parts_of(source, '+');
  if (source.ends_with('+') || is_among(terms, "")) terms.clear();
  return terms;
}

/// VTK's readers of CGNS and Exodus join NAMEX, NAMEY and NAMEZ, or NAMEx, ..., to a vector NAME.
std::optional<Component> component(const std::string& name, const std::vector<std::string>& there) {
  if (name == "0") return Component{};
  if (is_among(there, name)) return Component{name};
  const std::size_t letter = std::string("XYZxyz").find(name.back());
  const std::string vector = name.substr(0, name.size() - 1);
  if (letter == std::string::npos || !is_among(there, vector)) return {};
  return Component{vector, static_cast<int>(letter % 3)};
}

/// How programs call the components of vectors and tensors, "|" between words for one; the plane ones last.
constexpr std::array endings{"x y z", "1 2 3", "xx yy zz xy yz xz|zx", "11 22 33 12 23 13|31",
                             "x y",   "1 2",   "xx yy 0 xy",           "11 22 0 12"};

/// The names of NAME's components with one of these endings, if all are there.
std::vector<std::string> ending_in(const std::string& words, const std::string& name,
                                   const std::vector<std::string>& there) {
  std::vector<std::string> names;
  for (const std::string& word : parts_of(words, ' ')) {
    const std::size_t before = names.size();
    for (const std::string& ending : parts_of(word, '|'))
      if (ending == "0")
        names.push_back(ending);
      else if (names.size() == before && component(name + ending, there))
        names.push_back(name + ending);
    if (names.size() == before) return {};
  }
  return names;
}

std::string in_capitals(std::string words) {
  for (char& c : words)
    if (c >= 'x' && c <= 'z') c = static_cast<char>(c - 'x' + 'X');
  return words;
}

}  // namespace

std::vector<Component> components_of(std::string& source, const std::vector<std::string>& there) {
  if (is_among(there, source)) return {{source}};
  std::vector<std::string> names = terms_of(source);
  if (names.size() == 1 && !component(source, there)) {
    names.clear();
    for (const std::string words : endings)
      for (const char* between : {"", "_", "-", ".", ":", " "})
        for (const std::string& same : {words, in_capitals(words)})
          if (names.empty()) names = ending_in(same, source + between, there);
    std::string sum;
    for (const std::string& name : names) sum += (sum.empty() ? "" : "+") + name;
    if (!names.empty()) source = sum;
  }
  std::vector<Component> components;
  bool is_any_there = false;
  for (const std::string& name : names) {
    const auto found = component(name, there);
    components.push_back(found.value_or(Component{name}));
    is_any_there = is_any_there || (found && !found->is_zero());
  }
  return is_any_there ? components : std::vector<Component>{{source}};
}

SourceArray composed(const std::vector<Component>& components, std::vector<SourceArray> arrays,
                     const std::string& source) {
  const bool is_one_array = components.size() == 1 && components.front().column < 0;
  if (is_one_array && arrays.front().components != 2) return std::move(arrays.front());
  if (is_one_array) {  // a vector in the plane
    SourceArray vector{3, arrays.front().single, {}};
    const std::vector<double>& values = arrays.front().values;
    for (std::size_t i = 0; i + 1 < values.size(); i += 2)
      vector.values.insert(vector.values.end(), {values[i], values[i + 1], 0});
    return vector;
  }
  const std::size_t count = components.size(), width = count == 2 ? 3 : count == 4 ? 6 : count;
  SourceArray all;
  all.components = static_cast<int>(width);
  auto array = arrays.begin();
  for (std::size_t k = 0; k < count; ++k) {
    if (components[k].is_zero()) continue;
    const bool of_vector = components[k].column >= 0;
    if (array->components != (of_vector ? 3 : 1))
      throw InputError("--field " + source + ": array '" + components[k].array + "' has " +
                       std::to_string(array->components) + " components, where one is asked for");
    const auto columns = static_cast<std::size_t>(array->components), rows = array->values.size() / columns;
    all.values.resize(width * rows);
    for (std::size_t i = 0; i < rows; ++i)
      all.values[width * i + k] =
          array->values[columns * i + (of_vector ? static_cast<std::size_t>(components[k].column) : 0)];
    all.single = all.single || array->single;
    ++array;
  }
  return all;
}

std::string recorded_source(const std::string& source, const std::vector<Component>& components) {
  if (components.size() != 1 || components.front().column >= 0) return source;
  std::string recorded;
  for (const char c : source) recorded += c == '+' ? std::string("++") : std::string(1, c);
  return recorded;
}

std::string array_recorded(const std::string& source) {
  std::string array;
  for (std::size_t i = 0; i < source.size(); ++i) {
    array += source[i];
    if (source.compare(i, 2, "++") == 0) ++i;
  }
  return array;
}

std::vector<WrittenComponent> written_components(const std::string& source, int components) {
  const std::vector<std::string> terms = terms_of(source);
  const std::size_t count = terms.size();
  if (!(components == 3 && (count == 2 || count == 3)) &&
      !(components == 6 && (count == 4 || count == 6 || count == 9)))
    return {};
  constexpr std::array<int, 9> of_nine{0, 3, 5, 3, 1, 4, 5, 4, 2};
  std::vector<WrittenComponent> written;
  for (std::size_t k = 0; k < count; ++k)
    if (terms[k] != "0") written.push_back({terms[k], count == 9 ? of_nine[k] : static_cast<int>(k)});
  return written;
}

}  // namespace cleft
