#include "encoder/import/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "encoder/field/field_source.h"
#include "encoder/import/break_surface.h"
#include "encoder/import/placed.h"

namespace cleft {

namespace {

/// A break in its own coordinates, in the whole mesh.
struct OwnPlace {
  Placement placement;
  Placed placed;
  FieldSource source;  ///< with the extent, which tells the weights
};

/// The end of the extent at which the junctions of an arm are.
void mark_joined(FieldSource& source, const std::vector<Vec3>& junctions) {
  BreakExtent& extent = *source.extent;
  double off[4] = {0, 0, 0, 0};
  for (const bool at_front : {true, false}) {
    std::vector<Vec3> there;
    for (const Vec3& x : junctions) {
      const Vec3 at = source.canonical(x);
      if ((2 * at.x < extent.along.front + extent.along.back) == at_front) there.push_back(at);
    }
    if (there.empty()) continue;
    std::fill(std::begin(off), std::end(off), 0);
    for (const Vec3& at : there) {
      off[0] += std::abs(at.x - extent.along.front), off[1] += std::abs(at.x - extent.along.back);
      off[2] += std::abs(at.z - extent.height.front), off[3] += std::abs(at.z - extent.height.back);
    }
    const bool has_height = extent.height.back > extent.height.front;
    extent.joined[std::min_element(off, off + (has_height ? 4 : 2)) - off] = true;
  }
}

OwnPlace own_place(const ImportedSeries& series, Break& found, const std::optional<Vec3>& flat) {
  OwnPlace own;
  own.placement = placement_on(found, series.mesh(), static_cast<std::int32_t>(series.frames()), flat);
  own.placed = snapshot_of(series, series.mesh(), found, own.placement, flat.has_value());
  const std::vector<Vec3>& at = own.placed.map ? own.placed.canonical : own.placed.snapshot.points;
  std::vector<Vec3> parting;
  for (std::size_t p = 0; p < found.pairs.size(); ++p)
    if (found.first_frame[p] < static_cast<std::int32_t>(series.frames()))
      parting.push_back(at[found.pairs[p][0]]);
  own.source.origin = own.placement.origin, own.source.axes = own.placement.axes;
  own.source.map = own.placed.map;
  own.source.extent = BreakExtent{range_of(parting, 0), range_of(parting, 2), {}, {}};
  mark_joined(own.source, found.junctions);
  return own;
}

/// Nodes beyond an end at which other arms begin, and beyond all nodes there that count: knots are densest
/// where the domain begins.
std::vector<char> beyond_joined_ends(const SourceMesh& mesh, const std::vector<char>& counts,
                                     const FieldSource& source) {
  const BreakExtent& extent = *source.extent;
  std::vector<Vec3> places;
  for (const Vec3& x : mesh.points) places.push_back(source.canonical(x));
  Interval within = extent.along;
  for (std::size_t n = 0; n < places.size(); ++n)
    if (counts[n]) within = {std::min(within.front, places[n].x), std::max(within.back, places[n].x)};
  const double slack = in_plane(mesh);
  std::vector<char> beyond(places.size());
  for (std::size_t n = 0; n < places.size(); ++n)
    beyond[n] = (extent.joined[0] && places[n].x < within.front - slack) ||
                (extent.joined[1] && places[n].x > within.back + slack);
  return beyond;
}

/// The nodes of a piece: those that count, and the others of their cells, where no break of another piece
/// would have two sides in it.
std::vector<char> nodes_of_piece(const SourceMesh& mesh, const std::vector<char>& counts,
                                 const std::vector<Break>& breaks, std::size_t piece,
                                 const FieldSource& source, std::size_t frames, const std::string& series) {
  constexpr int layers = 2;  // of cells: so many nodes that bases of three functions more are determined
  std::vector<char> refused = beyond_joined_ends(mesh, counts, source);
  std::vector<char> own(mesh.points.size());
  std::vector<std::vector<NodePair>> parting(breaks.size());
  for (std::size_t b = 0; b < breaks.size(); ++b)
    for (std::size_t p = 0; p < breaks[b].pairs.size(); ++p)
      if (breaks[b].first_frame[p] < static_cast<std::int32_t>(frames))
        parting[b].push_back(breaks[b].pairs[p]);
  for (const auto& [left, right] : breaks[piece].pairs) own[left] = own[right] = 1;
  const auto refuse_beyond = [&](const std::vector<char>& known) {
    for (std::size_t b = 0; b < breaks.size(); ++b) {
      if (b == piece) continue;
      for (const auto& [left, right] : parting[b]) {
        if (own[left] && own[right]) continue;
        if (known[left]) refused[right] = 1;
        if (known[right]) refused[left] = 1;
      }
    }
  };
  for (std::size_t b = 0; b < breaks.size(); ++b) {
    if (b == piece) continue;
    for (const auto& [left, right] : parting[b]) {
      if (own[left] && own[right]) continue;
      if (counts[left] && counts[right]) {
        const Vec3& at = mesh.points[left];
        throw InputError(
            series + ": two breaks are so close to each other at (" + shortest(at.x) + ", " + shortest(at.y) +
            ", " + shortest(at.z) +
            ") that each would lie in the other's piece; refine the mesh there, or say which one "
            "to take with --break nx,ny,nz,offset");
      }
    }
  }
  refuse_beyond(counts);
  std::vector<char> kept = counts;
  for (int layer = 0; layer < layers; ++layer) {
    const std::vector<char> before = kept;
    for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
      const auto first = mesh.connectivity.begin() + mesh.cell_offsets[c],
                 last = mesh.connectivity.begin() + mesh.cell_offsets[c + 1];
      if (std::any_of(first, last, [&](std::int64_t n) { return before[n]; }) &&
          std::none_of(first, last, [&](std::int64_t n) { return refused[n]; }))
        std::for_each(first, last, [&](std::int64_t n) { kept[n] = 1; });
    }
    refuse_beyond(kept);
  }
  return kept;
}

/// The cells that have no other nodes; nodes are numbered by `number`.
SourceMesh part_of(const SourceMesh& mesh, const std::vector<std::int32_t>& nodes,
                   const std::vector<std::int64_t>& number) {
  SourceMesh part;
  for (const std::int32_t n : nodes) part.points.push_back(mesh.points[n]);
  part.cell_offsets = {0};
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    const auto first = mesh.connectivity.begin() + mesh.cell_offsets[c],
               last = mesh.connectivity.begin() + mesh.cell_offsets[c + 1];
    if (std::any_of(first, last, [&](std::int64_t n) { return number[n] < 0; })) continue;
    for (auto n = first; n != last; ++n) part.connectivity.push_back(number[*n]);
    part.cell_types.push_back(mesh.cell_types[c]);
    part.cell_offsets.push_back(static_cast<std::int64_t>(part.connectivity.size()));
  }
  return part;
}

/// Nodes on lips of other arms, which have no partner here, are put beside v = 0 on the side of their cells.
void put_on_sides(std::vector<Vec3>& places, const SourceMesh& part, const std::vector<NodePair>& pairs,
                  const std::vector<char>& on_lips) {
  constexpr double beside = 1e-7;  // of the extent across
  std::vector<char> alone = on_lips;
  for (const auto& [left, right] : pairs) alone[left] = alone[right] = 0;
  const Interval across = range_of(places, 1);
  const std::vector<Vec3> inside = places_inside_cells(places, part.cell_offsets, part.connectivity);
  for (std::size_t n = 0; n < places.size(); ++n)
    if (alone[n] && places[n].y == 0)
      places[n].y = std::copysign(beside * (across.back - across.front), inside[n].y);
}

/// Where another arm leaves this one: u at the shared junction, and whether that is the end of this arm
/// rather than its start. None where it turns back or aside.
struct Onward {
  Vec3 from;
  bool at_end;
};
std::optional<Onward> onward(const SourceMesh& mesh, const Break& other, const Break& found,
                             const FieldSource& source) {
  constexpr double least_cosine = 0.2;
  for (const Vec3& x : found.junctions)
    for (const Vec3& y : other.junctions) {
      if (norm(x - y) > same_place(mesh)) continue;
      const Vec3 from = source.canonical(x);
      const bool at_end = 2 * from.x > source.extent->along.front + source.extent->along.back;
      double ahead = 0, aside = 0;
      for (const auto& [left, right] : other.pairs) {
        const Vec3 way = source.canonical(mesh.points[left]) - from;
        ahead += at_end ? way.x : -way.x, aside += way.y;
      }
      if (ahead < least_cosine * std::hypot(ahead, aside)) return {};
      return Onward{from, at_end};
    }
  return {};
}

/// Pairs of other arms that lie on the surface of this one, or on arms that leave it onward: as far beyond
/// its end as they are from there. Those alone where its front comes from or goes to, which open before all
/// of it or after: others have a front of their own, that moves away from this one or toward it.
BeyondArm beyond(const SourceMesh& mesh, const std::vector<Break>& breaks, std::size_t arm,
                 const OwnPlace& own) {
  const Break& found = breaks[arm];
  const BreakExtent& extent = *own.source.extent;
  const double near = (found.curved ? 100 : 1) * in_plane(mesh), slack = in_plane(mesh);
  BeyondArm result{extent.joined[1]};
  if (found.first_frame.empty()) return result;
  const auto [earliest, latest] = std::minmax_element(found.first_frame.begin(), found.first_frame.end());
  for (std::size_t b = 0; b < breaks.size(); ++b) {
    if (b == arm || found.junctions.empty() || breaks[b].junctions.empty()) continue;
    const std::optional<Onward> on = onward(mesh, breaks[b], found, own.source);
    for (std::size_t p = 0; p < breaks[b].pairs.size(); ++p) {
      const Vec3 at = own.source.canonical(mesh.points[breaks[b].pairs[p][0]]);
      const bool is_beyond = at.x <= extent.along.front - slack || at.x >= extent.along.back + slack,
                 on_surface = is_beyond && std::abs(at.y) <= near && at.z >= extent.height.front - slack &&
                              at.z <= extent.height.back + slack;
      if (!on_surface && !on) continue;
      const double way = on ? std::hypot(at.x - on->from.x, at.y - on->from.y) : 0;
      if (!on_surface && way <= slack) continue;
      const double u = on_surface ? at.x : on->from.x + (on->at_end ? way : -way);
      const bool before = 2 * u < extent.along.front + extent.along.back;
      if (before ? breaks[b].first_frame[p] >= *earliest : breaks[b].first_frame[p] <= *latest) continue;
      result.u.push_back(u);
      result.first_frame.push_back(breaks[b].first_frame[p]);
    }
  }
  return result;
}

SnapshotPiece piece_of(const ImportedSeries& series, const std::vector<Break>& breaks, std::size_t arm,
                       const OwnPlace& own, const std::vector<char>& counts, const std::vector<char>& kept,
                       const std::vector<char>& on_lips, bool is_flat) {
  const SourceMesh& mesh = series.mesh();
  Break found = breaks[arm];
  pair_among(found, mesh, kept);
  SnapshotPiece piece;
  std::vector<std::int64_t> number(mesh.points.size(), -1);
  for (const bool counting : {true, false}) {
    for (std::size_t n = 0; n < kept.size(); ++n)
      if (kept[n] && (counts[n] != 0) == counting) {
        number[n] = static_cast<std::int64_t>(piece.nodes.size());
        piece.nodes.push_back(static_cast<std::int32_t>(n));
      }
    if (counting) piece.counting = static_cast<std::int32_t>(piece.nodes.size());
  }
  for (NodePair& pair : found.pairs)
    for (std::int32_t& node : pair) node = static_cast<std::int32_t>(number[node]);
  const SourceMesh part = part_of(mesh, piece.nodes, number);
  Placed placed =
      snapshot_of(series, part, found, own.placement, is_flat, &own.placed, beyond(mesh, breaks, arm, own));
  Snapshot& s = placed.snapshot;
  piece.places = placed.map ? std::move(placed.canonical) : std::move(s.points);
  std::vector<char> lips;
  for (const std::int32_t n : piece.nodes) lips.push_back(on_lips[n]);
  put_on_sides(piece.places, part, s.pairs, lips);
  piece.pairs = std::move(s.pairs), piece.released = std::move(s.released);
  piece.position = std::move(s.position);
  piece.cut_start = s.cut_start, piece.cut_length = s.cut_length, piece.cut_depth = s.cut_depth;
  piece.origin = own.placement.origin, piece.axes = own.placement.axes;
  piece.break_plane = s.source->break_plane, piece.break_map = s.source->break_map;
  piece.break_extent = own.source.extent->numbers();
  return piece;
}

/// Where arms meet, all are as near, and the surfaces that are fitted to curved arms are off them by more
/// than nodes are from the corners of their cells: there a node counts for the arms that it is a lip of.
void count_at_junctions(const SourceMesh& mesh, const std::vector<Break>& breaks,
                        std::vector<std::vector<char>>& counts) {
  const double near = same_place(mesh);
  std::vector<std::vector<char>> lip(breaks.size(), std::vector<char>(mesh.points.size()));
  std::vector<char> at_junction(mesh.points.size());
  for (std::size_t b = 0; b < breaks.size(); ++b)
    for (const NodePair& pair : breaks[b].pairs)
      for (const std::int32_t n : pair) {
        lip[b][n] = 1;
        at_junction[n] =
            at_junction[n] || std::any_of(breaks[b].junctions.begin(), breaks[b].junctions.end(),
                                          [&](const Vec3& x) { return norm(x - mesh.points[n]) <= near; });
      }
  for (std::size_t n = 0; n < at_junction.size(); ++n)
    for (std::size_t b = 0; at_junction[n] && b < breaks.size(); ++b) counts[b][n] = lip[b][n];
}

/// Between the pairs of two breaks; 0 where they meet.
double gap_between(const SourceMesh& mesh, const Break& a, const Break& b, std::int32_t frames) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& x : a.junctions)
    for (const Vec3& y : b.junctions)
      if (norm(x - y) <= same_place(mesh)) return 0;
  const auto places = [&](const Break& one) {
    std::vector<Vec3> list;
    for (std::size_t p = 0; p < one.pairs.size(); ++p)
      if (one.first_frame[p] < frames) list.push_back(mesh.points[one.pairs[p][0]]);
    return list;
  };
  const std::vector<Vec3> of_b = places(b);
  for (const Vec3& x : places(a))
    for (const Vec3& y : of_b) least = std::min(least, squared_norm(x - y));
  return std::sqrt(least);
}

}  // namespace

std::vector<SnapshotPiece> pieces_of(const ImportedSeries& series, std::vector<Break>& breaks,
                                     const std::optional<Vec3>& flat) {
  const SourceMesh& mesh = series.mesh();
  std::vector<OwnPlace> own;
  own.reserve(breaks.size());
  for (Break& found : breaks) own.push_back(own_place(series, found, flat));
  const auto frames = static_cast<std::int32_t>(series.frames());
  for (std::size_t p = 0; p < breaks.size(); ++p)
    for (std::size_t q = 0; q < breaks.size(); ++q)
      own[p].source.extent->gaps.push_back(p == q  ? 0
                                           : p > q ? own[q].source.extent->gaps[p]
                                                   : gap_between(mesh, breaks[p], breaks[q], frames));
  std::vector<const FieldSource*> sources;
  sources.reserve(own.size());
  for (const OwnPlace& one : own) sources.push_back(&one.source);
  std::vector<std::vector<char>> counts(breaks.size(), std::vector<char>(mesh.points.size()));
  std::vector<double> weights(breaks.size());
  const std::vector<Vec3> inside = places_inside_cells(mesh.points, mesh.cell_offsets, mesh.connectivity);
  for (std::size_t n = 0; n < inside.size(); ++n) {
    piece_weights(sources, inside[n], weights);
    for (std::size_t p = 0; p < weights.size(); ++p) counts[p][n] = weights[p] > 0;
  }
  count_at_junctions(mesh, breaks, counts);
  std::vector<char> on_lips(mesh.points.size());
  for (const Break& found : breaks)
    for (std::size_t p = 0; p < found.pairs.size(); ++p)
      if (found.first_frame[p] < static_cast<std::int32_t>(series.frames()))
        on_lips[found.pairs[p][0]] = on_lips[found.pairs[p][1]] = 1;
  std::vector<SnapshotPiece> pieces;
  for (std::size_t p = 0; p < breaks.size(); ++p)
    pieces.push_back(
        piece_of(series, breaks, p, own[p], counts[p],
                 nodes_of_piece(mesh, counts[p], breaks, p, own[p].source, series.frames(), series.path()),
                 on_lips, flat.has_value()));
  return pieces;
}

}  // namespace cleft
