#include "explorer/body/body_maker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "explorer/body/extrusion.h"
#include "explorer/body/lined_surface.h"
#include "explorer/body/parting.h"
#include "explorer/body/remesh.h"
#include "explorer/body/skin_coordinates.h"
#include "explorer/body/smooth_surface.h"
#include "params/meshed_cut.h"
#include "params/parameters/lip_formulation.h"

namespace cleft {

namespace {

constexpr double most_columns = 5000;  // of nodes along all cuts: no solver takes more
constexpr double most_nodes = 1e7;
constexpr double degrees = 180 / std::numbers::pi;
constexpr double bend_of_edge = 0.5;  // radians by which the skin may turn along an edge

/// The lip over a tilted blade ends in a thin edge, which the skin bends the more the thinner it is: elements
/// at the cuts are smaller by the square of the cosine of tilts from `upright` to `flattest`, degrees.
/// Upright, on a flat plate, the opening differs by 0.1 % from that with elements half as large; tilted by 45
/// degrees it would by 7 %, and does by 4, and with mean dilatation by 2.
constexpr double upright = least_tilt, flattest = 55;
constexpr int tilts = 16;  // at so many places of a path

}  // namespace

double tilt_of(const BodyRequest& request) {
  const SurfaceIndex skin(request.skin);
  const std::vector<Vec3> normals = normals_of(skin.surface());
  double least = 1;
  for (const ScalpelPath& path : request.paths) {
    std::vector<double> cosines;
    for (int i = 0; i < tilts; ++i) {
      const PathFrame frame = path.at(path.length() * (i + 0.5) / tilts);
      const SurfacePlace at = skin.nearest(frame.position);
      Vec3 normal;
      for (int k = 0; k < 3; ++k) normal += at.weights[k] * normals[skin.surface().triangles[at.triangle][k]];
      // That the blade leans along the path leaves lips as they are.
      const auto across = [&](const Vec3& x) { return x - dot(x, frame.along) * frame.along; };
      const Vec3 blade = across(frame.outward), upright_blade = across(normal);
      if (norm(blade) > 0 && norm(upright_blade) > 0)
        cosines.push_back(std::abs(dot(normalized(blade), normalized(upright_blade))));
    }
    std::sort(cosines.begin(), cosines.end());
    if (!cosines.empty()) least = std::min(least, cosines[cosines.size() / 4]);
  }
  return std::acos(least) * degrees;
}

namespace {

Parameters with_finer_lips(const BodyRequest& request, double tilt) {
  const double part = std::cos(std::clamp(tilt, upright, flattest) / degrees) / std::cos(upright / degrees);
  Parameters finer = request.parameters;
  finer.mesh.element_size *= part * part;
  return finer;
}

/// A path as the mesh has it: made longer at both ends by the front's part of an element, because a mesh's
/// cut opens as if it ended that much before its closed nodes (params/meshed_cut.h).
struct LongerPath {
  ScalpelPath path;
  double front;  ///< mm, at both ends

  LongerPath(const ScalpelPath& p, const Parameters& parameters) : path(p), front(0) {
    const double part = front_parts(parameters).end, size = parameters.mesh.element_size;
    const double count = std::max(1., std::ceil(p.length() / size + 2 * part - 1e-9));
    const Vec3 apart = p.at(p.length()).position - p.at(0).position;
    if (part == 0 || norm(apart) < size) return;  // a loop has no ends
    front = part * p.length() / (count - 2 * part);
    path = stretched(p, -front, p.length() + front, size);
  }
};

class Maker {
 public:
  explicit Maker(const BodyRequest& request)
      : r_(request), tilt_(tilt_of(request)), p_(with_finer_lips(request, tilt_)) {
    for (const ScalpelPath& path : r_.paths) longer_.emplace_back(path, p_);
  }

  Body make(BodyReport* report) {
    double depth = 0;
    for (const ScalpelPath& path : r_.paths) depth = std::max(depth, path.largest_depth());
    check_size(depth);
    make_surface();
    layers_ = divided(make_layers(p_, depth), r_.layers, p_.mesh.element_size);
    for (const TissueLayer& layer : r_.layers) body_.materials.push_back(layer.material);
    extrude_all();
    add_nodes();
    add_elements();
    set_canonical();
    body_.length = r_.paths.front().length();
    body_.depth = r_.paths.front().largest_depth();
    if (report) fill(*report);
    check_body(body_, "the body");
    body_.hash = hash_of(body_);
    return std::move(body_);
  }

 private:
  void check_size(double depth) const {
    const Parameters& asked = r_.parameters;
    if (asked.mesh.elements == ElementOrder::quadratic)
      throw InputError("mesh.elements = quadratic: a body has linear ones; set it to linear");
    double length = 0;
    for (const ScalpelPath& path : r_.paths) length += path.length();
    if (const double size = asked.mesh.element_size; length > most_columns * size)
      throw InputError("mesh.element_size = " + shortest(size) + " mm is too small for cuts of " +
                       shortest(std::round(1e3 * length) / 1e3) + " mm: at least " +
                       shortest(std::ceil(1e4 * length / most_columns) / 1e4) + " mm");
    if (const double nodes = expected_nodes(length, depth, asked); nodes > most_nodes) {
      Parameters enough = asked;
      while (expected_nodes(length, depth, enough) > most_nodes) enough.mesh.element_size *= 1.1;
      throw InputError("mesh.element_size = " + shortest(asked.mesh.element_size) + " mm makes about " +
                       formatted("%.0f", nodes / 1e6) +
                       " million nodes, and a body has at most 10: make it at least " +
                       formatted("%.2g", enough.mesh.element_size) + " mm, or mesh.grading larger");
    }
  }

  /// On a flat strip about the cuts, as long as they and half of the reach at both ends, in elements that
  /// grow away from them.
  double expected_nodes(double length, double depth, const Parameters& p) const {
    const double size = p.mesh.element_size, equilateral = std::sqrt(3.) / 2;  // height of a triangle
    const double across = 2 * r_.reach / (size * (size + growth(p) * r_.reach));
    return (length + r_.reach) * across / equilateral *
           static_cast<double>(make_layers(p, depth).depth.size());
  }

  /// Of elements, by mm away from the cuts: half of how the patch's grow, which do so in one direction only.
  static double growth(const Parameters& p) { return (p.mesh.grading - 1) / 2; }

  void make_surface() {
    std::vector<ScalpelPath> paths;
    for (const LongerPath& one : longer_) paths.push_back(one.path);
    s_ = lined_surface(r_.skin, paths, r_.reach);
    find_off_paths();
    for (std::size_t c = 0; c < s_.cuts.size(); ++c) trim(c);
    const SurfaceIndex shape(s_.mesh);
    const double size = p_.mesh.element_size;
    const std::vector<bool> stations = place_stations(s_, size);
    std::vector<Vec3> places;
    for (const auto& lines : s_.cuts) {
      if (lines.empty())
        throw InputError("cut " + std::to_string(&lines - s_.cuts.data() + 1) + " does not cut the skin");
      for (const CutLine& line : lines) places.push_back(s_.mesh.points[line.from]);
      places.push_back(s_.mesh.points[lines.back().to]);
    }
    const std::vector<double> radius = radii(shape.surface());
    s_ = remeshed(std::move(s_), stations, shape, [&](const Vec3& x) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& place : places) nearest = std::min(nearest, squared_norm(place - x));
      const double wanted = size + growth(p_) * std::sqrt(nearest);
      if (wanted <= size) return wanted;
      const SurfacePlace at = shape.nearest(x);
      double bent = std::numeric_limits<double>::infinity();
      for (const int p : shape.surface().triangles[at.triangle]) bent = std::min(bent, radius[p]);
      return std::clamp(bend_of_edge * bent, size, wanted);
    });
    const SmoothSurface smooth(r_.skin, s_.mesh.points);
    for (Vec3& p : s_.mesh.points) p = smooth.nearest(p);
  }

  void find_off_paths() {
    for (std::size_t c = 0; c < s_.cuts.size(); ++c) {
      const LongerPath& longer = longer_[c];
      const double length = r_.paths[c].length();
      OffPath found{static_cast<int>(c), 0, {}, 0, length};
      double nearest = std::numeric_limits<double>::infinity();
      for (const CutLine& line : s_.cuts[c]) {
        const double off = norm(s_.mesh.points[line.from] - longer.path.at(line.s_from).position);
        if (off > found.off) found.off = off, found.at = s_.mesh.points[line.from];
        nearest = std::min(nearest, off);
        found.made += std::clamp(line.s_to - longer.front, 0., length) -
                      std::clamp(line.s_from - longer.front, 0., length);
      }
      if (const double depth = r_.paths[c].largest_depth(); nearest > depth && std::isfinite(nearest))
        throw InputError("cut " + std::to_string(c + 1) + ": its path is " +
                         shortest(std::round(100 * nearest) / 100) +
                         " mm off the skin where it is nearest, and the cut is " + shortest(depth) +
                         " mm deep; check that the path is of this mesh, and --scale");
      found.far = found.off > r_.paths[c].largest_depth();
      found.leaves = found.made < 0.98 * length - p_.mesh.element_size;
      if (found.far || found.leaves) off_paths_.push_back(found);
    }
  }

  /// Radii of curvature at the points: the least distance along an edge over the turn of the normal.
  static std::vector<double> radii(const SurfaceMesh& mesh) {
    const std::vector<Vec3> normals = normals_of(mesh);
    std::vector<double> radius(mesh.points.size(), std::numeric_limits<double>::infinity());
    for (const auto& t : mesh.triangles)
      for (int i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3];
        const double r =
            norm(mesh.points[a] - mesh.points[b]) / std::max(1e-9, norm(normals[a] - normals[b]));
        radius[a] = std::min(radius[a], r), radius[b] = std::min(radius[b], r);
      }
    return radius;
  }

  /// A cut that begins or ends at another one does not go on beyond it.
  void trim(std::size_t cut) {
    std::set<int> others;
    for (std::size_t c = 0; c < s_.cuts.size(); ++c)
      for (const CutLine& line : s_.cuts[c])
        if (c != cut) others.insert({line.from, line.to});
    auto& lines = s_.cuts[cut];
    const double front = longer_[cut].front, length = r_.paths[cut].length();
    double begin = -1, end = std::numeric_limits<double>::infinity();
    for (const CutLine& line : lines) {
      if (others.contains(line.to) && line.s_to < 1.5 * front) begin = std::max(begin, line.s_to);
      if (others.contains(line.from) && line.s_from > length + 0.5 * front) end = std::min(end, line.s_from);
    }
    std::erase_if(lines, [&](const CutLine& line) { return line.s_to <= begin || line.s_from >= end; });
  }

  /// Where wedges are turned inside out far from the cuts, the body ends.
  void extrude_all() {
    for (;;) {
      set_blades();
      e_ = extrude(s_, layers_, blade_, r_.bone.get());
      if (e_.turned.empty()) return;
      std::vector<bool> out(s_.mesh.triangles.size(), false), at_out(s_.mesh.points.size(), false);
      for (const int t : e_.turned)
        for (const int p : s_.mesh.triangles[t]) at_out[p] = true;
      for (std::size_t p = 0; p < at_out.size(); ++p)
        if (at_out[p] && squared_norm(blade_[p]) > 0) {
          throw InputError(
              "the tissue below the cut at " + place_text(s_.mesh.points[p]) +
              " mm would be turned inside out: the skin is bent too strongly there, or the blade "
              "too flat; smooth the mesh, move the cut, or make mesh.element_size larger");
        }
      for (const int t : e_.turned) out[t] = true;
      if (left_out_ == 0) left_out_at_ = s_.mesh.points[s_.mesh.triangles[e_.turned.front()][0]];
      left_out_ += static_cast<int>(e_.turned.size());
      s_ = without(s_, out);
    }
  }

  /// The direction of the blade at the points of cuts: the mean where two meet.
  void set_blades() {
    blade_.assign(s_.mesh.points.size(), Vec3{});
    for (std::size_t c = 0; c < s_.cuts.size(); ++c)
      for (const CutLine& line : s_.cuts[c]) {
        blade_[line.from] += -1. * longer_[c].path.at(line.s_from).outward;
        blade_[line.to] += -1. * longer_[c].path.at(line.s_to).outward;
      }
    for (Vec3& b : blade_)
      if (squared_norm(b) > 0) b = normalized(b);
  }

  int columns() const { return static_cast<int>(s_.mesh.points.size()); }
  int layers() const { return static_cast<int>(layers_.depth.size()); }

  /// The nodes before all cuts: layer after layer.
  void add_nodes() {
    for (int k = 0; k < layers(); ++k)
      for (int p = 0; p < columns(); ++p) {
        body_.points.push_back(e_.node(s_, layers_, p, k));
        body_.skin_above.push_back(p);
        column_of_.push_back(p), depth_of_.push_back(layers_.depth[k]);
      }
  }

  /// Doubles the nodes, and makes wedges of triangle after triangle, layer after layer.
  void add_elements() {
    Parting parting(
        s_.mesh, layers_.bottom, [this](int point, int layer) { return layer * columns() + point; },
        [this](int node, int above) {
          body_.points.push_back(body_.points[node]);
          const int own = static_cast<int>(body_.points.size()) - 1;
          body_.skin_above.push_back(above < 0 ? own : above);
          column_of_.push_back(column_of_[node]), depth_of_.push_back(depth_of_[node]);
          return own;
        });
    body_.released = {0}, body_.times = {0}, body_.position = {-r_.paths.front().length() / 2};
    double before = 0;
    for (std::size_t c = 0; c < s_.cuts.size(); ++c) {
      release(static_cast<int>(c), before, parting);
      before += r_.paths[c].length();
    }
    if (body_.pairs.empty())
      throw InputError("the cuts are too short to open a node: make mesh.element_size = " +
                       shortest(p_.mesh.element_size) + " mm smaller");
    const auto node = [&](int t, int corner, int k) {
      return k < layers_.bottom ? parting.node(t, corner, k) : k * columns() + s_.mesh.triangles[t][corner];
    };
    std::vector<std::array<int, 6>> below;
    for (int k = 0; k + 1 < layers(); ++k)
      for (int t = 0; t < static_cast<int>(s_.mesh.triangles.size()); ++t) {
        std::array<int, 6> wedge;
        for (int i = 0; i < 3; ++i) wedge[i] = node(t, i, k + 1), wedge[3 + i] = node(t, i, k);
        body_.wedges.push_back(wedge);
        if (!r_.layers.empty())
          body_.region.push_back(static_cast<std::uint8_t>(tissue_between(layers_, r_.layers, k)));
        if (k == 0) body_.skin.push_back({wedge[3], wedge[4], wedge[5]});
        if (k + 2 == layers()) {
          body_.bottom.push_back({wedge[0], wedge[1], wedge[2]});
          const auto& corners = s_.mesh.triangles[t];
          const bool bone = std::all_of(corners.begin(), corners.end(), [&](int p) { return e_.on_bone[p]; });
          body_.support.push_back(bone ? Support::bone : Support::springs);
        }
      }
    add_sides();
    set_tension();
  }

  /// Opens a cut column by column.
  void release(int cut, double before, Parting& parting) {
    const auto& lines = s_.cuts[cut];
    const LongerPath& longer = longer_[cut];
    const double length = r_.paths[cut].length();
    const auto place = [&](double s) { return std::clamp(s - longer.front, 0., length); };
    const bool loop = lines.front().from == lines.back().to;
    const std::size_t frames_before = body_.times.size();
    for (std::size_t i = loop ? 1 : 0; i <= lines.size(); ++i) {
      Parting::Visit visit;
      visit.point = i < lines.size() ? lines[i].from : lines.back().to;
      const double s = i < lines.size() ? lines[i].s_from : lines.back().s_to;
      if (i > 0) visit.from = lines[i - 1].from;
      if (i < lines.size())
        visit.to = lines[i].to;
      else if (loop)
        visit.to = lines.front().to;
      const double depth = longer.path.depth(s);
      visit.layers = open_layers(depth);
      const PathFrame at = longer.path.at(s);
      const std::size_t had = body_.pairs.size();
      for (const Parting::Pair& pair : parting.open(visit))
        body_.pairs.push_back({pair.left, pair.right, cut, place(s) - length / 2, layers_.depth[pair.layer],
                               pair.reversed ? -1. * at.across : at.across});
      if (body_.pairs.size() == had) continue;
      // The tip is just inside the first node ahead that is still closed.
      const bool to_end = i + 1 > lines.size();
      const double next = to_end ? s : lines[i].s_to;
      const double tip = to_end ? place(s) : place(next - front_parts(p_).end * (next - s));
      const double time = before + tip;
      if (time > body_.times.back() + 1e-9 * length) {
        body_.times.push_back(time), body_.position.push_back(tip - length / 2);
        body_.released.push_back(static_cast<int>(body_.pairs.size()));
      } else if (body_.times.size() > 1) {  // at the same place as the frame before
        body_.released.back() = static_cast<int>(body_.pairs.size());
      }  // in frame 0 all is closed: they open with the next one
    }
    if (body_.released.back() < static_cast<int>(body_.pairs.size())) {
      body_.times.push_back(before + length), body_.position.push_back(length / 2);
      body_.released.push_back(static_cast<int>(body_.pairs.size()));
    }
    if (body_.times.size() == frames_before) return;
    if (lines.back().s_to - longer.front < 0.99 * length &&
        body_.times.back() < before + length) {  // it has left the skin: nothing opens any more
      body_.times.push_back(before + length), body_.position.push_back(length / 2);
      body_.released.push_back(body_.released.back());
    }
    // Its stations are along chords of the path.
    body_.times.back() = before + length, body_.position.back() = length / 2;
  }

  /// How many layers of nodes a cut of this depth opens: it ends just above the first closed one.
  int open_layers(double depth) const {
    int best = 1;
    for (int k = 1; k <= layers_.bottom; ++k)
      if (std::abs(layers_.depth[k] - layers_.front - depth) <
          std::abs(layers_.depth[best] - layers_.front - depth))
        best = k;
    return best;
  }

  /// Faces at the rim, where the body goes on, and at the mesh's own outlines, where it is held alike: the
  /// skin's tension is balanced there, and a strip between a cut and an outline is not pulled away by it.
  void add_sides() {
    std::map<std::pair<int, int>, int> count;
    for (const auto& t : s_.mesh.triangles)
      for (int i = 0; i < 3; ++i) ++count[std::minmax(t[i], t[(i + 1) % 3])];
    for (int t = 0; t < static_cast<int>(s_.mesh.triangles.size()); ++t)
      for (int i = 0; i < 3; ++i) {
        const auto& corners = s_.mesh.triangles[t];
        const int a = corners[i], b = corners[(i + 1) % 3];
        if (count[std::minmax(a, b)] != 1) continue;
        for (int k = 0; k + 1 < layers(); ++k) {
          const auto& wedge = body_.wedges[static_cast<std::size_t>(k) * s_.mesh.triangles.size() + t];
          const int j = (i + 1) % 3;
          body_.sides.push_back({wedge[3 + i], wedge[3 + j], wedge[j], wedge[i]});
        }
      }
  }

  void set_tension() {
    std::vector<bool> on_a_cut;
    for (const Vec3& blade : blade_) on_a_cut.push_back(squared_norm(blade) > 0);
    body_.tension = directions_within(s_.mesh, r_.paths.front(), r_.tension, on_a_cut);
  }

  /// Coordinates of the first cut: of its surroundings on the skin before it was cut, as replays have them.
  void set_canonical() {
    std::set<int> on_cut;
    for (const CutLine& line : s_.cuts.front()) on_cut.insert({line.from, line.to});
    const SkinCoordinates on_skin = coordinates_on(s_.mesh, r_.paths.front(), on_cut);
    for (std::size_t n = 0; n < body_.points.size(); ++n) {
      const Vec3& at = on_skin.canonical[column_of_[n]];
      body_.canonical.push_back({at.x, at.y, -depth_of_[n]});
      body_.frames.push_back(on_skin.frames[column_of_[n]]);
    }
  }

  void fill(BodyReport& report) const {
    report.nodes = static_cast<int>(body_.points.size());
    report.wedges = static_cast<int>(body_.wedges.size());
    report.triangles = static_cast<int>(body_.skin.size());
    report.pairs = static_cast<int>(body_.pairs.size());
    report.frames = static_cast<int>(body_.times.size());
    report.least_determinant = e_.least_determinant;
    report.thinned = e_.thinned, report.thinnest = e_.thinnest;
    report.least_thickness = *std::min_element(e_.thickness.begin(), e_.thickness.end());
    report.blade_turn = e_.blade_turn * degrees, report.blade_turned_at = e_.blade_turned_at;
    report.left_out = left_out_, report.left_out_at = left_out_at_, report.off_paths = off_paths_;
    report.on_bone = static_cast<int>(std::count(e_.on_bone.begin(), e_.on_bone.end(), true));
    report.least_angle = 180;
    for (const auto& t : s_.mesh.triangles)
      for (int i = 0; i < 3; ++i) {
        const Vec3 a = s_.mesh.points[t[(i + 1) % 3]] - s_.mesh.points[t[i]];
        const Vec3 b = s_.mesh.points[t[(i + 2) % 3]] - s_.mesh.points[t[i]];
        const double angle = std::atan2(norm(cross(a, b)), dot(a, b)) * degrees;
        if (angle < report.least_angle) report.least_angle = angle, report.sharpest = s_.mesh.points[t[i]];
      }
    if (Parameters settled = p_; !r_.own_formulation) {
      settle_formulation(settled, tilt_);
      if (settled.tissue.formulation != p_.tissue.formulation) report.stiff_tilt = tilt_;
    }
    for (const auto& lines : s_.cuts)
      for (const CutLine& line : lines)
        if (const double depth = e_.cut_depth(layers_, line.from);
            depth < 0.999 * layers_.depth[layers_.bottom])
          report.least_depth = report.least_depth == 0 ? depth : std::min(report.least_depth, depth);
  }

  const BodyRequest& r_;
  const double tilt_;  // degrees
  const Parameters p_;
  std::vector<LongerPath> longer_;
  LinedSurface s_;
  Layers layers_;
  std::vector<Vec3> blade_;
  Extrusion e_;
  int left_out_ = 0;
  Vec3 left_out_at_;
  std::vector<OffPath> off_paths_;
  Body body_;
  std::vector<int> column_of_;    // by node: its point of the surface
  std::vector<double> depth_of_;  // by node: of its layer
};

}  // namespace

Body make_body(const BodyRequest& request, BodyReport* report) { return Maker(request).make(report); }

}  // namespace cleft
