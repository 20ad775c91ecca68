#include "tests/incision/stress/subjects.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "explorer/io/mesh_file.h"
#include "tests/incision/meshes.h"

namespace cleft::stress {

namespace {

double hills(double x, double y) { return 0.8 * std::sin(0.9 * x) * std::cos(0.7 * y); }
double ridge(double x, double) { return -2 * std::abs(x); }
double folds(double x, double) { return 3 * std::sin(2.5 * x); }
double spikes(double x, double y) {
  return 2.5 * std::pow(std::max(0., std::cos(0.8 * x) * std::cos(0.8 * y)), 8);
}

SurfaceMesh jittered(SurfaceMesh mesh, double by) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> moved(-by, by);
  for (Vec3& p : mesh.points) p.x += moved(random), p.y += moved(random);
  return mesh;
}

/// Two plates close to each other, joined along their sides.
SurfaceMesh lamella(double thickness) {
  SurfaceMesh mesh = testing::ring(60, 40, 1, 2.5, false);
  for (Vec3& p : mesh.points) {
    const double angle = std::atan2(p.y, p.x), half = 8;
    const double x = std::cos(angle);
    p = {half * (std::abs(x) < 0.98 ? x : std::copysign(1., x)), p.z,
         std::copysign(thickness / 2, std::sin(angle)) * std::min(1., 8 * std::abs(std::sin(angle)))};
  }
  return mesh;
}

/// Each place moved by a map of the space.
template <class Map>
SurfaceMesh mapped(SurfaceMesh mesh, const Map& map) {
  for (Vec3& p : mesh.points) p = map(p);
  return mesh;
}

/// Regular meshes bent, sheared and drawn out.
void add_mapped(std::vector<Subject>& subjects) {
  using namespace testing;
  const auto plane = [] { return grid(40, 40, -10, -10, 0.5); };
  subjects.push_back({"coarse plane", grid(8, 8, -12, -12, 3)});
  subjects.push_back({"sheared plane", mapped(plane(), [](Vec3 p) { return Vec3{p.x + 2 * p.y, p.y, 0}; })});
  subjects.push_back({"graded plane", mapped(plane(), [](Vec3 p) {
                        return Vec3{5 * std::exp(0.2 * p.x), 5 * std::exp(0.2 * p.y), 0};
                      })});
  subjects.push_back({"saddle", mapped(plane(), [](Vec3 p) {
                        return Vec3{p.x, p.y, 0.05 * (p.x * p.x - p.y * p.y)};
                      })});
  subjects.push_back({"bowl", mapped(plane(), [](Vec3 p) {
                        return Vec3{p.x, p.y, 0.05 * (p.x * p.x + p.y * p.y)};
                      })});
  subjects.push_back({"waves", mapped(plane(), [](Vec3 p) { return Vec3{p.x, p.y, std::sin(2 * p.x)}; })});
  subjects.push_back({"jittered sphere", jittered(sphere(4, 10), 0.2)});
  subjects.push_back({"ellipsoid", mapped(sphere(4, 10), [](Vec3 p) {
                        return Vec3{2 * p.x, p.y, p.z / 2};
                      })});
  subjects.push_back({"thin torus", ring(80, 12, 10, 1.5, true)});
  subjects.push_back({"flat torus", mapped(ring(60, 24, 10, 4, true), [](Vec3 p) {
                        return Vec3{p.x, p.y, 0.3 * p.z};
                      })});
  subjects.push_back({"bellows", mapped(ring(40, 20, 10, 3, false), [](Vec3 p) {
                        const double wide = 1 + 0.15 * std::sin(2 * p.z);
                        return Vec3{wide * p.x, wide * p.y, p.z};
                      })});
}

SurfaceMesh with_holes(SurfaceMesh mesh) {
  std::mt19937_64 random(2);
  std::erase_if(mesh.triangles, [&](const auto&) { return random() % 40 == 0; });
  return mesh;
}

}  // namespace

std::vector<Subject> generated_subjects(bool difficult) {
  using namespace testing;
  SurfaceMesh stretched = grid(40, 40, -10, -10, 0.5);
  for (Vec3& p : stretched.points) p.y *= 0.1;
  std::vector<Subject> subjects{
      {"plane", grid(30, 30, -15, -15, 1)},    {"hills", grid(50, 50, -10, -10, 0.4, hills)},
      {"stretched plane", stretched},          {"sphere", sphere(4, 10)},
      {"octahedron", sphere(1, 10), false},    {"torus", ring(60, 24, 10, 4, true)},
      {"cylinder", ring(40, 20, 10, 3, false)}};
  if (!difficult) return subjects;
  subjects.push_back({"jittered plane", jittered(grid(40, 40, -20, -20, 1), 0.3)});
  subjects.push_back({"lamella", lamella(0.3), false});
  subjects.push_back({"ridge", grid(40, 40, -10, -10, 0.5, ridge), false});
  subjects.push_back({"spikes", grid(60, 60, -12, -12, 0.4, spikes), false});
  subjects.push_back({"folded sheet", grid(80, 40, -8, -8, 0.2, folds), false});
  subjects.push_back({"holes", with_holes(jittered(grid(40, 40, -20, -20, 1), 0.2)), false});
  add_mapped(subjects);
  return subjects;
}

Subject large_subject() {
  return {"plane of a million", testing::grid(708, 708, -10, -10, 20. / 708, hills)};
}

std::vector<Subject> subjects_of(const std::string& folder) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".obj" || entry.path().extension() == ".stl")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Subject> subjects;
  for (const fs::path& file : files)
    subjects.push_back(
        {file.stem().string(), read_mesh(file.string()), file.parent_path().filename() != "defective"});
  return subjects;
}

}  // namespace cleft::stress
