// Cuts that meet or lie side by side in one body: each gets a field of its own, as exact as that of one cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/output_file.h"
#include "base/text.h"
#include "encoder/field/file/pieces_at_nodes.h"
#include "solver/snapshot/snapshot.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

struct Line {
  double x0, y0, x1, y1;
};

constexpr double sphere = 50;  // mm, its radius

/// Of a place on the plate, above it.
double height(double x, double y, bool bent) {
  return bent ? std::sqrt(sphere * sphere - x * x - y * y) - sphere : 0;
}

/// A plate of 64 by 64 mm, in squares of 4 mm; bent: to a sphere.
void write_plate(const std::string& path, bool bent) {
  constexpr int squares = 16;
  std::string text;
  for (int i = 0; i <= squares; ++i)
    for (int j = 0; j <= squares; ++j)
      text += "v " + std::to_string(4 * i - 32) + " " + std::to_string(4 * j - 32) + " " +
              shortest(height(4 * i - 32, 4 * j - 32, bent)) + "\n";
  const auto point = [](int i, int j) { return " " + std::to_string(i * (squares + 1) + j + 1); };
  for (int i = 0; i < squares; ++i)
    for (int j = 0; j < squares; ++j)
      text += "f" + point(i, j) + point(i + 1, j) + point(i + 1, j + 1) + "\nf" + point(i, j) +
              point(i + 1, j + 1) + point(i, j + 1) + "\n";
  write_text_file(path, text);
}

class SeveralCuts : public testing::Test {
 protected:
  const TemporaryFolder folder;

  /// The figures of the field of the cuts, one after the other, each 3 mm deep.
  nlohmann::json field_of(const std::vector<Line>& cuts, bool bent = false) const {
    const auto file = [&](const std::string& name) { return folder / (std::to_string(cuts.size()) + name); };
    write_plate(file("plate.obj"), bent);
    std::vector<std::string> make = {
        "--mesh", file("plate.obj"),      "--out", file("body.h5"), "--reach", "18",
        "--set",  "mesh.element_size=1.5"};
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      std::string text = "x,y,z,nx,ny,nz,depth\n";
      constexpr int pieces = 14;
      for (int i = 0; i <= pieces; ++i) {
        const double part = static_cast<double>(i) / pieces, x = std::lerp(cuts[k].x0, cuts[k].x1, part),
                     y = std::lerp(cuts[k].y0, cuts[k].y1, part), z = height(x, y, bent);
        text += shortest(x) + "," + shortest(y) + "," + shortest(z);
        text += bent ? "," + shortest(x) + "," + shortest(y) + "," + shortest(z + sphere) : ",0,0,1";
        text += ",3\n";
      }
      const std::string path = file("path" + std::to_string(k) + ".csv");
      write_text_file(path, text);
      make.insert(make.end(), {"--path", path});
    }
    expect_success(run_cleft("body", make));
    write_text_file(file("case.toml"), "");
    expect_success(
        run_cleft("solve", {file("case.toml"), "--mesh", file("body.h5"), "--out", file("case.h5")}));
    expect_success(
        run_cleft("import", {file("case.h5"), "--field", "displacement", "--out", file("pieces.h5")}));
    return figures_of(
        expect_success(run_cleft("encode", {file("pieces.h5"), "--out", file("case.dffd"), "--json"})));
  }

  /// Of what is drawn between the nodes, over the largest displacement: at nodes, and of openings.
  struct Errors {
    double spline = 0, opening = 0;
  };
  Errors drawn(std::size_t cuts) const {
    const std::string name = folder / std::to_string(cuts);
    const SnapshotReader reader(name + "pieces.h5");
    const Snapshot& s = reader.snapshot();
    std::vector<NodesOfPiece> nodes;
    for (const SnapshotPiece& piece : s.pieces)
      nodes.push_back(
          counting_nodes(piece.nodes, static_cast<std::size_t>(piece.counting), piece.places, piece.pairs));
    const PiecesAtNodes spline(read_pieces(name + "case.dffd"), nodes,
                               places_inside_cells(s.points_in_source(), s.cell_offsets, s.connectivity), 0);
    Errors errors;
    double largest = 0;
    for (std::size_t j = 0; j < s.frames(); ++j) {
      std::vector<Vec3> off = spline.displacement(s.times[j], j);
      const std::vector<Vec3> data = reader.displacement(j);
      for (std::size_t n = 0; n < off.size(); ++n) {
        largest = std::max(largest, norm(data[n])), off[n] -= data[n];
        errors.spline = std::max(errors.spline, norm(off[n]));
      }
      for (const auto& [left, right] : s.pairs)
        errors.opening = std::max(errors.opening, norm(off[right] - off[left]));
    }
    return {errors.spline / largest, errors.opening / largest};
  }
};

}  // namespace

TEST_F(SeveralCuts, AreNearlyAsExactBetweenTheNodesAsOne) {
  constexpr double times = 2;
  const nlohmann::json one = field_of({{-14, 0, 14, 0}});
  const double spline = one.at("spline_error"), opening = one.at("gape_error");
  const std::pair<const char*, std::vector<Line>> bodies[] = {{"T", {{-14, 0, 14, 0}, {0, 0, 0, 14}}},
                                                              {"X", {{-14, 0, 14, 0}, {0, -14, 0, 14}}}};
  for (const auto& [name, cuts] : bodies) {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      std::filesystem::remove(entry.path());
    EXPECT_LE(field_of(cuts).at("node_error").get<double>(), 0.01) << name;
    const Errors errors = drawn(cuts.size());
    std::printf("%s %g %g (one %g %g)\n", name, errors.spline, errors.opening, spline, opening);
    EXPECT_LE(errors.spline, times * spline) << name;
    EXPECT_LE(errors.opening, times * opening) << name;
  }
}

/// The surfaces through curved arms pass beside the nodes at which they meet.
TEST_F(SeveralCuts, AreDividedWhereTheyCrossOnASphere) {
  const nlohmann::json figures = field_of({{-14, 0, 14, 0}, {-4, -12, 6, 13}}, true);
  EXPECT_LE(figures.at("node_error").get<double>(), 0.01);
  EXPECT_LE(figures.at("spline_error").get<double>(), 0.2) << "0.7 where nodes of further quarters count";
}

}  // namespace cleft
