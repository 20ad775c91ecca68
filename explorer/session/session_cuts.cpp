// The mesh, the cuts in it and the tension of its skin: what they are, undone and redone.
#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "explorer/session/session.h"

namespace cleft {

double Session::depth_of_case(int i) {
  constexpr double depth_without_study = 3;
  return study_ ? field_of(i)->cut().depth : depth_without_study;
}

std::vector<ScalpelPath> Session::cut_paths(double depth) const {
  std::vector<ScalpelPath> paths;
  for (CutState cut : state_.cuts) {
    for (ScalpelPath::Point& p : cut.points)
      if (p.depth <= 0) p.depth = depth;
    paths.emplace_back(cut.points);
  }
  return paths;
}

std::shared_ptr<const CutSurface> Session::cut_surface(double depth) {
  auto& found = cut_surfaces_[depth];
  if (found) return found;
  constexpr std::size_t most_kept = 8;  // a slider of the depth makes ever new ones
  if (cut_surfaces_.size() > most_kept)
    std::erase_if(cut_surfaces_, [depth](const auto& s) { return s.first != depth; });
  return cut_surfaces_[depth] = std::make_shared<CutSurface>(*mesh_, cut_paths(depth));
}

std::optional<CutFields> Session::cut_fields(int i) {
  if (!study_) return std::nullopt;
  if (!state_.tension) return CutFields(field_of(i));
  return CutFields(std::make_shared<const PrestressFields>(*study_, i), state_.tension);
}

void Session::read_mesh_in_mm() {
  SurfaceMesh mesh = services_.read_mesh(state_.mesh);
  for (Vec3& x : mesh.points) x *= state_.scale;
  mesh_ = std::make_shared<const SurfaceMesh>(std::move(mesh));
}

void Session::load_mesh(const std::string& file, double scale) {
  state_.mesh = absolute_path(file);
  state_.scale = scale;
  forget_cuts();
  read_mesh_in_mm();
  state_.coloring = Coloring::tissue;
  state_.zoom.reset(), state_.figure.clear();
  state_.camera = {};
  cuts_changed();
  changes_.all();
}

void Session::show_patch() {
  open_study();
  state_.mesh.clear();
  forget_cuts();
  mesh_.reset();
  follow_parameters();  // no tension keeps it from what lies between cases
  state_.coloring = Coloring::displacement;
  state_.figure.clear();
  state_.camera = {};
  cuts_changed();
  changes_.all();
}

void Session::forget_cuts() {
  state_.cuts.clear(), state_.undone.clear();
  state_.tension.reset(), state_.tensions.clear(), state_.tensions_undone.clear();
}

void Session::cuts_changed() {
  cut_surfaces_.clear(), scenes_.clear();
  state_.time = duration();  // makes the cuts, and throws where they cannot be made
  changes_.cuts = changes_.time = true;
}

void Session::cut(const CutState& cut) {
  if (!mesh_) throw InputError("there is no mesh to cut (say: mesh FILE)");
  const bool first = state_.cuts.empty();
  state_.cuts.push_back(cut);
  state_.undone.clear(), state_.tensions_undone.clear();
  cuts_changed();
  if (first && !state_.camera.pose) changes_.camera = true;  // angles count from the first cut
}

void Session::recut(const CutState& cut) {
  if (state_.cuts.empty()) throw InputError("there is no cut yet (say: cut ...)");
  state_.cuts.back() = cut;
  cuts_changed();
}

void Session::pull(const std::optional<SkinTension>& tension) {
  if (tension) open_study();
  if (tension && !mesh_) throw InputError("there is no skin to pull (say: mesh FILE)");
  state_.tensions.push_back({state_.cuts.size(), state_.tension});
  state_.undone.clear(), state_.tensions_undone.clear();
  state_.tension = tension;
  tension_changed();
}

void Session::tension_changed() {
  follow_parameters();
  scenes_.clear();
  set_time(state_.time);  // makes the scenes, and throws where they cannot be made
  changes_.cuts = true;
}

/// The last change, taken from one list and put on the other, whose kind tells the number of cuts it was made
/// at.
bool Session::swap_tension(std::vector<TensionChange>& from, std::vector<TensionChange>& to) {
  if (from.empty() || from.back().cuts != state_.cuts.size()) return false;
  to.push_back({from.back().cuts, state_.tension});
  state_.tension = from.back().tension;
  from.pop_back();
  tension_changed();
  return true;
}

void Session::undo() {
  if (swap_tension(state_.tensions, state_.tensions_undone)) return;
  if (state_.cuts.empty()) throw InputError("there is no cut and no tension to undo");
  state_.undone.push_back(state_.cuts.back());
  state_.cuts.pop_back();
  cuts_changed();
}

void Session::redo() {
  if (swap_tension(state_.tensions_undone, state_.tensions)) return;
  if (state_.undone.empty()) throw InputError("there is no undone cut or tension to make again");
  state_.cuts.push_back(state_.undone.back());
  state_.undone.pop_back();
  cuts_changed();
}

}  // namespace cleft
