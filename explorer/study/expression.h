// Conditions like "gape > 3 and (t < 20 or not tissue.young_modulus >= 0.02)".
//
//   or, and, not; < <= > >= == != (also =); + - * / and brackets; numbers; dotted names.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cleft {

class Expression {
 public:
  /// Throws InputError with the position of a syntax error, or with the nearest of `names` for an unknown
  /// name.
  Expression(const std::string& text, const std::vector<std::string>& names);
  /// Takes names with numbers in brackets too, like gape(12, 20): each is appended to `names`, without
  /// blanks.
  static Expression with_calls(const std::string& text, std::vector<std::string>& names);

  /// `values` has one for each of `names`. A comparison with NaN does not hold.
  bool holds(const std::vector<double>& values) const;
  /// How far the values are from fulfilling it, over the greater side of the comparison that decides (as it
  /// is where a side is 0): at most 0 where it holds. Here == holds within a thousandth, and < where both
  /// sides are equal.
  double excess(const std::vector<double>& values) const;
  /// Whether the name with this index occurs.
  bool uses(std::size_t name) const;

  struct Node;

 private:
  explicit Expression(std::shared_ptr<const Node> root) : root_(std::move(root)) {}
  std::shared_ptr<const Node> root_;
};

}  // namespace cleft
