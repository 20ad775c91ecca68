// Ranks in a build without MPI: this process is the only one.
#include <stdexcept>

#include "base/ranks/ranks.h"

namespace cleft {

Ranks::Ranks(int&, char**&) {}
Ranks::~Ranks() = default;

void Ranks::check() const {}
void Ranks::send(int, std::span<const std::byte>) const { throw std::logic_error("there is one process"); }
Bytes Ranks::receive(int) const { throw std::logic_error("there is one process"); }

}  // namespace cleft
