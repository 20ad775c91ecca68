// The legend of a picture's colours.
#pragma once

#include <vtkLookupTable.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>

#include <string>

namespace cleft {

/// Centred horizontally in a view; `low`: its vertical position, relative to the height.
vtkSmartPointer<vtkScalarBarActor> make_legend(vtkLookupTable* colors, const std::string& title,
                                               double low = 0.015);
void set_dark_background(vtkScalarBarActor* legend, bool dark);

}  // namespace cleft
