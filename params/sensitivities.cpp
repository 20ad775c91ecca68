#include "params/sensitivities.h"

#include "base/error.h"

namespace cleft {

void check_sensitivities(const std::vector<std::string>& names, const Parameters& parameters,
                         const std::string& where) {
  if (!names.empty() && parameters.cut.contact == "true")
    throw InputError(where +
                     ": the series has no derivative where lips begin to touch; set "
                     "cut.contact to false");
  for (const std::string& name : names) {
    const Parameter& row = find_parameter(name, where);
    const std::string part = name.substr(0, name.find('.'));
    if (row.is_text() || (part != "skin" && part != "tissue" && part != "foundation"))
      throw InputError(where + " " + name + ": must be a number of skin, tissue or foundation");
  }
}

}  // namespace cleft
