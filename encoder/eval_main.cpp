// cleft eval: displacements of a field at points given as CSV, or at the nodes of its snapshot.
#include <cmath>
#include <functional>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/field/blended_field.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/pieces_at_nodes.h"
#include "encoder/samples.h"
#include "solver/snapshot/snapshot.h"

using namespace cleft;

namespace {

constexpr const char* columns[] = {"u", "v", "w", "side", "t"};

constexpr double rounding = 1e-9;  // of the field's extent

/// A number of a row inside the field's domain; the field itself would clamp without a word.
double inside(const Field& field, int axis, double value, const std::string& where) {
  const auto [front, back] = field.domain(axis);
  const double slack = rounding * (back - front);
  if (value >= front - slack && value <= back + slack) return value;
  throw InputError(where + ": " + columns[axis == 3 ? 4 : axis] + " = " + shortest(value) +
                   ": the field reaches from " + shortest(front) + " to " + shortest(back) + " mm");
}

/// Columns of the field's further quantities: a number each, numbered from 1 where there are several.
std::string quantity_names(const Field& field) {
  std::string names;
  for (const Quantity& quantity : field.quantities)
    for (int c = 1; c <= quantity.components; ++c)
      names += "," + quantity.name + (quantity.components > 1 ? "_" + std::to_string(c) : "");
  return names;
}

const Field& first_of(const Field& field) { return field; }
const Field& first_of(const BlendedField& field) { return field.first(); }

template <class AField>
std::string quantity_values(const AField& field, const Vec3& uvw, Side side, double t) {
  std::string text;
  const auto& quantities = first_of(field).quantities;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    std::vector<double> values(static_cast<std::size_t>(quantities[q].components));
    field.quantity(q, uvw, side, t, values);
    for (const double value : values) text += "," + shortest(value);
  }
  return text;
}

std::string row_of(const Vec3& d) { return shortest(d.x) + "," + shortest(d.y) + "," + shortest(d.z); }

/// The field of one break, or of several, at rows of a table.
struct AtRows {
  std::function<Vec3(const Vec3&, Side, double)> displacement;
  std::function<std::string(const Vec3&, Side, double)> quantities;
  std::function<Vec3(const Vec3&, const std::string&)> inside;  ///< throws InputError outside of the domain
};

AtRows rows_of(const Field& field) {
  return {[&](const Vec3& uvw, Side side, double t) { return field.displacement(uvw, side, t); },
          [&](const Vec3& uvw, Side side, double t) { return quantity_values(field, uvw, side, t); },
          [&](const Vec3& uvw, const std::string& where) {
            return Vec3{inside(field, 0, uvw.x, where), inside(field, 1, uvw.y, where),
                        inside(field, 2, uvw.z, where)};
          }};
}

AtRows rows_of(const BlendedField& field) {
  return {[&](const Vec3& uvw, Side side, double t) { return field.displacement(uvw, side, t); },
          [&](const Vec3& uvw, Side side, double t) { return quantity_values(field, uvw, side, t); },
          [&](const Vec3& uvw, const std::string& where) {
            if (field.is_inside(uvw)) return uvw;
            throw InputError(where + ": (" + shortest(uvw.x) + ", " + shortest(uvw.y) + ", " +
                             shortest(uvw.z) + ") mm is outside of the body that the field was fitted to");
          }};
}

/// `first`: the field, or the first of its pieces. Of several pieces a side may be given away from v = 0; of
/// one, v that is 0 but for rounding is on the side that is given.
std::string evaluate_rows(const AtRows& at_rows, const Field& first, bool several, const NumberTable& table,
                          const std::string& file) {
  int at[5];
  for (int c = 0; c < 5; ++c) {
    at[c] = table.column(columns[c]);
    if (at[c] < 0)
      throw FileError(file,
                      std::string("column '") + columns[c] + "' is missing; the columns are u,v,w,side,t");
  }
  std::string text = "du,dv,dw" + quantity_names(first) + "\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& row = table.rows[r];
    const std::string where = file + ", row " + std::to_string(r + 1);
    const double side = row[at[3]];
    if (side != -1 && side != 0 && side != 1)
      throw InputError(where + ": side = " + shortest(side) +
                       ": must be -1 (left), 1 (right) or 0 (by the sign of v)");
    Vec3 uvw = at_rows.inside({row[at[0]], row[at[1]], row[at[2]]}, where);
    const Interval& across = first.domain(1);
    if (!several && side != 0 && std::abs(uvw.y) <= rounding * (across.back - across.front)) uvw.y = 0;
    if (uvw.y * side < 0 && !several)
      throw InputError(where + ": side = " + shortest(side) + " contradicts v = " + shortest(uvw.y));
    const auto lip = static_cast<Side>(static_cast<int>(side));
    const double t = inside(first, 3, row[at[4]], where);
    text += row_of(at_rows.displacement(uvw, lip, t)) + at_rows.quantities(uvw, lip, t) + "\n";
  }
  return text;
}

/// Throws InputError if the field is detectably not made from this snapshot.
void check_fit(const Field& field, const std::optional<NodeResidual>& residual, const Snapshot& s,
               const std::string& file, const std::string& nodes) {
  const auto need = [&](bool good, const std::string& what) {
    if (!good)
      throw InputError(nodes + ": " + what + "; is it the snapshot that " + file + " was made from?");
  };
  // Between cases of one mesh any snapshot of it has the nodes.
  need(field.interpolation || s.case_hash == field.case_hash,
       "is of case '" + s.case_hash + "', and the field of case '" + field.case_hash + "'");
  if (residual) {
    need(s.points.size() == static_cast<std::size_t>(residual->nodes),
         "holds " + std::to_string(s.points.size()) + " nodes, and the field has a residual at " +
             std::to_string(residual->nodes));
    const int frames = residual->frames + residual->first_frame;
    need(s.frames() == static_cast<std::size_t>(frames), "holds " + std::to_string(s.frames()) +
                                                             " frames, and the field has a residual in " +
                                                             std::to_string(frames));
  }
  need(s.times.back() == field.duration(),
       "ends at t = " + shortest(s.times.back()) + ", and the field at t = " + shortest(field.duration()));
}

/// The displacements of the file: those of the spline, plus the residual if there is one.
std::string evaluate_nodes(const Field& field, const std::string& file, const std::string& nodes, int frame) {
  const SnapshotReader reader(nodes);
  const Snapshot& s = reader.snapshot();
  const std::optional<NodeResidual> residual = read_residual(file);
  check_fit(field, residual, s, file, nodes);
  const std::size_t j = frame;
  if (j >= s.frames())
    throw InputError("--frame: " + std::to_string(frame) + ": " + nodes + " holds frames 0 to " +
                     std::to_string(s.frames() - 1));

  std::vector<Place> places;
  std::vector<double> axes;  // of the displacement, where nodes have their own
  if (s.has_own_coordinates()) axes = reader.point_array(frame_array, 0);
  for (const Sample& sample : samples_in_field(reader)) {
    const std::string where = nodes + ", node " + std::to_string(places.size());
    for (int axis = 0; axis < 3; ++axis) inside(field, axis, sample.uvw[axis], where);
    places.push_back({sample.uvw, sample.side, s.times[j]});
  }
  std::vector<Vec3> values(places.size());
  field.displacements(places, values);
  std::vector<std::optional<NodeResidual>> of_quantities;
  for (std::size_t q = 0; q < field.quantities.size(); ++q) {
    of_quantities.push_back(read_quantity_residual(file, q));
    check_fit(field, of_quantities.back(), s, file, nodes);
  }
  std::string text = "du,dv,dw" + quantity_names(field) + "\n";
  for (std::size_t n = 0; n < values.size(); ++n) {
    Vec3 d = residual ? values[n] + residual->at(n, j) : values[n];
    if (!axes.empty()) d = in_space(d, &axes[9 * n]);
    text += row_of(d);
    for (std::size_t q = 0; q < of_quantities.size(); ++q) {
      std::vector<double> numbers(static_cast<std::size_t>(field.quantities[q].components));
      field.quantity(q, places[n].uvw, places[n].side, places[n].t, numbers);
      for (std::size_t c = 0; c < numbers.size(); ++c)
        text += "," + shortest(numbers[c] +
                               (of_quantities[q] ? of_quantities[q]->at(n, static_cast<int>(c), j) : 0));
    }
    text += "\n";
  }
  return text;
}

/// The same of a field of several pieces, along the axes of the snapshot.
std::string evaluate_nodes_of_pieces(const std::string& file, const std::string& nodes, std::size_t frame) {
  const SnapshotReader reader(nodes);
  const Snapshot& s = reader.snapshot();
  if (frame >= s.frames())
    throw InputError("--frame: " + std::to_string(frame) + ": " + nodes + " holds frames 0 to " +
                     std::to_string(s.frames() - 1));
  std::vector<NodesOfPiece> of_pieces;
  for (const SnapshotPiece& piece : s.pieces)
    of_pieces.push_back(
        counting_nodes(piece.nodes, static_cast<std::size_t>(piece.counting), piece.places, piece.pairs));
  const PiecesAtNodes at_nodes(read_pieces(file), std::move(of_pieces),
                               places_inside_cells(s.points_in_source(), s.cell_offsets, s.connectivity),
                               s.frames());
  const Field& first = at_nodes.field().first();
  check_fit(first, {}, s, file, nodes);
  const double t = s.times[frame];
  const std::vector<Vec3> moved = at_nodes.displacement(t, frame);
  std::vector<std::vector<double>> quantities;
  for (std::size_t q = 0; q < first.quantities.size(); ++q)
    quantities.push_back(at_nodes.quantity(q, t, frame));
  std::string text = "du,dv,dw" + quantity_names(first) + "\n";
  for (std::size_t n = 0; n < moved.size(); ++n) {
    text += row_of(moved[n]);
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const auto components = static_cast<std::size_t>(first.quantities[q].components);
      for (std::size_t c = 0; c < components; ++c) text += "," + shortest(quantities[q][n * components + c]);
    }
    text += "\n";
  }
  return text;
}

std::string evaluated(const std::string& file, const std::string& points, const std::string& nodes,
                      int frame) {
  const bool several = pieces_in(file) > 0;
  if (several && !nodes.empty())
    return evaluate_nodes_of_pieces(file, nodes, static_cast<std::size_t>(frame));
  if (several) {
    const BlendedField field = read_blended(file);
    return evaluate_rows(rows_of(field), field.first(), true, read_csv(points), points);
  }
  const Field field = read_field(file);
  return nodes.empty() ? evaluate_rows(rows_of(field), field, false, read_csv(points), points)
                       : evaluate_nodes(field, file, nodes, frame);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Displacements (mm, from the closed frame) of a field at points, or at its snapshot's nodes.",
      "cleft eval");
  std::string file, points = "/dev/stdin", nodes, out;
  int frame = 0;
  app.add_option("CASE.dffd", file, "field")->required();
  auto* points_option =
      app.add_option("--points", points,
                     "CSV with columns u,v,w,side,t in mm; side -1 left, 1 right, 0 by the sign of v")
          ->capture_default_str();
  auto* nodes_option =
      app.add_option(
             "--nodes", nodes,
             "instead of points: the snapshot the field was made from; its nodes in their order, with "
             "what the file keeps of them beside the spline")
          ->excludes(points_option);
  auto* frame_option = app.add_option("--frame", frame, "with --nodes: the frame, 0 is closed")
                           ->needs(nodes_option)
                           ->check(nonnegative());
  nodes_option->needs(frame_option);
  app.add_option(
      "--out", out,
      "CSV to write, columns du,dv,dw and the field's further quantities (default: standard output)");
  return run_command(app, argc, argv, [&] {
    refuse_to_overwrite(out, nodes.empty() ? std::vector{file, points} : std::vector{file, nodes});
    const std::string text = evaluated(file, points, nodes, frame);
    if (out.empty())
      std::cout << text;
    else
      write_text_file(out, text);
  });
}
