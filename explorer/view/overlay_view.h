// Draws an overlay: dots and lines, in front of a surface that they touch.
#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>

#include "explorer/scene/overlay.h"

namespace cleft {

class OverlayView {
 public:
  /// Adds its actors to a renderer, which must outlive it, and removes them on destruction.
  explicit OverlayView(vtkRenderer* renderer);
  ~OverlayView();
  OverlayView(const OverlayView&) = delete;
  OverlayView& operator=(const OverlayView&) = delete;

  /// `dark`: whether the background of the legend is dark. `pixels`: the scene's in one of the window, 1, or
  /// 0.5 where it is drawn at half the resolution.
  void show(const Overlay& overlay, bool dark, double pixels = 1);

 private:
  void explain(const std::optional<Overlay::Scale>& scale, bool dark);

  vtkRenderer* renderer_;
  vtkNew<vtkActor> dots_, lines_, handles_;
  vtkNew<vtkPolyData> dot_data_, line_data_, handle_data_;
  vtkSmartPointer<vtkScalarBarActor> legend_;
};

}  // namespace cleft
