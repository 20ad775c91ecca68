#include "explorer/incision/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace cleft {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

}  // namespace

int side_of_line(const Vec3& foot, const Vec3& head, const Vec3& a, const Vec3& b) {
  return CGAL::orientation(point(foot), point(head), point(a), point(b));
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return CGAL::collinear(point(a), point(b), point(c));
}

}  // namespace cleft
