// Small pictures of cases, one after another.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

#include "explorer/view/wound_view.h"

namespace cleft {

/// What they show and how; pictures that were kept with another look are drawn anew.
inline constexpr const char* thumbnail_look = "160x100-1";
inline constexpr int thumbnail_width = 160, thumbnail_height = 100;

class ThumbnailDrawer {
 public:
  /// Throws InputError if this machine cannot draw.
  ThumbnailDrawer();
  ~ThumbnailDrawer();

  /// The wound of a case, completely cut, as it looks: red, green, blue, rows from the top.
  std::vector<unsigned char> draw(std::shared_ptr<const WoundScene> scene);

 private:
  vtkSmartPointer<vtkRenderWindow> window_;
  WoundView view_;
};

}  // namespace cleft
