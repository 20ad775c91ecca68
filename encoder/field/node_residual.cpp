#include "encoder/field/node_residual.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "encoder/field/range_coder.h"

namespace cleft {

namespace {

using code::Chance;
using code::Mixer;

constexpr int earlier_nodes = 3;

/// One component of a node over the frames, with a margin of zeros before and after.
class History {
 public:
  explicit History(int frames) : data_(static_cast<std::size_t>(frames) + 4, 0) {}
  std::int32_t& operator[](int frame) { return data_[frame + 2]; }
  std::int32_t operator[](int frame) const { return data_[frame + 2]; }

 private:
  std::vector<std::int32_t> data_;
};

int size_of(std::int32_t value) {
  return static_cast<int>(std::min<std::int64_t>(std::abs(std::int64_t{value}), 40));
}

int level_of(int sum) {
  constexpr std::array<std::uint8_t, 40> levels = {0, 1, 2,  3,  4,  4,  5,  5,  6,  6,  6,  7, 7, 7,
                                                   7, 8, 8,  8,  8,  8,  9,  9,  9,  9,  9,  9, 9, 9,
                                                   9, 9, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10};
  return sum < 40 ? levels[sum] : sum < 80 ? 11 : sum < 160 ? 12 : 13;
}

int sign_of(std::int32_t value) { return value < 0 ? 0 : value > 0 ? 2 : 1; }

template <class Coder>
class Model {
 public:
  Model(Coder& coder, int components, int frames)
      : coder_(coder),
        components_(components),
        nodes_(earlier_nodes + 1,
               std::vector<History>(static_cast<std::size_t>(components), History(frames))),
        third_(static_cast<std::size_t>(components) * 14 * 6 * 16) {
    for (auto& mixer : mixers_) mixer.weight = {26214, 26214, 26214};
  }

  /// One node: components x frames values, read where the coder decodes.
  void code_node(std::int32_t* values, int frames) {
    std::rotate(nodes_.begin(), nodes_.end() - 1, nodes_.end());
    for (int c = 0; c < components_; ++c) {
      const std::size_t k = c;
      History& own = nodes_[0][k];
      const History &last = nodes_[1][k], &second = nodes_[2][k], &third = nodes_[3][k];
      const History *other = c > 0 ? &nodes_[0][k - 1] : nullptr, *another = c > 1 ? &nodes_[0][0] : nullptr;
      for (int f = 0; f < frames; ++f) {
        const int in_time = 2 * size_of(own[f - 1]) + size_of(own[f - 2]);
        const int beside =
            2 * size_of(last[f]) + size_of(last[f + 1]) + size_of(second[f]) + size_of(third[f]);
        const int across = (other ? size_of((*other)[f]) : 0) + (another ? size_of((*another)[f]) : 0);
        const int all = level_of(in_time + beside + across);
        const int signs =
            sign_of(own[f - 1]) * 27 + sign_of(last[f]) * 9 + sign_of(second[f]) * 3 + sign_of(own[f - 2]);
        const Contexts contexts{(level_of(in_time) * 14 + level_of(beside)) * 16,
                                (signs * 6 + std::min(all, 5)) * 16,
                                ((c * 14 + all) * 6 + std::min(level_of(across), 5)) * 16, all};
        std::int32_t& value = values[static_cast<std::size_t>(c) * frames + f];
        own[f] = value = code_value(contexts, value);
      }
    }
  }

 private:
  struct Contexts {
    int first, second, third, selected;
  };

  int decide(const Contexts& at, int decision, int wanted) {
    Chance &a = first_[at.first + decision], &b = second_[at.second + decision],
           &c = third_[at.third + decision];
    const int bit = mixers_[decision * 14 + at.selected].code(
        coder_, std::array<int, 3>{code::stretch(a.p), code::stretch(b.p), code::stretch(c.p)}, wanted);
    a.learn(bit, 1023), b.learn(bit, 1023), c.learn(bit, 1023);
    return bit;
  }

  std::int32_t code_value(const Contexts& at, std::int32_t value) {
    if (!decide(at, 0, value != 0)) return 0;
    const int negative = decide(at, 1, value < 0);
    const std::int64_t beyond = std::abs(std::int64_t{value}) - 1;
    std::int64_t more = 0;
    while (more < 14 && decide(at, 2 + static_cast<int>(more), beyond > more)) ++more;
    if (more == 14)
      more += static_cast<std::int64_t>(code::code_plain(coder_, static_cast<std::uint64_t>(beyond - 14)));
    if (more > std::numeric_limits<std::int32_t>::max() - 1) throw InputError("a coded number is too large");
    return static_cast<std::int32_t>(negative ? -more - 1 : more + 1);
  }

  Coder& coder_;
  int components_;
  std::vector<std::vector<History>> nodes_;  // this one, and those before it
  std::vector<Chance> first_ = std::vector<Chance>(14 * 14 * 16);
  std::vector<Chance> second_ = std::vector<Chance>(81 * 6 * 16);
  std::vector<Chance> third_;
  std::array<Mixer<3>, 16 * 14> mixers_;
};

}  // namespace

void SmallIntegers::set(std::size_t i, std::int32_t number) {
  if (auto* bytes = std::get_if<std::vector<std::int8_t>>(&numbers_)) {
    if (std::in_range<std::int8_t>(number)) {
      (*bytes)[i] = static_cast<std::int8_t>(number);
      return;
    }
    numbers_ = std::vector<std::int32_t>(bytes->begin(), bytes->end());
  }
  std::get<std::vector<std::int32_t>>(numbers_)[i] = number;
}

SmallIntegers SmallIntegers::joined(std::vector<SmallIntegers> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  std::size_t count = 0;
  for (const SmallIntegers& part : parts) count += part.size();
  SmallIntegers all(count);
  std::size_t at = 0;
  for (SmallIntegers& part : parts) {
    for (std::size_t i = 0; i < part.size(); ++i) all.set(at++, part[i]);
    part = {};
  }
  return all;
}

bool operator==(const SmallIntegers& a, const SmallIntegers& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) return false;
  return true;
}

std::size_t CodedResidual::bytes() const {
  std::size_t sum = 0;
  for (const auto& block_bytes : blocks) sum += block_bytes.size();
  return sum;
}

std::vector<std::uint8_t> encode_block(std::span<const std::int32_t> values, int components, int frames) {
  code::Encoder coder;
  Model<code::Encoder> model(coder, components, frames);
  std::vector<std::int32_t> of_node(static_cast<std::size_t>(components) * static_cast<std::size_t>(frames));
  for (std::size_t first = 0; first < values.size(); first += of_node.size()) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first), of_node.size(), of_node.begin());
    model.code_node(of_node.data(), frames);  // returns its input
  }
  return coder.finish();
}

SmallIntegers decode_block(std::span<const std::uint8_t> bytes, int nodes, int components, int frames) {
  std::vector<std::int32_t> of_node(static_cast<std::size_t>(components) * static_cast<std::size_t>(frames));
  SmallIntegers values(of_node.size() * static_cast<std::size_t>(nodes));
  code::Decoder coder(bytes);
  Model<code::Decoder> model(coder, components, frames);
  for (std::size_t n = 0; n < static_cast<std::size_t>(nodes); ++n) {
    model.code_node(of_node.data(), frames);
    for (std::size_t i = 0; i < of_node.size(); ++i) values.set(n * of_node.size() + i, of_node[i]);
  }
  coder.finish();
  return values;
}

CodedResidual coded(const NodeResidual& residual, int block) {
  CodedResidual result{residual.quantum,
                       residual.nodes,
                       residual.frames,
                       residual.components,
                       residual.first_frame,
                       block,
                       {}};
  result.blocks.resize(static_cast<std::size_t>(std::max(1, (result.nodes - 1) / result.block + 1)));
  parallel_for(static_cast<int>(result.blocks.size()), [&](int b) {
    const std::size_t of_node =
        static_cast<std::size_t>(residual.components) * static_cast<std::size_t>(residual.frames);
    std::vector<std::int32_t> values(of_node * static_cast<std::size_t>(result.nodes_of(b)));
    const std::size_t first = of_node * static_cast<std::size_t>(result.first_of(b));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = residual.values[first + i];
    result.blocks[b] = encode_block(values, residual.components, residual.frames);
  });
  return result;
}

NodeResidual decoded(const CodedResidual& residual) {
  NodeResidual result{residual.quantum,    residual.nodes,      residual.frames, {},
                      residual.components, residual.first_frame};
  std::vector<SmallIntegers> blocks(residual.blocks.size());
  parallel_for(static_cast<int>(blocks.size()), [&](int b) {
    blocks[b] = decode_block(residual.blocks[b], residual.nodes_of(b), residual.components, residual.frames);
  });
  result.values = SmallIntegers::joined(std::move(blocks));
  return result;
}

}  // namespace cleft
