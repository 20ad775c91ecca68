#include <algorithm>

#include "base/error.h"
#include "base/h5/vtkhdf.h"
#include "base/text.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "Vec3 is written as three doubles");

std::span<const double> as_numbers(std::span<const Vec3> vectors) {
  return {vectors.empty() ? nullptr : &vectors.front().x, 3 * vectors.size()};
}

template <std::size_t K>
void write_table(h5::File& file, const std::string& name,
                 const std::vector<std::array<std::int32_t, K>>& rows) {
  file.write<std::int32_t>(name, {rows.empty() ? nullptr : rows.front().data(), K * rows.size()},
                           {rows.size(), K});
}

template <class T>
void write_list(h5::File& file, const std::string& name, const std::vector<T>& values) {
  file.write<T>(name, values, {values.size()});
}

void write_vtk(h5::File& file, const Snapshot& s, const std::vector<SnapshotArray>& arrays) {
  h5::write_vtk_mesh(file, as_numbers(s.points), s.cell_types, s.cell_offsets, s.connectivity);
  h5::write_vtk_steps(file, s.times);
  std::vector<SnapshotArray> all = {{"displacement", 3, true}};
  all.insert(all.end(), arrays.begin(), arrays.end());
  for (const SnapshotArray& array : all)
    h5::create_vtk_point_array(file, array.name, array.components, s.points.size(), s.frames(), array.varies);
}

void write_cut(h5::File& file, const Snapshot& s) {
  write_table(file, "/cut/pairs", s.pairs);
  write_list(file, "/cut/released", s.released);
  write_list(file, "/cut/position", s.position);
  file.write_number("/cut", "start", s.cut_start);
  file.write_number("/cut", "length", s.cut_length);
  file.write_number("/cut", "depth", s.cut_depth);
}

void write_parameters(h5::File& file, const Snapshot& s) {
  file.create_group("/parameters");
  for (const auto& [name, value] : s.parameters.all())
    if (const double* number = std::get_if<double>(&value))
      file.write_number("/parameters", name, *number);
    else
      file.write_text("/parameters", name, std::get<std::string>(value));
}

void write_source(h5::File& file, const SnapshotSource& source) {
  file.create_group("/import");
  file.write_text("/import", "source", source.file);
  file.write_numbers("/import", "origin", as_numbers({&source.origin, 1}));
  file.write_numbers("/import", "axes", as_numbers(source.axes));
  file.write_number("/import", "time_start", source.time_start);
  file.write_text("/import", "break", source.break_plane);
  file.write_number("/import", "rules", source.rules);
  std::string fields;
  for (const std::string& field : source.fields) fields += (fields.empty() ? "" : "\n") + field;
  if (!fields.empty()) file.write_text("/import", "fields", fields);
  if (!source.break_map.empty()) write_list(file, "/import/break_map", source.break_map);
}

void write_piece(h5::File& file, const std::string& group, const SnapshotPiece& piece) {
  write_list(file, group + "/nodes", piece.nodes);
  file.write_number(group, "counting", piece.counting);
  file.write<double>(group + "/places", as_numbers(piece.places), {piece.places.size(), 3});
  write_table(file, group + "/pairs", piece.pairs);
  write_list(file, group + "/released", piece.released);
  write_list(file, group + "/position", piece.position);
  file.write_number(group, "start", piece.cut_start);
  file.write_number(group, "length", piece.cut_length);
  file.write_number(group, "depth", piece.cut_depth);
  file.write_numbers(group, "origin", as_numbers({&piece.origin, 1}));
  file.write_numbers(group, "axes", as_numbers(piece.axes));
  file.write_text(group, "break", piece.break_plane);
  if (!piece.break_map.empty()) write_list(file, group + "/break_map", piece.break_map);
  write_list(file, group + "/break_extent", piece.break_extent);
}

}  // namespace

SnapshotWriter::SnapshotWriter(const std::string& path, const Snapshot& s,
                               const std::vector<SnapshotArray>& arrays)
    : out_(path), file_(h5::File::create(out_.path())), points_(s.points.size()) {
  FileFormat format = snapshot_format;
  if (!s.pieces.empty()) format.version = snapshot_format.further[0];
  write_format(file_, format);
  file_.write_text("/", "units", "mm N MPa");
  file_.write_text("/", "case", s.case_hash);
  file_.write_text("/", "producer", producer());
  if (!s.body.empty()) file_.write_text("/", "body", s.body);
  if (s.coordinates) file_.write_text("/", "coordinates", "canonical");
  write_vtk(file_, s, arrays);
  write_table(file_, "/foundation/triangles", s.foundation_triangles);
  write_table(file_, "/foundation/quads", s.foundation_quads);
  if (!s.body.empty() || !s.tension.empty())
    file_.write<double>("/skin/tension", as_numbers(s.tension), {s.tension.size(), 3});
  if (!s.body.empty() || !s.support.empty()) write_list(file_, "/foundation/support", s.support);
  if (!s.region.empty()) {
    write_list(file_, "/regions/of_wedge", s.region);
    file_.write<double>("/regions/moduli", {s.region_moduli.front().data(), 2 * s.region_moduli.size()},
                        {s.region_moduli.size(), 2});
  }
  write_cut(file_, s);
  write_parameters(file_, s);
  if (s.source) write_source(file_, *s.source);
  for (std::size_t p = 0; p < s.pieces.size(); ++p) write_piece(file_, piece_group(p), s.pieces[p]);
}

void SnapshotWriter::write_frames(std::size_t first, std::span<const Vec3> displacements) {
  CLEFT_CHECK(displacements.size() % points_, ==, 0u);
  file_.write_rows<double>("/VTKHDF/PointData/displacement", first * points_, displacements.size(),
                           as_numbers(displacements));
}

void SnapshotWriter::write_array(const SnapshotArray& array, std::size_t frame,
                                 std::span<const double> numbers) {
  CLEFT_CHECK(numbers.size(), ==, array.components * points_);
  file_.write_rows<double>("/VTKHDF/PointData/" + array.name, array.varies ? frame * points_ : 0, points_,
                           numbers);
}

void SnapshotWriter::finish(const Snapshot& s) {
  write_list(file_, "/frames/smallest_gap", s.smallest_gap);
  if (!s.source) {
    write_list(file_, "/frames/residual_equilibrium", s.residual_equilibrium);
    write_list(file_, "/frames/residual_closure", s.residual_closure);
  }
  file_.close();
  out_.commit();
}

}  // namespace cleft
