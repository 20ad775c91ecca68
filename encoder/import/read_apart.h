// Libraries that end the program, or crash, on damaged files.
#pragma once

#include <functional>
#include <string>

namespace cleft {

/// Runs `read` in a process of its own, whose output is dropped. Throws FileError about `path` with the
/// message of an InputError there, or if that process ended in any other way than by coming back.
void read_apart(const std::string& path, const std::function<void()>& read);

}  // namespace cleft
