// The parameters that a file records of a case: typed, as far as the table knows them.
#pragma once

#include <bitset>
#include <map>
#include <optional>
#include <string>

#include "params/parameters/table.h"

namespace cleft {

/// Older files and imported data record only some of the parameters; and a file may have values that no row
/// of the table describes (an unknown name, a text that is none of the choices): these are extras, which are
/// kept and written unchanged.
///
/// Physics reads members: `p->skin.thickness`, which is NaN if the file lacks it; p.has() tests that. Loops
/// over all parameters, and names from the user, read by name.
class RecordedParameters {
 public:
  RecordedParameters();  ///< nothing is recorded
  explicit RecordedParameters(const Parameters& parameters);

  /// Numbers that are not recorded are NaN; switches and choices are as they were before files recorded them
  /// (docs/formats.md).
  const Parameters* operator->() const { return &values_; }
  const Parameters& operator*() const { return values_; }

  /// Whether a member of this object is recorded: p.has(p->cut.length).
  template <class Member>
  bool has(const Member& member) const {
    return recorded_[index_of(row_of(values_, member))];
  }
  /// The member, or `otherwise` if it is not recorded.
  template <class Member>
  Member value_or(const Member& member, Member otherwise) const {
    return has(member) ? member : otherwise;
  }
  /// The name of a member of this object.
  template <class Member>
  const std::string& name_of(const Member& member) const {
    return row_of(values_, member).name;
  }
  /// Records another value of a number of this object: p.set(p->cut.length, 12).
  void set(const double& member, double value);

  /// Records a value by name: in the row's member, or as an extra if no row accepts it. Ranges are not
  /// checked.
  void set(const std::string& name, const Value& value);
  void erase(const std::string& name);
  /// The value of a name, also of an extra; none if it is not recorded.
  std::optional<Value> find(const std::string& name) const;
  /// The same for a number; none if it is a text.
  std::optional<double> number(const std::string& name) const;

  /// All parameters, with the checks of set_parameter(). Throws InputError "<where>: <lacks> NAME<remedy>" if
  /// one is not recorded.
  Parameters whole(const std::string& where, const std::string& lacks, const std::string& remedy) const;

  /// All recorded values including extras, sorted by name; and the numbers and texts among them.
  std::map<std::string, Value> all() const;
  std::map<std::string, double> numbers() const;
  std::map<std::string, std::string> texts() const;
  bool empty() const { return recorded_.none() && extras_.empty(); }

  friend bool operator==(const RecordedParameters& a, const RecordedParameters& b) {
    return a.all() == b.all();
  }

 private:
  static constexpr std::size_t most_rows = 64;
  static std::size_t index_of(const Parameter& row) { return &row - parameter_table().data(); }

  Parameters values_;
  std::bitset<most_rows> recorded_;  // by row of the table
  std::map<std::string, Value> extras_;
};

}  // namespace cleft
