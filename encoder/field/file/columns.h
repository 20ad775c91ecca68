// Many headers of fields as columns, so that common entries are stored once.
#pragma once

#include <vector>

#include "encoder/field/file/field_record.h"

namespace cleft {

/// One column for each entry of the headers ("quantum", "parameters/skin.thickness"), of one of three kinds:
/// {"all": value}, {"values": [...], "of": [index of each case]}, {"each": [value of each case]}. A case
/// without the entry has the text "absent".
Json columns_of(const std::vector<Json>& headers);

/// The inverse, one case at a time. Throws InputError if the columns are not those of `cases` cases.
class Columns {
 public:
  Columns(Json columns, std::size_t cases);
  Json header(std::size_t i) const;
  /// Only the entries of one group: "parameters", "choices", "report".
  Json group(const std::string& name, std::size_t i) const;
  Json entry(const std::string& name, std::size_t i) const;
  bool has(const std::string& name, std::size_t i) const;  ///< an entry

 private:
  const Json* find(const Json& column, std::size_t i) const;

  Json columns_;
};

}  // namespace cleft
