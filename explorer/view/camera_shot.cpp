#include "explorer/view/camera_shot.h"

#include <vtkImageShrink3D.h>
#include <vtkPNGWriter.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/memory_file.h"
#include "explorer/view/offscreen_window.h"
#include "explorer/view/picture.h"

namespace cleft {

vtkSmartPointer<vtkRenderWindow> double_window(int width, int height) {
  const vtkSmartPointer<vtkRenderWindow> window = make_offscreen_window(2 * width, 2 * height);
  window->SetDPI(2 * window->GetDPI());  // text keeps its size when the picture is shrunk
  return window;
}

vtkSmartPointer<vtkImageData> read_half(vtkRenderWindow* window) {
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> shrunk;
  shrunk->SetInputConnection(image->GetOutputPort());
  shrunk->SetShrinkFactors(2, 2, 1);
  shrunk->MeanOn();
  shrunk->Update();
  return shrunk->GetOutput();
}

void write_png(vtkImageData* image, const std::string& path, const std::string& state) {
  write_through_memory(path, [&](const std::string& file) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName(file.c_str());
    if (!state.empty()) writer->AddText(picture_state_key, state.c_str());
    writer->Write();
    if (writer->GetErrorCode() != 0) throw std::runtime_error(path + ": the picture could not be written");
  });
}

namespace {

/// The pictures on black and on white determine both colour and opacity.
vtkSmartPointer<vtkImageData> without_background(vtkImageData* black, vtkImageData* white) {
  const auto image = vtkSmartPointer<vtkImageData>::New();
  int size[3];
  black->GetDimensions(size);
  image->SetDimensions(size);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  const auto* b = static_cast<const unsigned char*>(black->GetScalarPointer());
  const auto* w = static_cast<const unsigned char*>(white->GetScalarPointer());
  auto* out = static_cast<unsigned char*>(image->GetScalarPointer());
  const vtkIdType pixels = vtkIdType{size[0]} * size[1];
  for (vtkIdType i = 0; i < pixels; ++i, b += 3, w += 3, out += 4) {
    const double seen_through = (w[0] - b[0] + w[1] - b[1] + w[2] - b[2]) / 3.;
    const double cover = std::clamp(255 - seen_through, 0., 255.);
    for (int k = 0; k < 3; ++k)
      out[k] = static_cast<unsigned char>(cover > 0 ? std::min(255., std::round(255 * b[k] / cover)) : 0);
    out[3] = static_cast<unsigned char>(std::round(cover));
  }
  return image;
}

}  // namespace

CameraShot::CameraShot(int width, int height) : window_(double_window(width, height)), stage_(window_, 2) {}

vtkSmartPointer<vtkImageData> CameraShot::take(Session& session, bool transparent) {
  stage_.show(session);
  if (!transparent) return read_half(window_);
  const auto before = [&](double shade) {
    for (int i = 0; i < stage_.views(); ++i) {
      stage_.view(i).renderer()->GradientBackgroundOff();
      stage_.view(i).renderer()->SetBackground(shade, shade, shade);
    }
    return read_half(window_);
  };
  const auto black = before(0);
  return without_background(black, before(1));
}

}  // namespace cleft
