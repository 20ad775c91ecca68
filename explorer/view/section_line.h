// A clipping plane, and the line where it meets a surface that moves.
#pragma once

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>

#include <vector>

#include "base/vec3.h"

namespace cleft {

class SectionLine {
 public:
  /// Through `place`; what lies where `ahead` points is left out.
  SectionLine(const Vec3& place, const Vec3& ahead);

  void clip(vtkActor* actor) const;
  /// The line is that of all surfaces that were added.
  void add(vtkPolyData* surface);
  vtkActor* line() { return line_; }

 private:
  vtkNew<vtkPlane> plane_;
  std::vector<vtkSmartPointer<vtkCutter>> cutters_;
  vtkNew<vtkAppendPolyData> all_;
  vtkNew<vtkActor> line_;
};

}  // namespace cleft
