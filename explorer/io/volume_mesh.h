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
  /// Reads .vtu. Throws FileError where the file is missing, damaged or has no cells of volume.
  explicit VolumeMesh(const std::string& path);
  ~VolumeMesh();
  VolumeMesh(VolumeMesh&&) noexcept;

  /// The outside of the cells, triangles counter-clockwise from there. Throws FileError where there is none.
  SurfaceMesh surface(MeshReport* report = nullptr) const;

  std::vector<Vec3> points() const;
  int cells() const;
  double size() const;  ///< the sum of the cells' volumes

  struct Nearest {
    int vertex;       ///< of the surface: the nearest corner of the nearest triangle
    double distance;  ///< to the surface
  };
  std::vector<Nearest> nearest(const SurfaceMesh& surface) const;  ///< of every point

  /// Splits cells where `beside`, a number for each point, changes its sign: those that `is_cut` says so of,
  /// told by the cell's points. Parts have points of their own. Others stay as they are, whole.
  void split(const std::vector<double>& beside, const std::function<bool(const std::vector<int>&)>& is_cut);
  /// The same without opening anything: no side is told of the parts, and no split counted.
  void slice(const std::vector<double>& beside, const std::function<bool(const std::vector<int>&)>& is_cut);
  /// For each point, of the number-th split -1 or 1, in a part where `beside` was so, or 0.
  std::vector<int> parts(int number) const;

  /// Writes .vtu with the file's own arrays and further ones of the points, whole or not at all.
  void write(const std::string& path, const std::vector<Vec3>& points,
             const std::vector<PointArray>& arrays) const;

 private:
  struct Grid;
  void clip(const std::vector<double>& beside, const std::function<bool(const std::vector<int>&)>& is_cut,
            const std::string& sides);
  std::string path_;
  std::unique_ptr<Grid> grid_;
  int splits_ = 0;
};

}  // namespace cleft
