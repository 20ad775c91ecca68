#include "tests/fuzz/targets.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "encoder/import/frame_files.h"
#include "explorer/incision/incision.h"
#include "explorer/io/mesh_file.h"

namespace cleft::fuzz {

namespace {

/// A file for a reader, in memory where the system has such a place.
class InputFile {
 public:
  InputFile(const std::string& ending, const std::uint8_t* data, std::size_t size) {
    const std::filesystem::path folder =
        std::filesystem::exists("/dev/shm") ? "/dev/shm" : std::filesystem::temp_directory_path();
    path_ = (folder / ("cleft-fuzz-" + std::to_string(getpid()) + ending)).string();
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  ~InputFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void cut_once(const SurfaceMesh& mesh) {
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const Vec3 n = cross(b - a, c - a), middle = 1. / 3 * (a + b + c);
    if (!(squared_norm(n) > 0) || !std::isfinite(squared_norm(n))) continue;
    const double depth = norm(b - a);
    const ScalpelPath path({{middle, n, depth}, {middle + 2 * (b - a) + 0.3 * (c - a), n, depth}});
    IncisionOptions options;
    options.max_edge = 0;
    Incision cut(mesh, path, options);
    cut.advance_to(path.length() / 3);
    cut.advance_to(path.length());
    cut.undo();
    return;
  }
}

}  // namespace

void read_path(const std::uint8_t* data, std::size_t size) {
  const InputFile file(".csv", data, size);
  try {
    const ScalpelPath path = ScalpelPath::from_table(read_csv(file.path()), file.path());
    for (const double part : {-0.1, 0., 0.3, 1., 1.2}) {
      const PathFrame frame = path.at(part * path.length());
      path.coordinates(frame.position + frame.across);
    }
  } catch (const InputError&) {
  }
}

void read_and_cut_mesh(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return;
  const char* endings[] = {".obj", ".stl", ".ply", ".vtp"};
  const char* ending = data[0] == 'g' ? ".glb" : data[0] == 't' ? ".gltf" : endings[data[0] % 4];
  const InputFile file(ending, data + 1, size - 1);
  try {
    const SurfaceMesh mesh = read_mesh(file.path());
    if (mesh.triangles.size() < 10000) cut_once(mesh);
  } catch (const InputError&) {
  }
}

void read_series(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  const InputFile file(data[0] % 2 == 0 ? ".frd" : ".xmf", data + 1, size - 1);
  try {
    const auto series = open_series({file.path()});
    for (std::size_t j = 0; j < series->times().size(); ++j)
      series->read(j, {series->point_arrays(j), series->cell_arrays(j)});
  } catch (const InputError&) {
  }
}

}  // namespace cleft::fuzz
