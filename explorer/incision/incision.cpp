#include "explorer/incision/incision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/incision_advance.h"
#include "explorer/incision/incision_change.h"
#include "explorer/incision/incision_start.h"
#include "explorer/incision/incision_walk.h"
#include "explorer/incision/refine.h"
#include "explorer/incision/triangle_quality.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

/// The height of a row of triangles in the walls: as the triangles near the path.
double wall_spacing(const CutMesh& mesh, int start, double max_edge) {
  if (max_edge > 0) return max_edge;
  double sum = 0;
  const auto fan = mesh.skin_fan(start);
  for (const auto t : fan)
    sum += norm(mesh.position(mesh.triangle(t).vertex[(mesh.triangle(t).corner(start) + 1) % 3]) -
                mesh.position(start));
  return sum / static_cast<double>(fan.size());
}

/// Throws InputError where the walls could not be computed.
void check_depth(const ScalpelPath& path) {
  const double least = path.smallest_depth(), most = path.largest_depth();
  if (!(least > 0))
    throw InputError("the cut has no depth: give the path a column 'depth', or a depth for all of it");
  if (!(most <= Limits::largest_coordinate))
    throw InputError("the cut's depth is " + shortest(most) + " in the mesh's units; it may be " +
                     shortest(Limits::largest_coordinate) + " at most");
  const Vec3 from = path.at(0).position, to = path.at(path.length()).position;
  const double rounding = std::numeric_limits<double>::epsilon() * std::max(norm(from), norm(to));
  if (!(least >= Limits::depth_over_rounding * rounding))
    throw InputError("the cut's depth is " + shortest(least) + " in the mesh's units; where the path is, " +
                     "coordinates are rounded to " + shortest(rounding) + ": cut " +
                     shortest(Limits::depth_over_rounding * rounding) + " deep or deeper");
}

}  // namespace

IncisionState::IncisionState(CutMesh& m, ScalpelPath p, int n, const IncisionOptions& options)
    : mesh(m),
      path(std::move(p)),
      number(n),
      snap(options.snap),
      chord_tolerance(options.chord_tolerance.value_or(path.length() / Limits::chord_parts)),
      longest_piece(path.length() / Limits::longest_piece_parts),
      worst_before(smallest_radius_ratio(mesh)),
      least_ratio(Limits::least_ratio_part *
                  std::min(Limits::fair_ratio, smallest_given_radius_ratio(mesh))) {}

IncisionState::Before IncisionState::before() const {
  constexpr std::size_t most =
      3;  // a step changes no earlier ones: the tip, and both ends of a pending segment
  const std::size_t tail = std::min(chain.size(), most);
  return {
      mesh.checkpoint(), chain.size(), {chain.end() - static_cast<std::ptrdiff_t>(tail), chain.end()}, tip};
}

void IncisionState::roll_back(const Before& to) {
  mesh.roll_back(to.mesh);
  chain.resize(to.chain - to.last.size());
  chain.insert(chain.end(), to.last.begin(), to.last.end());
  tip = to.tip;
}

void IncisionState::drop_provisional() {
  if (provisional) roll_back(*provisional);
  provisional.reset();
}

Incision::Incision(const SurfaceMesh& surface, ScalpelPath path, const IncisionOptions& options)
    : Incision(std::make_unique<CutMesh>(surface), nullptr, std::move(path), options) {}

Incision::Incision(CutMesh& mesh, ScalpelPath path, const IncisionOptions& options)
    : Incision(nullptr, &mesh, std::move(path), options) {}

Incision::Incision(std::unique_ptr<CutMesh> own, CutMesh* mesh, ScalpelPath path,
                   const IncisionOptions& options)
    : own_(std::move(own)),
      mesh_(own_ ? *own_ : *mesh),
      before_cut_(mesh_.checkpoint()),
      cut_(mesh_.begin_cut()),
      state_(std::make_unique<IncisionState>(mesh_, std::move(path), cut_, options)),
      path_(state_->path),
      max_edge_(options.max_edge.value_or(path_.length() / Limits::edge_parts)),
      reach_(options.reach),
      original_triangles_(static_cast<int>(mesh_.triangles().size())) {
  check_depth(path_);
  mesh_.forget_changes();
  try {
    begin(options);
  } catch (...) {
    mesh_.roll_back(before_cut_);
    throw;
  }
}

Incision::Incision(Incision&&) noexcept = default;
Incision::~Incision() = default;

void Incision::begin(const IncisionOptions& options) {
  IncisionState& cut = *state_;
  PathStep start = find_start(cut);
  if (max_edge_ > 0) {
    const double height = dot(start.place - path_.at(start.s).position, path_.at(start.s).outward);
    const bool growing = options.refined < path_.length();
    const Refinement how{
        height, max_edge_,
        growing ? Limits::growing_band_edges * max_edge_ : path_.length() / Limits::band_parts,
        !options.max_edge};
    if (growing)
      refine_along(mesh_, path_, 0, options.refined, triangles_at(cut, start), how);
    else
      refine_along(mesh_, path_, how);
    start = find_start(cut);
  }
  for (int k = 0; k < Limits::start_bisections && start.inside &&
                  longest_edge_length(mesh_, start.triangle) > Limits::room_for_piece * cut.longest_piece &&
                  bisect(mesh_, start.triangle);
       ++k)
    start = find_start(cut);
  if (reach_ > 0) surroundings_ = Surroundings(mesh_, path_, triangles_at(cut, start), reach_);
  const int first = realise(cut, start);
  grow(cut, first, start.s);
  mend(cut, before_cut_);
  cut.rows = static_cast<int>(std::clamp(path_.largest_depth() / wall_spacing(mesh_, first, max_edge_),
                                         Limits::fewest_rows, Limits::most_rows));
  rehearse(cut);
}

void Incision::advance_to(double s) {
  CLEFT_CHECK(undone_.has_value(), ==, false);
  mesh_.forget_changes();
  cut_on_to(*state_, s);
}

void Incision::extend(const ScalpelPath::Point& next, double ahead) {
  CLEFT_CHECK(undone_.has_value(), ==, false);
  mesh_.forget_changes();
  const double from = extended_to_;
  extended_to_ = path_.extend(from, next, path_.length() - from);
  state_->drop_provisional();  // what comes now would be taken back with it
  state_->next.reset();
  const int v = state_->tip_vertex();
  const std::vector<int> seeds = mesh_.skin_fan(v);
  const PathFrame here = path_.at(tip());
  const double height = dot(mesh_.position(v) - here.position, here.outward);
  if (max_edge_ > 0)
    refine_along(mesh_, path_, tip(), extended_to_ + Limits::growing_ahead_edges * max_edge_, seeds,
                 {height, max_edge_, Limits::growing_band_edges * max_edge_, true});
  if (reach_ > 0) surroundings_.extend(mesh_, path_, tip(), ahead, triangle_ahead(*state_), cut_);
  cut_on_to(*state_, extended_to_);
}

void Incision::end_path() {
  if (!(extended_to_ > 0)) return;
  mesh_.forget_changes();
  path_ = path_.until(left_mesh() ? extended_to_ : tip());
  extended_to_ = 0;
  state_->drop_provisional();  // what lay ahead of it was another path
  state_->next.reset();
  cut_on_to(*state_, path_.length());
}

void Incision::search_again() {
  if (reach_ > 0) surroundings_.search_again(mesh_, path_, tip(), triangle_ahead(*state_), cut_);
}

void Incision::undo() {
  CLEFT_CHECK(undone_.has_value(), ==, false);
  mesh_.forget_changes();
  undone_ = mesh_.undo(before_cut_);
}

void Incision::redo() {
  CLEFT_CHECK(undone_.has_value(), ==, true);
  mesh_.forget_changes();
  mesh_.redo(*undone_);
  undone_.reset();
}

double Incision::tip() const { return state_->tip_s(); }
bool Incision::is_short_of_end() const {
  return !left_mesh() && path_.length() - tip() >= Limits::shortest_rest * path_.length();
}
double Incision::start() const { return state_->chain.front().s; }
bool Incision::left_mesh() const { return state_->tip.left_mesh; }
bool Incision::bent() const { return state_->bent; }
const std::vector<Incision::ChainVertex>& Incision::chain() const { return state_->chain; }
double Incision::chord_error() const { return cleft::chord_error(*state_); }

int Incision::moved_vertices() const {
  return static_cast<int>(
      std::count_if(mesh_.vertices().begin(), mesh_.vertices().end(),
                    [](const CutMesh::Vertex& v) { return !(v.original == v.position); }));
}

}  // namespace cleft
