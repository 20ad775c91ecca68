#include "tradeoff/rivals/zfp_rival.h"

#include <zfp.h>

#include <memory>
#include <numeric>

#include "base/stopwatch.h"
#include "tradeoff/rivals/nearest.h"

namespace cleft {

namespace {

/// One array through zfp and back, in place.
ZfpCost through_zfp(std::vector<float>& values, std::size_t nx, std::size_t ny, std::size_t nz) {
  const std::unique_ptr<zfp_field, decltype(&zfp_field_free)> field(
      nz == 1 ? zfp_field_2d(values.data(), zfp_type_float, nx, ny)
              : zfp_field_3d(values.data(), zfp_type_float, nx, ny, nz),
      zfp_field_free);
  const std::unique_ptr<zfp_stream, decltype(&zfp_stream_close)> stream(zfp_stream_open(nullptr),
                                                                        zfp_stream_close);
  zfp_stream_set_accuracy(stream.get(), 1);
  std::vector<unsigned char> buffer(zfp_stream_maximum_size(stream.get(), field.get()));
  const std::unique_ptr<bitstream, decltype(&stream_close)> bits(stream_open(buffer.data(), buffer.size()),
                                                                 stream_close);
  zfp_stream_set_bit_stream(stream.get(), bits.get());
  zfp_stream_rewind(stream.get());
  const std::size_t bytes = zfp_compress(stream.get(), field.get());
  const double seconds = least_seconds(3, [&] {
    zfp_stream_rewind(stream.get());
    zfp_decompress(stream.get(), field.get());
  });
  return {static_cast<double>(bytes), seconds};
}

}  // namespace

bool zfp_is_there() { return true; }

std::string name_of(ZfpLayout layout) {
  return layout == ZfpLayout::interleaved  ? "2D, 3N x F"
         : layout == ZfpLayout::components ? "2D, N x F thrice"
                                           : "3D";
}

ZfpCost through_zfp(const NodeData& data, std::span<const int> order, ZfpLayout layout, double step,
                    std::vector<float>& approximation) {
  const std::size_t kept = order.size(), frames = data.frames;
  const auto factor = static_cast<float>(1 / step), back = static_cast<float>(step);
  const bool apart = layout == ZfpLayout::components;
  ZfpCost cost;
  std::vector<float> block;
  for (std::size_t part = 0; part < (apart ? 3 : 1); ++part) {
    const std::size_t axes = apart ? 1 : 3;
    const auto each = [&](const auto& visit) {  // visit(place in the block, place in the data)
      for (std::size_t j = 0, at = 0; j < frames; ++j)
        for (std::size_t i = 0; i < kept; ++i)
          for (std::size_t axis = 0; axis < axes; ++axis, ++at)
            visit(at, (j * data.nodes + static_cast<std::size_t>(order[i])) * 3 + part + axis);
    };
    block.resize(axes * kept * frames);
    each([&](std::size_t at, std::size_t from) { block[at] = factor * data.values[from]; });
    const ZfpCost part_cost = layout == ZfpLayout::triples ? through_zfp(block, 3, kept, frames)
                                                           : through_zfp(block, axes * kept, frames, 1);
    cost.bytes += part_cost.bytes, cost.decode_seconds += part_cost.decode_seconds;
    each([&](std::size_t at, std::size_t to) { approximation[to] = back * block[at]; });
  }
  return cost;
}

Compressed zfp_within(const NodeData& data, std::span<const int> order, Goal goal, double limit) {
  std::vector<float> approximation(data.values.size());
  const double first = limit * data.largest;
  ZfpLayout best = ZfpLayout::interleaved;
  double least = 0;
  for (const ZfpLayout layout : zfp_layouts)  // the same step gives about the same error
    if (const double bytes = through_zfp(data, order, layout, first, approximation).bytes;
        least == 0 || bytes < least)
      least = bytes, best = layout;
  return coarsest_within(
      [&](double step) {
        const ZfpCost cost = through_zfp(data, order, best, step, approximation);
        return Compressed{cost.bytes, errors_of(data, approximation), name_of(best),
                          1e9 * cost.decode_seconds / static_cast<double>(data.nodes * data.frames)};
      },
      goal, limit, first);
}

std::optional<Compressed> decimated_within(const NodeData& data, const std::vector<Sample>& samples,
                                           Goal goal, double limit) {
  std::optional<Compressed> best;
  for (const int n : {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64}) {
    std::vector<int> kept;
    for (std::size_t i = 0; i < data.nodes; i += static_cast<std::size_t>(n))
      kept.push_back(static_cast<int>(i));
    const std::vector<int> nearest = nearest_kept(samples, kept);
    std::vector<float> approximation(data.values.size());
    const auto fill = [&](const std::vector<float>& source) {
      for (std::size_t j = 0; j < data.frames; ++j)
        for (std::size_t i = 0; i < data.nodes; ++i)
          for (std::size_t axis = 0; axis < 3; ++axis)
            approximation[(j * data.nodes + i) * 3 + axis] =
                source[(j * data.nodes + static_cast<std::size_t>(nearest[i])) * 3 + axis];
      return errors_of(data, approximation);
    };
    if (of(fill(data.values), goal) > 0.9 * limit) break;  // further apart, it is worse still
    const Compressed c = coarsest_within(
        [&](double step) {
          const double bytes = through_zfp(data, kept, ZfpLayout::components, step, approximation).bytes;
          return Compressed{bytes, fill(std::vector<float>(approximation)),
                            "every " + std::to_string(n) + "th node"};
        },
        goal, limit, limit * data.largest);
    if (!best || c.bytes < best->bytes) best = c;
  }
  return best;
}

}  // namespace cleft
