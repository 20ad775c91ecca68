#include "explorer/wound/path_file.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

/// The way along the path to its next point over the straight distance, at most: nearly that of half a
/// circle.
constexpr double longest_arc = 1.5;

/// The prestress's components have the names of the parameters.
std::vector<std::string> prestress_columns() {
  const Parameters p;
  const Prestress& sigma = p.skin.prestress;
  return {row_of(p, sigma.uu).name, row_of(p, sigma.vv).name, row_of(p, sigma.uv).name};
}

}  // namespace

ScalpelPath read_path(const std::string& file, double depth, double scale, std::optional<double> otherwise) {
  return path_of(read_csv(file), file, depth, scale, otherwise);
}

ScalpelPath path_of(const NumberTable& table, const std::string& name, double depth, double scale,
                    std::optional<double> otherwise) {
  ScalpelPath path = ScalpelPath::from_table(table, name, prestress_columns());
  if (depth > 0)
    path.set_depth(depth / scale);
  else if (table.column("depth") < 0 && otherwise)
    path.set_depth(*otherwise / scale);
  else if (table.column("depth") < 0)
    throw FileError(name, "has no column 'depth', and there is no field that knows one: give --depth in mm");
  return path;
}

std::optional<PathPrestress> read_prestress(const std::string& file, const ScalpelPath& path, double scale) {
  return prestress_of(read_csv(file), path, scale);
}

std::optional<PathPrestress> prestress_of(const NumberTable& table, const ScalpelPath& path, double scale) {
  int column[3];
  for (int i = 0; i < 3; ++i) column[i] = table.column(prestress_columns()[i]);
  if (std::max({column[0], column[1], column[2]}) < 0) return std::nullopt;
  const int x = table.column("x"), y = table.column("y"), z = table.column("z");
  PathPrestress result;
  double s = 0;
  Vec3 before;
  for (const auto& row : table.rows) {
    const auto at = [&row](int i) { return i < 0 ? 0 : row[i]; };
    const Vec3 here{at(x), at(y), at(z)};
    // The path may come back to where it was: looked for from the point before.
    if (!result.stations.empty()) s = path.coordinates(here, s, s + longest_arc * norm(here - before)).s;
    before = here;
    if (!result.stations.empty() && !(s * scale > result.stations.back())) continue;
    result.stations.push_back(s * scale);
    result.values.push_back({at(column[0]), at(column[1]), at(column[2])});
  }
  return result;
}

}  // namespace cleft
