#include "encoder/import/remeshed_files.h"

#include <vtkCellLocator.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "base/error.h"
#include "base/text.h"
#include "encoder/field/field_source.h"
#include "encoder/import/coincident.h"
#include "encoder/import/vtk_frames.h"

namespace cleft {

namespace {

constexpr double most_lost = 1e-3;            // of the largest value, before a node is added
constexpr double farthest_off = 0.02;         // of the body's diagonal, of a node from another frame's mesh
constexpr double no_weight = 1e-6;            // of a cell's corner
constexpr double inward = 0.01;               // of the way to a cell's centroid
constexpr std::uint8_t vertex = 1, line = 3;  // VTK's cell types

/// Values at places in the cells of a mesh.
class MeshValues {
 public:
  struct At {
    std::vector<std::int64_t> corners;
    std::vector<double> weights;
    double off = 0;  ///< distance of the place from the cell
  };

  explicit MeshValues(const SourceMesh& mesh) : grid_(grid_of(mesh)) {
    locator_->SetDataSet(grid_);
    locator_->BuildLocator();
    weights_.resize(static_cast<std::size_t>(grid_->GetMaxCellSize()));
  }

  /// In the cell at `inside`, which is next to the place.
  At at(Vec3 place, Vec3 inside) {
    double parametric[3], closest[3], squared = 0;
    int part = 0;
    vtkIdType cell = locator_->FindCell(&inside.x, 0, cell_, parametric, weights_.data());
    if (cell < 0) {
      locator_->FindClosestPoint(&inside.x, closest, cell_, cell, part, squared);
      if (cell < 0) throw InputError("no cell is near");
    }
    grid_->GetCell(cell, cell_);
    At at;
    if (cell_->EvaluatePosition(&place.x, closest, part, parametric, squared, weights_.data()) == 0) {
      at.off = std::sqrt(squared);
      double again[3];
      cell_->EvaluatePosition(closest, again, part, parametric, squared, weights_.data());
    }
    for (vtkIdType i = 0; i < cell_->GetNumberOfPoints(); ++i) {
      at.corners.push_back(cell_->GetPointId(i));
      at.weights.push_back(weights_[static_cast<std::size_t>(i)]);
    }
    return at;
  }

  static void add(const At& at, const SourceArray& array, double* sum) {
    for (std::size_t i = 0; i < at.corners.size(); ++i)
      for (int c = 0; c < array.components; ++c)
        sum[c] +=
            at.weights[i] * array.values[static_cast<std::size_t>(at.corners[i] * array.components + c)];
  }

 private:
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  // The static one sorts cells by several threads: which of two a place between them is in would change by
  // chance.
  vtkNew<vtkCellLocator> locator_;
  vtkNew<vtkGenericCell> cell_;
  std::vector<double> weights_;
};

std::vector<Vec3> inside_cells(const SourceMesh& mesh) {
  return places_inside_cells(mesh.points, mesh.cell_offsets, mesh.connectivity);
}

/// Arrays of the points, then those of the cells as means at the points. Throws InputError about the frame's
/// file if it is damaged, or its arrays are others than those before.
SourceFrame checked(const FrameFiles& files, std::size_t frame, const WantedArrays& wanted,
                    std::vector<int>* components = nullptr) {
  SourceFrame found = files.read(frame, wanted);
  const std::string where = files.file(frame) + " (frame " + std::to_string(frame) + ")";
  check_cells(where, found.mesh);
  const auto check = [&](const SourceArray& array, std::size_t rows, const std::string& name, std::size_t a) {
    if (components && components->size() == a) components->push_back(array.components);
    if (array.values.size() != rows * static_cast<std::size_t>(array.components) ||
        (components && array.components != components->at(a)))
      throw InputError(where + ": field '" + name + "' has another shape than in frame 0");
  };
  for (std::size_t a = 0; a < wanted.points.size(); ++a)
    check(found.arrays.at(a), found.mesh.points.size(), wanted.points[a], a);
  for (std::size_t a = 0; a < wanted.cells.size(); ++a) {
    SourceArray& array = found.cell_arrays.at(a);
    check(array, found.mesh.cell_types.size(), wanted.cells[a], found.arrays.size());
    array.values = mean_of_cells(found.mesh, array.values, static_cast<std::size_t>(array.components));
    found.arrays.push_back(std::move(array));
  }
  found.cell_arrays.clear();
  return found;
}

/// Arrays at places of `values`' mesh.
std::vector<SourceArray> interpolated(MeshValues& values, const std::vector<SourceArray>& arrays,
                                      const std::vector<Vec3>& places, const std::vector<Vec3>& inside,
                                      double most_off, const std::string& where) {
  std::vector<SourceArray> result;
  result.reserve(arrays.size());
  for (const SourceArray& array : arrays)
    result.push_back({array.components, array.single,
                      std::vector<double>(places.size() * static_cast<std::size_t>(array.components), 0)});
  for (std::size_t n = 0; n < places.size(); ++n) {
    const MeshValues::At at = values.at(places[n], inside[n]);
    if (at.off > most_off)
      throw InputError(where + ": its mesh ends " + shortest(at.off) + " from node " + std::to_string(n) +
                       " of the last frame's; frames with other meshes must be of one body, in its places "
                       "before it moves");
    for (std::size_t a = 0; a < arrays.size(); ++a)
      MeshValues::add(at, arrays[a], &result[a].values[n * static_cast<std::size_t>(arrays[a].components)]);
  }
  return result;
}

double distance_at(const SourceArray& a, std::size_t i, const SourceArray& b, std::size_t j) {
  const auto components = static_cast<std::size_t>(a.components);
  double squared = 0;
  for (std::size_t c = 0; c < components; ++c)
    squared += std::pow(a.values[i * components + c] - b.values[j * components + c], 2);
  return std::sqrt(squared);
}

/// The largest norm of a row.
double largest_of(const SourceArray& array) {
  const SourceArray zero{array.components, false,
                         std::vector<double>(static_cast<std::size_t>(array.components), 0)};
  double largest = 0;
  for (std::size_t n = 0; n < array.values.size() / static_cast<std::size_t>(array.components); ++n)
    largest = std::max(largest, distance_at(array, n, zero, 0));
  return largest;
}

/// Where a place on the break is in the cell of one of its lips.
struct OnLip {
  Vec3 inside;                    ///< next to the place, in the cell
  std::int64_t behind = -1;       ///< a corner of the cell that is not on the break; -1: it has none
  std::set<std::int64_t> around;  ///< the corners on the break between which the place is
};

/// None where the place is not between corners on the break, which are `paired`.
std::optional<OnLip> lip_of(const MeshValues::At& at, const Vec3& place, const SourceMesh& mesh,
                            const std::vector<char>& paired) {
  OnLip lip;
  Vec3 centroid;
  for (std::size_t i = 0; i < at.corners.size(); ++i) {
    const std::int64_t corner = at.corners[i];
    centroid += (1 / static_cast<double>(at.corners.size())) * mesh.points[corner];
    if (std::abs(at.weights[i]) >= no_weight) lip.around.insert(corner);
    if (!paired[corner]) lip.behind = corner;
  }
  if (!std::all_of(lip.around.begin(), lip.around.end(), [&](std::int64_t n) { return paired[n]; }))
    return {};
  lip.inside = lerp(place, centroid, inward);
  return lip;
}

}  // namespace

bool is_remeshed(const FrameFiles& files, const SourceMesh& first) {
  return !same_mesh(first, files.read(files.times().size() - 1, {}).mesh);
}

RemeshedFiles::RemeshedFiles(std::unique_ptr<FrameFiles> files, const WantedArrays& wanted)
    : files_(std::move(files)) {
  const std::size_t frames = times().size();
  mesh_ = checked(*files_, frames - 1, {}).mesh;
  inside_ = inside_cells(mesh_);
  own_ = mesh_.points.size();
  const double extent = diagonal(mesh_.points), grain = same_place(mesh_);
  std::vector<char> paired(own_, 0);
  for (const auto& group : coincident_groups(mesh_.points, grain))
    for (const std::int32_t n : group) paired[n] = 1;
  std::vector<double> largest(wanted.points.size() + wanted.cells.size(), 0);
  std::vector<int> components;
  for (std::size_t j = 0; j < frames; ++j) {
    const SourceFrame frame = checked(*files_, j, wanted, &components);
    for (std::size_t a = 0; a < largest.size(); ++a)
      largest[a] = std::max(largest[a], largest_of(frame.arrays[a]));
  }
  SourceMesh last = mesh_;
  MeshValues of_last(last);
  std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> added;
  const auto cell_of = [&](const Vec3& p) {
    return std::tuple{std::llround(p.x / (10 * grain)), std::llround(p.y / (10 * grain)),
                      std::llround(p.z / (10 * grain))};
  };
  for (std::size_t j = 0; j < frames; ++j) {
    const SourceFrame frame = checked(*files_, j, wanted);
    if (same_mesh(frame.mesh, last)) continue;
    ++remeshed_;
    const std::vector<Vec3> inside = inside_cells(frame.mesh);
    MeshValues of_frame(frame.mesh);
    const std::vector<Vec3> own_inside(inside_.begin(), inside_.begin() + static_cast<std::ptrdiff_t>(own_));
    const auto there =
        interpolated(of_frame, frame.arrays, last.points, own_inside, farthest_off * extent, files_->file(j));
    for (std::size_t n = 0; n < frame.mesh.points.size(); ++n) {
      const MeshValues::At at = of_last.at(frame.mesh.points[n], inside[n]);
      double lost = 0;
      for (std::size_t a = 0; a < there.size(); ++a) {
        if (largest[a] == 0) continue;
        SourceArray back{there[a].components, false,
                         std::vector<double>(static_cast<std::size_t>(there[a].components), 0)};
        MeshValues::add(at, there[a], back.values.data());
        lost = std::max(lost, distance_at(back, 0, frame.arrays[a], n) / largest[a]);
      }
      if (lost <= most_lost) continue;
      const Vec3& place = frame.mesh.points[n];
      const auto lip = lip_of(at, place, last, paired);
      if (!lip) {
        if (added.insert(cell_of(place)).second) add(place, inside[n], {});
        continue;
      }
      const Vec3 across = place + (place - lip->inside);
      const auto other = lip_of(of_last.at(place, across), place, last, paired);
      if (!other || other->around == lip->around || lip->behind < 0 || other->behind < 0)
        most_lost_ = std::max(most_lost_, lost);
      else if (added.insert(cell_of(place)).second)
        add(place, lip->inside, lip->behind), add(place, other->inside, other->behind);
    }
  }
}

/// A line to a node of its side tells on which lip a node is.
void RemeshedFiles::add(const Vec3& place, const Vec3& inside, std::optional<std::int64_t> behind) {
  mesh_.cell_types.push_back(behind ? line : vertex);
  mesh_.connectivity.push_back(static_cast<std::int64_t>(mesh_.points.size()));
  if (behind) mesh_.connectivity.push_back(*behind);
  mesh_.cell_offsets.push_back(static_cast<std::int64_t>(mesh_.connectivity.size()));
  mesh_.points.push_back(place), inside_.push_back(inside);
}

bool RemeshedFiles::has_own_mesh(const SourceMesh& mesh) const {
  return mesh.points.size() == own_ &&
         mesh.cell_types.size() + mesh_.points.size() - own_ == mesh_.cell_types.size() &&
         std::equal(mesh.cell_types.begin(), mesh.cell_types.end(), mesh_.cell_types.begin()) &&
         std::equal(mesh.cell_offsets.begin(), mesh.cell_offsets.end(), mesh_.cell_offsets.begin()) &&
         std::equal(mesh.connectivity.begin(), mesh.connectivity.end(), mesh_.connectivity.begin());
}

std::vector<std::string> RemeshedFiles::point_arrays(std::size_t frame) const {
  std::vector<std::string> names = files_->point_arrays(frame);
  for (const std::string& name : files_->cell_arrays(frame))
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

SourceFrame RemeshedFiles::read(std::size_t frame, const WantedArrays& all) const {
  const std::vector<std::string> of_points = files_->point_arrays(frame);
  WantedArrays wanted;
  std::vector<std::size_t> place;  // of each array that is read, points first, among those wanted
  for (const bool cells : {false, true})
    for (std::size_t a = 0; a < all.points.size(); ++a)
      if ((std::find(of_points.begin(), of_points.end(), all.points[a]) == of_points.end()) == cells)
        (cells ? wanted.cells : wanted.points).push_back(all.points[a]), place.push_back(a);
  SourceFrame found = checked(*files_, frame, wanted);
  std::vector<SourceArray> in_order(found.arrays.size());
  for (std::size_t a = 0; a < place.size(); ++a) in_order[place[a]] = std::move(found.arrays[a]);
  found.arrays = std::move(in_order);
  MeshValues values(found.mesh);
  const double most_off = farthest_off * diagonal(mesh_.points);
  SourceFrame result;
  if (has_own_mesh(found.mesh)) {
    const std::vector<Vec3> places(mesh_.points.begin() + static_cast<std::ptrdiff_t>(own_),
                                   mesh_.points.end()),
        inside(inside_.begin() + static_cast<std::ptrdiff_t>(own_), inside_.end());
    const auto more = interpolated(values, found.arrays, places, inside, most_off, file(frame));
    result.arrays = std::move(found.arrays);
    for (std::size_t a = 0; a < more.size(); ++a)
      result.arrays[a].values.insert(result.arrays[a].values.end(), more[a].values.begin(),
                                     more[a].values.end());
  } else {
    result.arrays = interpolated(values, found.arrays, mesh_.points, inside_, most_off, file(frame));
  }
  result.mesh = mesh_;
  return result;
}

std::string RemeshedFiles::note() const {
  return std::to_string(remeshed_) +
         " frames have another mesh than the last one; their values were interpolated "
         "at its nodes, and at " +
         std::to_string(mesh_.points.size() - own_) +
         " of their own where more than 0.1 % of the largest would be lost" +
         (most_lost_ > 0 ? "; on the break, where the last mesh has no cell on either side, up to " +
                               shortest(std::round(1e4 * most_lost_) / 100) + " % are"
                         : "");
}

}  // namespace cleft
