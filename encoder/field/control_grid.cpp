#include "encoder/field/control_grid.h"

namespace cleft {

ControlGrid::ControlGrid(const std::array<BSplineBasis, 4>& bases, const Axes& axes,
                         std::span<const Vec3> coefficients) {
  stride[2] = 4 * axes[3].size();
  stride[1] = stride[2] * axes[2].size();
  stride[0] = stride[1] * axes[1].size();
  values.assign(stride[0] * axes[0].size(), 0);
  const Vec3* next = coefficients.data();
  for (int i = 0; i < bases[0].size(); ++i)
    for (int j = 0; j < bases[1].size(); ++j)
      for (int k = 0; k < bases[2].size(); ++k)
        for (int l = 0; l < bases[3].size(); ++l, ++next) {
          double* point = &values[i * stride[0] + j * stride[1] + k * stride[2] + 4 * l];
          point[0] = next->x, point[1] = next->y, point[2] = next->z;
        }
}

}  // namespace cleft
