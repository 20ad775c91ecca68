#include "explorer/view/scalpel_shape.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cleft {

namespace {

/// Linear between (z, value).
double at(const std::vector<std::pair<double, double>>& curve, double z) {
  const auto after = std::find_if(curve.begin(), curve.end(), [z](const auto& p) { return p.first >= z; });
  if (after == curve.begin()) return curve.front().second;
  if (after == curve.end()) return curve.back().second;
  const auto& [z0, low] = *(after - 1);
  const auto& [z1, high] = *after;
  return low + (high - low) * (z - z0) / (z1 - z0);
}

/// A cross-section: corners (x, y), counter-clockwise seen from the handle's end.
using Section = std::vector<std::pair<double, double>>;

/// The surface through sections with as many corners each, closed at both ends.
class Loft {
 public:
  void add(double z, const Section& section) {
    const auto count = static_cast<vtkIdType>(section.size()), first = points_->GetNumberOfPoints();
    for (const auto& [x, y] : section) points_->InsertNextPoint(x, y, z);
    for (vtkIdType i = 0; i < count && first > 0; ++i) {
      const vtkIdType next = (i + 1) % count, below = first - count;
      triangle(below + i, below + next, first + next);
      triangle(below + i, first + next, first + i);
    }
    if (first == 0) cap(0, count, true);
    last_ = first, corners_ = count;
  }
  vtkSmartPointer<vtkPolyData> close() {
    cap(last_, corners_, false);
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points_);
    data->SetPolys(faces_);
    return data;
  }

 private:
  void triangle(vtkIdType a, vtkIdType b, vtkIdType c) { faces_->InsertNextCell({a, b, c}); }
  void cap(vtkIdType first, vtkIdType count, bool below) {
    for (vtkIdType i = 1; i + 1 < count; ++i)
      below ? triangle(first, first + i + 1, first + i) : triangle(first, first + i, first + i + 1);
  }

  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> faces_;
  vtkIdType last_ = 0, corners_ = 0;
};

/// An ellipse with flat sides.
Section rounded(double left, double right, double thick) {
  constexpr int corners = 32;
  constexpr double power = 0.5;
  Section section;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners, c = std::cos(angle), s = std::sin(angle);
    section.emplace_back(
        (left + right) / 2 + (right - left) / 2 * std::copysign(std::pow(std::abs(c), power), c),
        thick / 2 * std::copysign(std::pow(std::abs(s), power), s));
  }
  return section;
}

}  // namespace

vtkSmartPointer<vtkPolyData> scalpel_blade() {
  constexpr double length = 30, half = 0.2, step = 0.5;
  const std::vector<std::pair<double, double>> back{{0, -0.01}, {6, -2.2}, {length, -2.2}},
      edge{{0, 0.01}, {0.5, 1.0}, {1, 1.55}, {2, 2.4},  {3.5, 3.3},   {5.5, 4.1},
           {8, 4.6},  {11, 4.8},  {21, 4.8}, {23, 2.9}, {length, 2.9}},
      ground{{0, 0.005}, {2, 1.1}, {6, 1.8}, {20.5, 1.8}, {23, 0.1}, {length, 0.1}};
  Loft loft;
  for (double z = 0; z <= length + step / 2; z += step) {
    const double left = at(back, z), right = at(edge, z), width = right - left;
    const double thick = std::min(half, 0.12 * width), bevel = right - std::min(at(ground, z), 0.8 * width);
    const double blunt = z > 22 ? thick : 0.004;  // behind its heel it does not cut
    loft.add(
        z, {{left, -thick}, {bevel, -thick}, {right, -blunt}, {right, blunt}, {bevel, thick}, {left, thick}});
  }
  return loft.close();
}

vtkSmartPointer<vtkPolyData> scalpel_handle() {
  constexpr double begin = 13, end = 140, step = 0.5;
  const std::vector<std::pair<double, double>> left{{begin, -0.6}, {14, -1},    {27, -1},
                                                    {29, -2.4},    {40, -3.8},  {65, -3},
                                                    {130, -3.8},   {138, -3.2}, {end, -1}},
      right{{begin, 0.8}, {14, 1.4},  {27, 1.4},  {29, 3.0}, {40, 4.6},
            {65, 3.8},    {130, 4.8}, {138, 4.2}, {end, 2}},
      thick{{begin, 0.7}, {27, 1.0}, {29, 3.0}, {40, 4.2}, {138, 3.8}, {end, 2.4}};
  Loft loft;
  for (double z = begin; z <= end + step / 2; z += step) {
    const bool grooved = z > 36 && z < 58;
    const double groove = grooved ? 0.45 * (1 - std::cos(2 * M_PI * (z - 36) / 2.2)) : 0;
    loft.add(z, rounded(at(left, z), at(right, z), at(thick, z) - groove));
  }
  return loft.close();
}

}  // namespace cleft
