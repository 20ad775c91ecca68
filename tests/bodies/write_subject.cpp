// write_subject NAME FOLDER: writes a small subject (subjects.h) as FOLDER/skin.obj, path1.csv, ... and
// bone.obj, and prints the options of cleft body that name them.
#include <cstdio>

#include "base/output_file.h"
#include "base/text.h"
#include "tests/bodies/subjects.h"

namespace {

using namespace cleft;

std::string numbers(const Vec3& v, const char* between) {
  return shortest(v.x) + between + shortest(v.y) + between + shortest(v.z);
}

void write(const SurfaceMesh& mesh, const std::string& file) {
  std::string text;
  for (const Vec3& p : mesh.points) text += "v " + numbers(p, " ") + "\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  write_text_file(file, text);
}

void write(const ScalpelPath& path, const std::string& file) {
  constexpr int pieces = 24;
  std::string text = "x,y,z,nx,ny,nz,depth\n";
  for (int i = 0; i <= pieces; ++i) {
    const double s = path.length() * i / pieces;
    const PathFrame at = path.at(s);
    text += numbers(at.position, ",") + "," + numbers(at.outward, ",") + "," + shortest(path.depth(s)) + "\n";
  }
  write_text_file(file, text);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: write_subject NAME FOLDER\n");
    return 2;
  }
  const testing::Subject subject = testing::small_subject(argv[1]);
  const std::string folder = std::string(argv[2]) + "/";
  write(subject.skin, folder + "skin.obj");
  std::printf("--mesh %sskin.obj", folder.c_str());
  for (std::size_t k = 0; k < subject.paths.size(); ++k) {
    const std::string file = folder + "path" + std::to_string(k + 1) + ".csv";
    write(subject.paths[k], file);
    std::printf(" --path %s", file.c_str());
  }
  if (subject.bone) {
    write(*subject.bone, folder + "bone.obj");
    std::printf(" --bone %sbone.obj", folder.c_str());
  }
  std::printf("\n");
  return 0;
}
