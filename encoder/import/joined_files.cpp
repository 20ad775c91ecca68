// Pieces of a frame, and several series of one mesh.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "encoder/import/frame_files.h"

namespace cleft {

void append(SourceFrame& all, const SourceFrame& piece, const std::string& path) {
  SourceMesh& mesh = all.mesh;
  const auto nodes = static_cast<std::int64_t>(mesh.points.size()),
             corners = static_cast<std::int64_t>(mesh.connectivity.size());
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(mesh.points, piece.mesh.points), add(mesh.cell_types, piece.mesh.cell_types);
  for (std::size_t c = 1; c < piece.mesh.cell_offsets.size(); ++c)
    mesh.cell_offsets.push_back(corners + piece.mesh.cell_offsets[c]);
  for (const std::int64_t n : piece.mesh.connectivity) mesh.connectivity.push_back(nodes + n);
  const auto join = [&](std::vector<SourceArray>& to, const std::vector<SourceArray>& from) {
    for (std::size_t a = 0; a < to.size(); ++a) {
      if (to[a].components != from[a].components)
        throw FileError(path, "an array has " + std::to_string(from[a].components) + " components, and " +
                                  std::to_string(to[a].components) + " in another piece of its frame");
      add(to[a].values, from[a].values);
    }
  };
  join(all.arrays, piece.arrays), join(all.cell_arrays, piece.cell_arrays);
}

void order_cells(SourceFrame& frame, const CellOrder& order) {
  if (order.empty()) return;
  for (SourceArray& array : frame.cell_arrays) {
    const auto components = static_cast<std::size_t>(array.components);
    std::vector<double> ordered;
    ordered.reserve(array.values.size());
    for (const std::size_t cell : order) {
      const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(components * cell);
      ordered.insert(ordered.end(), first, first + static_cast<std::ptrdiff_t>(components));
    }
    array.values = std::move(ordered);
  }
}

namespace {

class JoinedFiles : public FrameFiles {
 public:
  JoinedFiles(std::vector<std::unique_ptr<FrameFiles>> series, const std::vector<std::string>& paths)
      : series_(std::move(series)), paths_(paths) {
    for (std::size_t s = 1; s < series_.size(); ++s) check_times(s);
  }

  std::vector<std::string> files() const override {
    std::vector<std::string> all;
    for (const auto& one : series_)
      for (const std::string& file : one->files()) all.push_back(file);
    return all;
  }
  const std::vector<double>& times() const override { return series_.front()->times(); }
  bool in_pieces() const override { return series_.front()->in_pieces(); }
  const std::string& file(std::size_t frame) const override { return series_.front()->file(frame); }
  std::vector<std::string> point_arrays(std::size_t frame) const override {
    return names(frame, &FrameFiles::point_arrays);
  }
  std::vector<std::string> cell_arrays(std::size_t frame) const override {
    return names(frame, &FrameFiles::cell_arrays);
  }

  SourceFrame read(std::size_t frame, const WantedArrays& wanted) const override {
    SourceFrame all;
    all.arrays.resize(wanted.points.size()), all.cell_arrays.resize(wanted.cells.size());
    for (std::size_t s = 0; s < series_.size(); ++s) {
      WantedArrays here;
      const auto points = of_series(s, frame, wanted.points, &FrameFiles::point_arrays, here.points),
                 cells = of_series(s, frame, wanted.cells, &FrameFiles::cell_arrays, here.cells);
      if (s > 0 && points.empty() && cells.empty()) continue;
      SourceFrame one = series_[s]->read(frame, here);
      if (s == 0)
        all.mesh = std::move(one.mesh);
      else
        check_mesh(s, frame, all.mesh, one);
      for (std::size_t a = 0; a < points.size(); ++a) all.arrays[points[a]] = std::move(one.arrays[a]);
      for (std::size_t a = 0; a < cells.size(); ++a)
        all.cell_arrays[cells[a]] = std::move(one.cell_arrays[a]);
    }
    return all;
  }

 private:
  using Names = std::vector<std::string> (FrameFiles::*)(std::size_t) const;

  static bool among(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  /// Names as they are called here, series by series.
  std::vector<std::vector<std::string>> called(std::size_t frame, Names list) const {
    std::vector<std::vector<std::string>> own;
    for (const auto& one : series_) own.push_back((one.get()->*list)(frame));
    std::vector<std::vector<std::string>> all = own;
    for (std::size_t s = 0; s < own.size(); ++s)
      for (std::string& name : all[s])
        if (std::count_if(own.begin(), own.end(), [&](const auto& names) { return among(names, name); }) > 1)
          name.insert(0, std::filesystem::path(paths_[s]).stem().string() + "/");
    return all;
  }

  std::vector<std::string> names(std::size_t frame, Names list) const {
    std::vector<std::string> all;
    for (const auto& some : called(frame, list)) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  /// Which of the wanted arrays a series holds; their own names are appended to `own`.
  std::vector<std::size_t> of_series(std::size_t s, std::size_t frame, const std::vector<std::string>& wanted,
                                     Names list, std::vector<std::string>& own) const {
    std::vector<std::size_t> held;
    if (wanted.empty()) return held;
    const std::vector<std::string> there = (series_[s].get()->*list)(frame), here = called(frame, list)[s];
    for (std::size_t w = 0; w < wanted.size(); ++w)
      if (const auto at = std::find(here.begin(), here.end(), wanted[w]); at != here.end())
        held.push_back(w), own.push_back(there[static_cast<std::size_t>(at - here.begin())]);
    return held;
  }

  void check_times(std::size_t s) const {
    const std::vector<double>&a = times(), &b = series_[s]->times();
    if (a.size() != b.size())
      throw InputError(paths_[s] + ": has " + std::to_string(b.size()) + " frames, and " + paths_[0] +
                       " has " + std::to_string(a.size()) + "; series that are read together have the same");
    const double close = a.empty() ? 0 : 1e-9 * std::max(std::abs(a.front()), std::abs(a.back()));
    for (std::size_t j = 0; j < a.size(); ++j)
      if (!(std::abs(a[j] - b[j]) <= close))
        throw InputError(paths_[s] + ": frame " + std::to_string(j) + " is at " + shortest(b[j]) +
                         ", and that of " + paths_[0] + " at " + shortest(a[j]) +
                         "; series that are read together have the same times");
  }

  /// Brings values of the cells into the order of the first series', too.
  void check_mesh(std::size_t s, std::size_t frame, const SourceMesh& a, SourceFrame& one) const {
    const SourceMesh& b = one.mesh;
    const std::optional<CellOrder> order = order_as(b, a);
    bool same = order.has_value();
    const double near = same ? same_place(a) : 0;
    for (std::size_t i = 0; same && i < a.points.size(); ++i) same = norm(a.points[i] - b.points[i]) <= near;
    if (!same)
      throw InputError(series_[s]->file(frame) + " (frame " + std::to_string(frame) +
                       "): has another mesh than " + series_[0]->file(frame) +
                       "; series that are read together have the same cells, and the same nodes in the same "
                       "order");
    order_cells(one, *order);
  }

  std::vector<std::unique_ptr<FrameFiles>> series_;
  std::vector<std::string> paths_;
};

}  // namespace

std::unique_ptr<FrameFiles> joined(std::vector<std::unique_ptr<FrameFiles>> series,
                                   const std::vector<std::string>& paths) {
  return std::make_unique<JoinedFiles>(std::move(series), paths);
}

}  // namespace cleft
