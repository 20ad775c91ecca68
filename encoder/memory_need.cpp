#include "encoder/memory_need.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "encoder/field/node_residual.h"

namespace cleft {

namespace {

// Bytes, measured on meshes of 10^5 and 10^6 hexahedra with 40 frames: docs/size.md.
constexpr double of_program = 150e6, of_node = 400, of_other_node = 250;
// A component, node and frame of what is left at the nodes: coded, and in the blocks at work.
constexpr double of_coded = 0.25, of_block = 9;

}  // namespace

std::string gigabytes(double bytes) {
  std::ostringstream text;
  text.precision(bytes < 1e9 ? 2 : 3);
  text << bytes / 1e9 << " GB";
  return text.str();
}

double MemoryNeed::in_memory() const { return of_program + others + (spilled ? 0 : values); }

MemoryNeed memory_need(const SnapshotReader& reader) {
  const Snapshot& s = reader.snapshot();
  MemoryNeed need;
  need.nodes = static_cast<double>(s.points.size()), need.frames = static_cast<double>(s.frames());
  need.components = 3;
  for (const SnapshotArray& array : reader.point_arrays())
    if (array.varies && (s.source || array.name.starts_with("displacement_per_")))
      need.components += static_cast<double>(array.components);
  // Of further quantities three components are copied at a time.
  const double copied = need.components > 3 ? 3 : 0;
  const double fitted = std::min(need.nodes, static_cast<double>(most_fitted));
  need.values = sizeof(double) * (need.components + copied) * fitted * need.frames;
  const double numbers = need.components * need.frames;
  need.others = fitted * of_node + (need.nodes - fitted) * of_other_node + of_coded * numbers * need.nodes +
                of_block * numbers * std::min(need.nodes, 2. * CodedResidual::most_nodes);
  return need;
}

MemoryNeed operator+(const MemoryNeed& a, const MemoryNeed& b) {
  MemoryNeed sum;
  sum.values = a.values + b.values, sum.others = a.others + b.others, sum.nodes = a.nodes + b.nodes;
  sum.frames = std::max(a.frames, b.frames), sum.components = std::max(a.components, b.components);
  return sum;
}

void MemoryNeed::fit_into(double memory, const std::string& folder, const std::string& path) {
  spilled = in_memory() > memory;
  std::ostringstream size;
  size.precision(15);
  size << path << ": " << nodes << " nodes and " << frames << " frames of " << components << " numbers need ";
  const std::string remedy = "; import fewer fields (cleft import --field) or frames";
  if (in_memory() > memory)
    throw InputError(size.str() + "up to " + gigabytes(in_memory()) + " of memory, and " + gigabytes(memory) +
                     " may be used; allow more (--memory), on a larger machine" + remedy);
  std::error_code unknown;
  const auto space = std::filesystem::space(folder, unknown);
  if (spilled && !unknown && static_cast<double>(space.available) < values)
    throw InputError(size.str() + gigabytes(values) + " in a temporary file, and " + folder + " has " +
                     gigabytes(static_cast<double>(space.available)) +
                     " left; name another folder with TMPDIR, or allow more memory (--memory)" + remedy);
}

}  // namespace cleft
