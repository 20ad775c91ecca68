// Solved and encoded cases, made through the commands.
#pragma once

#include <string>

#include "encoder/field/field_file.h"
#include "solver/snapshot/snapshot.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

class TruthCases {
 public:
  /// `common`: lines of all case files.
  explicit TruthCases(std::string common) : common_(std::move(common)) {}

  /// Simulates a case of further lines; the next one takes its place.
  SnapshotReader truth(const std::string& lines) const { return SnapshotReader(solve("truth", lines)); }

  /// The field of the case without any.
  Field canonical() const {
    const std::string field = folder_ / "canonical.dffd";
    expect_success(run_cleft("encode", {solve("canonical", ""), "--out", field, "--tolerance", "0.01"}));
    return read_field(field);
  }

 private:
  std::string solve(const std::string& name, const std::string& lines) const {
    const std::string toml = folder_.write(name + ".toml", "[case]\n" + common_ + "\n" + lines),
                      out = folder_ / (name + ".h5");
    expect_success(run_cleft("solve", {toml, "--out", out}));
    return out;
  }

  std::string common_;
  TemporaryFolder folder_;
};

}  // namespace cleft
