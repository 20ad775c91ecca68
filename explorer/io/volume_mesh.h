// A mesh of volume cells from and to a .vtu file, through VTK, and its cells split at a cut. VTK's types stay
// out of here.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "explorer/io/mesh_file.h"

namespace cleft {

class VolumeMesh {
 public:
  /// Reads .vtu. Throws FileError if the file is missing, damaged or has no volume cells.
  explicit VolumeMesh(const std::string& path);
  ~VolumeMesh();
  VolumeMesh(VolumeMesh&&) noexcept;

  /// The boundary of the cells, triangles counter-clockwise seen from outside. Throws FileError if there is
  /// none.
  SurfaceMesh surface(MeshReport* report = nullptr) const;

  std::vector<Vec3> points() const;
  int cells() const;
  double size() const;  ///< the sum of the cells' volumes

  struct Nearest {
    int vertex;       ///< of the surface: the nearest corner of the nearest triangle
    double distance;  ///< to the surface
  };
  std::vector<Nearest> nearest(const SurfaceMesh& surface) const;  ///< of every point

  /// Splits cells where `level`, a number for each point, changes its sign, if `is_cut` is true for the
  /// cell's points. The parts have points of their own. Other cells are unchanged.
  void split(const std::vector<double>& level, const std::function<bool(const std::vector<int>&)>& is_cut);
  /// The same for parts that remain connected: they have no sides, and no split is counted.
  void slice(const std::vector<double>& level, const std::function<bool(const std::vector<int>&)>& is_cut);
  /// For each point, the sign of `level` in its part in the number-th split: -1 or 1, or 0.
  std::vector<int> parts(int number) const;

  /// Writes .vtu with the file's own arrays and further ones of the points, completely or not at all.
  void write(const std::string& path, const std::vector<Vec3>& points,
             const std::vector<PointArray>& arrays) const;

 private:
  struct Grid;
  void clip(const std::vector<double>& level, const std::function<bool(const std::vector<int>&)>& is_cut,
            const std::string& sides);
  std::string path_;
  std::unique_ptr<Grid> grid_;
  int splits_ = 0;
};

}  // namespace cleft
