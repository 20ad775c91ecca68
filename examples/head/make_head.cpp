// A head to cut: writes a closed surface of about 12,000 triangles, and a scalpel's path over its cheek.
//
//   make-head --out head.stl --path path.csv
//
// The shape is an implicit surface (head_shape.cpp), meshed by marching tetrahedra and remeshed to graded,
// well-shaped triangles (surface_mesher.cpp). Lengths in mm; x to the head's left, y up, z forward.

#include <cstdint>
#include <fstream>

#include "base/command/command.h"
#include "base/output_file.h"
#include "base/text.h"
#include "examples/head/head_shape.h"
#include "examples/head/surface_mesher.h"

namespace {

using namespace cleft;

void write_stl(const std::string& path, const head::TriangleMesh& mesh) {
  OutputFile file(path);
  std::ofstream out(file.path(), std::ios::binary);
  const auto put = [&out](const Vec3& p) {
    const float x[3] = {float(p.x), float(p.y), float(p.z)};
    out.write(reinterpret_cast<const char*>(x), sizeof x);
  };
  const std::string header("make-head, mm");
  out << header << std::string(80 - header.size(), ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 corners[3] = {mesh.points[a], mesh.points[b], mesh.points[c]};
    put(normalized(cross(corners[1] - corners[0], corners[2] - corners[0])));
    for (const Vec3& p : corners) put(p);
    out.write("\0", 2);
  }
  if (!out.flush()) throw std::runtime_error(path + ": could not be written");
  file.commit();
}

void write_path(const std::string& path) {
  std::string text = "x,y,z,nx,ny,nz\n";
  for (const auto& [p, n] : head::cheek_path(2))
    text += shortest(p.x) + "," + shortest(p.y) + "," + shortest(p.z) + "," + shortest(n.x) + "," +
            shortest(n.y) + "," + shortest(n.z) + "\n";
  write_text_file(path, text);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Writes a stylised human head as a closed triangle mesh, in mm", "make-head");
  std::string out, path;
  int triangles = 12000;
  app.add_option("--out", out, "The head, binary STL")->required();
  app.add_option("--path", path, "A scalpel's path over the cheek, CSV: x,y,z,nx,ny,nz");
  app.add_option("--triangles", triangles, "How many triangles")
      ->check(in_range(4000, 20000))
      ->capture_default_str();
  return run_command(app, argc, argv, [&] {
    write_stl(out, head::mesh_head(triangles));
    if (!path.empty()) write_path(path);
  });
}
