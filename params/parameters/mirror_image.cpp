#include "params/parameters/mirror_image.h"

#include <algorithm>
#include <vector>

#include "params/parameters/table.h"

namespace cleft {

namespace {

/// Besides the shear.
constexpr double& (*const shapes[])(Parameters&) = {
    [](Parameters& p) -> double& { return p.cut.curvature; },
    [](Parameters& p) -> double& { return p.cut.curvature_rate; },
    [](Parameters& p) -> double& { return p.cut.tilt; },
    [](Parameters& p) -> double& { return p.skin.curvature_uv; },
    [](Parameters& p) -> double& { return p.patch.slope; }};

void turn_over(double& number) {
  if (number != 0) number = -number;  // no -0, whose text differs
}

std::vector<std::string> names() {
  Parameters p;
  std::vector<std::string> list = {row_of(p, p.skin.prestress.uv).name};
  for (const auto& shape : shapes) list.push_back(row_of(p, shape(p)).name);
  return list;
}

}  // namespace

bool changes_sign_in_mirror(const std::string& name) {
  static const std::vector<std::string> all = names();
  return std::ranges::find(all, name) != all.end();
}

Parameters mirror_image(Parameters p) {
  for (const auto& shape : shapes) turn_over(shape(p));
  turn_over(p.skin.prestress.uv);
  return p;
}

bool mirror_image_tells(const Parameters& parameters) {
  Parameters p = parameters;
  for (const auto& shape : shapes)
    if (shape(p) != 0) return true;
  return p.skin.prestress.uv != 0 && !is_linear_in_prestress(p);
}

}  // namespace cleft
