#include "explorer/view/wound_colors.h"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

#include <vector>

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

void fade(vtkLookupTable* colors) {
  for (vtkIdType i = 0; i < colors->GetNumberOfTableValues(); ++i) {
    const double* own = colors->GetTableValue(i);
    const auto [red, green, blue] = faded({own[0], own[1], own[2]});
    colors->SetTableValue(i, red, green, blue);
  }
}

vtkSmartPointer<vtkLookupTable> tissue_colors() {
  return table({{0, 0.86, 0.52, 0.46},
                {0.12, 0.80, 0.40, 0.36},
                {0.20, 0.93, 0.74, 0.46},
                {0.50, 0.90, 0.66, 0.36},
                {0.64, 0.66, 0.17, 0.13},
                {1, 0.34, 0.04, 0.05}},
               0, 1);
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
