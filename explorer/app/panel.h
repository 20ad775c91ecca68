// A part of the window: it sends commands to the session and follows their changes.
#pragma once

#include <functional>
#include <string>

#include "explorer/session/session.h"

namespace cleft {

/// Sends a command; if it is refused, shows the message and returns false.
using Say = std::function<bool(const std::string& line)>;

class Panel {
 public:
  virtual ~Panel() = default;
  virtual void follow(const Changes& changes) = 0;
};

}  // namespace cleft
