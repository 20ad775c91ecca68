#include "encoder/knot_search.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "base/parallel.h"
#include "encoder/series_fit.h"

namespace cleft {

namespace {

constexpr std::size_t probes = 6;       // frames that represent all
constexpr double few = 5e-5;            // share of nodes for which a residual costs less than the next rung
constexpr double hardly_further = 1.1;  // than the largest rung, where none is sufficient

class KnotSearch {
 public:
  KnotSearch(double limit, const std::vector<Rung>& rungs, const Series& series, FitStore& store,
             const std::function<void(const std::string&)>& progress)
      : limit_(limit), rungs_(rungs), series_(series), store_(store), progress_(progress) {
    const std::size_t frames = series.times.size();
    for (std::size_t i = probes; i-- > 0;) frames_.push_back(1 + (frames - 2) * i / (probes - 1));
    frames_.erase(std::unique(frames_.begin(), frames_.end()), frames_.end());
    in_last_.resize(rungs.size());
  }

  /// From a rung on: the first that is off by more than the limit at a share `most` of the nodes at most. The
  /// last frame, where the cut is longest, is the hardest one and nearly always decides; the others are
  /// tested once it is satisfied.
  std::size_t first(std::size_t from, double most) {
    std::size_t low = from, high = rungs_.size();
    while (low < high) {  // two candidates at a time, side by side
      progress_("trying knots");
      const std::size_t third = (high - low) / 3, candidates[] = {low + third, high - 1 - third};
      const int count = candidates[0] == candidates[1] ? 1 : 2;
      bool within[2] = {false, false};
      parallel_for(count, [&](int i) { within[i] = beyond_in_last(candidates[i]) <= most; });
      if (within[0])
        high = candidates[0];
      else if (count == 2 && within[1])
        low = candidates[0] + 1, high = candidates[1];
      else
        low = candidates[count - 1] + 1;
    }
    const std::vector<std::size_t> others(frames_.begin() + 1, frames_.end());
    for (; low < rungs_.size(); ++low) {
      progress_("trying knots");
      const double of_last = beyond_in_last(low);
      if (of_last + beyond(low, others, most - of_last) <= most) break;
    }
    return low;
  }

  /// The smallest that is hardly further off in the last frame than the largest, at nodes and in the opening.
  std::size_t nearly_best() {
    const auto off = [this](std::size_t rung) { return std::max(in_last(rung).largest, in_last(rung).gape); };
    std::size_t low = 0, high = rungs_.size() - 1;
    const double most = hardly_further * off(high);
    while (low < high) {
      progress_("trying knots");
      const std::size_t middle = (low + high) / 2;
      off(middle) <= most ? high = middle : low = middle + 1;
    }
    return high;
  }

 private:
  SpaceMisfit misfit(std::size_t rung, std::size_t frame) const {
    const auto bases =
        bases_of(rungs_[rung], *store_.parametrization(), static_cast<int>(series_.times.size()));
    return space_misfit(series_, store_, {bases[0], bases[1], bases[2]}, frame, limit_);
  }
  const SpaceMisfit& in_last(std::size_t rung) {
    if (!in_last_[rung]) in_last_[rung] = misfit(rung, frames_[0]);
    return *in_last_[rung];
  }
  /// What a frame adds to the share of nodes that are off.
  double beyond_in_last(std::size_t rung) {
    return in_last(rung).beyond / static_cast<double>(frames_.size());
  }
  /// The same of frames; no longer exact once it is above `most`.
  double beyond(std::size_t rung, const std::vector<std::size_t>& frames, double most) const {
    const double part = 1 / static_cast<double>(frames_.size());
    std::atomic<double> sum = 0;
    parallel_for(static_cast<int>(frames.size()), [&](int i) {
      if (sum <= most) sum += part * misfit(rung, frames[i]).beyond;
    });
    return sum;
  }

  double limit_;
  const std::vector<Rung>& rungs_;
  const Series& series_;
  FitStore& store_;
  const std::function<void(const std::string&)>& progress_;
  std::vector<std::size_t> frames_;                  // the last first
  std::vector<std::optional<SpaceMisfit>> in_last_;  // of every rung, where known
};

}  // namespace

std::size_t sufficient_rung(double limit, const std::vector<Rung>& rungs, const Series& series,
                            FitStore& store, const std::function<void(const std::string&)>& progress) {
  KnotSearch search(limit, rungs, series, store, progress);
  const std::size_t nearly = search.first(0, few);
  if (nearly == rungs.size()) return search.nearly_best();
  const std::size_t wholly = search.first(nearly, 0);
  return wholly < rungs.size() ? wholly : nearly;
}

}  // namespace cleft
