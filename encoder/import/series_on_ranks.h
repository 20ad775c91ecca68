// A series whose frames several processes read in turn, while the first one takes them in their order.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/ranks/ranks.h"
#include "encoder/import/series.h"

namespace cleft {

/// On the first rank, while serve_series() runs on the others. Each has opened the files itself and holds one
/// frame at most, which it has read ahead.
class SeriesOnRanks : public ImportedSeries {
 public:
  /// `fields` as parse_fields takes them. Throws what goes wrong in any process.
  static std::unique_ptr<SeriesOnRanks> open(const Ranks& ranks, const std::vector<std::string>& paths,
                                             const std::vector<std::string>& fields);

  /// Of a frame that cannot be read, throws what reading it here throws, or else what another rank has told.
  void for_each_frame(const UseFrame& use) const override;
  void weld(const std::vector<std::int32_t>& number) override;

 private:
  SeriesOnRanks(const Ranks& ranks, const std::vector<std::string>& paths,
                const std::vector<SeriesField>& fields)
      : ImportedSeries(paths, fields), ranks_(ranks) {}
  FieldValues handed_over(int rank) const;

  const Ranks& ranks_;
};

/// What all ranks but the first do as long as its OtherRanks live.
void serve_series(const Ranks& ranks);

}  // namespace cleft
