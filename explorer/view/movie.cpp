#include "explorer/view/movie.h"

#include <vtkLogger.h>
#include <vtkOggTheoraWriter.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "base/error.h"
#include "base/memory_file.h"
#include "base/output_file.h"
#include "base/output_folder.h"
#include "base/vtk_listener.h"
#include "explorer/view/camera_shot.h"

namespace cleft {

namespace {

namespace fs = std::filesystem;

/// The session's time is put back, whatever happens.
class KeptTime {
 public:
  explicit KeptTime(Session& session) : session_(session), time_(session.state().time) {}
  ~KeptTime() { session_.edit().time = time_; }
  KeptTime(const KeptTime&) = delete;
  KeptTime& operator=(const KeptTime&) = delete;

 private:
  Session& session_;
  double time_;
};

void each_frame(Session& session, const MovieFormat& format,
                const std::function<void(int, vtkImageData*)>& use) {
  const KeptTime kept(session);
  CameraShot shot(format.width, format.height);
  const double duration = session.duration();
  const int frames = std::max(1, static_cast<int>(std::ceil(duration / session.state().speed * format.rate)));
  for (int j = 0; j <= frames; ++j) {
    session.progress("drawing the movie", double(j) / (frames + 1));
    session.edit().time = duration * j / frames;
    use(j, shot.take(session));
  }
}

void write_ogg(Session& session, const std::string& path, const MovieFormat& format) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
  vtkNew<vtkOggTheoraWriter> writer;
  const VtkListener writing(writer.Get());
  const auto check = [&] {
    if (writing.failed() || writer->GetErrorCode() != 0)
      throw std::runtime_error(path + ": the movie could not be written: " + writing.reason());
  };
  writer->SetRate(static_cast<int>(std::round(format.rate)));
  writer->SetQuality(2);
  write_through_memory(path, [&](const std::string& file) {
    writer->SetFileName(file.c_str());
    bool begun = false;
    each_frame(session, format, [&](int, vtkImageData* image) {
      writer->SetInputData(image);
      if (!begun) writer->Start(), begun = true;
      writer->Write();
      check();
    });
    writer->End();
    check();
  });
}

void write_folder(Session& session, const std::string& path, const MovieFormat& format) {
  fs::path place = fs::path(path).lexically_normal();
  if (place.filename().empty()) place = place.parent_path();
  if (fs::exists(place) && !(fs::is_directory(place) && fs::is_empty(place)))
    throw InputError(path + ": exists; give the name of a new folder, or one that ends in .ogv");
  const std::string name = place.filename().string();
  OutputFolder out(place.has_parent_path() ? place.parent_path().string() : ".", name);
  const fs::path frames = fs::path(out.path()) / name;
  fs::create_directory(frames);
  each_frame(session, format, [&](int j, vtkImageData* image) {
    char frame[40];
    std::snprintf(frame, sizeof frame, "frame_%04d.png", j);
    write_png(image, (frames / frame).string(), "");
  });
  out.commit({name});
}

}  // namespace

void write_movie(Session& session, const std::string& file, const MovieFormat& format) {
  const std::string ending = fs::path(file).extension().string();
  if (ending == ".ogv") return write_ogg(session, file, format);
  if (!ending.empty())
    throw InputError(file + ": a movie is a file .ogv (Ogg Theora), or a folder of pictures");
  write_folder(session, file, format);
}

}  // namespace cleft
