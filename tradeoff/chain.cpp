#include "tradeoff/chain.h"

#include <sys/resource.h>

#include "base/output_file.h"
#include "base/text.h"
#include "encoder/field/field_file.h"
#include "params/study.h"
#include "tradeoff/tool.h"

namespace cleft {

namespace {

/// Processor time of the commands run so far: it does not depend on what else the machine does.
double children_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Opening solved(const Parameters& parameters, const std::string& folder, double& nodes, double& seconds) {
  const std::string toml = folder + "/case.toml", out = folder + "/case.h5";
  write_text_file(toml, case_file_text({parameters, {}}));
  const double before = children_seconds();
  const nlohmann::json figures = run_tool("solve", {toml, "--out", out}, folder);
  nodes = figures.at("nodes").get<double>(), seconds = children_seconds() - before;
  return Opening(SnapshotReader(out));
}

}  // namespace

Chain::Chain(const Parameters& parameters, std::string folder)
    : folder_(std::move(folder)), opening_(solved(parameters, folder_, nodes_, solve_seconds_)) {}

Chain::Encoded Chain::encoded(double tolerance) const {
  const std::string out = folder_ + "/case.dffd";
  const double before = children_seconds();
  const nlohmann::json figures =
      run_tool("encode", {folder_ + "/case.h5", "--out", out, "--tolerance", shortest(tolerance)}, folder_);
  return {read_field(out), figures.at("bytes").get<double>(), children_seconds() - before};
}

}  // namespace cleft
