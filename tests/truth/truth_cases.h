// Solved and encoded cases, made through the commands.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"
#include "explorer/wound/prestress_fields.h"
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
  Field canonical() const { return read_field(encode("canonical", "")); }

  /// The same cut under three independent prestresses. (Shear alone would compress the skin.)
  PrestressFields prestresses() const {
    std::vector<StudyCase> cases;
    const std::vector<std::array<const char*, 3>> values{
        {"0.01", "0", "0"}, {"0", "0.01", "0"}, {"0.01", "0.01", "0.01"}};
    for (const auto& [u, v, uv] : values) {
      const std::string lines = std::string("skin.prestress_u = ") + u + "\nskin.prestress_v = " + v +
                                "\nskin.prestress_uv = " + uv,
                        name = "prestress" + std::to_string(cases.size());
      cases.push_back({name, encode(name, lines)});
    }
    write_study(folder_ / "study.dffd", study_records(cases));
    return PrestressFields(folder_ / "study.dffd");
  }

 private:
  std::string encode(const std::string& name, const std::string& lines) const {
    const std::string field = folder_ / (name + ".dffd");
    expect_success(run_cleft("encode", {solve(name, lines), "--out", field, "--tolerance", "0.01"}));
    return field;
  }

  std::string solve(const std::string& name, const std::string& lines) const {
    const std::string toml = folder_.write(name + ".toml", "[case]\n" + common_ + "\n" + lines),
                      out = folder_ / (name + ".h5");
    expect_success(run_cleft("solve", {toml, "--out", out, "--no-estimate"}));
    return out;
  }

  std::string common_;
  TemporaryFolder folder_;
};

}  // namespace cleft
