// Conditions, and where they hold in a study.
#include "explorer/study/find.h"

#include <cmath>
#include <random>

#include "base/text.h"
#include "explorer/study/case_figures.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

const std::vector<std::string> names{"a", "b", "skin.c"};

bool holds(const std::string& text, const std::vector<double>& values) {
  return Expression(text, names).holds(values);
}

TEST(Expression, BindsAsInMathematics) {
  const std::vector<double> v{2, 3, 5};
  EXPECT_TRUE(holds("a + b * skin.c == 17", v));
  EXPECT_TRUE(holds("(a + b) * skin.c = 25", v));
  EXPECT_TRUE(holds("10 - a - b == 5", v));
  EXPECT_TRUE(holds("12 / a / b == 2", v));
  EXPECT_TRUE(holds("-a + -b < -4.5e0", v));
  EXPECT_TRUE(holds("a > 1 or a > 5 and b > 5", v));
  EXPECT_FALSE(holds("(a > 1 or a > 5) and b > 5", v));
  EXPECT_TRUE(holds("not a > 5 and b >= 3", v));
  EXPECT_TRUE(holds("1e-3<a", v));
  EXPECT_FALSE(holds("a < b", {std::nan(""), 3, 5})) << "what is no number fulfils nothing";
  EXPECT_FALSE(holds("a != b", {std::nan(""), 3, 5}));
}

/// A random condition as text, with all brackets, next to what it is worth.
struct Random {
  std::mt19937 generator{7};
  std::vector<double> values{2, -1, 0.5};

  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(generator); }
  std::pair<std::string, double> value(int depth) {
    if (depth == 0 || below(3) == 0) {
      if (const int i = below(4); i < 3) return {names[i], values[i]};
      const int number = below(9);
      return {std::to_string(number), number};
    }
    const auto [left, a] = value(depth - 1);
    const auto [right, b] = value(depth - 1);
    const char op = "+-*/"[below(4)];
    return {"(" + left + op + right + ")", op == '+' ? a + b : op == '-' ? a - b : op == '*' ? a * b : a / b};
  }
  std::pair<std::string, bool> condition(int depth) {
    if (depth == 0 || below(3) == 0) {
      const auto [left, a] = value(2);
      const auto [right, b] = value(2);
      const bool numbers = !std::isnan(a) && !std::isnan(b);
      switch (below(4)) {
        case 0:
          return {left + " < " + right, numbers && a < b};
        case 1:
          return {left + " >= " + right, numbers && a >= b};
        case 2:
          return {left + " == " + right, numbers && a == b};
        default:
          return {left + " != " + right, numbers && a != b};
      }
    }
    const auto [left, a] = condition(depth - 1);
    const auto [right, b] = condition(depth - 1);
    if (below(4) == 0) return {"not (" + left + ")", !a};
    return below(2) ? std::pair{"(" + left + " and " + right + ")", a && b}
                    : std::pair{"(" + left + " or " + right + ")", a || b};
  }
};

TEST(Expression, RandomConditionsAreWorthWhatTheyWereMadeOf) {
  Random random;
  int held = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto [text, worth] = random.condition(4);
    EXPECT_EQ(holds(text, random.values), worth) << text;
    held += worth;
  }
  EXPECT_GT(held, 500);
  EXPECT_LT(held, 2500);
}

TEST(Expression, WhatIsNoConditionIsRefusedWithItsPlace) {
  for (const char* text : {"", "a", "a >", "> 3", "a > 3 and", "a > (3", "a > 3)", "a + (b > 3) > 2", "not a",
                           "a b", "a > 3 or b", "1 < a < 3", "a > 3..2", "a $ 3", "a > 3 and and b > 1"}) {
    try {
      Expression{text, names};
      ADD_FAILURE() << text;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("condition '"), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(Expression(std::string(100000, '('), names), InputError);
  EXPECT_THROW(Expression(std::string(100000, '-'), names), InputError);
}

TEST(Expression, AnUnknownNameGetsTheNearest) {
  try {
    Expression("skin.d > 3", names);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("'skin.c'"), std::string::npos) << e.what();
  }
}

TEST(Expression, TellsHowFarItIsFromHolding) {
  const std::vector<std::string> names{"a", "b"};
  const auto excess = [&](const std::string& text, double a, double b) {
    return Expression(text, names).excess({a, b});
  };
  EXPECT_DOUBLE_EQ(excess("a < b", 3, 4), -0.25);
  EXPECT_DOUBLE_EQ(excess("a < b", 4, 3), 0.25);
  EXPECT_DOUBLE_EQ(excess("a >= b", 4, 3), -0.25);
  EXPECT_DOUBLE_EQ(excess("not a >= b", 4, 3), 0.25);
  EXPECT_DOUBLE_EQ(excess("a > 0", -3, 0), 3);
  EXPECT_DOUBLE_EQ(excess("a < b and a < 2", 3, 4), 1. / 3);
  EXPECT_DOUBLE_EQ(excess("a < b or a < 2", 3, 4), -0.25);
  EXPECT_DOUBLE_EQ(excess("not (a < b or a < 2)", 3, 4), 0.25);
  EXPECT_LT(excess("a == b", 1, 1.0005), 0);
  EXPECT_GT(excess("a == b", 1, 1.002), 0);
  EXPECT_GT(excess("not a == b", 1, 1), 0);
  EXPECT_EQ(excess("a < b", std::nan(""), 1), HUGE_VAL);
}

TEST(Expression, TakesNamesWithNumbers) {
  std::vector<std::string> names{"gape", "cut.depth"};
  const Expression e =
      Expression::with_calls("gape( 3, 18 ) > gape and v(1,2,3) < (cut.depth + gape(3,18))", names);
  EXPECT_EQ(names, (std::vector<std::string>{"gape", "cut.depth", "gape(3,18)", "v(1,2,3)"}));
  EXPECT_TRUE(e.holds({1, 2, 3, 4}));
  EXPECT_FALSE(e.holds({1, 2, 3, 6}));
  EXPECT_TRUE(e.uses(3));
  EXPECT_THROW(Expression::with_calls("gape(3 > 2", names), InputError);
  EXPECT_THROW(Expression("gape(3) > 2", {"gape"}), InputError);
}

TEST(Condition, HoldsWhereTheFieldSaysSo) {
  const Field field = synthetic_field(5);
  const auto found = Condition("gape > 3").find(field);
  ASSERT_TRUE(found);
  EXPECT_GT(gape(field, found->best_u, found->best_t), 3);
  // On a grid of its own: nothing outside the ranges found, by more than their steps, has such a gape.
  double first = 1e9, last = -1e9, least = 1e9, greatest = -1e9, widest = 0;
  for (int j = 0; j <= 240; ++j)
    for (int i = 0; i <= 320; ++i) {
      const double t = 30. * j / 240, u = -15 + 30. * i / 320, opening = gape(field, u, t);
      if (opening <= 3) continue;
      first = std::min(first, t), last = std::max(last, t);
      least = std::min(least, u), greatest = std::max(greatest, u);
      widest = std::max(widest, opening);
    }
  EXPECT_NEAR(found->first_t, first, 30. / 60);
  EXPECT_NEAR(found->last_t, last, 30. / 60);
  EXPECT_NEAR(found->least_u, least, 30. / 80);
  EXPECT_NEAR(found->greatest_u, greatest, 30. / 80);
  EXPECT_NEAR(found->gape, widest, 0.02 * widest) << "the gape is flat where it is widest";
  EXPECT_FALSE(Condition("gape > 50").find(field));
  const auto early = Condition("gape > 1 and t < 10 and u < -10").find(field);
  ASSERT_TRUE(early);
  EXPECT_LT(early->last_t, 10);
  EXPECT_LT(early->greatest_u, -10);
}

TEST_F(SessionTest, FindFadesTheCasesWhereItHoldsNowhere) {
  open();
  EXPECT_EQ(refused("find gap > 3").find("condition"), 0u);
  say("find gape > 4 and tissue.young_modulus < 0.02");
  EXPECT_FALSE(session_.brushed(0)) << "2.1 mm wide";
  EXPECT_FALSE(session_.brushed(1)) << "2.4 mm wide";
  EXPECT_TRUE(session_.brushed(2)) << "5.1 mm wide";
  EXPECT_FALSE(session_.brushed(3)) << "wide, but stiff";
  EXPECT_NE(answers_.find("1 of 4 cases"), std::string::npos);
  EXPECT_NE(answers_.find("case 3: "), std::string::npos);
  ASSERT_FALSE(session_.study()->hash(2).empty());
  const std::string hash = " mm (" + session_.study()->hash(2) + ")";
  EXPECT_NE(answers_.find(hash), std::string::npos) << answers_;
  say("brush gape 0 3");
  EXPECT_FALSE(session_.brushed(2)) << "both have to hold";
  say("find clear");
  EXPECT_TRUE(session_.brushed(0));
  EXPECT_FALSE(session_.brushed(2));
  say("brush clear");
  EXPECT_TRUE(session_.brushed(2));
  EXPECT_NE(refused("brush gap 0 3").find("'gape'"), std::string::npos);
}

}  // namespace
}  // namespace cleft
