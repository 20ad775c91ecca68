#include "haptic/devices/recorded.h"

#include <cmath>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"

namespace cleft {

namespace {

const char* const columns[] = {"time", "x",  "y",  "z",  "ax",      "ay",
                               "az",   "ex", "ey", "ez", "cutting", "present"};

}  // namespace

Recorded::Recorded(const std::string& path) {
  const NumberTable table = read_csv(path);
  std::size_t at[12];
  for (std::size_t k = 0; k < 12; ++k) {
    const int column = table.column(columns[k]);
    if (column < 0)
      throw FileError(path, std::string("has no column '") + columns[k] +
                                "'; a recording has time,x,y,z,ax,ay,az,ex,ey,ez,cutting,present");
    at[k] = static_cast<std::size_t>(column);
  }
  for (const auto& row : table.rows) {
    const auto vector = [&](std::size_t k) { return Vec3{row[at[k]], row[at[k + 1]], row[at[k + 2]]}; };
    const RecordedPose pose{row[at[0]],
                            {vector(1), vector(4), vector(7), row[at[10]] != 0, row[at[11]] != 0}};
    const std::string where = "pose " + std::to_string(poses_.size() + 1);
    for (const double x : row)
      if (!std::isfinite(x)) throw FileError(path, where + " has a number that is not finite");
    if (!poses_.empty() && !(pose.time > poses_.back().time))
      throw FileError(path, where + ", at " + shortest(pose.time) + " s, must come after the one before it");
    for (const Vec3& direction : {pose.pose.axis, pose.pose.edge})
      if (!(std::abs(norm(direction) - 1) < 1e-6))
        throw FileError(path, where + ": axis and edge must have the length 1");
    poses_.push_back(pose);
  }
  if (poses_.empty()) throw FileError(path, "has no poses");
}

ScalpelPose Recorded::read(double time) {
  // Half a microsecond of grace: times are sums of periods, and files may come from other clocks.
  while (at_ + 1 < poses_.size() && poses_[at_ + 1].time <= time + 5e-7) ++at_;
  return poses_[at_].pose;
}

void write_recording(const std::string& path, const std::vector<RecordedPose>& poses) {
  std::string text;
  for (const char* column : columns) (text += text.empty() ? "" : ",") += column;
  text += '\n';
  for (const auto& [time, pose] : poses) {
    text += shortest(time);
    for (const Vec3* v : {&pose.tip, &pose.axis, &pose.edge})
      for (int k = 0; k < 3; ++k) text += ',' + shortest((*v)[k]);
    text += pose.cutting ? ",1" : ",0";
    text += pose.present ? ",1\n" : ",0\n";
  }
  write_text_file(path, text);
}

DeviceKind recorded_device() {
  return {
      .name = "recorded",
      .title = "&Recording ...",
      .help = "poses of a file, as cleft haptic --record writes them",
      .input = &recording_input,
      .make = [](const DeviceRequest& request) -> std::unique_ptr<Device> {
        if (request.trajectory.empty())
          throw InputError(std::string("the recorded device plays a file: give ") + recording_input.option);
        return std::make_unique<Recorded>(request.trajectory);
      }};
}

}  // namespace cleft
