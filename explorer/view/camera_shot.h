// Pictures of what a session shows, one after another: for screenshots, movies and databases.
#pragma once

#include <vtkImageData.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <string>

#include "explorer/session/session.h"
#include "explorer/view/stage.h"

namespace cleft {

class CameraShot {
 public:
  /// Pictures of that size in pixels, with four samples each. Throws InputError where nothing can be drawn on
  /// this machine.
  CameraShot(int width, int height);

  /// As the session is now. RGB; or RGBA without the background.
  vtkSmartPointer<vtkImageData> take(Session& session, bool transparent = false);

 private:
  vtkSmartPointer<vtkImageData> read();

  vtkSmartPointer<vtkRenderWindow> window_;
  Stage stage_;
};

/// The window's picture, shrunk to half its size.
vtkSmartPointer<vtkImageData> read_half(vtkRenderWindow* window);
/// A window of twice the size, so that pictures can be shrunk.
vtkSmartPointer<vtkRenderWindow> double_window(int width, int height);

/// As a PNG, whole or not at all, with the saved session `state` in it where there is one. Throws
/// std::runtime_error where it cannot be written.
void write_png(vtkImageData* image, const std::string& path, const std::string& state);

}  // namespace cleft
