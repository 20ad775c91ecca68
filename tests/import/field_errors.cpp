#include "tests/import/field_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/pieces_at_nodes.h"
#include "tests/pipeline/commands.h"

namespace cleft {

FieldPlaces::FieldPlaces(const SnapshotReader& reader) {
  const Snapshot& s = reader.snapshot();
  uvw = s.points;
  frames.assign(uvw.size(), s.source->axes);
  if (s.coordinates) {
    const std::vector<double> at = reader.point_array({"canonical", 3, false}, 0),
                              axes = reader.point_array({"frame", 9, false}, 0);
    for (std::size_t n = 0; n < uvw.size(); ++n) {
      uvw[n] = {at[3 * n], at[3 * n + 1], at[3 * n + 2]};
      for (int k = 0; k < 3; ++k) {
        frames[n][k] = {};
        for (int i = 0; i < 3; ++i) frames[n][k] += axes[9 * n + 3 * k + i] * s.source->axes[i];
      }
    }
  }
  for (const Vec3& p : uvw) sides.push_back(side_of(p.y));
  for (const auto& [left, right] : s.pairs) sides[left] = Side::left, sides[right] = Side::right;
}

namespace {

/// Displacements from frame 0 at all nodes, in the source's space: of the spline, and as the file keeps them.
class KeptAtNodes {
 public:
  KeptAtNodes(const std::string& snapshot, const std::string& file) : reader_(snapshot), places_(reader_) {
    const Snapshot& s = reader_.snapshot();
    if (pieces_in(file) == 0) {
      field_.emplace(read_field(file)), residual_ = read_residual(file);
      return;
    }
    std::vector<NodesOfPiece> nodes;
    for (const SnapshotPiece& piece : s.pieces)
      nodes.push_back(
          counting_nodes(piece.nodes, static_cast<std::size_t>(piece.counting), piece.places, piece.pairs));
    const auto inside = places_inside_cells(s.points_in_source(), s.cell_offsets, s.connectivity);
    alone_.emplace(read_pieces(file), nodes, inside, 0);
    all_.emplace(read_pieces(file), nodes, inside, s.frames());
  }

  std::vector<Vec3> spline(std::size_t frame) const { return at(frame, false); }
  std::vector<Vec3> stored(std::size_t frame) const { return at(frame, true); }

 private:
  std::vector<Vec3> at(std::size_t frame, bool stored) const {
    const double t = reader_.snapshot().times[frame];
    std::vector<Vec3> values;
    if (alone_) {
      values = (stored ? all_ : alone_)->displacement(t, frame);
    } else {
      for (std::size_t n = 0; n < places_.uvw.size(); ++n) {
        const Vec3 d = field_->displacement(places_.uvw[n], places_.sides[n], t);
        values.push_back(stored && residual_ && frame > 0 ? d + residual_->at(n, frame) : d);
      }
    }
    for (std::size_t n = 0; n < values.size(); ++n) {
      const auto& [u, v, w] = places_.frames[n];
      values[n] = values[n].x * u + values[n].y * v + values[n].z * w;
    }
    return values;
  }

  SnapshotReader reader_;
  FieldPlaces places_;
  std::optional<Field> field_;
  std::optional<NodeResidual> residual_;
  std::optional<PiecesAtNodes> alone_, all_;
};

}  // namespace

Errors measured(const CrackedBody& body, double tolerance) {
  const TemporaryFolder folder;
  Errors errors;
  const std::string snapshot = folder / "case.h5", file = folder / "case.dffd",
                    values = folder / "values.csv";
  const Outcome imported =
      run_cleft("import", {body.series().write(folder), "--field", "displacement", "--out", snapshot});
  EXPECT_EQ(imported.exit_code, 0) << body.name << ": " << imported.output;
  errors.said = imported.output;
  if (imported.exit_code != 0) return errors;
  const Outcome encoded = run_cleft("encode", {snapshot, "--tolerance", shortest(tolerance), "--out", file});
  EXPECT_EQ(encoded.exit_code, 0) << body.name << ": " << encoded.output;
  errors.said += encoded.output;
  if (encoded.exit_code != 0) return errors;

  const KeptAtNodes kept(snapshot, file);
  const std::vector<CrackedBody::Node> nodes = body.nodes();
  std::map<std::array<double, 3>, std::vector<std::size_t>> at_place;  // nodes of doubled places
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (nodes[n].side != 0) at_place[{nodes[n].abc.x, nodes[n].abc.y, nodes[n].abc.z}].push_back(n);
  double largest = 0;
  for (std::size_t j = 0; j < body.times.size(); ++j) {
    std::vector<Vec3> off = kept.spline(j), off_kept = kept.stored(j);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Vec3 exact = body.displacement(nodes[n].abc, nodes[n].side, body.times[j]) -
                         body.displacement(nodes[n].abc, nodes[n].side, body.times[0]);
      largest = std::max(largest, norm(exact));
      off[n] -= exact, off_kept[n] -= exact;
      errors.spline = std::max(errors.spline, norm(off[n]));
      errors.nodes = std::max(errors.nodes, norm(off_kept[n]));
    }
    for (const auto& [abc, there] : at_place)
      for (const std::size_t a : there)
        for (const std::size_t b : there) errors.opening = std::max(errors.opening, norm(off[a] - off[b]));
  }
  errors.nodes /= largest, errors.spline /= largest, errors.opening /= largest;
  errors.bytes = static_cast<double>(std::filesystem::file_size(file));
  return errors;
}

void expect_exact(const CrackedBody& body) {
  constexpr double tolerance = 0.01;
  const Errors errors = measured(body, tolerance);
  std::printf("| %s | %.4f | %.4f | %.4f | %.0f |\n", body.name.c_str(), errors.nodes, errors.spline,
              errors.opening, errors.bytes);
  EXPECT_LE(errors.nodes, 1.0001 * tolerance) << body.name << "\n" << errors.said;
  EXPECT_LE(errors.spline, 2 * tolerance) << body.name << "\n" << errors.said;
  EXPECT_LE(errors.opening, 2 * tolerance) << body.name << "\n" << errors.said;
}

}  // namespace cleft
