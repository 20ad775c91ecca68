#include "haptic/contact_surface.h"

#include <limits>
#include <thread>

namespace cleft {

namespace {

constexpr std::size_t ahead = 8192;  // vertices and triangles that memory is ready for

struct Box {
  Vec3 low, high;
};

Box box_of(std::span<const Vec3> points, double margin) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{{far, far, far}, {-far, -far, -far}};
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k)
      box.low[k] = std::min(box.low[k], p[k]), box.high[k] = std::max(box.high[k], p[k]);
  if (margin < 0) margin = norm(box.high - box.low) / 4;
  const Vec3 around{margin, margin, margin};
  return {box.low - around, box.high + around};
}

double mean_edge(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles) {
  double sum = 0;
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) sum += norm(points[t[(i + 1) % 3]] - points[t[i]]);
  return sum / static_cast<double>(3 * triangles.size());
}

ContactCells make_cells(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles,
                        const ContactSurfaceOptions& options) {
  if (triangles.empty()) throw InputError("a mesh without triangles cannot be felt");
  const Box box = box_of(points, options.margin);
  return {box.low, box.high, options.cell > 0 ? options.cell : 0.75 * mean_edge(points, triangles)};
}

}  // namespace

ContactSurface::ContactSurface(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles,
                               const ContactSurfaceOptions& options)
    : cells_(make_cells(points, triangles, options)),
      positions_(points.size() + options.spare),
      normals_(points.size() + options.spare),
      triangles_(triangles.size() + options.spare),
      firmness_differs_(!options.firmness.empty()),
      firmness_(firmness_differs_ ? points.size() + options.spare : 1),
      first_corner_(points.size() + options.spare),
      next_corner_(triangles.size() + options.spare),
      triangle_touched_(triangles.size() + options.spare),
      vertex_touched_(points.size() + options.spare) {
  std::vector<Moved> moved;
  moved.reserve(points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    moved.push_back({static_cast<int>(v), points[v], firmness_differs_ ? options.firmness[v] : 0});
  std::vector<Changed> changed;
  changed.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) changed.push_back({static_cast<int>(t), {triangles[t]}});
  update(moved, changed);
  for (auto* numbers : {&touched_, &renewed_}) numbers->reserve(ahead);
  left_.reserve(ahead);
  prepare();
}

void ContactSurface::prepare() {
  positions_.prepare(ahead), normals_.prepare(ahead), triangles_.prepare(ahead);
  first_corner_.prepare(ahead), next_corner_.prepare(ahead);
  triangle_touched_.prepare(ahead), vertex_touched_.prepare(ahead);
  if (firmness_differs_) firmness_.prepare(ahead);
  cells_.prepare();
}

Corners ContactSurface::corners_at(const ContactTriangle& t, std::uint64_t version) const {
  Corners corners;
  for (int i = 0; i < 3; ++i) corners[i] = positions_[t.vertex[i]].at(version);
  return corners;
}

void ContactSurface::wait_for_readers() const {
  const std::uint64_t last = version_.load(std::memory_order_relaxed);
  for (const auto& reader : readers_)
    for (;;) {
      const std::uint64_t says = reader.load(std::memory_order_seq_cst);
      if (says == unused || says == idle || (says >= reading && says - reading >= last)) break;
      if (says != entering) std::this_thread::yield();
    }
}

void ContactSurface::update(std::span<const Moved> moved, std::span<const Changed> changed) {
  wait_for_readers();
  leave_old_voxels();
  const std::uint64_t next = version_.load(std::memory_order_relaxed) + 1;
  for (const Moved& m : moved) set_vertex(m, next);
  for (const Changed& c : changed) set_triangle(c.triangle, c.now, next);
  renew_normals(next);
  for (const int t : touched_) rebin(t, next);
  touched_.clear();
  version_.store(next, std::memory_order_seq_cst);
}

/// Into the voxels it has come to, at once; out of those it has left in the next step.
void ContactSurface::rebin(int id, std::uint64_t next) {
  TwoStates<StoredTriangle>& triangle = triangles_[id];
  old_voxels_.clear(), new_voxels_.clear();
  if (const StoredTriangle& old = triangle.at(next - 1); old.exists())
    cells_.voxels_of(corners_at(old.triangle(), next - 1), old_voxels_);
  if (StoredTriangle now = triangle.last(); now.exists()) {
    const Corners corners = corners_at(now.triangle(), next);
    now.set_plane(corners);
    triangle.set(now, next);
    cells_.voxels_of(corners, new_voxels_);
  }
  const auto among = [](const std::vector<std::uint64_t>& voxels, std::uint64_t voxel) {
    return std::find(voxels.begin(), voxels.end(), voxel) != voxels.end();
  };
  for (const std::uint64_t voxel : new_voxels_)
    if (!among(old_voxels_, voxel)) cells_.add(voxel, id);
  for (const std::uint64_t voxel : old_voxels_)
    if (!among(new_voxels_, voxel)) left_.push_back({voxel, id});
}

/// Readers of the step before found triangles in the voxels they have left: only now may these forget them.
void ContactSurface::leave_old_voxels() {
  cells_.recycle();
  for (const auto& [voxel, triangle] : left_) cells_.remove(voxel, triangle);
  left_.clear();
}

void ContactSurface::touch(int triangle) {
  std::uint64_t& last = triangle_touched_[triangle];
  const std::uint64_t next = version_.load(std::memory_order_relaxed) + 1;
  if (last == next) return;
  last = next;
  touched_.push_back(triangle);
}

void ContactSurface::set_vertex(const Moved& moved, std::uint64_t version) {
  const std::size_t v = moved.vertex;
  if (v >= positions_.size()) {
    positions_.grow_to(v + 1);
    normals_.grow_to(v + 1);
    first_corner_.grow_to(v + 1, none);
    vertex_touched_.grow_to(v + 1);
    if (firmness_differs_) firmness_.grow_to(v + 1, 1.F);
  }
  if (firmness_differs_ && moved.firmness > 0) firmness_[v].store(moved.firmness, std::memory_order_relaxed);
  if (moved.position == positions_[v].last()) return;
  positions_[v].set(moved.position, version);
  for (int corner = first_corner_[v]; corner != none; corner = next_corner(corner)) touch(corner / 3);
}

void ContactSurface::set_triangle(int id, const ContactTriangle& now, std::uint64_t version) {
  const std::size_t t = id;
  if (t >= triangles_.size()) {
    triangles_.grow_to(t + 1);
    next_corner_.grow_to(t + 1, std::array{none, none, none});
    triangle_touched_.grow_to(t + 1);
  }
  touch(id);
  const ContactTriangle old = triangles_[t].last().triangle();
  for (int i = 0; i < 3; ++i) {
    if (old.vertex[i] == now.vertex[i]) continue;
    if (old.vertex[0] != none) {
      unlink(id, i, old.vertex[i]);
      renewed_.push_back(old.vertex[i]);
    }
    if (now.vertex[0] == none) continue;
    CLEFT_CHECK(static_cast<std::size_t>(now.vertex[i]), <, positions_.size());
    int& first = first_corner_[now.vertex[i]];
    next_corner(3 * id + i) = first;
    first = 3 * id + i;
  }
  triangles_[t].set(StoredTriangle(now), version);
}

void ContactSurface::unlink(int triangle, int corner, int vertex) {
  int* link = &first_corner_[vertex];
  while (*link != 3 * triangle + corner) {
    CLEFT_CHECK(*link, !=, none);
    link = &next_corner(*link);
  }
  *link = next_corner(*link);
}

void ContactSurface::renew_normals(std::uint64_t version) {
  for (const int t : touched_) {
    const ContactTriangle now = triangles_[t].last().triangle();
    if (now.vertex[0] == none) continue;
    for (const int v : now.vertex) renewed_.push_back(v);
  }
  for (const int v : renewed_)
    if (vertex_touched_[v] != version) {
      vertex_touched_[v] = version;
      renew_normal(v, version);
    }
  renewed_.clear();
}

/// A lip's normal is that of its skin: walls meet it at an edge that is meant to be sharp.
void ContactSurface::renew_normal(int vertex, std::uint64_t version) {
  const std::size_t v = vertex;
  Vec3 skin, wall;
  for (int corner = first_corner_[v]; corner != none; corner = next_corner(corner)) {
    const ContactTriangle t = triangles_[corner / 3].last().triangle();
    (t.wall ? wall : skin) += scaled_normal(corners_at(t, version));
  }
  const Vec3& sum = skin == Vec3{} ? wall : skin;
  const double length = norm(sum);
  normals_[v].set(length > 0 ? 1 / length * sum : Vec3{}, version);
}

}  // namespace cleft
