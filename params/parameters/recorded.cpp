#include "params/parameters/recorded.h"

#include <algorithm>
#include <limits>

#include "base/error.h"

namespace cleft {

namespace {

Parameters nothing_recorded() {
  Parameters p;
  for (const Parameter& row : parameter_table())
    if (const auto* number = std::get_if<Parameter::Number>(&row.access))
      (*number)(p) = std::numeric_limits<double>::quiet_NaN();
  // What was so before files recorded it, where the default is another now.
  p.skin.edges = SkinEdges::free, p.mesh.front = MeshFront::nodes;
  return p;
}

/// Whether the row's member can hold the value.
bool takes(const Parameter& row, const Value& value) {
  const std::string* text = std::get_if<std::string>(&value);
  if (!row.is_text()) return !text;
  return text && std::find(row.choices.begin(), row.choices.end(), *text) != row.choices.end();
}

}  // namespace

RecordedParameters::RecordedParameters() {
  CLEFT_CHECK(parameter_table().size(), <=, most_rows);
  static const Parameters nothing = nothing_recorded();
  values_ = nothing;
}

RecordedParameters::RecordedParameters(const Parameters& parameters) : values_(parameters) {
  for (const Parameter& row : parameter_table()) recorded_.set(index_of(row));
}

void RecordedParameters::set(const double& member, double value) {
  const Parameter& row = row_of(values_, member);
  std::get<Parameter::Number>(row.access)(values_) = value;
  recorded_.set(index_of(row));
}

void RecordedParameters::set(const std::string& name, const Value& value) {
  const Parameter* row = find_parameter(name);
  if (row && takes(*row, value)) {
    extras_.erase(name);
    put_parameter(values_, *row, value);
    recorded_.set(index_of(*row));
  } else {
    erase(name);
    extras_[name] = value;
  }
}

void RecordedParameters::erase(const std::string& name) {
  extras_.erase(name);
  const Parameter* row = find_parameter(name);
  if (!row) return;
  static const Parameters nothing = nothing_recorded();
  put_parameter(values_, *row, get_parameter(nothing, *row));
  recorded_.reset(index_of(*row));
}

std::optional<Value> RecordedParameters::find(const std::string& name) const {
  if (const Parameter* row = find_parameter(name); row && recorded_[index_of(*row)])
    return get_parameter(values_, *row);
  const auto extra = extras_.find(name);
  return extra == extras_.end() ? std::nullopt : std::optional(extra->second);
}

std::optional<double> RecordedParameters::number(const std::string& name) const {
  if (const Parameter* row = find_parameter(name); row && recorded_[index_of(*row)])
    return row->is_text() ? std::nullopt : std::optional(*static_cast<const double*>(row->address(values_)));
  const auto extra = extras_.find(name);
  const double* number = extra == extras_.end() ? nullptr : std::get_if<double>(&extra->second);
  return number ? std::optional(*number) : std::nullopt;
}

std::map<std::string, Value> RecordedParameters::all() const {
  std::map<std::string, Value> values = extras_;
  for (const Parameter& row : parameter_table())
    if (recorded_[index_of(row)]) values.emplace(row.name, get_parameter(values_, row));
  return values;
}

std::map<std::string, double> RecordedParameters::numbers() const {
  std::map<std::string, double> numbers;
  for (const auto& [name, value] : all())
    if (const double* number = std::get_if<double>(&value)) numbers.emplace(name, *number);
  return numbers;
}

std::map<std::string, std::string> RecordedParameters::texts() const {
  std::map<std::string, std::string> texts;
  for (const auto& [name, value] : all())
    if (const std::string* text = std::get_if<std::string>(&value)) texts.emplace(name, *text);
  return texts;
}

Parameters RecordedParameters::whole(const std::string& where, const std::string& lacks,
                                     const std::string& remedy) const {
  const auto missing = [&](const std::string& name) {
    return InputError(where + ": " + lacks + ' ' + name + remedy);
  };
  Parameters parameters;
  for (const Parameter& row : parameter_table()) {
    const std::optional<Value> value = find(row.name);
    if (!value && !row.added_later) throw missing(row.name);
    if (value) set_parameter(parameters, row.name, *value, where);
  }
  return parameters;
}

}  // namespace cleft
