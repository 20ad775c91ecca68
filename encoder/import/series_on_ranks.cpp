#include "encoder/import/series_on_ranks.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <optional>

#include "base/ranks/other_ranks.h"

namespace cleft {

namespace {

enum class Asked : int { open, weld, read, hand_over };

template <class... Values>
Bytes request(Asked asked, const Values&... values) {
  Packer packer;
  packer.add(asked), (packer.add(values), ...);
  return packer.bytes();
}

Bytes request_to_open(const std::vector<std::string>& paths, const std::vector<std::string>& fields) {
  Packer packer;
  packer.add(Asked::open), packer.add(paths.size()), packer.add(fields.size());
  for (const std::string& path : paths) packer.add(std::filesystem::absolute(path).string());
  for (const std::string& field : fields) packer.add(field);
  return packer.bytes();
}

/// What other ranks are reading; waits for them at the end, since they answer in any case.
class Readers {
 public:
  explicit Readers(const Ranks& ranks) : ranks_(ranks), reads_(static_cast<std::size_t>(ranks.count())) {}
  ~Readers() {
    for (int rank = 1; rank < ranks_.count(); ++rank)
      if (reads_[static_cast<std::size_t>(rank)]) ranks_.receive(rank);
  }
  Readers(const Readers&) = delete;
  Readers& operator=(const Readers&) = delete;

  void begin(int rank, std::size_t frame) {
    ranks_.send(rank, request(Asked::read, frame));
    reads_[static_cast<std::size_t>(rank)] = true;
  }
  void wait_for(int rank) {
    reads_[static_cast<std::size_t>(rank)] = false;
    answer_of(ranks_, rank);
  }

 private:
  const Ranks& ranks_;
  std::vector<bool> reads_;
};

/// In a process that serves.
class Reader {
 public:
  void answer(Unpacker& request, Packer& answer) {
    switch (request.take<Asked>()) {
      case Asked::open:
        open(request);
        break;
      case Asked::weld:
        series_->weld(request.take_list<std::int32_t>());
        break;
      case Asked::read:
        values_ = series_->frame(request.take<std::size_t>());
        break;
      case Asked::hand_over:
        answer.add(series_->farthest_moved());
        for (const std::vector<double>& values : values_) answer.add(values);
        values_.clear();
        break;
    }
  }

 private:
  void open(Unpacker& request) {
    std::vector<std::string> paths(request.take<std::size_t>()), fields(request.take<std::size_t>());
    for (std::string& path : paths) path = request.take_text();
    for (std::string& field : fields) field = request.take_text();
    series_.emplace(paths, parse_fields(fields));
  }

  std::optional<ImportedSeries> series_;
  FieldValues values_;  // of the frame that was read last
};

void nothing(int, Unpacker&) {}

}  // namespace

std::unique_ptr<SeriesOnRanks> SeriesOnRanks::open(const Ranks& ranks, const std::vector<std::string>& paths,
                                                   const std::vector<std::string>& fields) {
  const std::vector<SeriesField> parsed = parse_fields(fields);
  std::unique_ptr<SeriesOnRanks> series;
  on_all_ranks(
      ranks, request_to_open(paths, fields), [&] { series.reset(new SeriesOnRanks(ranks, paths, parsed)); },
      nothing);
  return series;
}

FieldValues SeriesOnRanks::handed_over(int rank) const {
  ranks_.send(rank, request(Asked::hand_over));
  Unpacker answer = answer_of(ranks_, rank);
  farthest_moved_ = std::max(farthest_moved_, answer.take<double>());
  FieldValues values(fields().size());
  for (std::vector<double>& list : values) list = answer.take_list<double>();
  return values;
}

void SeriesOnRanks::for_each_frame(const UseFrame& use) const {
  const auto count = static_cast<std::size_t>(ranks_.count());
  const auto rank_of = [&](std::size_t j) { return static_cast<int>(j % count); };
  Readers readers(ranks_);
  for (std::size_t j = 1; j < std::min(count, frames()); ++j) readers.begin(rank_of(j), j);
  for (std::size_t j = 0; j < frames(); ++j) {
    FieldValues values;
    if (const int rank = rank_of(j); rank == 0) {
      values = frame(j);
    } else {
      try {
        readers.wait_for(rank);
      } catch (const std::exception&) {
        frame(j);  // what is wrong with the file is told as by one process
        throw;
      }
      values = handed_over(rank);
      if (j + count < frames()) readers.begin(rank, j + count);
    }
    use(j, values);
  }
}

void SeriesOnRanks::weld(const std::vector<std::int32_t>& number) {
  on_all_ranks(
      ranks_, request(Asked::weld, number), [&] { ImportedSeries::weld(number); }, nothing);
}

void serve_series(const Ranks& ranks) {
  Reader reader;
  serve(ranks, [&](Unpacker& request, Packer& answer) { reader.answer(request, answer); });
}

}  // namespace cleft
