#include "encoder/series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/sets.h"
#include "base/text.h"
#include "encoder/break_ends.h"
#include "encoder/front_places.h"
#include "encoder/own_coordinates.h"
#include "encoder/series_samples.h"
#include "solver/snapshot/cell_types.h"

namespace cleft {

namespace {

constexpr std::size_t few_nodes = 1 << 16;  // above, cells alone determine a fit
constexpr double bent = 0.3;                // radians from which the middle of a cut needs knots of its own
constexpr double winding = 1;               // radians from which it needs as many as the ends

using Pairs = std::vector<std::array<std::int32_t, 2>>;

/// Whether the cells are surfaces and lines that are in no plane, such as the skin of a solid.
bool is_curved_surface(const Snapshot& s) {
  return std::all_of(s.cell_types.begin(), s.cell_types.end(), is_flat_type) &&
         std::any_of(s.points.begin(), s.points.end(), [](const Vec3& p) { return p.z != 0; });
}

/// Whether there are cells that no others connect with the first one, also where all pairs are closed.
bool has_parts(const Snapshot& s) {
  Sets joined(s.points.size());
  const auto node = [&](std::int64_t i) { return static_cast<std::int32_t>(s.connectivity[i]); };
  for (std::size_t c = 0; c < s.cell_types.size(); ++c)
    for (auto i = s.cell_offsets[c] + 1; i < s.cell_offsets[c + 1]; ++i) joined.join(node(i - 1), node(i));
  for (const auto& [left, right] : s.pairs) joined.join(left, right);
  return std::any_of(s.connectivity.begin(), s.connectivity.end(), [&](std::int64_t n) {
    return joined.root(static_cast<std::int32_t>(n)) != joined.root(node(0));
  });
}

/// Whether each pair parts in some frame.
std::vector<bool> parted(const Pairs& pairs, const StoredFrames<3>& frames, double largest) {
  // Where nothing moves, another field has told which ones were released.
  std::vector<bool> parts(pairs.size(), largest == 0);
  for (std::size_t j = 0; j < frames.size(); ++j) {
    const auto d = frames[j];
    for (std::size_t p = 0; p < parts.size(); ++p)
      parts[p] = parts[p] || (d.row(pairs[p][1]) - d.row(pairs[p][0])).norm() > 1e-6 * largest;
    frames.forget(j);
  }
  return parts;
}

/// Whether the front of an arm passes its end to go on as those of others there do. A front that comes late
/// meets what is open already.
bool goes_on(const Snapshot& s) {
  constexpr std::size_t late = 10;  // of the frames, one in
  return s.source && s.source->break_extent.size() >= 8 && s.source->break_extent[5] != 0 &&
         s.released[s.frames() / late] > 0;
}

FieldGeometry geometry_of(const Snapshot& s, const std::vector<bool>& parts, const OpenPairs* open) {
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
  if (goes_on(s)) g.domain[0].back = std::max(g.domain[0].back, s.source->break_extent[1] + s.cut_depth);
  BreakEnds ends = break_ends(s, parts, {g.domain[0], g.domain[1], g.domain[2]});
  if (open && ends.tip.front() < ends.tip.back()) place_fronts(ends.tip, *open);
  g.cut = ends.cut;
  g.domain[0].back = std::max(g.domain[0].back, ends.reach);
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

/// Of a frame, at all nodes or at the samples.
using ValuesOf = std::function<Eigen::MatrixXd(std::size_t frame)>;

/// Of quantity `number`, to which it refers: of all nodes where `at_nodes` reads them.
ValuesOf values_of(const SeriesQuantity& quantity, const NodeValues* at_nodes, std::size_t number,
                   std::size_t nodes) {
  return [&quantity, at_nodes, number, nodes](std::size_t frame) -> Eigen::MatrixXd {
    if (at_nodes) return at_nodes->quantity(number, frame, 0, nodes);
    return quantity.frames[frame];
  };
}

/// Least and greatest of a scalar.
std::array<double, 2> range_of(std::size_t frames, const ValuesOf& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t j = 0; j < frames; ++j) {
    const Eigen::MatrixXd frame = values(j);
    low = std::min(low, frame.minCoeff()), high = std::max(high, frame.maxCoeff());
  }
  return {low, high};
}

std::vector<double> numbers_of(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return numbers;
}

NodeRows rows_of(const std::vector<double>& numbers, std::size_t components) {
  return Eigen::Map<const NodeRows>(numbers.data(), static_cast<Eigen::Index>(numbers.size() / components),
                                    static_cast<Eigen::Index>(components));
}

/// Those of imported data; a simulation's own are about its solver.
std::vector<SnapshotArray> quantity_arrays(const SnapshotReader& reader) {
  if (!reader.snapshot().source) return {};
  std::vector<SnapshotArray> arrays = reader.point_arrays();
  if (reader.snapshot().coordinates)
    std::erase_if(arrays, [](const SnapshotArray& array) {
      return array.name == canonical_array.name || array.name == frame_array.name;
    });
  return arrays;
}

std::vector<SeriesQuantity> quantities_of(const SnapshotReader& reader, const SeriesSamples& taken,
                                          const std::vector<SnapshotArray>& arrays,
                                          const NodeValues* at_nodes, std::size_t nodes,
                                          const std::shared_ptr<SpillFile>& file) {
  std::vector<SeriesQuantity> quantities;
  for (const SnapshotArray& array : arrays) {
    SeriesQuantity quantity{array.name, StoredFrames<Eigen::Dynamic>(file), 0, 0, {}};
    for (std::size_t j = 0; j < reader.snapshot().frames(); ++j) {
      const Eigen::MatrixXd frame = rows_of(reader.point_array(array, j), array.components);
      const Eigen::VectorXd sizes = norms_of(frame);
      for (Eigen::Index n = 0; n < sizes.size(); ++n)
        if (!std::isfinite(sizes(n)))
          throw InputError("frame " + std::to_string(j) + ", node " + std::to_string(n) + ": " + array.name +
                           " is not finite; a field can only stand for finite numbers");
      quantity.largest = std::max(quantity.largest, sizes.maxCoeff());
      quantity.frames.push_back(taken.at_samples(frame));  // the places of a node all have its values
    }
    set_scale(quantity, values_of(quantity, at_nodes, quantities.size(), nodes));
    quantities.push_back(std::move(quantity));
  }
  return quantities;
}

/// What the displacements from frame 0 leave out. Its error is as large as theirs may be.
void add_start(std::vector<SeriesQuantity>& quantities, const NodeRows& start, std::size_t frames,
               double largest_displacement, const SeriesSamples& taken, const NodeValues* at_nodes,
               std::size_t nodes) {
  const double largest = start.rowwise().norm().maxCoeff();
  if (largest == 0) return;
  SeriesQuantity quantity{Series::at_start, StoredFrames<Eigen::Dynamic>(), largest, 0, {}};
  quantity.frames.assign(frames, taken.at_samples(start));
  set_scale(quantity, values_of(quantity, at_nodes, quantities.size(), nodes));
  if (largest_displacement > 0) quantity.scale = largest_displacement;
  quantities.push_back(std::move(quantity));
}

/// The solver's, which imported data do not know.
std::vector<SeriesDerivative> derivatives_of(const SnapshotReader& reader, const SeriesSamples& taken) {
  const std::string prefix = "displacement_per_";
  std::vector<SeriesDerivative> derivatives;
  if (reader.snapshot().source) return derivatives;
  for (const SnapshotArray& array : reader.point_arrays()) {
    if (!array.name.starts_with(prefix) || array.components != 3 || !array.varies) continue;
    SeriesDerivative& derivative = derivatives.emplace_back();
    derivative.parameter = array.name.substr(prefix.size());
    Eigen::MatrixX3d closed;
    for (std::size_t j = 0; j < reader.snapshot().frames(); ++j) {
      Eigen::MatrixX3d frame = taken.at_samples(rows_of(reader.point_array(array, j), 3));
      if (j == 0) closed = frame;
      frame -= closed;
      for (Eigen::Index n = 0; taken.has_axes() && n < frame.rows(); ++n) {
        const Vec3 d =
            taken.in_axes(taken.place(static_cast<std::size_t>(n)), {frame(n, 0), frame(n, 1), frame(n, 2)});
        frame.row(n) << d.x, d.y, d.z;
      }
      for (Eigen::Index n = 0; n < frame.rows(); ++n)
        if (!frame.row(n).allFinite())
          throw InputError("frame " + std::to_string(j) + ", node " +
                           std::to_string(taken.place(static_cast<std::size_t>(n))) + ": " + array.name +
                           " is not finite; a field can only stand for finite numbers");
      derivative.largest = std::max(derivative.largest, frame.rowwise().norm().maxCoeff());
      derivative.frames.push_back(std::move(frame));
    }
  }
  return derivatives;
}

}  // namespace

Eigen::MatrixXd Series::values(int field, std::size_t frame, std::size_t first, std::size_t count) const {
  if (node_values) return node_values->values(field, frame, first, count);
  const auto rows_of = [&](const auto& stored) -> Eigen::MatrixXd {
    Eigen::MatrixXd some =
        stored[frame].middleRows(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
    stored.forget(frame);
    return some;
  };
  return field == NodeSpline::displacement ? rows_of(frames) : rows_of(quantities[field].frames);
}

void set_scale(SeriesQuantity& quantity, const std::function<Eigen::MatrixXd(std::size_t)>& values) {
  const std::size_t frames = quantity.frames.size();
  const Eigen::Index components = quantity.frames.front().cols();
  Eigen::RowVectorXd middle = Eigen::RowVectorXd::Zero(components);
  if (components == 1) {
    const auto [low, high] = range_of(frames, values);
    middle(0) = (low + high) / 2;
  } else {
    for (std::size_t j = 0; j < frames; ++j)
      middle += values(j).colwise().mean() / static_cast<double>(frames);
  }
  double farthest = 0;
  for (std::size_t j = 0; j < frames; ++j)
    farthest = std::max(farthest, norms_of(values(j).rowwise() - middle).maxCoeff());
  const bool about_middle = 2 * farthest < quantity.largest;
  quantity.middle = about_middle ? middle : Eigen::RowVectorXd::Zero(components);
  quantity.scale = about_middle && farthest > 0 ? 2 * farthest : quantity.largest;
}

Series::Series(const SnapshotReader& reader, const SeriesStorage& storage)
    : block(storage.block), frames(storage.file) {
  std::shared_ptr<const OwnCoordinates> own;
  std::optional<Snapshot> moved;
  if (reader.snapshot().has_own_coordinates()) {
    own = std::make_shared<OwnCoordinates>(reader);
    round = own->around.has_value();
    turning = own->turning(reader.snapshot().pairs), bends = turning > bent, winds = turning > winding;
    tightest = own->tightest_bend(reader.snapshot());
    moved = own->of(reader.snapshot());
  }
  const Snapshot& s = moved ? *moved : reader.snapshot();
  if (s.frames() < 2)
    throw InputError("the snapshot holds " + std::to_string(s.frames()) +
                     " frame; a time series needs at least 2");
  check_cut(s);
  times = s.times, samples = samples_of(s), released = s.released;
  nodes = s.counting ? *s.counting : own ? own->nodes : samples.size();
  for (std::size_t i = nodes; own && i < samples.size(); ++i)
    if (samples[i].uvw.y == 0) samples[i].side = samples[own->node[own->kept[i]]].side;
  const SeriesSamples taken(s, samples, own, nodes, storage.most);
  const NodeRows closed = rows_of(numbers_of(reader.displacement(0)), 3);
  for (std::size_t j = 0; j < s.frames(); ++j) {
    const std::vector<Vec3> d = reader.displacement(j);
    Eigen::MatrixX3d frame(static_cast<Eigen::Index>(taken.size()), 3);
    double squared = 0;
    std::size_t sample = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::size_t n = taken.node_of(i);
      const auto row = static_cast<Eigen::Index>(n);
      const Vec3 change = d[n] - Vec3{closed(row, 0), closed(row, 1), closed(row, 2)};
      const Vec3 along = taken.in_axes(i, change);
      squared = std::max(squared, squared_norm(along));
      if (sample == taken.size() || taken.place(sample) != i) continue;
      frame.row(static_cast<Eigen::Index>(sample++)) << along.x, along.y, along.z;
    }
    largest.push_back(std::sqrt(squared));
    frames.push_back(frame);
  }
  largest_displacement = *std::max_element(largest.begin(), largest.end());
  pairs = taken.pairs_of(s.pairs);
  const std::vector<SnapshotArray> arrays = quantity_arrays(reader);
  if (taken.in_part()) {
    all_nodes = std::make_shared<const std::vector<Sample>>(
        samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(nodes));
    node_values = std::make_shared<const NodeValues>(taken.nodes_in_file(reader.values(), arrays));
    if (storage.spread) elsewhere = storage.spread(node_values, *all_nodes, times, block);
    std::vector<Sample> some;
    for (std::size_t i = 0; i < taken.size(); ++i) some.push_back(samples[taken.place(i)]);
    samples = std::move(some), nodes = taken.nodes();
    centres = cell_centres(taken.cells_of(s), samples);
  } else {
    centres = cell_centres(s, samples);
    if (samples.size() <= few_nodes) middles = edge_middles(s, samples), middles_hold = s.source.has_value();
    if (round && middles_hold) add_quadrilaterals_on_lips(middles, s, samples);
    if (own) {
      own->place_around_front(reader.snapshot(), centres);
      own->place_around_front(reader.snapshot(), middles);
      beside_jumps = own->beside_jumps(reader.snapshot());
    }
  }
  surface_only = s.source && is_curved_surface(reader.snapshot());
  in_parts = s.source && has_parts(reader.snapshot());
  quadratic = s.parameters->mesh.elements == ElementOrder::quadratic;
  if (s.source && s.source->break_extent.size() >= 8)
    arm = std::any_of(s.source->break_extent.begin() + 4, s.source->break_extent.begin() + 8,
                      [](double joined) { return joined != 0; });
  const NodeValues* at_nodes = node_values.get();
  quantities = quantities_of(reader, taken, arrays, at_nodes, node_samples().size(), storage.file);
  if (s.source)
    add_start(quantities, closed, s.frames(), largest_displacement, taken, at_nodes, node_samples().size());
  derivatives = derivatives_of(reader, taken);
  const OpenPairs open{samples, pairs, released, frames, round};
  const bool told = s.source && largest_displacement > 0;
  geometry = geometry_of(s, parted(pairs, frames, largest_displacement), told ? &open : nullptr);
  if (s.counting && s.source && s.source->break_extent.size() >= 8)
    front_kinks = cleft::front_kinks(geometry, s.source->break_extent, times);
}

void share_kinks(std::vector<Series>& pieces) {
  std::vector<FrontKinks> all;
  all.reserve(pieces.size());
  for (const Series& piece : pieces) all.push_back(piece.front_kinks);
  for (std::size_t p = 0; p < pieces.size(); ++p)
    pieces[p].kinks = kinks_of_all(all, p, pieces[p].times.size());
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
      if (quantity.frames.front().cols() != 1) continue;
      const auto [least, greatest] = range_of(
          piece.times.size(), values_of(quantity, piece.node_values.get(), q, piece.node_samples().size()));
      low = std::min(low, least), high = std::max(high, greatest);
    }
    if (low < high) scale = std::min(most, high - low);
    for (Series& piece : pieces) piece.quantities[q].largest = most, piece.quantities[q].scale = scale;
  }
}

}  // namespace cleft
