// The scalpel in the picture: blade and handle.
#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include "haptic/pose.h"

namespace cleft {

class ScalpelView {
 public:
  /// Adds its actors to a renderer, which must outlive it, and removes them on destruction.
  explicit ScalpelView(vtkRenderer* renderer);
  ~ScalpelView();
  ScalpelView(const ScalpelView&) = delete;
  ScalpelView& operator=(const ScalpelView&) = delete;

  /// `tip`: where it is drawn, which differs from the hand's position on stiff skin; lengths in mm.
  void move(const ScalpelPose& pose, const Vec3& tip);

 private:
  vtkRenderer* renderer_;
  vtkNew<vtkActor> blade_, handle_;
};

}  // namespace cleft
