// The level of detail against brute force: every vertex at many moments, with and without it.
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

class DetailTest : public SessionTest {
 protected:
  /// Two cuts whose wounds overlap, and that relieve each other.
  void beside_each_other() {
    cut_plate();
    say("cut -10,9,0,0,0,1 10,12,0,0,0,1 depth 2");
  }
  /// Two cuts in one line: at the end of one the other adds to the tension.
  void one_after_the_other() {
    cut_plate();
    say("undo");
    say("cut -24,0.7,0,0,0,1 -10,0.7,0,0,0,1 -2,0.7,0,0,0,1");
    say("cut 2,0.7,0,0,0,1 10,0.7,0,0,0,1 24,0.7,0,0,0,1");
  }
  std::vector<double> moments() {
    std::vector<double> times;
    for (int i = 0; i <= 400; ++i) times.push_back(session_.duration() * i / 400);
    return times;
  }
};

TEST_F(DetailTest, WhatStaysAtRestMovesLessAndAllElseIsBitForBitAsItWas) {
  for (int cuts = 0; cuts < 3; ++cuts) {
    if (cuts == 0) cut_plate();
    if (cuts == 1) beside_each_other();
    if (cuts == 2) one_after_the_other();
    const auto whole = session_.scene();
    const std::vector<Vec3>& rest = whole->surface().points;
    std::vector<double> largest(rest.size());
    std::vector<Vec3> x, y;
    for (const double t : moments()) {
      whole->positions(t, x);
      for (std::size_t v = 0; v < rest.size(); ++v) largest[v] = std::max(largest[v], norm(x[v] - rest[v]));
    }
    std::size_t before = 0;
    for (const double mm : {1e-3, 0.01, 0.1, 0.3}) {
      const auto some = whole->with_detail(mm);
      ASSERT_TRUE(some);
      EXPECT_EQ(&some->surface(), &whole->surface());
      const LeftOut out = *some->left_out();
      const std::vector<bool> moving = some->moving(), could = whole->moving();
      double error = 0;
      std::size_t left = 0, less = 0;
      for (std::size_t v = 0; v < rest.size(); ++v) {
        EXPECT_TRUE(could[v] || !moving[v]);
        less += could[v] && largest[v] <= 0.9 * mm;
        if (!could[v] || moving[v]) continue;
        ++left;
        error = std::max(error, largest[v]);
      }
      EXPECT_GT(left, before) << mm;
      before = left;
      EXPECT_GT(static_cast<double>(left), 0.85 * static_cast<double>(less))
          << mm << ": few are kept in vain";
      EXPECT_GE(out.vertices, left) << "counted for every cut";
      EXPECT_LE(error, out.error + 1e-13) << "rounding of places of some 10 mm";
      EXPECT_LE(out.error, mm);
      for (const double t : moments()) {
        whole->positions(t, x), some->positions(t, y);
        for (std::size_t v = 0; v < rest.size(); ++v)
          ASSERT_EQ(y[v], moving[v] ? x[v] : rest[v]) << "vertex " << v << " at " << t << ", detail " << mm;
      }
    }
  }
}

TEST_F(DetailTest, IsPartOfTheStateAndOffAtFirst) {
  cut_plate();
  EXPECT_FALSE(state().detail);
  EXPECT_EQ(state_to_json(state()).find("\"detail\""), std::string::npos);
  say("detail 0.25px");
  EXPECT_EQ(text_of(*state().detail), "0.25px");
  say("detail 10um");
  say("save " + folder_ / "a.json");
  say("detail off");
  EXPECT_FALSE(state().detail);
  say("load " + folder_ / "a.json");
  EXPECT_EQ(text_of(*state().detail), "10um");
}

TEST_F(DetailTest, InfoTellsWhatIsLeftOutAndByHowMuchItIsOff) {
  cut_plate();
  say("info");
  EXPECT_EQ(answers_.find("\ndetail"), std::string::npos) << answers_;
  say("detail 100um");
  say("info");
  const LeftOut out = *session_.scene()->with_detail(0.1)->left_out();
  EXPECT_GT(out.vertices, 0u);
  EXPECT_NE(answers_.find("detail 100um: " + std::to_string(out.vertices) + " of " + std::to_string(out.of)),
            std::string::npos)
      << answers_;
  say("detail 0.25px");
  answers_.clear();
  say("info");
  EXPECT_NE(answers_.find("detail 0.25px: no picture"), std::string::npos) << answers_;
  session_.see(DetailSeen{{10, 40, 0.0625}, 0.125});
  answers_.clear();
  say("info");
  EXPECT_NE(answers_.find("10 of 40 vertices that the cuts move are left at rest, off by at most 0.0625 mm, "
                          "0.125 pixels"),
            std::string::npos)
      << answers_;
  say("detail 0.5px");
  EXPECT_FALSE(session_.seen()) << "no picture has that yet";
  say("patch");
  say("detail 10um");
  answers_.clear();
  say("info");
  EXPECT_NE(answers_.find("no vertices are moved by cuts"), std::string::npos) << answers_;
}

TEST_F(DetailTest, MistakesAreTold) {
  cut_plate();
  say("detail 10um");
  for (const auto& [line, told] : {std::pair{"detail 10", "'10' has no unit"},
                                   {"detail um", "the detail"},
                                   {"detail -5um", "above 0"},
                                   {"detail 0px", "above 0"},
                                   {"detail infpx", "'inf' is not a number"},
                                   {"detail tenpx", "ten"},
                                   {"detail 10 um", "'10' has no unit"},
                                   {"detail 1px 2", "'2' is too much"},
                                   {"detail", "needs"}}) {
    const std::string error = refused(line);
    EXPECT_NE(error.find(told), std::string::npos) << line << ": " << error;
    EXPECT_NE(error.find("usage: detail"), std::string::npos) << error;
    EXPECT_EQ(text_of(*state().detail), "10um") << "as it was";
  }
}

}  // namespace
}  // namespace cleft
