#include "tradeoff/chain.h"

#include <sys/resource.h>

#include "base/output_file.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"
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

}  // namespace

Chain::Chain(const Parameters& parameters, std::string folder) : folder_(std::move(folder)) {
  const std::string toml = folder_ + "/case.toml";
  write_text_file(toml, case_file_text({parameters, {}}));
  const double before = children_seconds();
  const nlohmann::json figures = run_tool("solve", {toml, "--out", snapshot(), "--no-estimate"}, folder_);
  nodes_ = figures.at("nodes").get<double>(), unknowns_ = figures.at("unknowns").get<double>();
  solve_seconds_ = children_seconds() - before, wall_seconds_ = total_seconds(figures);
}

Opening Chain::opening() const { return Opening(SnapshotReader(snapshot())); }

Chain::Encoded Chain::encoded(double tolerance) const {
  const std::string out = folder_ + "/case.dffd";
  const double before = children_seconds();
  const nlohmann::json figures =
      run_tool("encode", {snapshot(), "--out", out, "--tolerance", shortest(tolerance)}, folder_);
  return {read_field(out), figures.at("bytes").get<double>(), children_seconds() - before};
}

}  // namespace cleft
