// Texts like "normal(5, 2)": a name, with or without numbers in brackets.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

struct CallText {
  std::string name;
  std::optional<std::vector<double>> numbers;  ///< none where there are no brackets
};

/// Throws InputError "<where>: ..." where a bracket is missing, or what is in the brackets is no list of
/// numbers.
inline CallText parse_call(const std::string& text, const std::string& where) {
  const auto trimmed = [](std::string part) {
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    return part;
  };
  const std::string whole = trimmed(text);
  const std::size_t open = whole.find('(');
  CallText call{trimmed(whole.substr(0, open)), {}};
  if (open == std::string::npos) return call;
  if (whole.back() != ')') throw InputError(where + ": the closing bracket is missing");
  const std::string list = whole.substr(open + 1, whole.size() - open - 2);
  call.numbers.emplace();
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t comma = std::min(list.find(',', from), list.size());
    call.numbers->push_back(parse_number(trimmed(list.substr(from, comma - from)), where));
    from = comma + 1;
  }
  return call;
}

}  // namespace cleft
