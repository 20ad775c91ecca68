#include "explorer/view/coarse_pass.h"

#include <vtkLightsPass.h>
#include <vtkObjectFactory.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkTranslucentPass.h>
#include <vtk_glew.h>

namespace cleft {

vtkStandardNewMacro(CoarsePass);

CoarsePass::CoarsePass() {
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(vtkNew<vtkLightsPass>());
  passes->AddItem(vtkNew<vtkOpaquePass>());
  passes->AddItem(vtkNew<vtkTranslucentPass>());
  vtkNew<vtkSequencePass> all;
  all->SetPasses(passes);
  scene_->SetDelegatePass(all);
}

void CoarsePass::make_frame(vtkRenderWindow* window, int width, int height) {
  frame_->SetContext(window);
  int size[2];
  frame_->GetLastSize(size);
  if (!made_)
    frame_->PopulateFramebuffer(width, height);
  else if (size[0] != width || size[1] != height)
    frame_->Resize(width, height);
  made_ = true;
}

void CoarsePass::Render(const vtkRenderState* state) {
  vtkRenderer* renderer = state->GetRenderer();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  vtkOpenGLState* gl = window->GetState();
  int width, height, left, low;
  renderer->GetTiledSizeAndOrigin(&width, &height, &left, &low);
  const int half_width = (width + 1) / 2, half_height = (height + 1) / 2;
  if (half_width < 1 || half_height < 1) return;

  gl->PushFramebufferBindings();
  make_frame(window, half_width, half_height);
  frame_->Bind();
  frame_->ActivateDrawBuffer(0);
  vtkRenderState half(renderer);
  half.SetPropArrayAndCount(state->GetPropArray(), state->GetPropArrayCount());
  half.SetFrameBuffer(frame_);
  scene_->Render(&half);
  gl->PopFramebufferBindings();

  gl->PushReadFramebufferBinding();
  frame_->Bind(vtkOpenGLFramebufferObject::GetReadMode());
  frame_->ActivateReadBuffer(0);
  gl->vtkglViewport(left, low, width, height);
  gl->vtkglScissor(left, low, width, height);
  const int from[] = {0, half_width, 0, half_height}, to[] = {left, left + width, low, low + height};
  vtkOpenGLFramebufferObject::Blit(from, to, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  gl->PopReadFramebufferBinding();
  labels_->Render(state);
}

void CoarsePass::ReleaseGraphicsResources(vtkWindow* window) {
  scene_->ReleaseGraphicsResources(window);
  labels_->ReleaseGraphicsResources(window);
  frame_->ReleaseGraphicsResources(window);
  made_ = false;
}

}  // namespace cleft
