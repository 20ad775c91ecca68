// Damages files in every way that a reader must notice.
#pragma once

#include <functional>
#include <string>

/// Flips one bit at `places` places spread over the file, one at a time, and cuts the file at as many
/// lengths. `read` must throw InputError, or give what it gave for the sound file: `same()` is asked after a
/// read that does not throw. Returns the number of damages that were neither noticed nor harmless.
int unnoticed_damages(const std::string& file, int places,
                      const std::function<void(const std::string&)>& read, const std::function<bool()>& same);
