#include "explorer/view/picture.h"

#include <vtkPNGReader.h>

#include <filesystem>

#include "base/error.h"
#include "base/output_file.h"
#include "explorer/io/mesh_file.h"
#include "explorer/view/camera_shot.h"
#include "explorer/view/movie.h"

namespace cleft {

namespace {

void check_ending(const std::string& path) {
  if (!path.ends_with(".png"))
    throw InputError(path + ": pictures are written as PNG; let the name end in .png");
}

}  // namespace

void write_picture(WoundView& view, int width, int height, const std::string& path) {
  check_ending(path);
  const OutputFile probe(path);  // reports a bad name before the work
  const vtkSmartPointer<vtkRenderWindow> window = double_window(width, height);
  window->AddRenderer(view.renderer());
  write_png(read_half(window), path, "");
  view.renderer()->ReleaseGraphicsResources(window);
  window->RemoveRenderer(view.renderer());
}

void write_picture(Session& session, int width, int height, const std::string& path, bool transparent) {
  check_ending(path);
  const OutputFile probe(path);  // reports a bad name before the work
  CameraShot shot(width, height);
  write_png(shot.take(session, transparent), path, state_to_json(session.state()));
}

std::string state_in_picture(const std::string& path) {
  if (!std::filesystem::exists(path)) throw FileError(path, "no such file");
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(path.c_str())) throw FileError(path, "is no PNG");
  reader->SetFileName(path.c_str());
  reader->Update();
  int range[2];
  reader->GetTextChunks(picture_state_key, range);
  if (range[0] >= range[1]) throw FileError(path, "holds no session: it is no picture of cleft explore");
  return reader->GetTextValue(range[0]);
}

SessionServices session_services(std::function<void(const std::string&)> answer) {
  return {[](const std::string& file) { return read_mesh(file); },
          [](const std::string& file, const SurfaceMesh& mesh) { write_mesh(file, mesh); },
          [](Session& session, const std::string& file, int width, int height, bool transparent) {
            write_picture(session, width, height, file, transparent);
          },
          state_in_picture,
          std::move(answer),
          nullptr,
          write_movie};
}

}  // namespace cleft
