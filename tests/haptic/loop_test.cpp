// The loop: what a tick takes from the system, what other threads see of it, and recordings.
#include "haptic/loop.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>

#include <cstring>
#include <thread>

#include "base/error.h"
#include "haptic/devices/hand.h"
#include "haptic/devices/mouse.h"
#include "haptic/devices/recorded.h"
#include "tests/haptic/stability.h"
#include "tests/support/allocations.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

using testing::rounds;

long faults() {
  rusage usage;
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

TEST(Loop, TakesNoMemoryAndNoPageInATick) {
  const auto s = testing::flat(40, 2);
  const ContactSurface surface(s.points, s.triangles);
  Hand hand({}, rounds(3, 2));
  LoopOptions options;
  options.record = 20000;
  HapticLoop loop(hand, surface, {}, options);
  while (loop.state().time < 6) loop.update(1e-3);  // a round of everything: contact, puncture, cut, exit
  ASSERT_EQ(loop.state().punctures, 1);
  const std::size_t before = allocations();
  const long faults_before = faults();
  while (loop.state().time < 12) loop.update(1e-3);
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(faults(), faults_before);
  EXPECT_EQ(loop.state().punctures, 2);
}

TEST(Loop, RunsAtItsRateAndCounts) {
  const auto s = testing::flat(4, 2);
  const ContactSurface surface(s.points, s.triangles);
  Mouse mouse;
  LoopOptions options;
  options.measure = options.real_time = true;
  HapticLoop loop(mouse, surface, {}, options);
  std::atomic<bool> stop{false};
  const int policy = sched_getscheduler(0);
  loop.run(stop, 0.3);
  EXPECT_EQ(sched_getscheduler(0), policy);  // what follows in this thread keeps no other waiting
  // Ticks that were missed are counted by their overruns; time goes on as the clock does.
  EXPECT_GE(loop.state().time, 0.3 - 1e-6);
  EXPECT_LE(loop.statistics().ticks, 301u);
  EXPECT_EQ(loop.statistics().compute.count(), loop.statistics().ticks);
  EXPECT_EQ(loop.statistics().lateness.count(), loop.statistics().ticks);
  EXPECT_TRUE(loop.statistics().overruns > 0 || loop.statistics().ticks >= 299u);
}

TEST(Loop, ADeviceThatReturnsBeginsWithoutForceAndWithoutWork) {
  // It is unplugged while it presses with 0.3 N, and plugged in again 30 mm above the surface: there is
  // neither a rest of the old force nor any work of it over the gap.
  const auto s = testing::flat(20, 1);
  const ContactSurface surface(s.points, s.triangles);
  Mouse mouse;
  HapticLoop loop(mouse, surface, {});
  ScalpelPose pose;
  const auto to = [&](const ScalpelPose& next) {
    mouse.set(next);
    loop.update(1e-3);
  };
  for (int k = 0; k <= 200; ++k) pose.tip = {0.3, 0.2, 1 - 0.01 * k}, to(pose);
  for (int k = 0; k < 300; ++k) to(pose);
  ASSERT_NEAR(loop.state().force.z, 0.3, 0.015);
  const double delivered = loop.passivity().delivered();
  for (int k = 0; k < 20; ++k) to(absent(pose));
  ASSERT_EQ(loop.state().force, Vec3{});
  pose.tip.z = 30;
  for (int k = 0; k < 20; ++k) {
    to(pose);
    EXPECT_EQ(loop.state().force, Vec3{}) << "tick " << k << " after it came back";
  }
  EXPECT_EQ(loop.passivity().delivered(), delivered);
}

TEST(Loop, RefusesRatesAndLatenciesItCannotHold) {
  const auto s = testing::flat(4, 2);
  const ContactSurface surface(s.points, s.triangles);
  Mouse mouse;
  EXPECT_THROW(HapticLoop(mouse, surface, {}, {.rate = 1}), InputError);
  HandParameters slow;
  slow.delay = 0.05;
  EXPECT_THROW(Hand(slow, rounds(1, 1)), InputError);
}

TEST(Loop, OverrunsAreNamed) {
  // A device that once takes three periods.
  struct Slow : Mouse {
    ScalpelPose read(double time) override {
      if (++reads == 20) std::this_thread::sleep_for(std::chrono::milliseconds(4));
      return Mouse::read(time);
    }
    int reads = 0;
  } slow;
  const auto s = testing::flat(4, 2);
  const ContactSurface surface(s.points, s.triangles);
  HapticLoop loop(slow, surface, {});
  std::atomic<bool> stop{false};
  loop.run(stop, 0.1);
  ASSERT_GE(loop.statistics().overruns, 1u);
  const auto& named = loop.statistics().overrun_ticks;
  EXPECT_NE(std::find(named.begin(), named.end(), 20u), named.end());
  EXPECT_GE(loop.state().time, 0.1 - 1e-6);
}

TEST(Loop, HistogramsTellQuantiles) {
  TimeHistogram h;
  for (int n = 1; n <= 1000; ++n) h.add(1e-6 * n);
  EXPECT_NEAR(h.quantile(0.5), 500e-6, 0.045 * 500e-6);
  EXPECT_NEAR(h.quantile(0.999), 999e-6, 0.045 * 999e-6);
  EXPECT_EQ(h.quantile(1), 1e-3);
  EXPECT_EQ(h.largest(), 1e-3);
}

TEST(Loop, SnapshotsAreWhole) {
  // What is read is one value, never older than one read before, while it is being written all the time.
  struct Value {
    std::uint64_t a[40];
  };
  TripleBuffer<Value> buffer;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    Value value;
    for (std::uint64_t n = 1; n <= 100000; ++n) {
      for (auto& a : value.a) a = n;
      buffer.write(value);
    }
    done = true;
  });
  std::uint64_t last = 0;
  while (!done) {
    const Value& value = buffer.read();
    for (const auto a : value.a) ASSERT_EQ(a, value.a[0]);
    ASSERT_GE(value.a[0], last);
    last = value.a[0];
  }
  writer.join();
  EXPECT_EQ(buffer.read().a[39], 100000u);
}

TEST(TickQueue, TellsEveryValueInOrderAndLeavesOutWhatHasNoRoom) {
  TickQueue<int> queue(4);
  int value = -1;
  EXPECT_FALSE(queue.pop(value));
  for (int n = 0; n < 6; ++n) queue.push(n);  // 4 and 5 have no room
  for (int n = 0; n < 4; ++n) {
    ASSERT_TRUE(queue.pop(value));
    EXPECT_EQ(value, n);
  }
  EXPECT_FALSE(queue.pop(value));
  std::atomic<bool> written{false};
  std::thread writer([&] {
    for (int n = 0; n < 100000; ++n) queue.push(n);
    written = true;
  });
  int last = -1;
  for (bool more = true; more;) {
    more = !written;
    while (queue.pop(value)) {
      ASSERT_GT(value, last);
      last = value;
    }
  }
  writer.join();
  EXPECT_GE(last, 3);
}

TEST(Loop, RunsWhileAnotherThreadCutsAndAThirdLooks) {
  // The surface is torn open and closed under the hand; ThreadSanitizer watches.
  auto s = testing::flat(20, 2);
  ContactSurface surface(s.points, s.triangles);
  Hand hand({}, rounds(1, 2));
  HapticLoop loop(hand, surface, {});
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> steps{0};
  std::thread cutting([&] {
    std::mt19937 random(1);
    while (!stop) {
      for (HapticState state; loop.for_cutting().pop(state);) {
      }
      std::vector<ContactSurface::Moved> moved;
      std::vector<ContactSurface::Changed> changed;
      for (int n = 0; n < 10; ++n) {
        const auto v = random() % s.points.size();
        moved.push_back(
            {static_cast<int>(v), s.points[v] + Vec3{0, 0, 1e-2 * static_cast<double>(random() % 10)}});
        const auto t = random() % s.triangles.size();
        changed.push_back(
            {static_cast<int>(t), random() % 2 ? ContactTriangle{s.triangles[t]} : ContactTriangle{}});
      }
      surface.update(moved, changed);
      steps = surface.version();
    }
  });
  std::thread looking([&] {
    while (!stop) loop.for_view().read();
  });
  for (int n = 0; n < 3000 || steps < 500; ++n) {
    loop.update(1e-3);
    ASSERT_LE(norm(loop.state().force), hand.limits().max_force * (1 + 1e-12));
  }
  stop = true;
  cutting.join();
  looking.join();
  EXPECT_LE(loop.statistics().excess_change, 0);
}

TEST(Hand, WaitsForALoopThatMissesTicks) {
  // Both go the same way, tick by tick; the one whose loop misses every second tick needs twice the time.
  ScalpelPose far;
  far.tip = {10, 0, 0};
  const std::vector<HandTarget> script = {{0, {}}, {0.2, far}};
  Hand on_time({}, script), late({}, script);
  for (int tick = 1; tick <= 200; ++tick) {
    ASSERT_EQ(on_time.read(1e-3 * tick).tip, late.read(2e-3 * tick).tip) << tick;
    on_time.command({-0.4, 0, 0}), late.command({-0.4, 0, 0});
  }
  EXPECT_NEAR(late.duration(), 0.4, 1e-9);
  EXPECT_EQ(on_time.duration(), 0.2);
}

TEST(Recorded, ReplaysBitForBit) {
  const auto s = testing::ball(16, 20, 0.1);
  const ContactSurface surface(s.points, s.triangles);
  const TemporaryFolder folder;
  std::vector<HandTarget> script;
  for (int k = 0; k < 5; ++k) {
    ScalpelPose pose;
    pose.tip = {-5. + 3.1 * k, 0.3, k % 2 ? 14. : 25.};
    script.push_back({0.3 * k, pose});
  }
  Hand hand({}, script);
  LoopOptions options;
  options.record = 1200;
  HapticLoop first(hand, surface, {}, options);
  std::vector<Vec3> forces;
  for (int n = 0; n < 1200; ++n) first.update(1e-3), forces.push_back(first.state().force);
  write_recording(folder / "run.csv", first.recorded());
  Recorded recorded(folder / "run.csv");
  HapticLoop second(recorded, surface, {}, options);
  int contacts = 0;
  for (int n = 0; n < 1200; ++n) {
    second.update(1e-3);
    const RecordedPose &a = first.recorded()[n], &b = second.recorded()[n];
    ASSERT_EQ(a.time, b.time);
    ASSERT_EQ(a.pose, b.pose) << n;
    ASSERT_EQ(second.state().force, forces[n]) << n;
    contacts += norm(forces[n]) > 0;
  }
  EXPECT_GT(contacts, 200);
}

TEST(Recorded, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string header = "time,x,y,z,ax,ay,az,ex,ey,ez,cutting,present\n";
  const auto message = [&](const std::string& text) -> std::string {
    try {
      Recorded recorded(folder.write("bad.csv", text));
    } catch (const FileError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message("time,x,y\n0,1,2\n").find("no column 'z'"), std::string::npos);
  EXPECT_NE(message(header).find("no poses"), std::string::npos);
  EXPECT_NE(message(header + "1,0,0,0,0,0,1,1,0,0,1,1\n0,0,0,0,0,0,1,1,0,0,1,1\n").find("pose 2"),
            std::string::npos);
  EXPECT_NE(message(header + "0,0,0,0,0,0,2,1,0,0,1,1\n").find("length 1"), std::string::npos);
}

}  // namespace
}  // namespace cleft
