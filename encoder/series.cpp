#include "encoder/series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/text.h"
#include "encoder/break_ends.h"
#include "encoder/curved_places.h"
#include "encoder/field/break_map.h"
#include "params/cut_curve.h"

namespace cleft {

namespace {

/// Whether each pair parts in some frame.
std::vector<bool> parted(const Snapshot& s, const StoredFrames<3>& frames, double largest) {
  // Where nothing moves, another field has told which ones were released.
  std::vector<bool> parts(s.pairs.size(), largest == 0);
  for (std::size_t j = 0; j < frames.size(); ++j) {
    const auto d = frames[j];
    for (std::size_t p = 0; p < parts.size(); ++p)
      parts[p] = parts[p] || (d.row(s.pairs[p][1]) - d.row(s.pairs[p][0])).norm() > 1e-6 * largest;
    frames.forget(j);
  }
  return parts;
}

/// Of a patch along u and v: its grid's, whatever its shape; of others, what the nodes take up.
std::optional<std::array<Interval, 2>> own_domain(const Snapshot& s) {
  const auto& patch = s.parameters->patch;
  if (!s.coordinates || s.source || !s.parameters.has(patch.length) || !s.parameters.has(patch.width))
    return {};
  return {{{{-patch.length / 2, patch.length / 2}, {-patch.width / 2, patch.width / 2}}}};
}

FieldGeometry geometry_of(const Snapshot& s, const std::vector<bool>& parts) {
  FieldGeometry g;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, greatest] = std::minmax_element(
        s.points.begin(), s.points.end(), [=](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    g.domain[axis] = {(*least)[axis], (*greatest)[axis]};
    // A body without extent along an axis is the same everywhere along it.
    if (g.domain[axis].front == g.domain[axis].back) g.domain[axis].front -= 1, g.domain[axis].back += 1;
  }
  // The cut of a plane mesh goes through it. It stands for a slab a third of the cut deep.
  const bool plane = std::all_of(s.points.begin(), s.points.end(), [](const Vec3& p) { return p.z == 0; });
  if (s.cut_length > 0 && plane) g.domain[2] = {-s.cut_length / 3, 0};
  if (const auto own = own_domain(s)) g.domain[0] = (*own)[0], g.domain[1] = (*own)[1];
  g.domain[3] = {s.times.front(), s.times.back()};
  const BreakEnds ends = break_ends(s, parts, {g.domain[0], g.domain[1], g.domain[2]});
  g.cut = ends.cut;
  // A closed cut ends where it begins, at nodes whose u is that of its start.
  if (!s.body.empty()) g.domain[0].back = std::max(g.domain[0].back, g.cut.start + g.cut.length);
  if (g.cut.length > 0 && !(g.domain[1].front < 0 && g.domain[1].back > 0))
    throw InputError("the nodes reach from v = " + shortest(g.domain[1].front) + " to " +
                     shortest(g.domain[1].back) + " mm: the cut plane v = 0 does not divide them");
  const auto [nearest, farthest] = std::minmax_element(ends.tip.begin(), ends.tip.end());
  const double slack = 1e-6 * (g.domain[0].back - g.domain[0].front);
  if (g.cut.length > 0 && (*farthest < g.domain[0].front - slack || *nearest > g.domain[0].back + slack))
    throw InputError("the tip stands between u = " + shortest(*nearest) + " and " + shortest(*farthest) +
                     " mm, and the nodes between " + shortest(g.domain[0].front) + " and " +
                     shortest(g.domain[0].back) + " mm: mend /cut/position, and /cut's start and length");
  for (std::size_t j = 0; j < s.times.size(); ++j) {
    const double at = std::clamp(ends.tip[j], g.domain[0].front, g.domain[0].back);
    g.tip.times.push_back(s.times[j]), g.tip.positions.push_back(at);
  }
  // Points on a straight line are left out.
  TipPath few;
  for (std::size_t j = 0; j < g.tip.times.size(); ++j) {
    const bool end = j == 0 || j + 1 == g.tip.times.size();
    if (!end) {
      const double part = (g.tip.times[j] - few.times.back()) / (g.tip.times[j + 1] - few.times.back());
      const double straight = few.positions.back() + part * (g.tip.positions[j + 1] - few.positions.back());
      if (std::abs(straight - g.tip.positions[j]) < 1e-9 * (g.domain[0].back - g.domain[0].front)) continue;
    }
    few.times.push_back(g.tip.times[j]), few.positions.push_back(g.tip.positions[j]);
  }
  g.tip = few;
  return g;
}

void check_cut(const Snapshot& s) {
  const std::string several =
      s.body.empty()
          ? "cut.radius, cut.count and cut.branch make snapshots to measure against, not to encode "
            "(cut.curvature makes a curved cut to encode); a tilted cut: solve it again, which writes its "
            "coordinates"
          : "a field holds one cut that does not cross itself; cleft cut --simulate opens several, and cleft "
            "import CASE.h5 --field displacement --out pieces.h5 divides the body so that cleft encode "
            "pieces.h5 gives each cut a field of its own";
  for (const auto& [left, right] : s.pairs) {
    const Vec3& at = s.points[left];
    if (std::abs(at.y) > 1e-6 * s.cut_length)
      throw InputError("the cut leaves the plane v = 0 (node " + std::to_string(left) +
                       " at v = " + shortest(at.y) + " mm): a field has its break there; " + several);
  }
}

/// Of a cut that curves; none where its snapshot does not say that it does.
std::optional<CutCurve> curve_of(const RecordedParameters& recorded) {
  Parameters parameters = *recorded;
  for (double* member : {&parameters.cut.curvature, &parameters.cut.curvature_rate})
    if (std::isnan(*member)) *member = 0;  // not recorded
  if (!is_curved(parameters)) return std::nullopt;
  return CutCurve(parameters);
}

/// The nodes of a body or a shaped patch in the coordinates of its cut, and the directions of these there. A
/// node beside a curved cut may have several places (curved_places.h): the first ones are those of all nodes.
struct OwnCoordinates {
  std::vector<Vec3> places;
  std::vector<std::array<Vec3, 3>> frames;  // of all places
  std::vector<std::size_t> node;            // of all places
  std::vector<std::size_t> kept;            // the places of the series
  std::size_t nodes = 0;                    // of these, the first ones: of nodes, one for each
  bool round = false;                       // whether w is an angle around a front
  double turn = 0;                          // a whole turn of it, in mm; 0: it has none

  explicit OwnCoordinates(const SnapshotReader& reader) {
    const std::vector<double> at = reader.point_array(canonical_array, 0);
    const std::vector<double> axes = reader.point_array(frame_array, 0);
    places.resize(at.size() / 3), frames.resize(axes.size() / 9);
    for (std::size_t i = 0; i < at.size(); ++i) places[i / 3][static_cast<int>(i % 3)] = at[i];
    for (std::size_t i = 0; i < axes.size(); ++i) frames[i / 9][i % 9 / 3][static_cast<int>(i % 3)] = axes[i];
    node.resize(places.size());
    std::iota(node.begin(), node.end(), std::size_t{0});
    const auto domain = own_domain(reader.snapshot());
    const auto curve = curve_of(reader.snapshot().parameters);
    if (domain && curve) add_further_places(*curve);
    if (const auto& source = reader.snapshot().source; source && !source->break_map.empty())
      add_turned_places(BreakMap::from(source->break_map));
    for (std::size_t n = 0; n < places.size(); ++n)
      if (!domain || (within((*domain)[0], places[n].x) && within((*domain)[1], places[n].y)))
        kept.push_back(n), nodes += node[n] == n;
    if (domain && curve) fill_gaps(*domain);
  }

  /// Around a front, the angle of a node near its ends is known with a turn more or less.
  void add_turned_places(const BreakMap& map) {
    round = map.round().has_value();
    turn = round && map.round()->whole_circle() ? 2 * std::numbers::pi * map.round()->radius : 0;
    for (std::size_t n = 0, count = places.size(); n < count; ++n)
      if (const auto again = map.again(places[n]))
        places.push_back(*again), frames.push_back(frames[n]), node.push_back(n);
  }

  /// Frames depend on the place along the cut alone.
  void add_further_places(const CutCurve& cut) {
    std::vector<std::size_t> along(places.size());
    std::iota(along.begin(), along.end(), std::size_t{0});
    std::sort(along.begin(), along.end(),
              [this](std::size_t a, std::size_t b) { return places[a].x < places[b].x; });
    for (std::size_t n = 0, count = places.size(); n < count; ++n)
      for (const Vec3& place : further_places(cut, places[n])) {
        const auto after = std::lower_bound(along.begin(), along.end(), place.x,
                                            [this](std::size_t a, double u) { return places[a].x < u; });
        if (after == along.begin() || after == along.end()) continue;
        const std::size_t a = *(after - 1), b = *after;
        const double part = (place.x - places[a].x) / (places[b].x - places[a].x);
        std::array<Vec3, 3> frame;
        for (int k = 0; k < 3; ++k) frame[k] = normalized(lerp(frames[a][k], frames[b][k], part));
        places.push_back(place), frames.push_back(frame), node.push_back(n);
      }
  }

  /// Beyond the patch's edges, which are no lines of these coordinates, displacements are as at the nearest
  /// column of nodes: what a fit would have there is neither known nor bounded.
  void fill_gaps(const std::array<Interval, 2>& domain) {
    constexpr int gaps = 24;  // that the domain is divided into, along and across
    std::map<std::pair<double, double>, std::vector<std::size_t>> columns;
    for (const std::size_t n : kept) columns[{places[n].x, places[n].y}].push_back(n);
    const double along = (domain[0].back - domain[0].front) / gaps,
                 across = (domain[1].back - domain[1].front) / gaps;
    for (int i = 0; i <= gaps; ++i)
      for (int j = 0; j <= gaps; ++j) {
        const double u = domain[0].front + i * along, v = domain[1].front + j * across;
        const std::vector<std::size_t>* nearest = nullptr;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [at, column] : columns)
          if (const double off = std::hypot((at.first - u) / along, (at.second - v) / across); off < least)
            least = off, nearest = &column;
        if (!nearest || least < 1) continue;
        for (const std::size_t n : *nearest) {
          kept.push_back(places.size());
          places.push_back({u, v, places[n].z}), frames.push_back(frames[n]), node.push_back(node[n]);
        }
      }
  }

  static bool within(const Interval& range, double x) {
    const double slack = 1e-9 * (range.back - range.front);
    return range.front - slack <= x && x <= range.back + slack;
  }

  /// Values at the places of the series, of values at the nodes.
  Eigen::MatrixXd at_places(const Eigen::MatrixXd& values) const {
    Eigen::MatrixXd moved(static_cast<Eigen::Index>(kept.size()), values.cols());
    for (Eigen::Index i = 0; i < moved.rows(); ++i)
      moved.row(i) = values.row(static_cast<Eigen::Index>(node[kept[i]]));
    return moved;
  }

  /// Of a displacement at a place.
  Vec3 components(std::size_t place, const Vec3& d) const {
    return {dot(frames[place][0], d), dot(frames[place][1], d), dot(frames[place][2], d)};
  }

  /// The snapshot in these coordinates, of the nodes that are kept. Cells are left out where the coordinates
  /// jump, as they do beyond the middle of a curved cut's circle.
  Snapshot of(const Snapshot& s) const {
    constexpr double most_stretched = 4;
    Snapshot moved = s;
    std::vector<std::int64_t> number(places.size(), -1);
    for (std::size_t i = 0; i < kept.size(); ++i) number[kept[i]] = static_cast<std::int64_t>(i);
    moved.points.clear(), moved.cell_types.clear(), moved.connectivity.clear(), moved.cell_offsets = {0};
    for (const std::size_t n : kept) moved.points.push_back(places[n]);
    const auto jumps = [&](std::int64_t a, std::int64_t b) {
      return norm(places[a] - places[b]) > most_stretched * norm(s.points[a] - s.points[b]) ||
             (turn > 0 && std::abs(places[a].z - places[b].z) > turn / 2);
    };
    for (std::size_t c = 0; c + 1 < s.cell_offsets.size(); ++c) {
      const std::span cell(s.connectivity.begin() + s.cell_offsets[c],
                           s.connectivity.begin() + s.cell_offsets[c + 1]);
      if (std::any_of(cell.begin(), cell.end(),
                      [&](std::int64_t n) { return number[n] < 0 || (s.coordinates && jumps(n, cell[0])); }))
        continue;
      for (const std::int64_t n : cell) moved.connectivity.push_back(number[n]);
      moved.cell_types.push_back(s.cell_types[c]);
      moved.cell_offsets.push_back(static_cast<std::int64_t>(moved.connectivity.size()));
    }
    for (auto& pair : moved.pairs)
      for (std::int32_t& end : pair) end = static_cast<std::int32_t>(number[end]);
    return moved;
  }
};

std::vector<SeriesQuantity> quantities_of(const SnapshotReader& reader,
                                          const std::optional<OwnCoordinates>& own,
                                          const std::shared_ptr<SpillFile>& file) {
  std::vector<SeriesQuantity> quantities;
  if (!reader.snapshot().source) return quantities;  // a simulation's own arrays are about its solver
  const auto nodes = static_cast<Eigen::Index>(reader.snapshot().points.size());
  for (const SnapshotArray& array : reader.point_arrays()) {
    if (reader.snapshot().coordinates &&
        (array.name == canonical_array.name || array.name == frame_array.name))
      continue;
    const auto components = static_cast<Eigen::Index>(array.components);
    SeriesQuantity quantity{array.name, StoredFrames<Eigen::Dynamic>(file), 0, 0, {}};
    for (std::size_t j = 0; j < reader.snapshot().frames(); ++j) {
      const std::vector<double> numbers = reader.point_array(array, j);
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      const Eigen::MatrixXd frame = Eigen::Map<const RowMajor>(numbers.data(), nodes, components);
      const Eigen::VectorXd sizes = norms_of(frame);
      for (Eigen::Index n = 0; n < nodes; ++n)
        if (!std::isfinite(sizes(n)))
          throw InputError("frame " + std::to_string(j) + ", node " + std::to_string(n) + ": " + array.name +
                           " is not finite; a field can only stand for finite numbers");
      quantity.largest = std::max(quantity.largest, sizes.maxCoeff());
      quantity.frames.push_back(own ? own->at_places(frame)
                                    : frame);  // the places of a node all have its values
    }
    set_scale(quantity);
    quantities.push_back(std::move(quantity));
  }
  return quantities;
}

/// What the displacements from frame 0 leave out. Its error is as large as theirs may be.
void add_start(std::vector<SeriesQuantity>& quantities, const std::vector<Vec3>& closed, std::size_t frames,
               double largest_displacement, const std::optional<OwnCoordinates>& own) {
  Eigen::MatrixXd start(static_cast<Eigen::Index>(closed.size()), 3);
  for (Eigen::Index n = 0; n < start.rows(); ++n) start.row(n) << closed[n].x, closed[n].y, closed[n].z;
  const double largest = start.rowwise().norm().maxCoeff();
  if (largest == 0) return;
  SeriesQuantity quantity{Series::at_start, StoredFrames<Eigen::Dynamic>(), largest, 0, {}};
  quantity.frames.assign(frames, own ? own->at_places(start) : start);
  set_scale(quantity);
  if (largest_displacement > 0) quantity.scale = largest_displacement;
  quantities.push_back(std::move(quantity));
}

/// The solver's, which imported data do not know.
std::vector<SeriesDerivative> derivatives_of(const SnapshotReader& reader,
                                             const std::optional<OwnCoordinates>& own) {
  const std::string prefix = "displacement_per_";
  std::vector<SeriesDerivative> derivatives;
  if (reader.snapshot().source) return derivatives;
  const auto nodes = static_cast<Eigen::Index>(reader.snapshot().points.size());
  for (const SnapshotArray& array : reader.point_arrays()) {
    if (!array.name.starts_with(prefix) || array.components != 3 || !array.varies) continue;
    SeriesDerivative& derivative = derivatives.emplace_back();
    derivative.parameter = array.name.substr(prefix.size());
    Eigen::MatrixX3d closed;
    for (std::size_t j = 0; j < reader.snapshot().frames(); ++j) {
      const std::vector<double> numbers = reader.point_array(array, j);
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
      Eigen::MatrixX3d frame = Eigen::Map<const RowMajor>(numbers.data(), nodes, 3);
      if (j == 0) closed = frame;
      frame -= closed;
      if (own) {
        Eigen::MatrixX3d turned(static_cast<Eigen::Index>(own->kept.size()), 3);
        for (Eigen::Index i = 0; i < turned.rows(); ++i) {
          const auto n = static_cast<Eigen::Index>(own->node[own->kept[i]]);
          const Vec3 d = own->components(own->kept[i], {frame(n, 0), frame(n, 1), frame(n, 2)});
          turned.row(i) << d.x, d.y, d.z;
        }
        frame = turned;
      }
      for (Eigen::Index n = 0; n < frame.rows(); ++n)
        if (!frame.row(n).allFinite())
          throw InputError("frame " + std::to_string(j) + ", node " + std::to_string(n) + ": " + array.name +
                           " is not finite; a field can only stand for finite numbers");
      derivative.largest = std::max(derivative.largest, frame.rowwise().norm().maxCoeff());
      derivative.frames.push_back(std::move(frame));
    }
  }
  return derivatives;
}

}  // namespace

void set_scale(SeriesQuantity& quantity) {
  const Eigen::Index components = quantity.frames.front().cols();
  Eigen::RowVectorXd middle = Eigen::RowVectorXd::Zero(components);
  if (components == 1) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto frame : quantity.frames)
      low = std::min(low, frame.minCoeff()), high = std::max(high, frame.maxCoeff());
    middle(0) = (low + high) / 2;
  } else {
    for (const auto frame : quantity.frames)
      middle += frame.colwise().mean() / static_cast<double>(quantity.frames.size());
  }
  double farthest = 0;
  for (const auto frame : quantity.frames)
    farthest = std::max(farthest, norms_of(frame.rowwise() - middle).maxCoeff());
  const bool about_middle = 2 * farthest < quantity.largest;
  quantity.middle = about_middle ? middle : Eigen::RowVectorXd::Zero(components);
  quantity.scale = about_middle && farthest > 0 ? 2 * farthest : quantity.largest;
}

Eigen::VectorXd norms_of(const Eigen::MatrixXd& rows) {
  if (rows.cols() != 6) return rows.rowwise().norm();
  return (rows.leftCols<3>().rowwise().squaredNorm() + 2 * rows.rightCols<3>().rowwise().squaredNorm())
      .cwiseSqrt();
}

Series::Series(const SnapshotReader& reader, const std::shared_ptr<SpillFile>& file) : frames(file) {
  std::optional<OwnCoordinates> own;
  std::optional<Snapshot> moved;
  if (!reader.snapshot().body.empty() || reader.snapshot().coordinates) {
    own.emplace(reader);
    round = own->round;
    moved = own->of(reader.snapshot());
  }
  const Snapshot& s = moved ? *moved : reader.snapshot();
  if (s.frames() < 2)
    throw InputError("the snapshot holds " + std::to_string(s.frames()) +
                     " frame; a time series needs at least 2");
  check_cut(s);
  times = s.times, samples = samples_of(s), pairs = s.pairs, released = s.released;
  nodes = s.counting ? *s.counting : own ? own->nodes : samples.size();
  for (std::size_t i = nodes; own && i < samples.size(); ++i)
    if (samples[i].uvw.y == 0) samples[i].side = samples[own->node[own->kept[i]]].side;
  const std::vector<Vec3> closed = reader.displacement(0);
  for (std::size_t j = 0; j < s.frames(); ++j) {
    const std::vector<Vec3> d = reader.displacement(j);
    Eigen::MatrixX3d frame(static_cast<Eigen::Index>(s.points.size()), 3);
    for (Eigen::Index i = 0; i < frame.rows(); ++i) {
      const std::size_t n = own ? own->node[own->kept[i]] : static_cast<std::size_t>(i);
      const Vec3 moved_by = d[n] - closed[n],
                 change = own ? own->components(own->kept[i], moved_by) : moved_by;
      frame.row(i) << change.x, change.y, change.z;
    }
    largest.push_back(frame.rowwise().norm().maxCoeff());
    frames.push_back(frame);
  }
  largest_displacement = *std::max_element(largest.begin(), largest.end());
  centres = cell_centres(s, samples);
  if (s.source && s.source->break_extent.size() >= 8)
    arm = std::any_of(s.source->break_extent.begin() + 4, s.source->break_extent.begin() + 8,
                      [](double joined) { return joined != 0; });
  quantities = quantities_of(reader, own, file);
  if (s.source) add_start(quantities, closed, s.frames(), largest_displacement, own);
  derivatives = derivatives_of(reader, own);
  geometry = geometry_of(s, parted(s, frames, largest_displacement));
}

void share_scales(std::vector<Series>& pieces) {
  double largest = 0;
  for (const Series& piece : pieces) largest = std::max(largest, piece.largest_displacement);
  for (Series& piece : pieces) piece.largest_displacement = largest;
  const auto has_start = [](const Series& piece) {
    return !piece.quantities.empty() && piece.quantities.back().name == Series::at_start;
  };
  if (std::any_of(pieces.begin(), pieces.end(), has_start))
    for (Series& piece : pieces)
      if (!has_start(piece)) {
        const Eigen::MatrixXd none =
            Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(piece.samples.size()), 3);
        SeriesQuantity quantity{Series::at_start, StoredFrames<Eigen::Dynamic>(), 0, 0,
                                Eigen::RowVectorXd::Zero(3)};
        quantity.frames.assign(piece.times.size(), none);
        piece.quantities.push_back(std::move(quantity));
      }
  for (std::size_t q = 0; q < pieces.front().quantities.size(); ++q) {
    double most = 0, scale = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Series& piece : pieces) {
      const SeriesQuantity& quantity = piece.quantities[q];
      most = std::max(most, quantity.largest), scale = std::max(scale, quantity.scale);
      for (const auto frame : quantity.frames)
        if (frame.cols() == 1) low = std::min(low, frame.minCoeff()), high = std::max(high, frame.maxCoeff());
    }
    if (low < high) scale = std::min(most, high - low);
    for (Series& piece : pieces) piece.quantities[q].largest = most, piece.quantities[q].scale = scale;
  }
}

}  // namespace cleft
