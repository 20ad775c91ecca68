// A part of the window: it says lines to the session and follows what they change.
#pragma once

#include <functional>
#include <string>

#include "explorer/session/session.h"

namespace cleft {

/// Says a line; where it is refused the message is shown, and false comes back.
using Say = std::function<bool(const std::string& line)>;

class Panel {
 public:
  virtual ~Panel() = default;
  virtual void follow(const Changes& changes) = 0;
};

}  // namespace cleft
