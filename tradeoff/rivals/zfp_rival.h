// zfp in its fixed-accuracy mode on the node array (Lindstrom 2014). Not built without libzfp.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "tradeoff/rivals/node_data.h"

namespace cleft {

bool zfp_is_there();

/// Layouts of the array for zfp; x varies fastest.
enum class ZfpLayout { interleaved, components, triples };
inline constexpr ZfpLayout zfp_layouts[] = {ZfpLayout::interleaved, ZfpLayout::components,
                                            ZfpLayout::triples};
std::string name_of(ZfpLayout layout);

struct ZfpCost {
  double bytes = 0, decode_seconds = 0;
};

/// Compressed and decompressed: the nodes of `order` (node order[i] is the i-th), all frames. zfp rounds its
/// tolerance down to a power of two, so the values are divided by `step`, and the tolerance is 1.
/// `approximation` is as long as the data; values of nodes that are not in `order` are unchanged.
ZfpCost through_zfp(const NodeData& data, std::span<const int> order, ZfpLayout layout, double step,
                    std::vector<float>& approximation);

/// All nodes in the given order, in the layout that takes the fewest bytes.
Compressed zfp_within(const NodeData& data, std::span<const int> order, Goal goal, double limit);

/// Every n-th node by zfp, the others with the displacement of the nearest one kept on the same side; the n
/// of 2, 3, 4, 6, 8, ... that takes the fewest bytes. None if no n is within the limit.
std::optional<Compressed> decimated_within(const NodeData& data, const std::vector<Sample>& samples,
                                           Goal goal, double limit);

}  // namespace cleft
