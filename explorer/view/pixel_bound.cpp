#include "explorer/view/pixel_bound.h"

#include <vtkCamera.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cleft {

PixelBound::PixelBound(vtkRenderer* renderer, const std::pair<Vec3, Vec3>& box, double samples) {
  vtkCamera* camera = renderer->GetActiveCamera();
  const auto vec = [](const double* x) { return Vec3{x[0], x[1], x[2]}; };
  const Vec3 eye = vec(camera->GetPosition()), forward = vec(camera->GetDirectionOfProjection());
  nearest_ = 0;  // the nearest corner's
  for (int k = 0; k < 3; ++k)
    nearest_ += forward[k] * ((forward[k] > 0 ? box.first : box.second)[k] - eye[k]);
  const int* size = renderer->GetSize();
  focal_ = size[1] / (2 * samples * std::tan(camera->GetViewAngle() / 2 * M_PI / 180));
  half_diagonal_ = std::hypot(size[0], size[1]) / (2 * samples);
}

double PixelBound::mm(double pixels) const {
  const double part = pixels / std::hypot(focal_, half_diagonal_ + pixels);  // d / (z - d)
  return std::max(0., nearest_ * part / (1 + part));
}

double PixelBound::pixels(double mm) const {
  if (mm == 0) return 0;
  const double part = mm / (nearest_ - mm), square = part * part, r = half_diagonal_;
  if (!(part > 0 && part < 1)) return std::numeric_limits<double>::infinity();
  return (square * r + part * std::sqrt(square * r * r + (1 - square) * (focal_ * focal_ + r * r))) /
         (1 - square);
}

}  // namespace cleft
