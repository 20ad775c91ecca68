// The snapshot file case.h5 (docs/formats.md): a finite element time series with a growing cut.
// It is also a VTKHDF 2.0 temporal UnstructuredGrid.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/h5/h5.h"
#include "base/output_file.h"
#include "base/turned.h"
#include "params/parameters/recorded.h"
#include "solver/snapshot/snapshot_values.h"

namespace cleft {

/// Version 2: with several breaks.
inline constexpr FileFormat snapshot_format{"cleft-snapshot", 1, "snapshot", "cleft solve", {2}};

/// The placement of imported data: (u, v, w) = axes (x - origin) for a point x in the space of the source.
struct SnapshotSource {
  std::string file;         ///< the series' name, without folders
  Vec3 origin;              ///< of (u, v, w), in the space of the source
  AxesInSpace axes;         ///< unit vectors of u, v, w in that space, right-handed
  double time_start = 0;    ///< time of the first frame in the source
  std::string break_plane;  ///< nx,ny,nz,offset in that space: points x with n . x = offset; or "none"
  /// Of a break that is no plane, or has a round front: its map to canonical coordinates (encoder/field/
  /// break_map.h), from (u, v, w) as they are placed here. `coordinates` are then its values at the nodes.
  std::vector<double> break_map = {};
  std::vector<std::string> fields = {};   ///< SOURCE:NAME: names of fields there and here; none: not recorded
  std::vector<double> break_extent = {};  ///< of a piece: SnapshotPiece::break_extent
  /// By which cleft import placed the break; 1 in files of before 0.2.
  static constexpr int newest_rules = 2;
  int rules = newest_rules;
};

/// A piece of a body with several breaks: the nodes around one of them, over its own (u, v, w).
struct SnapshotPiece {
  std::vector<std::int32_t> nodes;  ///< n of the N points
  /// Of them, the first ones, ascending: those at which the piece counts. The others, ascending, are nodes of
  /// the same cells.
  std::int32_t counting = 0;
  std::vector<Vec3> places;                        ///< n, in the coordinates of the break
  std::vector<std::array<std::int32_t, 2>> pairs;  ///< of `nodes`, by their place there
  std::vector<std::int32_t> released;              ///< F
  std::vector<double> position;                    ///< F
  double cut_start = 0, cut_length = 0, cut_depth = 0;
  Vec3 origin;                            ///< of (u, v, w), in the space of the source
  AxesInSpace axes = same_axes;           ///< unit vectors of u, v, w in that space
  std::string break_plane;                ///< as SnapshotSource::break_plane
  std::vector<double> break_map = {};     ///< as SnapshotSource::break_map
  std::vector<double> break_extent = {};  ///< encoder/field/field_source.h
};

/// The contents without the displacements. N points, C cells, P pairs, F frames. Lengths in mm.
struct Snapshot {
  static constexpr std::uint8_t triangle = 5, wedge = 13;  ///< VTK's cell types: skin and tissue

  std::vector<Vec3> points;                ///< N stress-free positions (u, v, w)
  std::vector<std::uint8_t> cell_types;    ///< C
  std::vector<std::int64_t> cell_offsets;  ///< C + 1
  std::vector<std::int64_t> connectivity;

  std::vector<std::array<std::int32_t, 3>>
      foundation_triangles;                                   ///< bottom faces; may be empty in imported data
  std::vector<std::array<std::int32_t, 4>> foundation_quads;  ///< side faces, in cyclic order

  std::vector<std::array<std::int32_t, 2>> pairs;  ///< P: left node, right node, in release order
  std::vector<std::int32_t> released;              ///< F: number of pairs open in each frame; 0 in frame 0
  std::vector<double> position;                    ///< F: u of the first node ahead that is still closed
  double cut_start = 0, cut_length = 0, cut_depth = 0;

  std::vector<double> times;                                   ///< F: t, the length cut, from 0
  std::vector<double> smallest_gap;                            ///< F
  std::vector<double> residual_equilibrium, residual_closure;  ///< F each; none in imported data

  RecordedParameters parameters;
  std::string case_hash;
  std::string body;  ///< hash of the body that was solved; empty for a patch
  /// Of a shaped patch: points are in space, and the arrays `canonical` and `frame` hold every node's
  /// coordinates of the cut, as those of a body do.
  bool coordinates = false;
  std::vector<Vec3> tension;  ///< of a body or a shaped patch, by triangle of skin: direction of prestress_u
  std::vector<std::uint8_t> support;  ///< by foundation triangle: 0 springs, 1 bone; empty: all springs
  std::vector<std::uint8_t> region;   ///< of a body with regions, by wedge: its number; else empty
  std::vector<std::array<double, 2>> region_moduli;  ///< E, MPa, and Poisson's ratio, by number
  std::optional<SnapshotSource> source;  ///< of imported data, which may lack pairs and have no residuals
  std::optional<std::size_t> counting;   ///< of a piece: SnapshotPiece::counting
  std::vector<SnapshotPiece> pieces;     ///< of imported data with several breaks: one for each

  std::size_t frames() const { return times.size(); }
  /// Whether points are not (u, v, w), which the arrays `canonical` and `frame` hold.
  bool has_own_coordinates() const { return coordinates || !body.empty(); }
  /// The points in the space of the source; of a simulation, as they are.
  std::vector<Vec3> points_in_source() const;
  /// The skin: all triangles, as indices into points.
  std::vector<std::array<int, 3>> skin() const;
};

/// Where `coordinates` is set, or of a body: every node's coordinates of the cut, and their unit vectors.
inline const SnapshotArray canonical_array{"canonical", 3, false}, frame_array{"frame", 9, false};

/// The group of a piece in the file.
inline std::string piece_group(std::size_t piece) { return "/pieces/" + std::to_string(piece); }

/// Writes a snapshot completely or not at all: displacement frame by frame, further arrays, then finish().
class SnapshotWriter {
 public:
  /// Writes mesh, cut, times and parameters, and allocates `arrays`; finish() writes the figures of the
  /// frames.
  SnapshotWriter(const std::string& path, const Snapshot& snapshot,
                 const std::vector<SnapshotArray>& arrays = {});
  /// Displacements from `points`, N of them, of frames first, first + 1, ...: one or more whole frames.
  void write_frames(std::size_t first, std::span<const Vec3> displacements);
  /// `values`: N times the components, point by point, for a frame of an allocated array. Rows that are never
  /// written are 0.
  void write_array(const SnapshotArray& array, std::size_t frame, std::span<const double> numbers);
  const std::string& path() const { return out_.path(); }  ///< the name the file has until finish()
  /// Writes smallest_gap and the residuals, flushes, and gives the file its name.
  void finish(const Snapshot& snapshot);

 private:
  OutputFile out_;
  h5::File file_;
  std::size_t points_;
};

/// Reads and checks all but the displacements when it opens a file; these are read frame by frame or in slabs
/// of nodes.
class SnapshotReader {
 public:
  /// Throws FileError if the file is not a snapshot, is damaged, or is inconsistent.
  explicit SnapshotReader(const std::string& path);
  /// One of its pieces (Snapshot::pieces), as if it had been imported alone: a snapshot of its nodes and of
  /// the cells that have no others, in its own (u, v, w).
  SnapshotReader(const std::string& path, std::size_t piece);

  const Snapshot& snapshot() const { return snapshot_; }
  const SnapshotValues& values() const { return values_; }
  /// Displacements from `points` in a frame, N of them.
  std::vector<Vec3> displacement(std::size_t frame) const;
  /// Displacements of the nodes first .. first + count - 1 in a frame.
  std::vector<Vec3> displacement(std::size_t frame, std::size_t first, std::size_t count) const;

  /// Every node's coordinates of the cut: its place, unless the snapshot says otherwise.
  std::vector<Vec3> coordinates() const;

  /// All arrays of /VTKHDF/PointData but the displacement, by name. Throws FileError if one has neither N nor
  /// F N rows.
  std::vector<SnapshotArray> point_arrays() const;
  /// N times the components, point by point; those of `frame` if the array varies.
  std::vector<double> point_array(const SnapshotArray& array, std::size_t frame) const;
  /// The same of the nodes first .. first + count - 1.
  std::vector<double> point_array(const SnapshotArray& array, std::size_t frame, std::size_t first,
                                  std::size_t count) const;

 private:
  explicit SnapshotReader(h5::File file);

  Snapshot snapshot_;
  SnapshotValues values_;
  std::vector<double> canonical_;  // of a piece over a map
};

/// Reads every byte of a snapshot and throws FileError at the first fault.
void check_snapshot(const std::string& path);

}  // namespace cleft
