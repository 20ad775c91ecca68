// A session's look at the simulations behind its fields, and what is drawn over a scene.
#include <filesystem>

#include "base/error.h"
#include "explorer/session/session.h"

namespace cleft {

namespace {

const std::vector<std::string> figure_names{"off", "constraints", "lattice", "volume"};

}  // namespace

const std::vector<std::string>& overlay_figures() { return figure_names; }

std::string Session::why_no_raw(int i) const {
  if (!study_) return "no study is open (say: open DIR)";
  if (between_ && i == state_.shown)
    return "what lies between cases was never simulated: there are no raw frames (say: case " +
           std::to_string(i + 1) + ")";
  const std::string file = study_->snapshot(i);
  if (std::filesystem::exists(file)) return "";
  return "the raw frames of case " + std::to_string(i + 1) + " are gone: there is no " + file +
         " (solve the case.toml beside it again, or run the study with keep_snapshots = \"all\")";
}

std::shared_ptr<const RawCase> Session::raw_of(int i) {
  if (const std::string why = why_no_raw(i); !why.empty()) throw InputError(why);
  constexpr std::size_t most_kept = 4;  // views
  if (const auto found = raws_.find(i); found != raws_.end()) return found->second;
  if (raws_.size() >= most_kept) raws_.clear();
  return raws_[i] = std::make_shared<const RawCase>(study_->snapshot(i), study_->field(i));
}

void Session::color_by(Coloring coloring) {
  if (coloring == Coloring::error) {
    if (mesh_) throw InputError("errors are those of the patch that was simulated (say: patch)");
    raw_of(state_.shown);
    scenes_.clear();  // made anew with what they are compared with
  }
  state_.coloring = coloring;
  state_.range.reset();
  changes_.coloring = true;
}

Motion Session::probed_motion() {
  if (!state_.probe) throw InputError("no point is probed (say: probe U,V,W)");
  const auto field = this->field();
  if (!field) throw InputError("no study is open (say: open DIR)");
  const bool raw = why_no_raw(state_.shown).empty();
  return motion_of(*field, state_.probe->uvw, state_.probe->side, raw ? raw_of(state_.shown).get() : nullptr);
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
  const double t = study_ ? std::min(state_.time, field()->duration()) : state_.time;
  if (state_.figure == "volume" && mesh_) {
    if (!study_ || state_.cuts.empty()) throw InputError("there is no cut yet (say: cut ...)");
    const ScalpelPath path = cut_paths().front();
    overlay = volume_along(path, *field(), std::min(state_.time, path.length()));
  } else if (study_ && !mesh_) {
    if (state_.figure == "constraints") overlay = constraints_at(*raw_of(state_.shown), t);
    if (state_.figure == "lattice") overlay = lattice_at(*field(), t);
    if (state_.zoom)
      overlay = nodes_around(*raw_of(state_.shown), state_.zoom->place, state_.zoom->radius, t);
    if (state_.probe) {
      const auto& [uvw, side] = *state_.probe;
      overlay.dots.push_back({uvw + field()->displacement(uvw, side, t), {0.8, 0, 0.5}});
    }
  }
  return overlay;
}

Tornado Session::tornado() {
  const std::vector<std::string>& names = open_study().varying();
  std::vector<std::vector<double>> rows;
  std::vector<double> gapes;
  for (int i = 0; i < study_->size(); ++i) {
    progress("reading the cases", double(i) / study_->size());
    gapes.push_back(figures(i).gape);
    rows.emplace_back();
    for (const std::string& name : names) rows.back().push_back(column_value(i, name));
  }
  return tornado_of(names, rows, gapes);
}

void Session::progress(const std::string& what, double part) const {
  if (services_.progress && !services_.progress(what, part)) throw InputError("cancelled: " + what);
}

}  // namespace cleft
