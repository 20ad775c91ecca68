// The scalpel in the picture: blade and handle, standing on its tip.
#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include "haptic/pose.h"

namespace cleft {

class ScalpelView {
 public:
  /// Into a renderer that outlives it, and out of it at the end.
  explicit ScalpelView(vtkRenderer* renderer);
  ~ScalpelView();
  ScalpelView(const ScalpelView&) = delete;
  ScalpelView& operator=(const ScalpelView&) = delete;

  /// `tip` is where it is drawn, which stiff skin may keep from where the hand is; lengths in mm.
  void move(const ScalpelPose& pose, const Vec3& tip);

 private:
  vtkRenderer* renderer_;
  vtkNew<vtkActor> blade_, handle_;
};

}  // namespace cleft
