#include "encoder/field/file/columns.h"

#include <algorithm>
#include <map>

#include "base/error.h"

namespace cleft {

namespace {

constexpr const char* groups[] = {"bases", "domain", "parameters", "choices", "report", "modes"};
const Json absent = "absent";

bool is_group(const std::string& name) {
  return std::find(std::begin(groups), std::end(groups), name) != std::end(groups);
}

Json column_of(const std::vector<Json>& values) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::size_t> of;
  Json distinct = Json::array();
  for (const Json& value : values) {
    const auto [found, is_new] = numbers.emplace(value.dump(), numbers.size());
    if (is_new) distinct.push_back(value);
    of.push_back(found->second);
  }
  if (distinct.size() == 1) return {{"all", distinct.front()}};
  if (2 * distinct.size() > values.size()) return {{"each", values}};
  return {{"values", distinct}, {"of", of}};
}

}  // namespace

Json columns_of(const std::vector<Json>& headers) {
  // In the order in which entries are first met.
  std::vector<std::string> names;
  std::map<std::string, std::vector<Json>> columns;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    const auto put = [&](const std::string& name, const Json& value) {
      const auto [found, is_new] = columns.emplace(name, std::vector<Json>());
      if (is_new) names.push_back(name), found->second.assign(headers.size(), absent);
      found->second[i] = value;
    };
    for (const auto& [key, value] : headers[i].items()) {
      if (!is_group(key)) {
        put(key, value);
        continue;
      }
      for (const auto& [name, member] : value.items()) put(key + "/" + name, member);
    }
  }
  Json result = Json::object();
  for (const std::string& name : names) result[name] = column_of(columns[name]);
  return result;
}

Columns::Columns(Json columns, std::size_t cases) : columns_(std::move(columns)) {
  if (!columns_.is_object()) throw InputError("the columns are missing");
  for (const auto& [name, column] : columns_.items()) {
    bool good = column.is_object();
    if (good && column.contains("all")) continue;
    if (good && column.contains("each")) {
      good = column["each"].is_array() && column["each"].size() == cases;
    } else if (good) {
      good = column.contains("values") && column["values"].is_array() && column.contains("of") &&
             column["of"].is_array() && column["of"].size() == cases;
      if (good)
        for (const Json& index : column["of"])
          good = good && index.is_number_unsigned() && index.get<std::size_t>() < column["values"].size();
    }
    if (!good) throw InputError("the column " + name + " is not one of " + std::to_string(cases) + " cases");
  }
}

const Json* Columns::find(const Json& column, std::size_t i) const {
  const auto all = column.find("all");
  if (all != column.end()) return &*all;
  const auto each = column.find("each");
  const Json& value =
      each != column.end() ? (*each)[i] : column["values"][column["of"][i].get<std::size_t>()];
  return value == absent ? nullptr : &value;
}

Json Columns::header(std::size_t i) const {
  Json header = {{"parameters", Json::object()}};
  for (const auto& [name, column] : columns_.items()) {
    const Json* value = find(column, i);
    if (!value) continue;
    const std::size_t slash = name.find('/');
    const std::string group = name.substr(0, slash);
    if (slash != std::string::npos && is_group(group))
      header[group][name.substr(slash + 1)] = *value;
    else
      header[name] = *value;
  }
  return header;
}

Json Columns::group(const std::string& group, std::size_t i) const {
  Json members = Json::object();
  for (const auto& [name, column] : columns_.items())
    if (name.size() > group.size() && name.starts_with(group) && name[group.size()] == '/')
      if (const Json* value = find(column, i)) members[name.substr(group.size() + 1)] = *value;
  return {{group, members}};
}

bool Columns::has(const std::string& name, std::size_t i) const {
  const auto column = columns_.find(name);
  return column != columns_.end() && find(*column, i);
}

Json Columns::entry(const std::string& name, std::size_t i) const {
  const auto column = columns_.find(name);
  const Json* value = column == columns_.end() ? nullptr : find(*column, i);
  if (!value) throw InputError("the column " + name + " is missing");
  return *value;
}

}  // namespace cleft
