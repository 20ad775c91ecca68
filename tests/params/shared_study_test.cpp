// Two users of one group on one folder of a study, and what dead processes left in it.
#include <fcntl.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

#include "base/text.h"
#include "params/run/leftovers.h"
#include "params/run/lock.h"
#include "params/run/study_folder.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

namespace fs = std::filesystem;

constexpr uid_t first = 61001, second = 61002;
constexpr gid_t group = 61100, elsewhere = 61101;

Study two_cases() {
  Study study;
  study.text = "[vary]\n'skin.thickness' = [1, 2]\n";
  return study;
}

/// Does `work` as another user, of the group, and waits for its end; what it threw, else "".
std::string as_user(uid_t user, mode_t mask, const std::string& answer, const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    const gid_t groups[] = {group};
    if (setgroups(1, groups) != 0 || setgid(elsewhere) != 0 || setuid(user) != 0) _exit(2);
    umask(mask);
    try {
      work();
    } catch (const std::exception& e) {
      std::FILE* file = std::fopen(answer.c_str(), "w");
      if (file) std::fputs(e.what(), file), std::fclose(file);
      _exit(1);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  return fs::exists(answer) ? read_text_file(answer) : "it ended with status " + std::to_string(status);
}

/// A folder of the group, setgid, whose umask is that of work groups or the usual one.
class SharedStudy : public testing::TestWithParam<mode_t> {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "only root may act as two users";
    chmod(place_.path().c_str(), 0755);
    fs::create_directory(study_);
    ASSERT_EQ(chown(study_.c_str(), first, group), 0);
    ASSERT_EQ(chmod(study_.c_str(), 02775), 0);
    fs::create_directory(answers_);
    ASSERT_EQ(chmod(answers_.c_str(), 0777), 0);
    ASSERT_EQ(of_first([&] { StudyFolder::create(study_, two_cases()); }), "");
  }
  std::string of_first(const std::function<void()>& work) const {
    return as_user(first, GetParam(), answers_ + "/first", work);
  }
  std::string of_second(const std::function<void()>& work) const {
    return as_user(second, GetParam(), answers_ + "/second", work);
  }
  static void expect(bool kept, const char* promise) {
    if (!kept) throw std::runtime_error(promise);
  }
  const TemporaryFolder place_;
  const std::string study_ = place_ / "study", answers_ = place_ / "answers";
};

TEST_P(SharedStudy, LocksHaveTheGroupAndTheModeOfTheFolder) {
  ASSERT_EQ(of_first([&] { const Moment moment(study_); }), "");
  struct stat lock {};
  ASSERT_EQ(stat((study_ + "/.lock").c_str(), &lock), 0);
  EXPECT_EQ(lock.st_gid, group);
  EXPECT_EQ(lock.st_mode & 0777, 0664U);
  struct stat folder {};
  ASSERT_EQ(stat((study_ + "/cases").c_str(), &folder), 0);
  EXPECT_EQ(folder.st_gid, group);
  EXPECT_EQ(folder.st_mode & 07777, 02775U);
}

TEST_P(SharedStudy, TheOthersLiveAttemptIsSeenAndStays) {
  const std::string begun = answers_ + "/begun", seen = answers_ + "/seen";
  std::string said;
  std::thread maker([&] {
    said = of_first([&] {
      const StudyFolder mine(study_);
      const Attempt attempt = mine.begin("a");
      std::fclose(std::fopen(begun.c_str(), "w"));
      while (!fs::exists(seen)) usleep(1000);
      expect(fs::exists(attempt.folder + "/lock"), "the live attempt was removed");
      expect(mine.publish(attempt, "a", {{"case", "a"}}, {}), "it could not be published");
    });
  });
  while (!fs::exists(begun)) usleep(1000);
  EXPECT_EQ(of_second([&] {
              const StudyFolder folder(study_);
              expect(folder.status("a").state == CaseState::running, "status does not see the attempt");
              CaseStatus state;
              expect(!folder.begin("a", StudyFolder::Retry::failed, state), "it begins what another makes");
              folder.remove_abandoned();
              folder.begin("b");
            }),
            "");
  std::fclose(std::fopen(seen.c_str(), "w"));
  maker.join();
  EXPECT_EQ(said, "");
}

TEST_P(SharedStudy, DeadAttemptsOfTheOtherAreRemoved) {
  ASSERT_EQ(of_first([&] {
              const Attempt killed = StudyFolder(study_).begin("a");
              make_shared_folder(killed.folder, "group");
              std::fclose(std::fopen((killed.folder + "/group/case.h5").c_str(), "w"));
            }),
            "");
  ASSERT_EQ(of_second([&] { StudyFolder(study_).remove_abandoned(); }), "");
  EXPECT_FALSE(fs::exists(study_ + "/attempts/a"));
}

TEST_P(SharedStudy, ALockThatCannotBeHadNamesItsOwner) {
  ASSERT_EQ(of_first([&] {
              const Moment moment(study_);
              chmod((study_ + "/.lock").c_str(), 0600);
            }),
            "");
  const std::string said = of_second([&] { StudyFolder(study_).begin("b"); });
  EXPECT_NE(said.find(study_ + "/.lock: could not be locked: Permission denied; it belongs to user 61001"),
            std::string::npos)
      << said;
  EXPECT_FALSE(fs::exists(study_ + "/attempts/b"));
  // A lock of an attempt that may not be looked at is held.
  const std::string lock = study_ + "/attempts/lock";
  ASSERT_EQ(of_first([&] {
              std::fclose(std::fopen(lock.c_str(), "w"));
              chmod(lock.c_str(), 0600);
            }),
            "");
  EXPECT_EQ(of_second([&] { expect(Lock::is_held(lock), "not held"); }), "");
}

INSTANTIATE_TEST_SUITE_P(Umasks, SharedStudy, testing::Values(mode_t{002}, mode_t{022}));

/// The number of a process that has ended.
std::string dead() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return std::to_string(child);
}

void make_old(const std::string& path) {
  fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::seconds(60));
}

TEST(Leftovers, OfDeadMakersAreSwept) {
  const TemporaryFolder place;
  const std::string gone = dead(), alive = std::to_string(getpid());
  const auto names = [&](const std::string& maker) {
    return std::vector<std::string>{".study." + maker + ".part.dffd", ".study." + maker + ".part.toml",
                                    "index.json." + maker + ".part"};
  };
  for (const std::string& maker : {gone, alive}) {
    for (const std::string& name : names(maker)) make_old(place.write(name, "half"));
    fs::create_directories(place / ".probe." + maker + "/one");
    make_old(place / ".probe." + maker);
  }
  for (const char* kept : {"study.toml", ".lock", ".pack", "study.dffd", ".notes.12"})
    make_old(place.write(kept, "whole"));
  place.write(".young." + gone + ".part.dffd", "half");  // it may be written on another machine
  sweep_leftovers(place.path());
  for (const std::string& name : names(gone)) EXPECT_FALSE(fs::exists(place / name)) << name;
  for (const std::string& name : names(alive)) EXPECT_TRUE(fs::exists(place / name)) << name;
  EXPECT_FALSE(fs::exists(place / ".probe." + gone));
  EXPECT_TRUE(fs::exists(place / ".probe." + alive));
  EXPECT_EQ(place.entries(), 5 + 1 + 4);
}

TEST(Leftovers, WhatIsLockedIsKept) {
  const TemporaryFolder place;
  const std::string part = place.write(".study." + dead() + ".part.dffd", "half");
  make_old(part);
  const int file = open(part.c_str(), O_RDONLY);
  flock(file, LOCK_EX);  // as HDF5 does while it writes
  sweep_leftovers(place.path());
  EXPECT_TRUE(fs::exists(part));
  close(file);
  sweep_leftovers(place.path());
  EXPECT_FALSE(fs::exists(part));
}

TEST(Leftovers, LogsOfPackingsGoUnlessTheyAreOnesOwn) {
  const TemporaryFolder place;
  for (const char* name : {".pack.12.log", ".pack.13.log", "pack.log"}) place.write(name, "");
  sweep_pack_logs(place.path(), place / ".pack.13.log");
  EXPECT_FALSE(fs::exists(place / ".pack.12.log"));
  EXPECT_EQ(place.entries(), 2);
}

}  // namespace
}  // namespace cleft
