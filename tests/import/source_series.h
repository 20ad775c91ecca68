// A series as another program would leave it: .vtu files in text, listed in a .pvd.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "encoder/import/import_series.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

/// VTK's types of cells.
inline constexpr std::uint8_t quad = 9, tetra = 10, hexahedron = 12, wedge = 13, quadratic_hexahedron = 25;

struct SourceSeries {
  struct Field {
    std::string name;
    int components;
    std::vector<std::vector<double>> frames;  ///< point by point, or cell by cell
    bool of_cells = false;
  };

  SourceMesh mesh;
  std::vector<double> times;
  std::vector<Field> fields;
  bool single = false;  ///< fields in single precision

  std::int32_t add_point(const Vec3& p);
  void add_cell(std::uint8_t type, const std::vector<std::int64_t>& corners);
  std::string vtu(std::size_t frame) const;
  /// NAME.pvd and NAME_0.vtu, ...; gives the path of the .pvd.
  std::string write(const TemporaryFolder& folder, const std::string& name = "series") const;
};

/// The skin of a body of hexahedra: quads, the faces that only one of them has.
SourceSeries skin_of(SourceSeries series);

/// A rigid map, as a program may have placed the body in its own space.
struct Pose {
  Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< where (u, v, w) point there
  Vec3 origin;

  static Pose random(unsigned seed);
  Vec3 vector(const Vec3& local) const { return local.x * axes[0] + local.y * axes[1] + local.z * axes[2]; }
  Vec3 point(const Vec3& local) const { return origin + vector(local); }
  /// XX YY ZZ XY YZ XZ there, of a tensor given as such in (u, v, w).
  std::vector<double> tensor(const std::vector<double>& local) const;
};

/// Imports with the library, and reads what was written; checks the file, too.
struct Imported {
  Imported(const TemporaryFolder& folder, const std::string& series, const std::vector<std::string>& fields,
           const std::optional<std::string>& break_plane = {}, Box box = Box::smaller);
  ImportReport report;
  SnapshotReader reader;
  const Snapshot& snapshot() const { return reader.snapshot(); }
  /// All notes as one text.
  std::string notes() const;
};

/// Largest difference of two lists of points.
double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

}  // namespace cleft
