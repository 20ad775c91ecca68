#include "encoder/import/plane.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

Vec3 vector_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d eigen_of(const Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

Plane parse_plane(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');)
    numbers.push_back(parse_number(part, "--break '" + text + "'"));
  const Vec3 normal = numbers.size() == 4 ? Vec3{numbers[0], numbers[1], numbers[2]} : Vec3{};
  const double length = norm(normal);
  if (numbers.size() != 4 || !(length > 0) || !std::isfinite(length) || !std::isfinite(numbers[3]))
    throw InputError(
        "--break '" + text +
        "': expected nx,ny,nz,offset with a normal that is not 0, or none: the plane of the points x "
        "with n . x = offset");
  return {snapped((1 / length) * normal), numbers[3] / length};
}

std::string text_of(const Plane& plane) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += shortest(plane.normal[i]) + ",";
  return text + shortest(plane.offset);
}

Vec3 snapped(const Vec3& unit) {
  for (int i = 0; i < 3; ++i) {
    Vec3 axis;
    axis[i] = unit[i] < 0 ? -1 : 1;
    if (norm(unit - axis) < 1e-9) return axis;
  }
  return unit;
}

Vec3 forward(const Vec3& axis) {
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    if (std::abs(axis[i]) > std::abs(largest) + 1e-9) largest = axis[i];
  return largest < 0 ? -axis : axis;
}

Spread spread_of(const std::vector<Vec3>& points) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Vec3& p : points) centre += eigen_of(p);
  centre /= static_cast<double>(points.size());
  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = (eigen_of(points[i]) - centre).transpose();
  const Eigen::Matrix3d covariance = rows.transpose() * rows / static_cast<double>(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Spread spread;
  spread.centre = vector_of(centre);
  for (int i = 0; i < 3; ++i) {  // Eigen's come ascending
    spread.axis[i] = snapped(vector_of(solver.eigenvectors().col(2 - i)));
    spread.deviation[i] =
        (rows * eigen_of(spread.axis[i])).norm() / std::sqrt(static_cast<double>(points.size()));
  }
  spread.axis[2] = cross(spread.axis[0], spread.axis[1]);
  return spread;
}

std::optional<Plane> common_plane(const std::vector<Vec3>& points, double tolerance,
                                  const std::optional<Vec3>& within) {
  if (points.size() < 2) return {};
  const Spread spread = spread_of(points);
  if (!(spread.deviation[within ? 0 : 1] > tolerance)) return {};
  const Vec3 normal =
      forward(snapped(within ? normalized(cross(*within, spread.axis[0])) : normalized(spread.axis[2])));
  Plane plane{normal, dot(normal, spread.centre)};
  for (const Vec3& p : points)
    if (!(std::abs(plane.distance(p)) <= tolerance)) return {};
  return plane;
}

}  // namespace cleft
