#include "encoder/field/range_coder.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"

namespace cleft::code {

// No entry is so near to the middle between two integers that the last digits of exp and log could matter; a
// test asserts it.
Tables::Tables() {
  for (int p = 0; p < 4096; ++p)
    stretch[p] = static_cast<std::int16_t>(std::lround(256 * std::log((p + 0.5) / (4095.5 - p))));
  for (int x = -farthest; x <= farthest; ++x)
    squash[x + farthest] = static_cast<std::uint16_t>(std::clamp<long>(
        std::lround(65536 / (1 + std::exp(-x / 256.))), least_probability, greatest_probability));
  for (int n = 0; n < 1024; ++n) rate[n] = static_cast<std::uint16_t>(655360 / (10 * n + 16));
}

const Tables tables;

void Encoder::shift() {
  if (low_ >> 32) {  // a carry into the bytes before
    std::size_t at = bytes_.size();
    while (at > 0 && ++bytes_[at - 1] == 0) --at;
    low_ &= 0xFFFFFFFF;
  }
  bytes_.push_back(static_cast<std::uint8_t>(low_ >> 24));
  low_ = (low_ & 0x00FFFFFF) << 8;
}

std::vector<std::uint8_t> Encoder::finish() {
  // Of the numbers from low to low + range - 1 the one with most zero bits at its end.
  for (int zeros = 32; zeros >= 0; --zeros) {
    const std::uint64_t unit = std::uint64_t{1} << zeros, candidate = (low_ + unit - 1) & ~(unit - 1);
    if (candidate - low_ >= range_) continue;
    low_ = candidate;
    break;
  }
  for (int i = 0; i < 4; ++i) shift();
  for (int i = 0; i < 4 && !bytes_.empty() && bytes_.back() == 0; ++i) bytes_.pop_back();
  return std::move(bytes_);
}

Decoder::Decoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
  for (int i = 0; i < 4; ++i) code_ = code_ << 8 | next();
}

void Decoder::finish() const {
  if (at_ < bytes_.size()) throw InputError("coded numbers go on after their end");
}

void Decoder::ended_early() { throw InputError("coded numbers end too early"); }

template <class Coder>
std::uint64_t code_plain(Coder& coder, std::uint64_t value) {
  int digits = 0;
  const int wanted = Coder::decodes ? 0 : std::bit_width(value + 1) - 1;
  while (coder.bit(32768, digits < wanted))
    if (++digits > 48) throw InputError("a coded number is too large");
  std::uint64_t read = 1;
  for (int i = digits - 1; i >= 0; --i)
    read = read << 1 | static_cast<std::uint64_t>(coder.bit(32768, static_cast<int>((value + 1) >> i & 1)));
  return read - 1;
}

template std::uint64_t code_plain(Encoder&, std::uint64_t);
template std::uint64_t code_plain(Decoder&, std::uint64_t);

}  // namespace cleft::code
