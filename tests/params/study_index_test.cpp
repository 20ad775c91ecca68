// The index against the manifests it is made from.
#include "params/run/study_index.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "base/sealed_json.h"
#include "base/text.h"
#include "params/run/study_folder.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

class StudyIndex : public testing::Test {
 protected:
  StudyIndex() : folder_(StudyFolder::create(place_ / "study", Study{})) {}

  void publish(const std::string& hash, double seconds) {
    const Attempt attempt = folder_.begin(hash);
    fs::copy_file(folder_.study_file(), attempt.folder + "/case.h5");
    folder_.publish(attempt, hash,
                    {{"version", 2}, {"case", hash}, {"solve", "s" + hash}, {"seconds", seconds}},
                    {"case.h5"});
  }

  std::map<std::string, double> seconds() const {
    std::map<std::string, double> list;
    for (const auto& [hash, one] : folder_.index()) list[hash] = one.seconds;
    return list;
  }

  std::string file() const { return place_ / "study/index.json"; }

  const TemporaryFolder place_;
  const StudyFolder folder_;
};

using Seconds = std::map<std::string, double>;

}  // namespace

TEST_F(StudyIndex, FollowsThePublishedCases) {
  EXPECT_EQ(seconds(), Seconds());
  publish("a", 1);
  EXPECT_EQ(seconds(), (Seconds{{"a", 1}}));
  publish("b", 2);
  EXPECT_EQ(seconds(), (Seconds{{"a", 1}, {"b", 2}}));
  const auto written = fs::last_write_time(file());
  EXPECT_EQ(seconds(), (Seconds{{"a", 1}, {"b", 2}}));
  EXPECT_EQ(fs::last_write_time(file()), written) << "nothing had changed";
  fs::remove_all(folder_.published("a"));
  EXPECT_EQ(seconds(), (Seconds{{"b", 2}}));
  publish("a", 3);
  EXPECT_EQ(seconds(), (Seconds{{"a", 3}, {"b", 2}})) << "the same name, another case";
  EXPECT_EQ(folder_.index().at("a").solve, "sa");
  EXPECT_TRUE(folder_.index().at("a").snapshot);
}

TEST_F(StudyIndex, IsMadeAgainWhereItIsDamagedCutShortOrMissing) {
  publish("a", 1), publish("b", 2);
  const Seconds right = seconds();
  const std::string text = read_text_file(file());
  fs::remove(file());
  EXPECT_EQ(seconds(), right);
  EXPECT_EQ(read_text_file(file()), text);
  for (std::size_t byte = 0; byte < text.size(); ++byte)
    for (const std::size_t bit : {byte % 8}) {
      std::string damaged = text;
      damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << bit));
      place_.write("study/index.json", damaged);
      ASSERT_EQ(seconds(), right) << "byte " << byte << ", bit " << bit;
    }
  for (std::size_t length = 0; length < text.size(); length += 7) {
    place_.write("study/index.json", text.substr(0, length));
    ASSERT_EQ(seconds(), right) << length;
  }
}

TEST_F(StudyIndex, ADamagedManifestIsFoundWhateverBitItIs) {
  publish("a", 1);
  const std::string manifest = folder_.published("a") + "/manifest.json", text = read_text_file(manifest);
  for (std::size_t byte = 0; byte < text.size(); ++byte)
    for (const std::size_t bit : {byte % 8}) {
      std::string damaged = text;
      damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << bit));
      place_.write("study/cases/a/manifest.json", damaged);
      ASSERT_THROW(folder_.manifest("a"), FileError) << "byte " << byte << ", bit " << bit;
    }
  place_.write("study/cases/a/manifest.json", text);
  EXPECT_EQ(folder_.manifest("a").at("case"), "a");
}

}  // namespace cleft
