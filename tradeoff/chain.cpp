#include "tradeoff/chain.h"

#include "base/output_file.h"
#include "base/text.h"
#include "encoder/field/field_file.h"
#include "params/study.h"
#include "tradeoff/tool.h"

namespace cleft {

namespace {

Opening solved(const Parameters& parameters, const std::string& folder, double& nodes, double& seconds) {
  const std::string toml = folder + "/case.toml", out = folder + "/case.h5";
  write_text_file(toml, case_file_text({parameters, {}}));
  const nlohmann::json figures = run_tool("solve", {toml, "--out", out}, folder);
  nodes = figures.at("nodes").get<double>(), seconds = total_seconds(figures);
  return Opening(SnapshotReader(out));
}

}  // namespace

Chain::Chain(const Parameters& parameters, std::string folder)
    : folder_(std::move(folder)), opening_(solved(parameters, folder_, nodes_, solve_seconds_)) {}

Chain::Encoded Chain::encoded(double tolerance) const {
  const std::string out = folder_ + "/case.dffd";
  const nlohmann::json figures =
      run_tool("encode", {folder_ + "/case.h5", "--out", out, "--tolerance", shortest(tolerance)}, folder_);
  return {read_field(out), figures.at("bytes").get<double>(),
          figures.at("fit_seconds").get<double>() + figures.at("measure_seconds").get<double>()};
}

}  // namespace cleft
