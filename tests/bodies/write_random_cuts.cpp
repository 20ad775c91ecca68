// write_random_cuts FOLDER SEED [MESHES]: writes generated meshes, and those of a folder, with paths of all
// kinds of tests/incision/stress as FOLDER/NAME.obj and FOLDER/NAME-KIND.csv, and prints a line for each
// path: NAME, KIND, mm per unit, the files of the mesh and of the paths, between tabs. "across" has a second
// path.
#include <algorithm>
#include <cstdio>
#include <optional>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "tests/incision/stress/random_path.h"
#include "tests/incision/stress/subjects.h"

namespace {

using namespace cleft;

constexpr double size = 200;  // mm: of a mesh, from corner to corner of its box
constexpr double shortest_cut = 4, longest_cut = 80, deepest = 5;  // mm
constexpr int throws = 400;                                        // for a path of such a length

std::string numbers(const Vec3& v, const char* between) {
  return shortest(v.x) + between + shortest(v.y) + between + shortest(v.z);
}

double diagonal(const SurfaceMesh& mesh) {
  Vec3 low = mesh.points[mesh.triangles[0][0]], high = low;
  for (const auto& t : mesh.triangles)
    for (const int v : t) {
      const Vec3& p = mesh.points[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  return norm(high - low);
}

void write(const SurfaceMesh& mesh, const std::string& file) {
  std::string text;
  for (const Vec3& p : mesh.points) text += "v " + numbers(p, " ") + "\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  write_text_file(file, text);
}

void write(const ScalpelPath& path, double scale, const std::string& file) {
  std::string text = "x,y,z,nx,ny,nz,depth\n";
  for (const double s : path.given()) {
    const PathFrame at = path.at(s);
    text += numbers(at.position, ",") + "," + numbers(at.outward, ",") + "," +
            shortest(std::min(path.depth(s), deepest / scale)) + "\n";
  }
  write_text_file(file, text);
}

/// Of a length that is cut into a body; of a tiny one, any.
std::optional<ScalpelPath> thrown(const stress::Ground& ground, stress::PathKind kind, double scale,
                                  const std::optional<ScalpelPath>& earlier, std::mt19937_64& random) {
  for (int i = 0; i < throws; ++i) {
    std::optional<ScalpelPath> path = random_path(ground, kind, earlier, random);
    if (!path) continue;
    const double length = path->length() * scale;
    if (kind == stress::PathKind::tiny || (length >= shortest_cut && length <= longest_cut)) return path;
  }
  return {};
}

void write_cuts(const stress::Subject& subject, const std::string& folder, unsigned seed) {
  std::string name = subject.name;
  std::ranges::replace(name, ' ', '-');
  const double scale = size / diagonal(subject.mesh);
  const stress::Ground ground(subject.mesh);
  write(subject.mesh, folder + name + ".obj");
  const std::string begin = folder + name + "-";
  std::mt19937_64 random(seed);
  std::optional<ScalpelPath> earlier;
  for (int i = 0; i < stress::path_kinds; ++i) {
    const auto kind = static_cast<stress::PathKind>(i);
    const auto path = thrown(ground, kind, scale, earlier, random);
    if (!path) continue;
    std::string kind_name = stress::name_of(kind);
    std::ranges::replace(kind_name, ' ', '-');
    std::string file = begin;
    file.append(kind_name).append(".csv");
    write(*path, scale, file);
    std::printf("%s\t%s\t%s\t%s", name.c_str(), kind_name.c_str(), shortest(scale).c_str(),
                (folder + name + ".obj").c_str());
    if (kind == stress::PathKind::across && earlier) std::printf("\t%s", (begin + "straight.csv").c_str());
    std::printf("\t%s\n", file.c_str());
    if (kind == stress::PathKind::straight) earlier = path;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: write_random_cuts FOLDER SEED [MESHES]\n");
    return 2;
  }
  std::vector<stress::Subject> subjects = stress::generated_subjects(true);
  if (argc == 4)
    for (stress::Subject& subject : stress::subjects_of(argv[3])) subjects.push_back(std::move(subject));
  for (const stress::Subject& subject : subjects) {
    try {
      write_cuts(subject, std::string(argv[1]) + "/", static_cast<unsigned>(std::stoul(argv[2])));
    } catch (const InputError& e) {
      std::fprintf(stderr, "%s: %s\n", subject.name.c_str(), e.what());
    }
  }
  return 0;
}
