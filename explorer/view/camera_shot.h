// Pictures of a session, one after another, for screenshots, movies and databases.
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
  /// Pictures of this size in pixels, with four samples for each. Throws InputError if this machine cannot
  /// draw.
  CameraShot(int width, int height);

  /// A picture of the session's current state: RGB, or RGBA without the background.
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

/// Writes a PNG, completely or not at all, which contains the session `state` if one is given. Throws
/// std::runtime_error if it cannot be written.
void write_png(vtkImageData* image, const std::string& path, const std::string& state);

}  // namespace cleft
