#include "tests/faults/disk.h"

#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>

#include "base/error.h"
#include "base/text.h"

namespace cleft::faults {

namespace fs = std::filesystem;

namespace {

/// A failed run has said why, and has published nothing that is not sound.
void expect_no_harm(const StudyUnderFault& study, const std::string& folder, const ProcessResult& result) {
  const std::string words = read_text_file(folder + ".log");
  promise(result.signal == 0, "cleft run was ended by a signal:\n" + words);
  promise(words.find("fail") != std::string::npos || words.find("error") != std::string::npos,
          "cleft run failed without a message:\n" + words);
  if (study.published(folder).empty()) return;
  const ProcessResult check = run_process({CLEFT_BIN "/cleft", "check", folder}, folder + ".check.log", {});
  const std::string verdict = read_text_file(folder + ".check.log");
  // The study's file is packed now and then, and at the end of a run: until then it may lack what is
  // published.
  promise(check.success() || verdict.find("study.dffd") != std::string::npos, "cleft check: " + verdict);
}

}  // namespace

std::optional<DiskReport> fill_the_disk(const StudyUnderFault& study, int runs, std::mt19937& random) {
  DiskReport report;
  const std::string mounted = study.place() + "/small";
  fs::create_directories(mounted);
  for (; report.runs < runs; ++report.runs) {
    const int kilobytes = std::uniform_int_distribution<int>(8, 700)(random);
    if (mount("tmpfs", mounted.c_str(), "tmpfs", 0, ("size=" + std::to_string(kilobytes) + "k").c_str()) != 0)
      return {};
    const std::string folder = mounted + "/study";
    std::exception_ptr broken;
    try {
      // The messages of the run would be on the full disk too: they go to another file.
      const std::string log = study.place() + "/full.log";
      const ProcessResult result = run_process(study.command(folder), log, {});
      if (!result.success()) {
        ++report.failed;
        const std::string words = read_text_file(log);
        promise(result.signal == 0, "cleft run was ended by a signal:\n" + words);
        promise(words.find("fail") != std::string::npos || words.find("error") != std::string::npos,
                "cleft run failed without a message:\n" + words);
      }
      promise(mount("tmpfs", mounted.c_str(), "tmpfs", MS_REMOUNT, "size=64m") == 0,
              "could not be remounted");
      if (!result.success() && fs::exists(folder)) {
        fs::copy_file(log, folder + ".log", fs::copy_options::overwrite_existing);
        expect_no_harm(study, folder, result);
      }
      study.finish(folder);
    } catch (...) {
      broken = std::current_exception();
    }
    umount(mounted.c_str());
    if (broken) std::rethrow_exception(broken);
  }
  return report;
}

DiskReport fail_writes(const StudyUnderFault& study, int runs, std::mt19937& random) {
  DiskReport report;
  for (; report.runs < runs; ++report.runs) {
    const std::string folder = study.place() + "/failing" + std::to_string(report.runs);
    const char* one_in[] = {"3", "30", "100", "300"};
    const std::string rate = one_in[random() % std::size(one_in)];
    const ProcessResult result =
        study.run(folder, {"env", "LD_PRELOAD=" CLEFT_FAILING_WRITES, "CLEFT_FAILING_WRITES=" + rate});
    if (!result.success()) {
      ++report.failed;
      if (fs::exists(folder)) expect_no_harm(study, folder, result);
    }
    study.finish(folder);
    fs::remove_all(folder);
  }
  return report;
}

}  // namespace cleft::faults
