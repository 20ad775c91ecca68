// Counts what the program takes from the heap. Add allocations.cpp to a test's sources: it replaces operator
// new.
#pragma once

#include <cstddef>

namespace cleft {

/// Calls of any operator new so far.
std::size_t allocations();

}  // namespace cleft
