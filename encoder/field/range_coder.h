// An adaptive binary range coder and the models of single binary decisions. Integers only: the same bytes on
// every machine. docs/formats.md specifies it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cleft::code {

/// Probabilities that a decision is 1, in units of 2^-16.
inline constexpr int least_probability = 4, greatest_probability = 65536 - least_probability;

class Encoder {
 public:
  static constexpr bool decodes = false;
  /// Codes `bit`, where p is the probability of 1; returns the bit.
  int bit(int p, int value) {
    const std::uint32_t part = (range_ >> 16) * static_cast<std::uint32_t>(p);
    if (value)
      range_ = part;
    else
      low_ += part, range_ -= part;
    while (range_ < (1u << 24)) shift(), range_ <<= 8;
    return value;
  }
  /// The bytes; up to four zero bytes at the end are left out.
  std::vector<std::uint8_t> finish();

 private:
  void shift();

  std::uint64_t low_ = 0;  // 32 bits and a carry
  std::uint32_t range_ = 0xFFFFFFFF;
  std::vector<std::uint8_t> bytes_;
};

/// Throws InputError if the bytes end too early, or were not read to their end.
class Decoder {
 public:
  static constexpr bool decodes = true;
  explicit Decoder(std::span<const std::uint8_t> bytes);
  int bit(int p, int = 0) {
    const std::uint32_t part = (range_ >> 16) * static_cast<std::uint32_t>(p);
    const int value = code_ < part;
    if (value)
      range_ = part;
    else
      code_ -= part, range_ -= part;
    while (range_ < (1u << 24)) code_ = code_ << 8 | next(), range_ <<= 8;
    return value;
  }
  void finish() const;

 private:
  std::uint32_t next() {
    if (at_ < bytes_.size()) return bytes_[at_++];
    if (++beyond_ > 4) ended_early();
    return 0;
  }
  [[noreturn]] static void ended_early();

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  int beyond_ = 0;  // zero bytes taken after the end
  std::uint32_t range_ = 0xFFFFFFFF, code_ = 0;
};

inline constexpr int farthest = 3071;  ///< that stretch and squash reach: 12 either way

struct Tables {
  std::array<std::int16_t, 4096> stretch;              ///< by p / 16
  std::array<std::uint16_t, 2 * farthest + 1> squash;  ///< from -farthest
  std::array<std::uint16_t, 1024> rate;                ///< 65536 / (n + 1.6)
  Tables();
};
extern const Tables tables;

/// stretch(p) = ln(p / (1 - p)) in units of 1/256, and its inverse squash.
inline int stretch(int p) { return tables.stretch[p >> 4]; }
inline int squash(int x) { return tables.squash[std::clamp(x, -farthest, farthest) + farthest]; }

/// The adaptive probability of one kind of decision; it adapts quickly at first.
struct Chance {
  std::uint16_t p = 32768, seen = 0;

  void learn(int value, int most) {
    const int target = value ? 65535 : 0;
    p = static_cast<std::uint16_t>(p + ((target - p) * static_cast<std::int64_t>(tables.rate[seen]) >> 16));
    if (seen < most) ++seen;
  }
};

/// Codes one decision with one chance, which then adapts.
template <class Coder>
int code_bit(Coder& coder, Chance& chance, int value, int most = 255) {
  const int p = chance.p;
  const int bit = coder.bit(std::clamp(p, least_probability, greatest_probability), value);
  chance.learn(bit, most);
  return bit;
}

/// Mixes N stretched probability estimates of a decision (logistic mixing) with adaptive weights.
template <int N>
struct Mixer {
  std::array<std::int32_t, N> weight;  ///< units of 2^-16

  template <class Coder>
  int code(Coder& coder, const std::array<int, N>& opinion, int value) {
    std::int64_t sum = 0;
    for (int n = 0; n < N; ++n) sum += static_cast<std::int64_t>(weight[n]) * opinion[n];
    const int p = squash(static_cast<int>(sum >> 16));
    const int bit = coder.bit(p, value);
    const int error = 5 * ((bit << 16) - p);
    for (int n = 0; n < N; ++n) {
      const std::int32_t next = weight[n] + ((error * opinion[n] + 32768) >> 16);  // 5 2^16 farthest < 2^31
      weight[n] = std::min(std::max(next, -(1 << 20)), 1 << 20);
    }
    return bit;
  }
};

/// A non-negative integer without a model: as many ones as its binary digits after the first, a zero, the
/// digits. Exp-Golomb of order 0.
template <class Coder>
std::uint64_t code_plain(Coder& coder, std::uint64_t value);

extern template std::uint64_t code_plain(Encoder&, std::uint64_t);
extern template std::uint64_t code_plain(Decoder&, std::uint64_t);

}  // namespace cleft::code
