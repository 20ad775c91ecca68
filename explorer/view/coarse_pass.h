// A scene at half the resolution with labels at the whole one, for pictures that follow each other.
#pragma once

#include <vtkCameraPass.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOverlayPass.h>
#include <vtkRenderPass.h>

namespace cleft {

/// As a renderer's pass: what is in space is drawn into a framebuffer of half the size, which is stretched
/// over the renderer's part of the window; what lies over the picture (titles, legend, scale bar) is drawn
/// onto that.
class CoarsePass : public vtkRenderPass {
 public:
  static CoarsePass* New();
  vtkTypeMacro(CoarsePass, vtkRenderPass)

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

 protected:
  CoarsePass();

 private:
  void make_frame(vtkRenderWindow* window, int width, int height);

  vtkNew<vtkOpenGLFramebufferObject> frame_;
  bool made_ = false;
  vtkNew<vtkCameraPass> scene_;
  vtkNew<vtkOverlayPass> labels_;
};

}  // namespace cleft
