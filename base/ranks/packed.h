// Values as bytes, for messages between processes of one program.
#pragma once

#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/ranks/ranks.h"

namespace cleft {

/// Appends values to a message.
class Packer {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(std::as_bytes(std::span(&value, 1)));
  }
  template <class T>
  void add(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(values.size()), append(std::as_bytes(values));
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::span<const T>(values));
  }
  void add(const std::string& text) { add(std::span<const char>(text)); }

  const Bytes& bytes() const { return bytes_; }

 private:
  void append(std::span<const std::byte> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }

  Bytes bytes_;
};

/// Takes them from it, in the same order.
class Unpacker {
 public:
  explicit Unpacker(Bytes bytes) : bytes_(std::move(bytes)) {}

  template <class T>
  T take() {
    T value;
    copy(&value, sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> take_list() {
    std::vector<T> values(take<std::size_t>());
    copy(values.data(), values.size() * sizeof(T));
    return values;
  }
  std::string take_text() {
    const std::vector<char> text = take_list<char>();
    return {text.begin(), text.end()};
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }

  Bytes bytes_;
  std::size_t at_ = 0;
};

}  // namespace cleft
