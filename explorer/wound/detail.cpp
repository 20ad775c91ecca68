#include "explorer/wound/detail.h"

#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

std::string text_of(const Detail& detail) { return shortest(detail.amount) + (detail.pixels ? "px" : "um"); }

Detail detail_of(const std::string& text) {
  const bool pixels = text.ends_with("px");
  if (!pixels && !text.ends_with("um"))
    throw InputError("'" + text + "' has no unit: say micrometres, like 10um, or pixels, like 0.25px");
  const double amount = parse_number(text.substr(0, text.size() - 2), "the detail");
  if (!(amount > 0) || !std::isfinite(amount))
    throw InputError("the detail '" + text + "' must be above 0, and 'off' leaves nothing out");
  return {amount, pixels};
}

}  // namespace cleft
