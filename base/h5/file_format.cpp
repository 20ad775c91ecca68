// What a file of ours says of itself.
#include <algorithm>

#include "base/error.h"
#include "base/h5/h5.h"
#include "base/text.h"

namespace cleft {

void write_format(h5::File& file, const FileFormat& format) {
  file.write_text("/", "format", format.name);
  file.write_number("/", "version", format.version);
}

void require_format(const h5::File& file, const FileFormat& format) {
  const std::string noun = format.noun, writer = format.writer;
  if (!file.has_attribute("/", "format") || file.read_text("/", "format") != format.name)
    throw FileError(file.path(), "is not a " + noun + " (no attribute format = \"" + format.name + "\"); " +
                                     writer + " writes one");
  const double found = file.read_number("/", "version");
  const auto is_it = [&](int version) { return version != 0 && found == version; };
  if (!is_it(format.version) && std::none_of(format.further.begin(), format.further.end(), is_it))
    throw FileError(file.path(), noun + " format version " + shortest(found) +
                                     "; this program reads version " + std::to_string(format.version) +
                                     ": run " + writer + " again");
}

std::string format_of(const std::string& path) {
  const h5::File file = h5::File::open(path);
  return file.has_attribute("/", "format") ? file.read_text("/", "format") : "";
}

}  // namespace cleft
