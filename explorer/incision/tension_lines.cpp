#include "explorer/incision/tension_lines.h"

#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr double near = 1;  // mm: nearer lines count alike

}  // namespace

std::optional<double> twice_angle_of(const std::vector<TensionLine>& lines,
                                     const std::array<Vec3, 2>& directions, const Vec3& place) {
  double cosine = 0, sine = 0, all = 0;
  for (const TensionLine& line : lines) {
    const Vec3 way = line.place - place;
    const Vec3 d = normalized(line.direction);
    const double along = dot(d, directions[0]), across = dot(d, directions[1]);
    const double weight = 1 / (dot(way, way) + near * near);
    cosine += weight * (along * along - across * across), sine += weight * 2 * along * across;
    all += weight;
  }
  if (std::hypot(cosine, sine) < upright_line * upright_line * all) return std::nullopt;
  return std::atan2(sine, cosine);
}

std::vector<TensionLine> read_tension_lines(const std::string& file, double scale) {
  const NumberTable table = read_csv(file);
  std::vector<TensionLine> lines;
  for (const char* name : {"x", "y", "z", "dx", "dy", "dz"})
    if (table.column(name) < 0)
      throw FileError(file, std::string("has no column ") + name + " (lines of tension: x,y,z,dx,dy,dz)");
  for (const std::vector<double>& row : table.rows) {
    const auto at = [&](const char* name) { return row[static_cast<std::size_t>(table.column(name))]; };
    const Vec3 way{at("dx"), at("dy"), at("dz")};
    if (!(norm(way) > 0)) throw FileError(file, "a line of tension has no direction: dx = dy = dz = 0");
    lines.push_back({scale * Vec3{at("x"), at("y"), at("z")}, way});
  }
  if (lines.empty()) throw FileError(file, "has no line of tension");
  return lines;
}

}  // namespace cleft
