#include "explorer/incision/incision.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/refine.h"
#include "explorer/incision/triangle_quality.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

}  // namespace

Incision::Incision(const SurfaceMesh& surface, ScalpelPath path, const IncisionOptions& options)
    : Incision(std::make_unique<CutMesh>(surface), nullptr, std::move(path), options) {}

Incision::Incision(CutMesh& mesh, ScalpelPath path, const IncisionOptions& options)
    : Incision(nullptr, &mesh, std::move(path), options) {}

Incision::Incision(std::unique_ptr<CutMesh> own, CutMesh* mesh, ScalpelPath path,
                   const IncisionOptions& options)
    : own_(std::move(own)),
      mesh_(own_ ? *own_ : *mesh),
      path_(std::move(path)),
      options_(options),
      before_cut_(mesh_.checkpoint()),
      cut_(mesh_.begin_cut()),
      chord_tolerance_(options.chord_tolerance.value_or(path_.length() / Limits::chord_parts)),
      longest_step_(
          path_.length() /
          Limits::longest_piece_parts),  // even a cut inside one triangle has vertices that can open
      max_edge_(options.max_edge.value_or(path_.length() / Limits::edge_parts)),
      original_triangles_(static_cast<int>(mesh_.triangles().size())),
      worst_before_(smallest_radius_ratio(mesh_)),
      asked_(Limits::asked_part * std::min(Limits::fair_ratio, smallest_given_radius_ratio(mesh_))) {
  if (!(path_.smallest_depth() > 0))
    throw InputError("the cut has no depth: give the path a column 'depth', or a depth for all of it");
  mesh_.forget_changes();
  try {
    Step start = find_start();
    if (max_edge_ > 0) {
      const double height = dot(start.place - path_.at(start.s).position, path_.at(start.s).outward);
      if (options_.refined < path_.length())
        refine_along(mesh_, path_, 0, options_.refined, triangles_at(start), height, max_edge_,
                     Limits::growing_band_edges * max_edge_);
      else
        refine_along(mesh_, path_, height, max_edge_, path_.length() / Limits::band_parts);
      start = find_start();
    }
    for (int k = 0; k < Limits::start_bisections && start.inside &&
                    longest_edge_length(mesh_, start.triangle) > Limits::room_for_piece * longest_step_ &&
                    bisect(mesh_, start.triangle);
         ++k)
      start = find_start();
    if (options_.reach > 0) surroundings_ = Surroundings(mesh_, path_, triangles_at(start), options_.reach);
    const int first = realise(start);
    grow(first, start.s);
    mend(before_cut_);
    rows_ = static_cast<int>(std::clamp(path_.largest_depth() / wall_spacing(first, max_edge_),
                                        Limits::fewest_rows, Limits::most_rows));
    rehearse();
  } catch (...) {
    mesh_.roll_back(before_cut_);
    throw;
  }
}

/// Cuts the first segment and takes it back. What was looked through for the start has driven all else out of
/// the caches: so the blade finds there what its first steps read and write, instead of waiting for it.
void Incision::rehearse() {
  constexpr int most_steps = 6;            // of them some make room only
  constexpr std::size_t segment_open = 3;  // vertices of the chain: start, one that opens, tip
  const Before untouched = before();
  const bool bent = bent_;
  try {
    for (int k = 0; k < most_steps && chain_.size() < segment_open && !state_.left_mesh &&
                    next_step().s <= path_.length();
         ++k)
      step_on();
  } catch (const InputError&) {  // for the blade to meet, if it gets there
  }
  roll_back(untouched);
  next_.reset();
  bent_ = bent;
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
  CLEFT_CHECK(undone_.has_value(), ==, false);
  mesh_.forget_changes();
  cut_on_to(s);
}

void Incision::lead_on(const ScalpelPath::Point& next, double ahead) {
  CLEFT_CHECK(undone_.has_value(), ==, false);
  mesh_.forget_changes();
  const double from = led_;
  led_ = path_.lead_on(from, next, path_.length() - from);
  if (provisional_) roll_back(*provisional_);  // what comes now would be taken back with it
  provisional_.reset();
  next_.reset();
  const std::vector<int> seeds = mesh_.skin_fan(tip_vertex());
  const PathFrame here = path_.at(tip());
  const double height = dot(mesh_.position(tip_vertex()) - here.position, here.outward);
  if (max_edge_ > 0)
    refine_along(mesh_, path_, tip(), led_ + Limits::growing_ahead_edges * max_edge_, seeds, height,
                 max_edge_, Limits::growing_band_edges * max_edge_);
  if (options_.reach > 0) surroundings_.lead_on(mesh_, path_, tip(), ahead, triangle_ahead());
  cut_on_to(led_);
}

void Incision::cut_on_to(double s) {
  s = std::min(s, path_.length());
  if (s < tip() || (!provisional_ && (s == tip() || state_.left_mesh))) return;
  if (provisional_) roll_back(*provisional_);
  provisional_.reset();
  const double same = Limits::same_s * path_.length();
  while (!state_.left_mesh && s - tip() > same && next_step().s <= s + same) {
    const Before state = before();
    try {
      step_on();
    } catch (...) {
      roll_back(state);
      throw;
    }
    check_progress();
  }
  if (state_.left_mesh || s - tip() <= same) return;

  // The blade stands between two vertices of the path: at one of them if it is close, else at one of its own.
  const Step& next = next_step();
  const double close = options_.snap / Limits::path_snap_parts * std::min(next.s - tip(), longest_step_);
  if (s - tip() <= close) return;
  const Step step = next.s - s <= close ? next : shorter(next, s);
  const Before state = before();
  try {
    take(step);
  } catch (...) {
    roll_back(state);
    throw;
  }
  provisional_ = state;
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

int Incision::moved_vertices() const {
  return static_cast<int>(
      std::count_if(mesh_.vertices().begin(), mesh_.vertices().end(),
                    [](const CutMesh::Vertex& v) { return !(v.original == v.position); }));
}

void Incision::step_on() {
  const Step step = next_step();
  next_.reset();
  if (!made_room(step)) take(step);
}

void Incision::check_progress() const {
  constexpr std::size_t steps = Limits::stuck_vertices;
  if (chain_.size() < steps ||
      tip() - chain_[chain_.size() - steps].s > Limits::stuck_progress * path_.length())
    return;
  throw InputError("the path runs along a wound near " + place_of(mesh_.position(tip_vertex())) +
                   ", at arc length " + shortest(tip()) + "; lead it across, or away from it");
}

Incision::Before Incision::before() const {
  constexpr std::size_t most =
      3;  // a step changes no earlier ones: the tip, and both ends of a pending piece
  const std::size_t tail = std::min(chain_.size(), most);
  return {mesh_.checkpoint(),
          chain_.size(),
          {chain_.end() - static_cast<std::ptrdiff_t>(tail), chain_.end()},
          state_};
}

void Incision::roll_back(const Before& to) {
  mesh_.roll_back(to.mesh);
  chain_.resize(to.chain - to.last.size());
  chain_.insert(chain_.end(), to.last.begin(), to.last.end());
  state_ = to.state;
}

}  // namespace cleft
