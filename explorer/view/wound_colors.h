// The colours of skin, wound and displacement.
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>

#include "explorer/incision/surface_mesh.h"
#include "explorer/scene/color_maps.h"

namespace cleft {

inline constexpr std::array<double, 3> skin_color{0.91, 0.70, 0.60};

/// A colour of a surface that is a guess: paler and greyer.
std::array<double, 3> faded(const std::array<double, 3>& color);
PointColor faded(const PointColor& color);
/// The same of all colours of a table.
void fade(vtkLookupTable* colors);

/// From the skin down to the bottom of the cut, by depth fraction 0 to 1: dermis, fat, muscle.
vtkSmartPointer<vtkLookupTable> tissue_colors();

vtkSmartPointer<vtkLookupTable> value_colors(const ColorMap& map, double least, double greatest);

}  // namespace cleft
