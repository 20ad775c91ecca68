#include "encoder/import/import_series.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <variant>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/import/break_surface.h"
#include "encoder/import/coincident.h"
#include "encoder/import/pieces.h"
#include "encoder/import/placed.h"
#include "encoder/import/series_on_ranks.h"

namespace cleft {

namespace {

RecordedParameters parse_parameters(const std::vector<std::string>& list) {
  RecordedParameters parameters;
  for (const std::string& text : list) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == text.npos)
      throw InputError("--set " + text + ": is not NAME=VALUE, such as skin.thickness=1.5");
    const std::string name = text.substr(0, equals);
    const double value = parse_number(text.substr(equals + 1), "--set " + name);
    if (parameters.find(name)) throw InputError("--set " + name + " is given twice");
    parameters.set(name, value);
  }
  return parameters;
}

/// Least opening along v over the released pairs; 0 where there are none.
double smallest_gap(const Snapshot& s, std::size_t frame, const std::vector<double>& displacement) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < static_cast<std::size_t>(s.released[frame]); ++p) {
    const auto v = [&](std::int32_t node) { return displacement[3 * static_cast<std::size_t>(node) + 1]; };
    least = std::min(least, v(s.pairs[p][1]) - v(s.pairs[p][0]));
  }
  return std::isfinite(least) ? least : 0;
}

std::vector<Vec3> as_vectors(const std::vector<double>& numbers) {
  std::vector<Vec3> vectors;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    vectors.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return vectors;
}

/// Where the break is no plane: coordinates of the cut, and their directions, which are those of (u, v, w).
void write_coordinates(SnapshotWriter& writer, const std::vector<Vec3>& canonical) {
  std::vector<double> places, frames;
  for (const Vec3& p : canonical) {
    places.insert(places.end(), {p.x, p.y, p.z});
    frames.insert(frames.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
  }
  writer.write_array(canonical_array, 0, places);
  writer.write_array(frame_array, 0, frames);
}

void write_frames(const ImportedSeries& series, const Placement& placement, const std::string& out,
                  const std::vector<Vec3>& canonical, ImportReport& report,
                  const std::function<void(const std::string&)>& progress) {
  Snapshot& s = report.snapshot;
  s.smallest_gap.assign(s.frames(), 0);
  std::vector<SnapshotArray> arrays = report.arrays;
  if (s.coordinates) arrays.insert(arrays.end(), {canonical_array, frame_array});
  SnapshotWriter writer(out, s, arrays);
  if (s.coordinates) write_coordinates(writer, canonical);
  series.for_each_frame([&](std::size_t j, FieldValues& values) {
    progress("writing frame " + std::to_string(j + 1) + " of " + std::to_string(s.frames()));
    auto array = report.arrays.begin();
    for (std::size_t f = 0; f < values.size(); ++f) {
      const SeriesField& field = series.fields()[f];
      turn(values[f], field.components, placement.axes);
      if (field.name == "displacement") {
        writer.write_frames(j, as_vectors(values[f]));
        s.smallest_gap[j] = smallest_gap(s, j, values[f]);
      } else {
        writer.write_array(*array++, j, values[f]);
      }
    }
  });
  writer.finish(s);
}

}  // namespace

namespace {

/// The snapshot of a body with several breaks: the pairs of all, and the piece around each.
Placed whole_of(const ImportedSeries& series, std::vector<Break>& breaks, const Placement& placement,
                const std::optional<Vec3>& flat) {
  Break all = breaks.front();
  Sets joined(series.mesh().points.size());
  all.pairs.clear(), all.first_frame.clear();
  for (const Break& one : breaks)
    for (std::size_t p = 0; p < one.pairs.size(); ++p) {
      const auto [left, right] = one.pairs[p];
      if (joined.root(left) == joined.root(right)) continue;  // where breaks meet
      joined.join(left, right);
      all.pairs.push_back(one.pairs[p]), all.first_frame.push_back(one.first_frame[p]);
    }
  const Placed plain;
  Placed whole = snapshot_of(series, series.mesh(), all, placement, flat.has_value(), &plain);
  whole.snapshot.pieces = pieces_of(series, breaks, flat);
  return whole;
}

}  // namespace

ImportReport import_series(const ImportOptions& o, const std::function<void(const std::string&)>& progress,
                           const Ranks* ranks) {
  // Told before the long part.
  if (o.break_plane && *o.break_plane != "none") parse_plane(*o.break_plane);
  std::optional<OpenAt> open_at;
  if (o.open_at) open_at = parse_open_at(*o.open_at);
  auto parameters = parse_parameters(o.parameters);
  std::vector<std::string> all_series = o.more_series;
  all_series.insert(all_series.begin(), o.series);
  const std::unique_ptr<ImportedSeries> opened =
      ranks ? SeriesOnRanks::open(*ranks, all_series, o.fields)
            : std::make_unique<ImportedSeries>(all_series, parse_fields(o.fields));
  ImportedSeries& series = *opened;
  refuse_to_overwrite(o.out, series.files());
  { const OutputFile probe(o.out); }

  const std::optional<Vec3> flat = flatness(series.mesh());
  const std::string frames = std::to_string(series.frames());
  Breaks found = find_breaks(series, o.break_plane, open_at, flat, [&](std::size_t j) {
    progress("looking at frame " + std::to_string(j + 1) + " of " + frames);
  });
  Break& first = found.list.front();
  const Placement placement =
      first.plane ? placement_on(first, series.mesh(), static_cast<std::int32_t>(series.frames()), flat)
                  : placement_in_box(series.mesh(), o.box, flat);

  ImportReport report;
  Placed placed = found.list.size() == 1
                      ? snapshot_of(series, series.mesh(), first, placement, flat.has_value())
                      : whole_of(series, found.list, placement, flat);
  report.snapshot = std::move(placed.snapshot);
  report.snapshot.parameters = std::move(parameters);
  for (const SeriesField& field : series.fields())
    if (field.name == "displacement")
      report.has_displacement = true;
    else
      report.arrays.push_back({field.name, static_cast<std::size_t>(field.components), true});
  write_frames(series, placement, o.out, placed.canonical, report, progress);
  report.notes = std::move(found.notes);
  report.notes.insert(report.notes.end(), series.notes().begin(), series.notes().end());
  if (found.list.size() > 1)
    report.notes.push_back(std::to_string(found.list.size()) +
                           " breaks, or arms of such: the body around each gets a field of its own");
  if (series.loose_nodes() > 0)
    report.notes.push_back(std::to_string(series.loose_nodes()) +
                           " nodes belong to no cell, and were left out");
  if (series.farthest_moved() > same_place(series.mesh()))
    report.notes.push_back("the nodes move by up to " + shortest(series.farthest_moved()) +
                           " between frames; their places in the first frame were taken");
  return report;
}

}  // namespace cleft
