#include "params/run/study_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

Study small_study() {
  Study study;
  study.text = "[vary]\n'skin.thickness' = [1, 2]\n";
  return study;
}

void write_file(const Attempt& attempt, const std::string& text) {
  std::FILE* file = std::fopen((attempt.folder + "/case.h5").c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fputs(text.c_str(), file);
  std::fclose(file);
}

}  // namespace

TEST(StudyFolder, APublishedCaseVerifiesUntilAByteChanges) {
  const TemporaryFolder place;
  const StudyFolder folder = StudyFolder::create(place / "study", small_study());
  EXPECT_EQ(folder.status("a").state, CaseState::missing);
  {
    const Attempt attempt = folder.begin("a");
    EXPECT_EQ(folder.status("a").state, CaseState::running);
    write_file(attempt, "data");
    EXPECT_TRUE(folder.publish(attempt, "a", {{"case", "a"}, {"solve", "s"}}, {"case.h5"}));
  }
  EXPECT_EQ(folder.status("a").state, CaseState::published);
  EXPECT_NO_THROW(folder.verify("a"));
  ASSERT_EQ(folder.index().size(), 1u);
  EXPECT_EQ(folder.index().at("a").solve, "s");
  std::FILE* file = std::fopen((folder.published("a") + "/case.h5").c_str(), "r+");
  std::fputc('D', file);
  std::fclose(file);
  EXPECT_THROW(folder.verify("a"), FileError);
}

TEST(StudyFolder, ExactlyOneOfTwoWritersWins) {
  const TemporaryFolder place;
  const StudyFolder folder = StudyFolder::create(place / "study", small_study());
  const Attempt first = folder.begin("a"), second = folder.begin("a");
  write_file(first, "first");
  write_file(second, "second");
  EXPECT_TRUE(folder.publish(second, "a", {{"case", "a"}}, {"case.h5"}));
  EXPECT_TRUE(fs::exists(first.folder)) << "the folder of a running attempt was removed";
  EXPECT_FALSE(folder.publish(first, "a", {{"case", "a"}}, {"case.h5"}))
      << "a published case was overwritten";
  EXPECT_EQ(folder.manifest("a")["token"], second.token);
  EXPECT_FALSE(fs::exists(first.folder));
}

TEST(StudyFolder, AKilledAttemptIsMissingAgainAndAFailedOneKeepsItsReason) {
  const TemporaryFolder place;
  const StudyFolder folder = StudyFolder::create(place / "study", small_study());
  { const Attempt killed = folder.begin("a"); }
  EXPECT_EQ(folder.status("a").state, CaseState::missing);
  {
    const Attempt failed = folder.begin("a");
    folder.fail(failed, "out of salt");
  }
  EXPECT_EQ(folder.status("a").state, CaseState::failed);
  EXPECT_EQ(folder.status("a").reason, "out of salt");
}

TEST(StudyFolder, AManifestOfAnotherCaseOrNoneIsTold) {
  const TemporaryFolder place;
  const StudyFolder folder = StudyFolder::create(place / "study", small_study());
  {
    const Attempt attempt = folder.begin("a");
    write_file(attempt, "data");
    EXPECT_TRUE(folder.publish(attempt, "a", {{"case", "b"}, {"solve", "s"}}, {"case.h5"}));
  }
  EXPECT_THROW(folder.verify("a"), FileError);
  EXPECT_EQ(folder.index().size(), 1u);
  place.write("study/cases/a/manifest.json", "[]");
  EXPECT_THROW(folder.manifest("a"), FileError);
  fs::create_directories(place / "study/cases/stray");
  EXPECT_TRUE(folder.index().empty()) << "what is no case of ours stops nobody";
}

TEST(StudyFolder, ManyBeginAtOnceAndNoneLosesItsFolder) {
  const TemporaryFolder place;
  const StudyFolder folder = StudyFolder::create(place / "study", small_study());
  std::vector<std::thread> threads;
  std::atomic<int> lost = 0;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 200; ++k) {
        const Attempt attempt = folder.begin("a");
        folder.status("a");
        if (!fs::exists(attempt.folder + "/lock")) ++lost;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(lost, 0);
}

TEST(StudyFolder, OtherPeoplesFoldersAreLeftAlone) {
  const TemporaryFolder place;
  place.write("precious.txt", "");
  EXPECT_THROW(StudyFolder::create(place.path(), small_study()), InputError);
  EXPECT_EQ(place.entries(), 1);
  EXPECT_THROW(StudyFolder{place.path()}, InputError);
  fs::create_directories(place / "begun/cases");  // what a run leaves whose study file could not be written
  fs::create_directories(place / "begun/.probe.1");
  EXPECT_NO_THROW(StudyFolder::create(place / "begun", small_study()));
  EXPECT_THROW(StudyFolder{place / "absent"}, InputError);
}

TEST(StudyFolder, DamagedCasesAreSetAside) {
  const TemporaryFolder place;
  const StudyFolder folder = StudyFolder::create(place / "study", small_study());
  for (const char* name : {"whole", "gone", "changed", "untold"}) {
    const Attempt attempt = folder.begin(name);
    std::ofstream(attempt.folder + "/case.dffd") << "a field";
    EXPECT_TRUE(folder.publish(attempt, name, {{"case", name}}, {"case.dffd"}));
  }
  EXPECT_TRUE(folder.set_damaged_aside().empty());
  fs::remove(folder.published("gone") + "/case.dffd");
  std::ofstream(folder.published("changed") + "/case.dffd") << "a fielD";
  fs::remove(folder.published("untold") + "/manifest.json");
  EXPECT_EQ(folder.damage("gone", true), "case.dffd is missing");
  const auto aside = folder.set_damaged_aside();
  ASSERT_EQ(aside.size(), 3u);
  for (const auto& one : aside) {
    EXPECT_NE(one.hash, "whole");
    EXPECT_TRUE(fs::exists(one.folder)) << one.folder;
    EXPECT_EQ(folder.status(one.hash).state, CaseState::missing);
  }
  EXPECT_EQ(aside[0].why, "case.dffd differs from its manifest (size or SHA-256)");
  EXPECT_EQ(folder.status("whole").state, CaseState::published);
}

}  // namespace cleft
