// Fields on meshes of which they know nothing: twice as fine as that of their series.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "encoder/import/frame_files.h"
#include "tests/import/cracked_bodies.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

constexpr double tolerance = 0.01;

CrackedBody body_with_curved_break(const std::string& name) {
  if (name == "wave") {
    CrackedBody body = edge_crack();
    body.place = [](const Vec3& x) { return Vec3{x.x, x.y + 1.5 * std::sin(x.x / 4), x.z}; };
    return body;
  }
  if (name == "kinked by 44 degrees") {
    CrackedBody body = edge_crack();
    body.place = [](const Vec3& x) { return Vec3{x.x, x.y + 0.966 * std::max(0., x.x - 10), x.z}; };
    return body;
  }
  std::vector<CrackedBody> all = cracked_bodies();
  for (const CrackedBody& body : bodies_of_several_cracks()) all.push_back(body);
  for (const CrackedBody& body : all)
    if (body.name == name) return body;
  throw std::logic_error("no body " + name);
}

std::vector<double> halved(const std::vector<double>& planes) {
  std::vector<double> list = {planes.front()};
  for (std::size_t i = 1; i < planes.size(); ++i)
    list.insert(list.end(), {(planes[i - 1] + planes[i]) / 2, planes[i]});
  return list;
}

/// Each hexahedron in six: on a lip, most have three of their nodes there.
SourceSeries in_tetrahedra(SourceSeries series) {
  constexpr int corners[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                 {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  const SourceMesh hexahedra = series.mesh;
  series.mesh.cell_types.clear(), series.mesh.cell_offsets = {0}, series.mesh.connectivity.clear();
  for (std::size_t c = 0; c < hexahedra.cell_types.size(); ++c)
    for (const auto& cell : corners) {
      std::vector<std::int64_t> nodes;
      for (const int corner : cell)
        nodes.push_back(hexahedra.connectivity[static_cast<std::size_t>(hexahedra.cell_offsets[c] + corner)]);
      series.add_cell(tetra, nodes);
    }
  return series;
}

/// What is known at the body's own nodes, at any place of it: linear in each of its cells.
class Interpolated {
 public:
  explicit Interpolated(const CrackedBody& body) : body_(body) {}

  /// `value` of a node (abc, side) at the place of a node that is on the side `side`, or on none: 0.
  template <class Value>
  Vec3 at(const Vec3& abc, int side, const Value& value) const {
    const auto [i, x] = cell(body_.a, abc.x, false);
    const auto [j, y] = cell(body_.b, abc.y, side < 0);
    const auto [k, z] = cell(body_.c, abc.z, false);
    Vec3 sum;
    for (int corner = 0; corner < 8; ++corner) {
      const bool a = corner & 1, b = corner & 2, c = corner & 4;
      const Vec3 node{body_.a[i + a], body_.b[j + b], body_.c[k + c]};
      const double weight = (a ? x : 1 - x) * (b ? y : 1 - y) * (c ? z : 1 - z);
      const bool on_crack = std::find(body_.cracks.begin(), body_.cracks.end(), node.y) != body_.cracks.end();
      sum += weight * value(node, on_crack && body_.doubled(node) ? (b ? -1 : 1) : 0);
    }
    return sum;
  }

 private:
  /// The cell of a place on an axis, and where it is in it; a plane's is the one behind it, or before.
  static std::pair<std::size_t, double> cell(const std::vector<double>& planes, double x, bool before) {
    const auto next = before ? std::lower_bound(planes.begin(), planes.end(), x)
                             : std::upper_bound(planes.begin(), planes.end(), x);
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(next - planes.begin() - 1, 0, static_cast<int>(planes.size()) - 2));
    return {i, (x - planes[i]) / (planes[i + 1] - planes[i])};
  }

  const CrackedBody& body_;
};

class FinerMesh : public testing::Test {
 protected:
  const TemporaryFolder folder;
  const std::string field = folder / "case.dffd";

  void encode(const CrackedBody& body) { encode(body.series()); }
  void encode(const SourceSeries& series) {
    const std::string snapshot = folder / "case.h5";
    expect_success(run_cleft("import", {series.write(folder), "--field", "displacement", "--out", snapshot}));
    expect_success(run_cleft("encode", {snapshot, "--tolerance", shortest(tolerance), "--out", field}));
  }
  Outcome decode(const SourceSeries& on, const std::string& name) {
    SourceSeries mesh = on;
    mesh.times = {0};
    mesh.fields.clear();
    mesh.write(folder, name);
    return run_cleft("decode",
                     {field, "--on", folder / (name + "_0.vtu"), "--out", folder / (name + "_on.pvd")});
  }
  /// By how much more what decode() wrote is off, at the nodes of `on` and at any time, than what is linear
  /// between the nodes of `body`, the series.
  double worst_decoded(const std::string& name, const CrackedBody& on, const CrackedBody& body) const {
    const ImportedSeries decoded(folder / (name + "_on.pvd"), parse_fields({"displacement"}));
    const Interpolated interpolated(body);
    const std::vector<CrackedBody::Node> nodes = on.nodes();
    double worst = 0;
    for (std::size_t j = 0; j < body.times.size(); ++j) {
      const std::vector<double> values = decoded.frame(j)[0];
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        const auto& [abc, side] = nodes[n];
        const auto exact = [&](const Vec3& at, int of) { return body.displacement(at, of, body.times[j]); };
        const double of_series = norm(interpolated.at(abc, side, exact) - exact(abc, side));
        const Vec3 d{values[3 * n], values[3 * n + 1], values[3 * n + 2]};
        worst = std::max(worst, norm(d - exact(abc, side)) - of_series);
      }
    }
    return worst;
  }
};

}  // namespace

/// Its new nodes on the curve, on chords of it (in the middle between nodes of the series), or on those of
/// one lip without the other.
TEST_F(FinerMesh, OfACurvedBreakOpensAsThatOfTheSeries) {
  for (const char* name : {"curved, radius 60", "kinked by 30 degrees", "kinked by 44 degrees", "wave",
                           "two parallel cracks, curved, radius 60"}) {
    for (const auto* file : {"case.h5", "case.dffd"}) std::filesystem::remove(folder / file);
    CrackedBody body = body_with_curved_break(name);
    body.c = planes(-6, 0, 2);
    encode(body);
    const Interpolated interpolated(body);
    for (const std::string nodes_are :
         {"on the curve", "on the curve, tetrahedra", "on chords", "of one lip"}) {
      CrackedBody fine = body;
      for (auto* planes : {&fine.a, &fine.b, &fine.c}) *planes = halved(*planes);
      if (!nodes_are.starts_with("on the curve"))
        fine.place = [&](const Vec3& abc) {
          return interpolated.at(abc, 0, [&](const Vec3& node, int) { return body.place(node); });
        };
      if (nodes_are == "of one lip") fine.solid = [](const Vec3& middle) { return middle.y > 0; };
      const std::string mesh = std::string(name) + nodes_are.substr(3);
      const SourceSeries series = fine.series();
      expect_success(decode(nodes_are.ends_with("tetrahedra") ? in_tetrahedra(series) : series, mesh));
      double largest = 0;
      for (const CrackedBody::Node& node : body.nodes())
        largest = std::max(largest, norm(body.displacement(node.abc, node.side, body.times.back())));
      const double worst = worst_decoded(mesh, fine, body);
      std::printf("%s, %s: %.4f\n", name, nodes_are.c_str(), worst / largest);
      EXPECT_LE(worst, 2.1 * tolerance * largest) << name << ", " << nodes_are;
    }
  }
}

/// Where the front is within the elements, and beside the middle, which is at all angles.
TEST_F(FinerMesh, OfRoundCracksOpensAsThatOfTheSeries) {
  for (const char* name : {"penny crack inside the body", "elliptic crack inside the body, coarse"}) {
    for (const auto* file : {"case.h5", "case.dffd"}) std::filesystem::remove(folder / file);
    CrackedBody body = body_with_curved_break(name);
    if (body.a.size() == 25) body.times = planes(0, 5.4, 6);
    encode(body);
    CrackedBody fine = body;
    for (auto* planes : {&fine.a, &fine.b, &fine.c}) *planes = halved(*planes);
    const std::string mesh = std::string(name).substr(0, 5);
    expect_success(decode(fine.series(), mesh));
    double largest = 0;
    for (const double time : body.times)
      for (const CrackedBody::Node& node : fine.nodes())
        largest = std::max(largest, norm(body.displacement(node.abc, node.side, time)));
    const double worst = worst_decoded(mesh, fine, body);
    std::printf("%s: %.4f\n", name, worst / largest);
    EXPECT_LE(worst, 3 * tolerance * largest) << name;
  }
}

/// The faces of the crack are part of the skin, and lie in the break: they are on the side of the skin with
/// which they hang together.
TEST_F(FinerMesh, OfASkinHasTheFacesOfACrackOnBothSides) {
  std::vector<CrackedBody> bodies = {edge_crack(), body_with_curved_break("curved, radius 60")};
  bodies.front() = posed(bodies.front(), "turned", Pose::random(3));
  for (CrackedBody& body : bodies) {
    for (const auto* file : {"case.h5", "case.dffd"}) std::filesystem::remove(folder / file);
    body.c = planes(-6, 0, 3);
    encode(skin_of(body.series()));
    CrackedBody fine = body;
    for (auto* planes : {&fine.a, &fine.b, &fine.c}) *planes = halved(*planes);
    for (const bool finer : {false, true}) {
      const CrackedBody& on = finer ? fine : body;
      const std::string mesh = body.name + (finer ? ", finer" : ", as it is");
      const SourceSeries skin = skin_of(on.series());
      expect_success(decode(skin, mesh));
      const std::vector<CrackedBody::Node> nodes = on.nodes();
      const auto decoded = open_series({folder / (mesh + "_on.pvd")});
      double worst = 0, largest = 0;
      for (std::size_t j = 0; j < body.times.size(); ++j) {
        const std::vector<double> d = decoded->read(j, {{"displacement"}, {}}).arrays.at(0).values;
        for (const std::int64_t n : skin.mesh.connectivity) {
          const Vec3 exact = body.displacement(nodes[n].abc, nodes[n].side, body.times[j]);
          largest = std::max(largest, norm(exact));
          worst = std::max(worst, norm(Vec3{d[3 * n], d[3 * n + 1], d[3 * n + 2]} - exact));
        }
      }
      std::printf("%s: %.4f\n", mesh.c_str(), worst / largest);
      // The finer one has nodes beside the front, where the series knows only what is linear between its own.
      EXPECT_LE(worst, (finer ? 3.5 : 2) * tolerance * largest) << mesh;
    }
  }
}

/// A node that is outside of the body by a part of a cell is told of, with its place and what to do.
TEST_F(FinerMesh, BeyondTheBodyIsRefused) {
  CrackedBody body = edge_crack();
  body.c = {0};
  encode(body);
  for (const double off : {0.05, 0.3}) {
    SourceSeries on = body.series();
    for (Vec3& p : on.mesh.points)
      if (p.x == 40 && p.y == 3) p.x += off;
    const Outcome outcome = decode(on, "off" + shortest(off));
    EXPECT_EQ(outcome.exit_code, off < 0.1 ? 0 : 2) << outcome.output;
    if (off > 0.1) EXPECT_NE(outcome.output.find("at (40.3, 3, 0)"), std::string::npos) << outcome.output;
    if (off > 0.1) EXPECT_NE(outcome.output.find("leave out what is beyond"), std::string::npos);
  }
}

}  // namespace cleft
