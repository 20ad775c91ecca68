#include "explorer/incision/ipv.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace cleft {

namespace {

/// The skin triangles around every vertex, by index into one list.
struct Star {
  std::vector<int> first, triangles;

  explicit Star(const CutMesh& mesh) : first(mesh.vertices().size() + 2) {
    const auto each_corner = [&](const auto& use) {
      for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
        if (mesh.triangles()[t].region == Region::skin)
          for (const int v : mesh.triangles()[t].vertex) use(v, static_cast<int>(t));
    };
    each_corner([&](int v, int) { ++first[v + 2]; });
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    triangles.resize(first.back());
    each_corner([&](int v, int t) { triangles[first[v + 1]++] = t; });
  }
};

class Volume {
 public:
  Volume(const Incision& incision, const Field& field, double scale)
      : incision_(incision),
        mesh_(incision.mesh()),
        path_(incision.path()),
        field_(field),
        scale_(scale),
        star_(incision.mesh()) {
    const Interval v = field.domain(1);
    margin_ = (v.back - v.front) / 4;
    for (const auto& c : incision.chain())
      skin_height_.push_back(path_.coordinates(mesh_.position(c.left), c.s, c.s).w);
    find_normals();
  }

  std::vector<ActiveVertex> run() {
    add_cut();
    add_skin();
    return std::move(active_);
  }

 private:
  /// Lips, walls and closed ends: they know where they are.
  void add_cut() {
    for (std::size_t i = 0; i < mesh_.vertices().size(); ++i) {
      const CutMesh::Vertex& vertex = mesh_.vertices()[i];
      if (vertex.cut != incision_.cut()) continue;
      const double w = -vertex.depth_fraction * field_.cut().depth;
      add(static_cast<int>(i), vertex.s, 0, w, side_of(vertex.kind), true);
    }
  }

  /// The skin's normal along the cut, at rest, even where its triangles are not: a mean over the triangles
  /// at both lips, as far along as the cut is deep. The blade may be tilted against it; the field is not.
  void find_normals() {
    std::vector<Vec3> around;
    for (const auto& c : incision_.chain()) {
      Vec3 sum;
      for (const int v : {c.left, c.right})
        for (int k = star_.first[v]; k < star_.first[v + 1]; ++k) {
          const auto& [a, b, d] = mesh_.triangle(star_.triangles[k]).vertex;
          sum += cross(mesh_.position(b) - mesh_.position(a), mesh_.position(d) - mesh_.position(a));
        }
      around.push_back(sum);
    }
    const auto& chain = incision_.chain();
    const double reach = field_.cut().depth / scale_;
    for (const auto& c : chain) {
      Vec3 sum;
      for (std::size_t i = 0; i < chain.size(); ++i)
        sum += std::max(0.0, 1 - std::abs(chain[i].s - c.s) / reach) * around[i];
      const Vec3 blade = path_.at(c.s).outward;
      normal_.push_back(dot(sum, blade) > 0 ? normalized(sum) : blade);
    }
  }

  /// From both lips at once over the skin, nearest first (Dijkstra), as far as the field reaches.
  void add_skin() {
    using Entry = std::tuple<double, int, Side>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    std::vector<bool> done(mesh_.vertices().size());
    for (const auto& c : incision_.chain()) {
      front.push({0, c.left, c.left == c.right ? Side::both : Side::left});
      if (c.left != c.right) front.push({0, c.right, Side::right});
    }
    while (!front.empty()) {
      const auto [distance, v, side] = front.top();
      front.pop();
      if (done[v]) continue;
      done[v] = true;
      if (mesh_.vertex(v).kind == VertexKind::skin && !add_skin_vertex(v, side, distance)) continue;
      for (int k = star_.first[v]; k < star_.first[v + 1]; ++k)
        for (const int next : mesh_.triangle(star_.triangles[k]).vertex)
          if (!done[next])
            front.push({distance + norm(mesh_.position(next) - mesh_.position(v)), next, side});
    }
  }

  bool add_skin_vertex(int v, Side side, double distance) {
    const PathCoordinates at = path_.coordinates(mesh_.position(v));
    // Along edges the way is at most sqrt(2) times as long as over a flat patch of well-shaped triangles.
    // Where it is longer still, the surface has folded back under the cut: what counts is how far that is
    // along it.
    const double beyond = std::max({0.0, incision_.start() - at.s, at.s - incision_.tip()});
    // Slopes up to 45 degrees count in full; what lies over the path itself stays at v = 0.
    const double rise = std::min(std::abs(at.w - skin_height(at.s)), std::abs(at.v));
    const double chord = std::hypot(at.v, rise);
    const double along_surface = std::sqrt(std::max(0.0, distance * distance / 2.25 - beyond * beyond));
    double across = std::copysign(std::max(chord, along_surface), at.v);
    if (!beside_cut(at.s) || side == Side::both) {
      // Uncut there: the sign of v tells, and what lies on the plane belongs to both sides.
      if (std::abs(across) <= 1e-9 * path_.length()) across = 0;
      side = side_of(across);
    } else {
      across = side == Side::left ? std::min(across, 0.0) : std::max(across, 0.0);
    }
    return add(v, at.s, across, 0, side, false);
  }

  bool beside_cut(double s) const {
    const double tiny = 1e-9 * path_.length();
    return s > incision_.start() + tiny && s < incision_.tip() - tiny;
  }

  /// What is known at the chain's vertices, at s between them.
  template <class T>
  T along_chain(const std::vector<T>& values, double s) const {
    const auto& chain = incision_.chain();
    const auto next =
        std::upper_bound(chain.begin(), chain.end(), s,
                         [](double value, const Incision::ChainVertex& c) { return value < c.s; });
    if (next == chain.begin()) return values.front();
    if (next == chain.end()) return values.back();
    const auto i = next - chain.begin();
    const double part = (s - chain[i - 1].s) / (chain[i].s - chain[i - 1].s);
    return (1 - part) * values[i - 1] + part * values[i];
  }

  /// Height of the skin over the path at s (a path need not lie in the surface).
  double skin_height(double s) const { return along_chain(skin_height_, s); }

  /// T of the path made perpendicular to the skin's normal, and that.
  PathFrame skin_frame(double s) const {
    PathFrame frame = path_.at(s);
    frame.outward = normalized(along_chain(normal_, s));
    frame.along = normalized(frame.along - dot(frame.along, frame.outward) * frame.outward);
    frame.across = cross(frame.outward, frame.along);
    return frame;
  }

  /// Lengths s and across in mesh units, w in mm. False where the field does not reach.
  bool add(int vertex, double s, double across, double w, Side side, bool on_cut) {
    const CanonicalPlace place = canonical_place(s * scale_, path_.length() * scale_, field_.cut());
    const double v = across * scale_;
    const double u_in = std::clamp(place.u, field_.domain(0).front, field_.domain(0).back);
    const double v_in = std::clamp(v, field_.domain(1).front, field_.domain(1).back);
    const double outside = std::hypot(place.u - u_in, v - v_in) / margin_;
    if (outside >= 1) return false;
    const double weight = 1 - outside * outside * (3 - 2 * outside);
    const PathFrame frame = skin_frame(s);
    const double lift = lift_of_tilted_blade(path_.at(s).outward, frame, std::abs(v));
    active_.push_back({vertex,
                       {u_in, v_in, w},
                       side,
                       frame.along,
                       frame.across + lift * frame.outward,
                       frame.outward,
                       s * scale_,
                       place.time_offset,
                       weight,
                       on_cut});
    return true;
  }

  /// Under a tilted blade the thinner lip rises and the thicker one sinks: the line between them turns by two
  /// thirds of the tilt, as the solver's tilted cuts show (tests/truth), and the more the nearer to the cut.
  double lift_of_tilted_blade(const Vec3& blade, const PathFrame& skin, double v) const {
    const double tilt = std::atan2(-dot(blade, skin.across), dot(blade, skin.outward));
    return std::tan(2. / 3 * tilt) * std::exp(-v / (1.5 * field_.cut().depth));
  }

  const Incision& incision_;
  const CutMesh& mesh_;
  const ScalpelPath& path_;
  const Field& field_;
  double scale_, margin_;
  Star star_;
  std::vector<double> skin_height_;
  std::vector<Vec3> normal_;
  std::vector<ActiveVertex> active_;
};

}  // namespace

CanonicalPlace canonical_place(double s, double length, const CanonicalCut& cut) {
  if (length <= cut.length || s < cut.length / 2) return {cut.start + s, 0};
  if (length - s < cut.length / 2) return {cut.start + cut.length - (length - s), cut.length - length};
  return {cut.start + cut.length / 2, cut.length / 2 - s};
}

std::vector<ActiveVertex> active_vertices(const Incision& incision, const Field& field, double scale) {
  return Volume(incision, field, scale).run();
}

}  // namespace cleft
