#include "explorer/study/expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

struct Expression::Node {
  std::string what;  ///< an operator, "number" or "name"
  double number = 0;
  std::size_t name = 0;
  std::shared_ptr<const Node> left, right;
  bool is_condition = false;
};

namespace {

using Node = Expression::Node;
using NodePtr = std::shared_ptr<const Node>;

const std::vector<std::string> comparisons{"<=", ">=", "==", "!=", "<", ">", "="};

class Parser {
 public:
  /// `calls`: those that are found, if there may be any.
  Parser(const std::string& text, const std::vector<std::string>& names,
         std::vector<std::string>* calls = nullptr)
      : text_(text), names_(names), calls_(calls) {}

  NodePtr run() {
    NodePtr node = disjunction();
    skip();
    if (at_ < text_.size()) wrong("'" + text_.substr(at_) + "' is too much");
    if (!node->is_condition) wrong("is a value, not a condition like gape > 3");
    return node;
  }

 private:
  [[noreturn]] void wrong(const std::string& what) const {
    throw InputError("condition '" + text_ + "', place " + std::to_string(at_ + 1) + ": " + what);
  }
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  static bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; }
  bool take(std::string_view token) {
    skip();
    if (text_.compare(at_, token.size(), token) != 0) return false;
    const std::size_t end = at_ + token.size();
    if (in_word(token.back()) && end < text_.size() && in_word(text_[end])) return false;
    at_ = end;
    return true;
  }
  /// Both sides must be conditions, or both values.
  NodePtr join(const std::string& what, NodePtr left, NodePtr right, bool of_conditions, bool is_condition) {
    if (left->is_condition != of_conditions || right->is_condition != of_conditions)
      wrong("'" + what + "' stands between two " + (of_conditions ? "conditions" : "values"));
    return std::make_shared<Node>(Node{what, 0, 0, std::move(left), std::move(right), is_condition});
  }

  NodePtr disjunction() {
    NodePtr node = conjunction();
    while (take("or")) node = join("or", node, conjunction(), true, true);
    return node;
  }
  NodePtr conjunction() {
    NodePtr node = negation();
    while (take("and")) node = join("and", node, negation(), true, true);
    return node;
  }
  NodePtr negation() {
    if (!take("not")) return comparison();
    if (++depth_ > most_nested) wrong("'not's lie too deep in each other");
    const NodePtr node = negation();
    --depth_;
    return join("not", node, node, true, true);
  }
  NodePtr comparison() {
    const NodePtr left = sum();
    for (const std::string& c : comparisons)
      if (take(c)) return join(c == "=" ? "==" : c, left, sum(), false, true);
    return left;
  }
  NodePtr sum() {
    NodePtr node = product();
    while (true) {
      if (take("+"))
        node = join("+", node, product(), false, false);
      else if (take("-"))
        node = join("-", node, product(), false, false);
      else
        return node;
    }
  }
  NodePtr product() {
    NodePtr node = factor();
    while (true) {
      if (take("*"))
        node = join("*", node, factor(), false, false);
      else if (take("/"))
        node = join("/", node, factor(), false, false);
      else
        return node;
    }
  }
  NodePtr factor() {
    if (++depth_ > most_nested) wrong("brackets or signs lie too deep in each other");
    const NodePtr node = signed_or_bracketed();
    --depth_;
    return node;
  }
  NodePtr signed_or_bracketed() {
    if (take("-"))
      return join("-", std::make_shared<Node>(Node{"number", 0, 0, {}, {}, false}), factor(), false, false);
    if (take("(")) {
      const NodePtr node = disjunction();
      if (!take(")")) wrong("a bracket is not closed");
      return node;
    }
    skip();
    if (at_ == text_.size()) wrong("a value is missing");
    return std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.' ? number() : name();
  }
  NodePtr number() {
    std::size_t end = at_;
    while (end < text_.size() && (in_word(text_[end]) || ((text_[end] == '+' || text_[end] == '-') &&
                                                          (text_[end - 1] == 'e' || text_[end - 1] == 'E'))))
      ++end;
    const double value = parse_number(text_.substr(at_, end - at_), "condition '" + text_ + "'");
    at_ = end;
    return std::make_shared<Node>(Node{"number", value, 0, {}, {}, false});
  }
  NodePtr name() {
    std::size_t end = at_;
    while (end < text_.size() && in_word(text_[end])) ++end;
    const std::string word = text_.substr(at_, end - at_);
    if (word.empty()) wrong(std::string("'") + text_[at_] + "' is no value");
    if (calls_ && end < text_.size() && text_[end] == '(') return call(end);
    const auto found = std::find(names_.begin(), names_.end(), word);
    if (found == names_.end()) {
      std::string all;
      for (const std::string& n : names_)
        if (n.find('.') == std::string::npos) all += (all.empty() ? "" : ", ") + n;
      wrong("nothing is named '" + word + "'" + did_you_mean(word, names_) + "; there are " + all +
            " and the parameters");
    }
    at_ = end;
    return std::make_shared<Node>(
        Node{"name", 0, static_cast<std::size_t>(found - names_.begin()), {}, {}, false});
  }

  /// A name with its brackets, which open at a place.
  NodePtr call(std::size_t open) {
    const std::size_t close = text_.find(')', open);
    if (close == std::string::npos) wrong("a bracket is not closed");
    std::string whole = text_.substr(at_, close + 1 - at_);
    std::erase_if(whole, [](unsigned char c) { return std::isspace(c); });
    at_ = close + 1;
    auto found = std::find(calls_->begin(), calls_->end(), whole);
    if (found == calls_->end()) found = calls_->insert(found, whole);
    const auto number = static_cast<std::size_t>(found - calls_->begin());
    return std::make_shared<Node>(Node{"name", 0, names_.size() + number, {}, {}, false});
  }

  const std::string& text_;
  const std::vector<std::string>& names_;
  std::vector<std::string>* calls_;
  std::size_t at_ = 0;
  static constexpr int most_nested = 200;
  int depth_ = 0;
};

double value_of(const Node& n, const std::vector<double>& values) {
  if (n.what == "number") return n.number;
  if (n.what == "name") return values[n.name];
  const double a = value_of(*n.left, values), b = value_of(*n.right, values);
  return n.what == "+" ? a + b : n.what == "-" ? a - b : n.what == "*" ? a * b : a / b;
}

bool holds_at(const Node& n, const std::vector<double>& values) {
  if (n.what == "or") return holds_at(*n.left, values) || holds_at(*n.right, values);
  if (n.what == "and") return holds_at(*n.left, values) && holds_at(*n.right, values);
  if (n.what == "not") return !holds_at(*n.left, values);
  const double a = value_of(*n.left, values), b = value_of(*n.right, values);
  if (std::isnan(a) || std::isnan(b)) return false;
  return n.what == "<"    ? a < b
         : n.what == "<=" ? a <= b
         : n.what == ">"  ? a > b
         : n.what == ">=" ? a >= b
         : n.what == "==" ? a == b
                          : a != b;
}

/// Of a comparison, `negated` or not.
double excess_of(std::string what, bool negated, double a, double b) {
  constexpr double equal = 1e-3;
  if (std::isnan(a) || std::isnan(b)) return HUGE_VAL;
  if (negated)
    what = what == "<"    ? ">="
           : what == "<=" ? ">"
           : what == ">"  ? "<="
           : what == ">=" ? "<"
           : what == "==" ? "!="
                          : "==";
  const double apart = a == 0 || b == 0 ? a - b : (a - b) / std::max(std::abs(a), std::abs(b));
  if (what == "==") return std::abs(apart) - equal;
  if (what == "!=") return apart == 0 ? equal : 0;
  return what[0] == '<' ? apart : -apart;
}

double excess_at(const Node& n, bool negated, const std::vector<double>& values) {
  if (n.what == "not") return excess_at(*n.left, !negated, values);
  if (n.what == "and" || n.what == "or") {
    const double a = excess_at(*n.left, negated, values), b = excess_at(*n.right, negated, values);
    return (n.what == "and") != negated ? std::max(a, b) : std::min(a, b);
  }
  return excess_of(n.what, negated, value_of(*n.left, values), value_of(*n.right, values));
}

bool occurs(const Node& n, std::size_t name) {
  if (n.what == "name") return n.name == name;
  return (n.left && occurs(*n.left, name)) || (n.right && occurs(*n.right, name));
}

}  // namespace

Expression::Expression(const std::string& text, const std::vector<std::string>& names)
    : root_(Parser(text, names).run()) {}

Expression Expression::with_calls(const std::string& text, std::vector<std::string>& names) {
  std::vector<std::string> calls;
  Expression expression(Parser(text, names, &calls).run());
  names.insert(names.end(), calls.begin(), calls.end());
  return expression;
}

double Expression::excess(const std::vector<double>& values) const {
  return excess_at(*root_, false, values);
}
bool Expression::holds(const std::vector<double>& values) const { return holds_at(*root_, values); }
bool Expression::uses(std::size_t name) const { return occurs(*root_, name); }

}  // namespace cleft
