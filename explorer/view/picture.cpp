#include "explorer/view/picture.h"

#include <vtkImageShrink3D.h>
#include <vtkPNGWriter.h>
#include <vtkWindowToImageFilter.h>

#include <stdexcept>

#include "base/error.h"
#include "base/output_file.h"
#include "explorer/view/offscreen_window.h"

namespace cleft {

void write_picture(WoundView& view, int width, int height, const std::string& path) {
  if (!path.ends_with(".png"))
    throw InputError(path + ": pictures are written as PNG; let the name end in .png");
  OutputFile file(path);
  const vtkSmartPointer<vtkRenderWindow> window = make_offscreen_window(2 * width, 2 * height);
  window->SetDPI(2 * window->GetDPI());  // text keeps its size when the picture is shrunk
  window->AddRenderer(view.renderer());
  window->Render();

  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> shrunk;
  shrunk->SetInputConnection(image->GetOutputPort());
  shrunk->SetShrinkFactors(2, 2, 1);
  shrunk->MeanOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(shrunk->GetOutputPort());
  writer->SetFileName(file.path().c_str());
  writer->Write();
  view.renderer()->ReleaseGraphicsResources(window);
  window->RemoveRenderer(view.renderer());
  if (writer->GetErrorCode() != 0) throw std::runtime_error(path + ": the picture could not be written");
  file.commit();
}

}  // namespace cleft
