// A session's look at the simulations behind its fields, and what is drawn over a scene.
#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "explorer/session/session.h"

namespace cleft {

namespace {

const std::vector<std::string> figure_names{"off", "constraints", "lattice", "volume"};

}  // namespace

const std::vector<std::string>& overlay_figures() { return figure_names; }

std::string Session::why_no_raw(int i) const {
  if (!study()) return "no study is open (say: open DIR)";
  if (between() && i == state().shown)
    return "what lies between cases was never simulated: there are no raw frames (say: case " +
           std::to_string(i + 1) + ")";
  const std::string file = study()->snapshot(i);
  if (std::filesystem::exists(file)) return "";
  return "the raw frames of case " + std::to_string(i + 1) + " are gone: there is no " + file +
         " (solve the case.toml beside it again, or run the study with keep_snapshots = \"all\")";
}

std::shared_ptr<const RawCase> Session::raw_of(int i) {
  if (const std::string why = why_no_raw(i); !why.empty()) throw InputError(why);
  return cases().raw(i);
}

Vec3 Session::probed_place() {
  const auto& [uvw, side] = state().probe.value();
  if (!why_no_raw(state().shown).empty()) return uvw;
  const auto raw = raw_of(state().shown);
  const int node = raw->nearest_node(uvw, side);
  return node < 0 ? uvw : raw->snapshot().points[static_cast<std::size_t>(node)];
}

Motion Session::probed_motion() {
  if (!state().probe) throw InputError("no point is probed (say: probe U,V,W)");
  const auto field = this->field();
  if (!field) throw InputError("no study is open (say: open DIR)");
  const bool raw = why_no_raw(state().shown).empty();
  return motion_of(*field, state().probe->uvw, state().probe->side,
                   raw ? raw_of(state().shown).get() : nullptr);
}

Overlay Session::overlay() {
  try {
    return make_overlay();
  } catch (const InputError& e) {  // said in the picture: another case may have what this one lacks
    Overlay none;
    none.caption = e.what();
    return none;
  }
}

Overlay Session::make_overlay() {
  Overlay overlay;
  const SessionState& s = state();
  const double t = study() ? std::min(s.time, field()->duration()) : s.time;
  if (s.figure == "volume" && mesh()) {
    if (!study() || s.cuts.empty()) throw InputError("there is no cut yet (say: cut ...)");
    const ScalpelPath path = cut_paths().front();
    overlay = volume_along(path, *field(), std::min(s.time, path.length()));
  } else if (study() && !mesh()) {
    if (s.figure == "constraints") overlay = constraints_at(*raw_of(s.shown), t);
    if (s.figure == "lattice") overlay = lattice_at(*field(), t);
    if (s.zoom) overlay = nodes_around(*raw_of(s.shown), s.zoom->place, s.zoom->radius, t);
    if (s.probe) {
      const Vec3 place = probed_place();
      overlay.dots.push_back({place + field()->displacement(place, s.probe->side, t), {0.8, 0, 0.5}});
    }
  }
  if (mesh() && s.tension && s.tension->lines)
    for (const auto& [place, way] : *s.tension->lines) {
      constexpr double least = 2;  // mm, to be seen
      const Vec3 half = std::max(norm(way), least) / 2 * normalized(way);
      overlay.lines.push_back({{place - half, place + half}, {0.0, 0.45, 0.7}});
      overlay.in_front = true;
    }
  if (!s.ruler.empty() && has_scene()) lay_ruler_over(overlay);
  lay_handles_over(overlay);
  return overlay;
}

const SkinRuler& Session::ruler() {
  const auto scene = this->scene();
  std::shared_ptr<const SkinRuler>& ruler = opened_.drawn.ruler;
  const std::vector<Vec3>& places = state().ruler;
  if (!ruler || ruler->scene() != scene || ruler->places() != places)
    ruler = std::make_shared<const SkinRuler>(scene, places);
  return *ruler;
}

void Session::lay_ruler_over(Overlay& overlay) {
  constexpr Ink ink{0.8, 0, 0.5};
  const SkinRuler& ruler = this->ruler();
  const Measures now = ruler.at(std::min(state().time, ruler.scene()->duration())), rest = ruler.at_rest();
  for (const Vec3& place : now.places) overlay.dots.push_back({place, ink});
  if (now.places.size() > 1) overlay.lines.push_back({now.places, ink});
  overlay.in_front = true;
  overlay.caption += (overlay.caption.empty() ? "" : "\n") + told(now, rest);
}

const Skin& Session::skin() {
  if (!mesh()) throw InputError("there is no skin with cuts (say: mesh FILE)");
  if (!opened_.skin) opened_.skin = std::make_shared<const Skin>(*mesh());
  return *opened_.skin;
}

std::optional<CutHandles> Session::handles() {
  if (!mesh() || state().handled < 0) return std::nullopt;
  const CutState& cut = preview_ ? *preview_ : state().cuts.at(static_cast<std::size_t>(state().handled));
  return handles_of(cut, depth_of_case(state().shown), skin());
}

void Session::lay_handles_over(Overlay& overlay) {
  const auto handles = this->handles();
  if (!handles) return;
  constexpr Ink of_path{0.84, 0.37, 0}, of_depth{0, 0.45, 0.7}, of_tilt{0, 0.62, 0.45}, old{0.5, 0.5, 0.5};
  if (preview_) {
    const CutState& cut = state().cuts.at(static_cast<std::size_t>(state().handled));
    overlay.lines.push_back({handles_of(cut, depth_of_case(state().shown), skin()).line, old});
  }
  overlay.lines.push_back({handles->line, of_path});
  overlay.lines.push_back({handles->edge, of_depth});
  overlay.lines.push_back({{handles->depth.foot, handles->depth_handle()}, of_depth});
  overlay.lines.push_back({{handles->tilt.foot, handles->tilt_handle()}, of_tilt});
  for (const Vec3& place : handles->places) overlay.handles.push_back({place, of_path});
  overlay.handles.push_back({handles->depth_handle(), of_depth});
  overlay.handles.push_back({handles->tilt_handle(), of_tilt});
  overlay.in_front = true;
}

Tornado Session::tornado() {
  KnownCases& cases = this->cases();
  const PublishedStudy& study = cases.study();
  std::vector<std::vector<double>> rows;
  std::vector<double> gapes;
  for (int i = 0; i < study.size(); ++i) {
    progress("reading the cases", double(i) / study.size());
    gapes.push_back(cases.figures(i).gape);
    rows.emplace_back();
    for (const std::string& name : study.varying()) rows.back().push_back(cases.column_value(i, name));
  }
  return tornado_of(study.varying(), rows, gapes);
}

}  // namespace cleft
