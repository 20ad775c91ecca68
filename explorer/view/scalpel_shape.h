// The shape of a scalpel with a curved blade, in mm: the tip is at the origin, the handle in the direction
// z, and the edge cuts in the direction x.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace cleft {

/// 30 mm long and 0.4 mm thick, ground to nothing along its edge. A closed surface, outward seen from
/// outside.
vtkSmartPointer<vtkPolyData> scalpel_blade();

/// From the fitting, over which the blade slides, to its end 140 mm above the tip; grooves for the fingers.
vtkSmartPointer<vtkPolyData> scalpel_handle();

}  // namespace cleft
