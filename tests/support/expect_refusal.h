// That something is refused, and what is said of it.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "base/error.h"

namespace cleft::testing {

/// Expects an InputError whose text has all of the parts.
inline void expect_refusal(const std::string& what, const std::function<void()>& work,
                           const std::vector<std::string>& told) {
  SCOPED_TRACE(what);
  try {
    work();
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    for (const std::string& part : told)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

}  // namespace cleft::testing
