#include <algorithm>
#include <cmath>
#include <utility>

#include "params/meshed_cut.h"
#include "solver/patch_mesh.h"

namespace cleft {

namespace {

/// The line nearest to a place, of every `step`-th.
std::size_t nearest(const std::vector<double>& lines, double place, std::size_t step) {
  std::size_t best = 0;
  for (std::size_t n = 0; n < lines.size(); n += step)
    if (std::abs(lines[n] - place) < std::abs(lines[best] - place)) best = n;
  return best;
}

/// Opens the incisions of a mesh one after the other.
class Releaser {
 public:
  Releaser(const PatchMesh& mesh, const Parameters& p) : mesh_(mesh), p_(p), lines_(mesh.lines_of_element()) {
    // If the ends of the case are half-way between nodes, rounding must not leave it without a node to open.
    const std::vector<double>& lines = mesh.lines_along[0];
    const auto& [along, depth, branch] = mesh.fronts;
    const std::size_t elements = (lines.size() - 1) / lines_,
                      fewest = lines_ == 2 ? 1 : 2;  // with a node to open
    const std::size_t most = (elements - fewest) / 2 * lines_;
    const std::size_t skipped = std::min(nearest(lines, -p.cut.length / 2 - along, lines_), most);
    first_ = lines[skipped], last_ = lines[lines.size() - 1 - skipped];
    lowest_ = mesh.lines_depth[std::max(lines_, nearest(mesh.lines_depth, p.cut.depth + depth, lines_))];
    r_.start = first_ + along;
    r_.length = last_ - along - r_.start;
    r_.depth = lowest_ - depth;
  }

  Release release() {
    r_.released = {0};
    r_.position = {r_.start};
    r_.times = {0};
    for (std::size_t n = 0; n < mesh_.pairs.size();) n = open_column(n);
    for (std::size_t n = 0; n < mesh_.pairs.size(); ++n)
      if (!opens(mesh_.pairs[n])) r_.order.push_back(static_cast<int>(n));
    return std::move(r_);
  }

 private:
  bool is_branch(const NodePair& pair) const { return p_.cut.branch > 0 && pair.incision == 1; }

  bool opens(const NodePair& pair) const {
    return pair.depth < lowest_ && (is_branch(pair) || (pair.along > first_ && pair.along < last_));
  }

  /// Opens the column that begins with the n-th pair; the number of the next column's first pair. In a front
  /// in the middle of quadratic elements displacements are others than at their corners: it is no frame.
  std::size_t open_column(std::size_t n) {
    const NodePair& first = mesh_.pairs[n];
    std::vector<int> column;
    for (; n < mesh_.pairs.size() && mesh_.pairs[n].incision == first.incision &&
           mesh_.pairs[n].along == first.along;
         ++n)
      if (opens(mesh_.pairs[n])) column.push_back(static_cast<int>(n));
    const std::vector<double>& lines = mesh_.lines_along[first.incision];
    const auto next = std::upper_bound(lines.begin(), lines.end(), first.along);
    const bool ends_at_element = static_cast<std::size_t>(next - lines.begin()) % lines_ == 0;
    const double front = is_branch(first) ? mesh_.fronts.branch : mesh_.fronts.along;
    const double cut_before = first.incision * r_.length;  // a branch is the second incision
    for (std::size_t m = 1; m <= column.size(); ++m) {
      r_.order.push_back(column[m - 1]);
      if (p_.cut.frames == FrameEvery::column && (m < column.size() || !ends_at_element)) continue;
      const double part = static_cast<double>(m) / static_cast<double>(column.size());
      r_.released.push_back(static_cast<int>(r_.order.size()));
      r_.position.push_back(first.along + (*next - first.along) * part - front);
      r_.times.push_back(cut_before + r_.position.back() - (is_branch(first) ? 0 : r_.start));
    }
    return n;
  }

  const PatchMesh& mesh_;
  const Parameters& p_;
  const std::size_t lines_;                   // from an element's line to the next
  double first_ = 0, last_ = 0, lowest_ = 0;  // the outermost nodes of the case's cut, which stay closed
  Release r_;
};

}  // namespace

Release make_release(const PatchMesh& mesh, const Parameters& parameters) {
  return Releaser(mesh, parameters).release();
}

}  // namespace cleft
