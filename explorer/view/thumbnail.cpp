#include "explorer/view/thumbnail.h"

#include <vtkImageData.h>

#include <cstring>

#include "explorer/view/camera_shot.h"

namespace cleft {

ThumbnailDrawer::ThumbnailDrawer() : window_(double_window(thumbnail_width, thumbnail_height)) {
  window_->AddRenderer(view_.renderer());
}

ThumbnailDrawer::~ThumbnailDrawer() {
  view_.renderer()->ReleaseGraphicsResources(window_);
  window_->RemoveRenderer(view_.renderer());
}

std::vector<unsigned char> ThumbnailDrawer::draw(std::shared_ptr<const WoundScene> scene) {
  constexpr double elevation = -28, zoom = 1.9;  // into the wound; the edges of a patch are left out
  view_.show(std::move(scene));
  view_.color_by(Coloring::tissue);
  CameraState camera;
  camera.elevation = elevation, camera.zoom = zoom;
  view_.aim(camera);
  const auto image = read_half(window_);
  constexpr std::size_t row = 3 * thumbnail_width;
  std::vector<unsigned char> pixels(row * thumbnail_height);
  const auto* from = static_cast<const unsigned char*>(image->GetScalarPointer());
  for (std::size_t y = 0; y < thumbnail_height; ++y)  // VTK's rows begin at the bottom
    std::memcpy(&pixels[row * y], from + row * (thumbnail_height - 1 - y), row);
  return pixels;
}

}  // namespace cleft
