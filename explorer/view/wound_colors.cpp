#include "explorer/view/wound_colors.h"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

#include <vector>

#include "explorer/wound/tissue_colors.h"

namespace cleft {
namespace {

struct Stop {
  double at, red, green, blue;
};

vtkSmartPointer<vtkLookupTable> table(const std::vector<Stop>& stops, double least, double greatest) {
  vtkNew<vtkColorTransferFunction> between;
  between->SetColorSpaceToLab();
  for (const Stop& s : stops) between->AddRGBPoint(s.at, s.red, s.green, s.blue);
  vtkNew<vtkLookupTable> colors;
  constexpr int count = 256;
  colors->SetNumberOfTableValues(count);
  colors->SetTableRange(least, greatest);
  for (int i = 0; i < count; ++i) {
    double rgb[3];
    between->GetColor(i / (count - 1.), rgb);
    colors->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  colors->SetNanColor(0.62, 0.62, 0.62, 1);
  return colors;
}

}  // namespace

std::array<double, 3> faded(const std::array<double, 3>& color) {
  constexpr double grey = 0.80, part = 0.65;
  return {color[0] + part * (grey - color[0]), color[1] + part * (grey - color[1]),
          color[2] + part * (grey - color[2])};
}

PointColor faded(const PointColor& color) {
  const auto [red, green, blue] = faded(std::array<double, 3>{color[0], color[1], color[2]});
  return {static_cast<float>(red), static_cast<float>(green), static_cast<float>(blue)};
}

void fade(vtkLookupTable* colors) {
  for (vtkIdType i = 0; i < colors->GetNumberOfTableValues(); ++i) {
    const double* own = colors->GetTableValue(i);
    const auto [red, green, blue] = faded(std::array{own[0], own[1], own[2]});
    colors->SetTableValue(i, red, green, blue);
  }
}

vtkSmartPointer<vtkLookupTable> tissue_colors() {
  std::vector<Stop> stops;
  for (const auto& [at, red, green, blue] : tissue_stops) stops.push_back({at, red, green, blue});
  return table(stops, 0, 1);
}

vtkSmartPointer<vtkLookupTable> value_colors(const ColorMap& map, double least, double greatest) {
  std::vector<Stop> stops;
  for (std::size_t i = 0; i < map.stops.size(); ++i) {
    const auto& [red, green, blue] = map.stops[i];
    stops.push_back({double(i) / double(map.stops.size() - 1), red, green, blue});
  }
  return table(stops, least, greatest);
}

}  // namespace cleft
