#include "explorer/incision/incision.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/refine.h"

namespace cleft {

Incision::Incision(const SurfaceMesh& surface, ScalpelPath path, const IncisionOptions& options)
    : mesh_(surface),
      path_(std::move(path)),
      options_(options),
      chord_tolerance_(options.chord_tolerance.value_or(path_.length() / 1000)),
      longest_step_(path_.length() / 4),  // even a cut inside one triangle has vertices that can open
      original_triangles_(static_cast<int>(surface.triangles.size())) {
  if (!(path_.smallest_depth() > 0))
    throw InputError("the cut has no depth: give the path a column 'depth', or a depth for all of it");
  const double max_edge = options_.max_edge.value_or(path_.length() / 30);
  Step start = find_start();
  if (max_edge > 0) {
    const double height = dot(start.place - path_.at(start.s).position, path_.at(start.s).outward);
    refine_along(mesh_, path_, height, max_edge, path_.length() / 8);
    start = find_start();
  }
  const int first = realise(start);
  grow(first, start.s);
  walls_ =
      Walls(static_cast<int>(std::clamp(path_.largest_depth() / wall_spacing(first, max_edge), 3.0, 32.0)));
}

Incision::Step Incision::find_start() const {
  const double reach = path_.length() / 2;
  if (const auto start = start_on_face(reach)) return *start;
  if (const auto start = start_on_boundary(reach)) return *start;
  const Vec3 c = path_.at(0).position;
  double least = std::numeric_limits<double>::infinity();
  for (const CutMesh::Vertex& v : mesh_.vertices()) least = std::min(least, norm(v.position - c));
  throw InputError("the path never touches the mesh: it begins at (" + shortest(c.x) + ", " + shortest(c.y) +
                   ", " + shortest(c.z) + "), " + shortest(least) +
                   " from the nearest vertex. It must lie within " + shortest(reach) +
                   " of a surface that faces along its directions (nx, ny, nz), in the mesh's own " +
                   "units: divide a path in mm by the mm per unit given as --scale");
}

double Incision::wall_spacing(int start, double max_edge) const {
  if (max_edge > 0) return max_edge;
  double sum = 0;
  const auto fan = mesh_.skin_fan(start);
  for (const int t : fan)
    sum += norm(mesh_.position(mesh_.triangle(t).vertex[(mesh_.triangle(t).corner(start) + 1) % 3]) -
                mesh_.position(start));
  return sum / static_cast<double>(fan.size());
}

void Incision::advance_to(double s) {
  s = std::min(s, path_.length());
  if (s <= tip() || (left_mesh_ && !provisional_)) return;
  if (provisional_) roll_back(*provisional_);
  provisional_.reset();
  const double same = 1e-12 * path_.length();
  while (!left_mesh_ && next_step().s <= s + same) {
    const Step step = next_step();
    take(step);
    next_.reset();
  }
  if (left_mesh_ || s - tip() <= same) return;

  // The blade stands between two vertices of the path: at one of them if it is close, else at one of its own.
  const Step& next = next_step();
  const double close = options_.snap / 2 * std::min(next.s - tip(), longest_step_);
  if (s - tip() <= close) return;
  std::optional<Step> step;
  if (next.s - s <= close)
    step = next;
  else if (const auto inside = inside_fan(tip_vertex(), s))
    step = placed(inside->triangle, inside->place, s);
  else if (next.s < std::numeric_limits<double>::infinity())  // just outside: on the chord, then
    step = on_chord(next, s);
  if (!step) {
    const Vec3& p = mesh_.position(tip_vertex());
    throw InputError("the path leaves the surface near (" + shortest(p.x) + ", " + shortest(p.y) + ", " +
                     shortest(p.z) + "), at arc length " + shortest(tip()) +
                     ": its directions (nx, ny, nz) must point out of the surface there");
  }
  const Before state = before();
  take(*step);
  provisional_ = state;
}

int Incision::moved_vertices() const {
  return static_cast<int>(
      std::count_if(mesh_.vertices().begin(), mesh_.vertices().end(),
                    [](const CutMesh::Vertex& v) { return !(v.original == v.position); }));
}

void Incision::take(const Step& step) {
  const Before state = before();
  mesh_.mark();
  try {
    grow(realise(step), step.s);
  } catch (...) {
    roll_back(state);
    throw;
  }
}

int Incision::realise(const Step& step) {
  if (step.kind == Step::edge) return mesh_.split_edge(step.triangle, step.index, step.place);
  if (step.kind == Step::face) return mesh_.split_face(step.triangle, step.place);
  mesh_.edit_vertex(step.index).position = step.place;
  return step.index;
}

void Incision::grow(int next, double s) {
  CutMesh::Vertex& vertex = mesh_.edit_vertex(next);
  vertex.kind = VertexKind::shared;
  vertex.s = s;
  const bool at_boundary = mesh_.on_boundary(next);
  if (chain_.empty()) {
    open_start_ = at_boundary;
    chain_.push_back({next, next, s});
    return;
  }

  const int tip = tip_vertex();
  const int right = mesh_.triangle_with(tip, next), left = mesh_.triangle_with(next, tip);
  if (right < 0 || left < 0)
    throw InputError("the path runs along the mesh's boundary at arc length " + shortest(s) +
                     "; move it inwards");
  const auto add_column = [this](const ChainVertex& c) { walls_.add_column(mesh_, c.left, down(c.s), c.s); };

  const bool opens = chain_.size() > 1 || open_start_;
  if (opens) {  // the tip's vertex becomes two lips
    ChainVertex& last = chain_.back();
    const bool first_to_open = walls_.columns() == 0 && !open_start_;
    const int start = chain_.front().left;
    const int start_left = first_to_open ? mesh_.triangle_with(tip, start) : -1;
    const int start_right = first_to_open ? mesh_.triangle_with(start, tip) : -1;
    last.right = part(tip, right, first_to_open ? start_right : mesh_.skin_fan(tip).back(), left);
    if (first_to_open) add_column(chain_.front());
    if (walls_.columns() < static_cast<int>(chain_.size())) add_column(last);
    walls_.open_last_column(mesh_, last.right);
    if (first_to_open) walls_.add_segment(mesh_, start_left, start_right);
  }
  chain_.push_back({next, next, s});
  if (!opens && !at_boundary) return;
  if (walls_.columns() == 0) add_column(chain_[chain_.size() - 2]);
  add_column(chain_.back());
  if (at_boundary) {
    chain_.back().right = part(next, mesh_.skin_fan(next).front(), right, left);
    walls_.open_last_column(mesh_, chain_.back().right);
    left_mesh_ = true;
  }
  walls_.add_segment(mesh_, left, right);
}

int Incision::part(int v, int first_right, int last_right, int left) {
  // The triangles from first_right counter-clockwise to last_right get a copy of v.
  const std::vector<int> fan = mesh_.skin_fan(v);
  CutMesh::Vertex copy = mesh_.vertex(v);
  copy.kind = VertexKind::right_lip;
  copy.triangle = first_right;
  const int right = mesh_.add_vertex(copy);
  CutMesh::Vertex& kept = mesh_.edit_vertex(v);
  kept.kind = VertexKind::left_lip;
  kept.triangle = left;
  std::size_t i = static_cast<std::size_t>(std::find(fan.begin(), fan.end(), first_right) - fan.begin());
  for (std::size_t count = 0;; ++i, ++count) {
    CLEFT_CHECK(count, <, fan.size());
    const int t = fan[i % fan.size()];
    CLEFT_CHECK(t, !=, left);
    CutMesh::Triangle& triangle = mesh_.edit(t);
    triangle.vertex[triangle.corner(v)] = right;
    if (t == last_right) return right;
  }
}

Incision::Before Incision::before() const {
  return {chain_.size(), chain_.back(), walls_.mark(), left_mesh_};
}

void Incision::roll_back(const Before& state) {
  mesh_.roll_back();
  chain_.resize(state.chain);
  chain_.back() = state.last;
  walls_.roll_back(state.walls);
  left_mesh_ = state.left_mesh;
}

}  // namespace cleft
