#include "explorer/view/picture.h"

#include <vtkImageShrink3D.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkWindowToImageFilter.h>

#include <filesystem>
#include <stdexcept>

#include "base/error.h"
#include "base/output_file.h"
#include "explorer/io/mesh_file.h"
#include "explorer/view/offscreen_window.h"
#include "explorer/view/stage.h"

namespace cleft {

namespace {

constexpr const char* state_key = "cleft-session";

void check_ending(const std::string& path) {
  if (!path.ends_with(".png"))
    throw InputError(path + ": pictures are written as PNG; let the name end in .png");
}

vtkSmartPointer<vtkRenderWindow> window_for(int width, int height) {
  const vtkSmartPointer<vtkRenderWindow> window = make_offscreen_window(2 * width, 2 * height);
  window->SetDPI(2 * window->GetDPI());  // text keeps its size when the picture is shrunk
  return window;
}

void write_window(vtkRenderWindow* window, const OutputFile& file, const std::string& path,
                  const std::string& state) {
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
  if (!state.empty()) writer->AddText(state_key, state.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0) throw std::runtime_error(path + ": the picture could not be written");
}

}  // namespace

void write_picture(WoundView& view, int width, int height, const std::string& path) {
  check_ending(path);
  OutputFile file(path);
  const vtkSmartPointer<vtkRenderWindow> window = window_for(width, height);
  window->AddRenderer(view.renderer());
  write_window(window, file, path, "");
  view.renderer()->ReleaseGraphicsResources(window);
  window->RemoveRenderer(view.renderer());
  file.commit();
}

void write_picture(Session& session, int width, int height, const std::string& path) {
  check_ending(path);
  OutputFile file(path);
  const vtkSmartPointer<vtkRenderWindow> window = window_for(width, height);
  Stage stage(window);
  stage.show(session);
  write_window(window, file, path, state_to_json(session.state()));
  file.commit();
}

std::string state_in_picture(const std::string& path) {
  if (!std::filesystem::exists(path)) throw FileError(path, "no such file");
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(path.c_str())) throw FileError(path, "is no PNG");
  reader->SetFileName(path.c_str());
  reader->Update();
  int range[2];
  reader->GetTextChunks(state_key, range);
  if (range[0] >= range[1]) throw FileError(path, "holds no session: it is no picture of cleft explore");
  return reader->GetTextValue(range[0]);
}

SessionServices session_services(std::function<void(const std::string&)> answer) {
  return {[](const std::string& file) { return read_mesh(file); },
          [](const std::string& file, const SurfaceMesh& mesh) { write_mesh(file, mesh); },
          [](Session& session, const std::string& file, int width, int height) {
            write_picture(session, width, height, file);
          },
          state_in_picture, std::move(answer)};
}

}  // namespace cleft
