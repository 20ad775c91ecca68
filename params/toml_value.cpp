#include "params/toml_value.h"

#include "base/error.h"

namespace cleft {

toml::table parse_toml(const std::string& text, const std::string& path) {
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& e) {
    throw InputError(path + ", line " + std::to_string(e.source().begin.line) + ": " +
                     std::string(e.description()));
  }
}

std::string place_of(const std::string& path, const toml::node& node) {
  return path + ", line " + std::to_string(node.source().begin.line);
}

Value value_of(const toml::node& node, const std::string& name, const std::string& where) {
  find_parameter(name, where);  // an unknown name is told first
  if (const toml::value<bool>* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto number = node.value<double>()) return *number;
  if (const auto text = node.value<std::string>()) return *text;
  throw InputError(where + ": " + name + ": must be a number or a text");
}

}  // namespace cleft
