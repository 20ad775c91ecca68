#include "encoder/import/decode_series.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/error.h"
#include "base/output_file.h"
#include "base/parallel.h"
#include "base/text.h"
#include "encoder/field/at_time.h"
#include "encoder/field/quantity_fields.h"
#include "encoder/import/coincident.h"
#include "encoder/import/components.h"
#include "encoder/import/decoded_vtkhdf.h"
#include "solver/snapshot/cell_types.h"

namespace cleft {

namespace {

constexpr const char* at_start = "displacement_at_start";  // what encode calls the displacement of frame 0

FieldSource source_of(const Field& field) {
  if (field.source) return *field.source;
  FieldSource source;
  source.axes = {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return source;
}

/// The name in the source of a field that is called `name` here.
std::string name_there(const FieldSource& source, const std::string& name) {
  for (const std::string& field : source.fields)
    if (const SourceName one(field); one.here == name) return one.there;
  return name;
}

/// Calls work(first, last) for ranges of so many nodes, on all cores.
template <class Work>
void in_ranges(std::size_t nodes, const Work& work) {
  constexpr std::size_t at_once = 1 << 16;
  parallel_for(static_cast<int>((nodes + at_once - 1) / at_once), [&](int range) {
    const std::size_t first = static_cast<std::size_t>(range) * at_once;
    work(first, std::min(nodes, first + at_once));
  });
}

double clamped(const Field& field, int axis, double value) {
  const auto [front, back] = field.domain(axis);
  return value < front ? front : value > back ? back : value;
}

/// Where a node is in a field, and the cells that have it.
struct InCells {
  Vec3 extent;                                 ///< largest of its cells along each axis of the field
  double across = 0;                           ///< their farthest node from the break
  std::array<bool, 2> sides = {false, false};  ///< whether there are such on the left, and on the right
};

std::vector<char> doubled_nodes(const SourceMesh& mesh, double near) {
  std::vector<char> doubled(mesh.points.size());
  for (const auto& group : coincident_groups(mesh.points, near))
    for (const std::int32_t node : group) doubled[node] = 1;
  return doubled;
}

std::vector<InCells> in_cells(const SourceMesh& m, const std::vector<Place>& nodes,
                              const std::vector<char>& doubled) {
  std::vector<InCells> list(nodes.size());
  FacesInBreak faces(m, doubled);
  std::vector<double> side(nodes.size()), distances;
  for (std::size_t c = 0; c < m.cell_types.size(); ++c) {
    const std::span corners(m.connectivity.begin() + m.cell_offsets[c],
                            m.connectivity.begin() + m.cell_offsets[c + 1]);
    distances.clear();
    Vec3 low = nodes[corners.front()].uvw, high = low;
    double farthest = 0;  // of its nodes from the break: those of a lip may be on the wrong side of it
    for (const std::int64_t n : corners) {
      const Vec3& at = nodes[n].uvw;
      distances.push_back(at.y);
      if (std::abs(at.y) > std::abs(farthest)) farthest = at.y;
      for (int axis = 0; axis < 3; ++axis)
        low[axis] = std::min(low[axis], at[axis]), high[axis] = std::max(high[axis], at[axis]);
    }
    const bool in_break = faces.take(c, distances, std::numeric_limits<double>::infinity());
    const bool flat = is_flat_type(m.cell_types[c]);  // the skin of a body bulges across its cells
    const double width = norm(high - low);
    for (const std::int64_t n : corners) {
      InCells& node = list[n];
      for (int axis = 0; axis < 3; ++axis)
        node.extent[axis] = std::max(node.extent[axis], flat ? width : high[axis] - low[axis]);
      node.across = std::max({node.across, -low.y, high.y, in_break ? width : 0});
      if (farthest != 0 && !in_break) node.sides[farthest > 0] = true;
    }
  }
  for (std::size_t n = 0; n < list.size(); ++n)
    side[n] = (list[n].sides[1] ? 1 : 0) - (list[n].sides[0] ? 1 : 0);
  faces.spread(side);
  for (std::size_t n = 0; n < list.size(); ++n)
    if (side[n] != 0) list[n].sides = {side[n]<0, side[n]> 0};
  return list;
}

/// How far from the break, over the extent of its cells across it, a node may be that is on it: in any case,
/// where all its cells are on the other side, and where it is on a lip of which most nodes are nearer.
constexpr double at_break = 1e-3, single = 0.05, of_lip = 0.5;

/// Whether all cells of a node are on one side of the break, and the node, by its place, on the other.
bool is_on_wrong_side(const Place& place, const InCells& cells) {
  const auto [left, right] = cells.sides;
  return left != right && (right ? place.uvw.y < 0 : place.uvw.y > 0);
}

/// Nodes of the lips: those that are doubled and, in a mesh with one lip alone, those that hang together,
/// most of them at the break.
std::vector<char> nodes_of_lips(const SourceMesh& m, const std::vector<Place>& nodes,
                                const std::vector<InCells>& cells, const std::vector<char>& doubled) {
  const auto is_within = [&](std::size_t n, double share) {
    return cells[n].sides[0] != cells[n].sides[1] && std::abs(nodes[n].uvw.y) <= share * cells[n].across;
  };
  std::vector<char> lips = doubled, near(nodes.size());
  for (std::size_t n = 0; n < near.size(); ++n)
    near[n] = is_within(n, is_on_wrong_side(nodes[n], cells[n]) ? of_lip : single);
  Sets together(nodes.size());
  for (std::size_t c = 0; c < m.cell_types.size(); ++c) {
    std::optional<std::int32_t> one;
    for (auto i = m.cell_offsets[c]; i < m.cell_offsets[c + 1]; ++i) {
      const auto n = static_cast<std::int32_t>(m.connectivity[i]);
      if (!near[n]) continue;
      if (one) together.join(*one, n);
      one = n;
    }
  }
  std::vector<int> surplus(nodes.size());  // of those at the break
  for (std::size_t n = 0; n < near.size(); ++n)
    if (near[n]) surplus[together.root(static_cast<std::int32_t>(n))] += is_within(n, single) ? 1 : -1;
  for (std::size_t n = 0; n < near.size(); ++n)
    if (near[n] && surplus[together.root(static_cast<std::int32_t>(n))] > 0) lips[n] = 1;
  return lips;
}

/// Puts a node at the break on the side of its cells. A mesh whose nodes are others than the source's has
/// chords where the break is curved: its lips are beside v = 0 then, and may be on the wrong side.
void put_on_side(Place& place, const InCells& cells, bool on_lip) {
  const auto [left, right] = cells.sides;
  const double near = !is_on_wrong_side(place, cells) ? at_break : on_lip ? of_lip : single;
  if (std::abs(place.uvw.y) <= near * cells.across) {
    place.uvw.y = 0;
    place.side = left == right ? Side::both : left ? Side::left : Side::right;
  } else {
    place.side = side_of(place.uvw.y);
  }
}

/// Throws InputError unless the node, which is at `x` in the source's space, is in the field's domain, or
/// beside it by a small part of its cells: those of another mesh bulge where faces are curved.
void expect_inside(const Field& field, const Place& place, const InCells& cells, double rounding,
                   std::size_t node, const Vec3& x) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [front, back] = field.domain(axis);
    const double slack = std::max(rounding, std::min(0.1 * cells.extent[axis], 0.01 * (back - front)));
    const double value = place.uvw[axis];
    if (value < front - slack || value > back + slack)
      throw InputError("node " + std::to_string(node) + " at (" + shortest(x.x) + ", " + shortest(x.y) +
                       ", " + shortest(x.z) + ") is at " + "uvw"[axis] + " = " + shortest(value) +
                       " of the field, which reaches from " + shortest(front) + " to " + shortest(back) +
                       "; the mesh must lie in the space of the series that the field was made from, within "
                       "its body: move it there, or leave out what is beyond");
  }
}

/// Fields whose components were arrays of their own are such again; an array that stands in several fields,
/// or twice in one, is written once.
std::vector<DecodedValues> as_they_were(std::vector<DecodedValues> all) {
  std::vector<DecodedValues> apart;
  for (DecodedValues& values : all) {
    const auto written = written_components(values.name, values.components);
    const auto components = static_cast<std::size_t>(values.components);
    for (const auto& [array, place] : written) {
      if (std::ranges::any_of(apart, [&, &name = array](const auto& one) { return one.name == name; }))
        continue;
      DecodedValues& one = apart.emplace_back(DecodedValues{array, 1, {}, values.unit});
      for (auto i = static_cast<std::size_t>(place); i < values.numbers.size(); i += components)
        one.numbers.push_back(values.numbers[i]);
    }
    if (written.empty()) values.name = array_recorded(values.name), apart.push_back(std::move(values));
  }
  return apart;
}

}  // namespace

std::vector<std::size_t> loose_nodes(const SourceMesh& mesh) {
  std::vector<char> has_cell(mesh.points.size(), mesh.cell_types.empty());
  for (const std::int64_t n : mesh.connectivity) has_cell[n] = 1;
  std::vector<std::size_t> loose;
  for (std::size_t n = 0; n < has_cell.size(); ++n)
    if (!has_cell[n]) loose.push_back(n);
  return loose;
}

std::vector<Place> nodes_in_field(const SourceMesh& m, const Field& field, const std::vector<char>* asked) {
  const FieldSource source = source_of(field);
  std::vector<Place> nodes;
  nodes.reserve(m.points.size());
  for (const Vec3& p : m.points) nodes.push_back({source.canonical(p)});
  std::vector<char> expected = asked ? *asked : std::vector<char>(nodes.size(), 1);
  SourceMesh body{m.points, {}, {}, {}};  // loose nodes may be far from it
  for (const std::size_t n : loose_nodes(m)) expected[n] = 0, body.points[n] = m.points[m.connectivity[0]];
  const std::vector<char> doubled = doubled_nodes(m, same_place(body));
  const std::vector<InCells> cells = in_cells(m, nodes, doubled);
  const std::vector<char> lips = nodes_of_lips(m, nodes, cells, doubled);
  const double rounding = 100 * same_place(body);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Place& place = nodes[n];
    put_on_side(place, cells[n], lips[n]);
    if (expected[n]) expect_inside(field, place, cells[n], rounding, n, m.points[n]);
    for (int axis = 0; axis < 3; ++axis) place.uvw[axis] = clamped(field, axis, place.uvw[axis]);
  }
  return nodes;
}

std::vector<NodesOfPiece> nodes_in_pieces(const SourceMesh& mesh, const BlendedField& field) {
  const std::vector<Vec3> inside_cells =
      places_inside_cells(mesh.points, mesh.cell_offsets, mesh.connectivity);
  std::vector<std::vector<double>> weights(mesh.points.size(), std::vector<double>(field.pieces().size()));
  for (std::size_t n = 0; n < weights.size(); ++n) field.weights(inside_cells[n], weights[n]);
  std::vector<NodesOfPiece> pieces;
  for (std::size_t p = 0; p < field.pieces().size(); ++p) {
    std::vector<char> mostly(weights.size());
    for (std::size_t n = 0; n < weights.size(); ++n) mostly[n] = weights[n][p] >= 0.5;
    const std::vector<Place> places = nodes_in_field(mesh, field.pieces()[p], &mostly);
    auto& piece = pieces.emplace_back();
    for (std::size_t n = 0; n < weights.size(); ++n)
      if (weights[n][p] > 0)
        piece.nodes.push_back(static_cast<std::int32_t>(n)), piece.places.push_back(places[n]);
  }
  return pieces;
}

DecodedNodes decoded_at(const KeptField& kept, const std::vector<Place>& nodes) {
  const auto places_at = [&nodes](std::size_t first, std::size_t last, double t) {
    return at_time(std::span(nodes).subspan(first, last - first), t);
  };
  const auto displacement = [&, places_at](double t, std::size_t frame) {
    std::vector<Vec3> d(nodes.size());
    in_ranges(nodes.size(), [&](std::size_t first, std::size_t last) {
      kept.field->displacements(places_at(first, last, t), std::span(d).subspan(first, last - first));
      for (std::size_t n = first; kept.residual && n < last; ++n) d[n] += kept.residual->at(n, frame);
    });
    return d;
  };
  const auto quantity = [&, places_at](std::size_t q, double t, std::size_t frame) {
    const QuantityFields fields(*kept.field, q);
    const std::size_t components = fields.components();
    const bool has = q < kept.of_quantities.size() && kept.of_quantities[q];
    std::vector<double> numbers(components * nodes.size());
    in_ranges(nodes.size(), [&](std::size_t first, std::size_t last) {
      fields.at(places_at(first, last, t),
                std::span(numbers).subspan(components * first, components * (last - first)));
      for (std::size_t n = first; has && n < last; ++n)
        for (std::size_t c = 0; c < components; ++c)
          numbers[components * n + c] += kept.of_quantities[q]->at(n, static_cast<int>(c), frame);
    });
    return numbers;
  };
  return {kept.field, displacement, quantity};
}

DecodedNodes decoded_at(const PiecesAtNodes& pieces) {
  return {&pieces.field().first(), [&](double t, std::size_t frame) { return pieces.displacement(t, frame); },
          [&](std::size_t q, double t, std::size_t frame) { return pieces.quantity(q, t, frame); }};
}

std::vector<double> times_of(const Field& field) {
  if (field.source && !field.source->times.empty()) return field.source->times;
  std::vector<double> times;
  const auto frames = static_cast<int>(std::max(2., field.report.frames));
  times.reserve(static_cast<std::size_t>(frames));
  for (int j = 0; j < frames; ++j) times.push_back(field.duration() * j / (frames - 1));
  return times;
}

std::vector<DecodedValues> values_at(const DecodedNodes& decoded, std::size_t frame) {
  const Field& field = *decoded.first;
  const FieldSource source = source_of(field);
  const std::vector<double> times = times_of(field);
  const double t = times[frame] - times.front();
  std::vector<DecodedValues> all;
  DecodedValues start;
  for (std::size_t q = 0; q < field.quantities.size(); ++q) {
    DecodedValues values{field.quantities[q].name, field.quantities[q].components,
                         decoded.quantity(q, t, frame)};
    if (values.name == at_start)
      start = std::move(values);
    else
      all.push_back(std::move(values));
  }
  if (field.report.largest_displacement > 0 || !start.numbers.empty() || all.empty()) {
    DecodedValues displacement{"displacement", 3, {}};
    const std::vector<Vec3> d = decoded.displacement(t, frame);
    displacement.numbers.reserve(3 * d.size());
    for (std::size_t n = 0; n < d.size(); ++n)
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = 3 * n + static_cast<std::size_t>(c);
        displacement.numbers.push_back(d[n][c] + (start.numbers.empty() ? 0 : start.numbers[i]));
      }
    all.insert(all.begin(), std::move(displacement));
  }
  const AxesInSpace to_source = axes_between(source.axes, same_axes);
  for (DecodedValues& values : all) {
    turn(values.numbers, values.components, to_source);
    const auto components = static_cast<std::size_t>(values.components);
    for (const std::size_t n : decoded.loose)
      std::fill_n(values.numbers.begin() + static_cast<std::ptrdiff_t>(components * n), components,
                  std::numeric_limits<double>::quiet_NaN());
    values.unit = field.source ? unit_of(source, values.name) : values.name == "displacement" ? "mm" : "";
    values.name = name_there(source, values.name);
  }
  return as_they_were(std::move(all));
}

void refuse_existing(const std::string& path) {
  if (std::filesystem::exists(path)) throw InputError(path + " exists: remove it, or give another name");
}

void write_vtkhdf(const DecodedNodes& decoded, const SourceMesh& mesh, const std::string& out,
                  const std::function<void(const std::string&)>& progress) {
  refuse_existing(out);
  const std::vector<double> times = times_of(*decoded.first);
  OutputFile file(out);
  DecodedVtkHdf series(file.path(), mesh, times);
  for (std::size_t j = 0; j < times.size(); ++j) {
    progress("writing frame " + std::to_string(j + 1) + " of " + std::to_string(times.size()));
    for (const DecodedValues& values : values_at(decoded, j))
      series.write(j, values.name, values.components, values.numbers, values.unit);
  }
  series.close();
  file.commit();
}

}  // namespace cleft
