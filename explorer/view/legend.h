// What the colours of a picture mean.
#pragma once

#include <vtkLookupTable.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>

#include <string>

namespace cleft {

/// Across the middle of a view; `low`: how far up its height.
vtkSmartPointer<vtkScalarBarActor> make_legend(vtkLookupTable* colors, const std::string& title,
                                               double low = 0.015);
void set_dark_background(vtkScalarBarActor* legend, bool dark);

}  // namespace cleft
