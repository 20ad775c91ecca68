// What a session shows: views, scenes, fields, and what is written next to them.
#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "explorer/incision/near_ends.h"
#include "explorer/scene/body_scene.h"
#include "explorer/scene/mesh_scene.h"
#include "explorer/scene/patch_scene.h"
#include "explorer/session/session.h"

namespace cleft {

namespace {

std::string shortest_of(double value, int digits) { return formatted("%.*g", digits, value); }

}  // namespace

std::string error_of_interpolation(const Field& field) {
  const Interpolation& made = *field.interpolation;
  return "estimated error " + shortest_of(100 * made.estimated_error, 2) + " %" +
         (made.outside > 0 ? ", a guess outside the cases" : "");
}

std::string error_of_openings(const std::vector<Validity>& cuts) {
  const auto largest = std::max_element(cuts.begin(), cuts.end(), [](const Validity& a, const Validity& b) {
    return a.expected_error.largest < b.expected_error.largest;
  });
  return "expected error of the opening " + shortest_of(100 * largest->expected_error.largest, 2) + " %" +
         (cuts.size() > 1 ? ", of cut " + std::to_string(largest - cuts.begin() + 1) : "");
}

std::vector<int> Session::views() const {
  return state().compared.empty() ? std::vector<int>{state().shown} : state().compared;
}

std::shared_ptr<const FieldOnMesh> Session::own_mesh(int i) {
  if (!study() || between() || study()->file(i).empty()) return nullptr;
  auto& known = opened_.drawn.own_meshes;
  const auto found = known.find(i);
  return (found != known.end() ? found : known.emplace(i, field_on_own_mesh(study()->file(i))).first)->second;
}

std::vector<std::string> Session::quantities() {
  std::vector<std::string> names;
  if (const auto own = mesh() ? nullptr : own_mesh(state().shown)) {
    for (const SnapshotArray& quantity : own->quantities()) names.push_back(quantity.name);
  } else if (const auto shown = field()) {
    for (const Quantity& quantity : shown->quantities) names.push_back(quantity.name);
  }
  return names;
}

Coloring Session::coloring_with_unit() {
  Coloring coloring = state().coloring;
  if (coloring.kind != Coloring::quantity) return coloring;
  const std::shared_ptr<const Field> shown = field();
  if (shown && shown->source) coloring.unit = unit_of(*shown->source, coloring.name);
  return coloring;
}

std::shared_ptr<const Field> Session::field() { return study() ? field_of(state().shown) : nullptr; }

std::shared_ptr<const Field> Session::field_of(int i) {
  return between() && i == state().shown ? between() : open_study().field(i);
}

std::shared_ptr<const Field> Session::reference() {
  return study() && state().reference >= 0 ? study()->field(state().reference) : nullptr;
}

std::shared_ptr<const WoundScene> Session::scene_of(int i) {
  if (!has_scene()) throw InputError("nothing is open (say: open DIR, or mesh FILE)");
  auto& scenes = opened_.drawn.scenes;
  const std::vector<int> shown = views();
  std::erase_if(scenes,
                [&](const auto& s) { return std::find(shown.begin(), shown.end(), s.first) == shown.end(); });
  auto& found = scenes[i];
  if (found) return found;
  if (mesh())
    found = std::make_shared<MeshScene>(cut_surface(depth_of_case(i)), cut_fields(i),
                                        i == state().shown ? opened_.simulated.wounds : nullptr);
  else if (const auto own = own_mesh(i))
    found = std::make_shared<BodyScene>(own);
  else if (study()->has_several_breaks(i))
    throw InputError(study()->file(i) + ": has several breaks, and is shown on its mesh; put its snapshot " +
                     "beside it, with the same name and the ending .h5");
  else
    found = std::make_shared<PatchScene>(
        field_of(i), state().coloring == Coloring::error && why_no_raw(i).empty() ? raw_of(i) : nullptr);
  return found;
}

std::shared_ptr<const WoundScene> Session::scene_as_simulated(int i) const {
  const PublishedStudy& study = open_study();
  if (const auto own = field_on_own_mesh(study.file(i))) return std::make_shared<BodyScene>(own);
  if (study.has_several_breaks(i)) throw InputError(study.file(i) + ": has several breaks, and no snapshot");
  return std::make_shared<PatchScene>(std::make_shared<const Field>(study.read(i)));
}

bool Session::is_imported() {
  const std::shared_ptr<const Field> shown = field();
  return shown && shown->source;
}

std::string Session::progress_text(double time, double duration) {
  if (!is_imported()) return formatted("%.1f of %.1f mm cut", time, duration);
  const std::vector<double>& times = field()->source->times;
  const double start = times.empty() ? 0 : times.front();
  return formatted("time %.4g of %.4g", start + time, start + duration);
}

double Session::duration() {
  double longest = 0;
  for (const int i : views()) longest = std::max(longest, scene_of(i)->duration());
  return longest;
}

double Session::depth_of_case(int i) {
  constexpr double depth_without_study = 3;
  return study() ? field_of(i)->cut().depth : depth_without_study;
}

double Session::cut_length_of_fields() {
  static const double usual = Parameters{}.cut.length;
  return study() ? field_of(state().shown)->cut().length : usual;
}

std::vector<ScalpelPath> Session::cut_paths(double depth) const {
  std::vector<ScalpelPath> paths;
  for (CutState cut : state().cuts) {
    for (ScalpelPath::Point& p : cut.points)
      if (p.depth <= 0) p.depth = depth;
    paths.emplace_back(cut.points);
  }
  return with_near_ends_joined(std::move(paths), narrowest_bridge).paths;
}

std::shared_ptr<const CutSurface> Session::cut_surface(double depth) {
  auto& surfaces = opened_.drawn.cut_surfaces;
  auto& found = surfaces[depth];
  if (found) return found;
  constexpr std::size_t most_kept = 8;  // a slider of the depth makes ever new ones
  if (surfaces.size() > most_kept)
    std::erase_if(surfaces, [depth](const auto& s) { return s.first != depth; });
  return surfaces[depth] = std::make_shared<CutSurface>(*mesh(), cut_paths(depth));
}

std::optional<CutFields> Session::cut_fields(int i) {
  if (!study()) return std::nullopt;
  if (study()->has_several_breaks(i))
    throw InputError(study()->file(i) +
                     ": has several breaks, and cuts of meshes open by one; import one of them (cleft import "
                     "--break)");
  const auto fields = [&]() -> CutFields {
    if (const auto family = opened_.cases->family()) return {family, state().tension};
    if (const auto turning = turning_fields(i)) return *turning;
    if (!state().tension) return CutFields(field_of(i));
    auto three = opened_.cases->prestress_fields(i);
    if (!three) three = std::make_shared<const PrestressFields>(*study(), i);  // tells why there are none
    return {three, state().tension};
  }();
  return opened_.bone ? fields.above_bone(distance_to(opened_.bone)) : fields;
}

std::function<double(const Vec3&)> Session::distance_to_bone() const {
  return opened_.bone ? least_distance_to(opened_.bone) : std::function<double(const Vec3&)>();
}

/// Where the study has three cases that differ in their prestress alone, the tension of the shown case, as it
/// is along and across the first cut, turns against every cut, even if no tension has been said.
std::optional<CutFields> Session::turning_fields(int i) {
  if (state().tension || state().cuts.empty() || (between() && i == state().shown)) return std::nullopt;
  const auto three = opened_.cases->prestress_fields(i);
  if (!three) return std::nullopt;
  const Prestress sigma = prestress_of(study()->parameters(i));
  if (sigma.uv != 0) return std::nullopt;  // the fields of the case know no other direction
  const ScalpelPath path = cut_paths(depth_of_case(i)).front();
  const Vec3 chord = path.at(path.length()).position - path.at(0).position;
  if (norm(chord) < 0.5 * path.length()) return std::nullopt;  // it has no direction
  return CutFields(three, SkinTension{chord, sigma.uu, sigma.vv});
}

std::string Session::title_of(int i) const {
  if (!study()) return "";
  if (mesh() && opened_.cases->family())
    return "family of " + std::to_string(study()->size()) + " cases: each place opens by its own shape";
  const bool interpolated = between() && i == state().shown;
  std::string title = !interpolated                           ? "case " + std::to_string(i + 1) + ":"
                      : between()->interpolation->outside > 0 ? "outside the cases:"
                                                              : "between cases:";
  const std::vector<std::string>& varying = study()->varying();
  if (!interpolated && varying.empty()) return title + " " + study()->name(i);
  for (const std::string& name : varying) {
    const auto requested = state().parameters.find(name);
    if (interpolated && requested != state().parameters.end())
      title += " " + name + "=" + shortest_of(requested->second, 4);
    else if (const auto value = study()->parameters(i).number(name); value && !interpolated)
      title += " " + name + "=" + shortest_of(*value, 4);
  }
  return title;
}

std::string Session::note_of(int i) const {
  std::string note;
  const auto add = [&](const std::string& text) { note += (note.empty() ? "" : "; ") + text; };
  if (between() && i == state().shown && !(mesh() && opened_.cases->family()))
    note = "interpolated, " + error_of_interpolation(*between());
  if (i == state().shown && !why_nearest().empty()) note = "the nearest case: " + why_nearest();
  if (i == state().shown && !simulation_note().empty()) add(simulation_note());
  if (i == state().shown && !validity().empty()) add(error_of_openings(validity()));
  if (state().warp != 1) add("displacements drawn " + shortest_of(state().warp, 3) + " times as large");
  const auto own = opened_.drawn.own_meshes.find(i);
  const bool is_own = own != opened_.drawn.own_meshes.end() && own->second;
  if (state().coloring == Coloring::error && !mesh() && !is_own && !why_no_raw(i).empty())
    add("without raw frames: no error is known");
  return note;
}

bool Session::is_outside() const {
  if (between()) return between()->interpolation->outside > 0;
  if (!study() || shows_exactly()) return false;
  const auto ranges = cases().parameter_ranges();
  return std::any_of(state().parameters.begin(), state().parameters.end(), [&](const auto& requested) {
    const auto range = ranges.find(requested.first);
    return range != ranges.end() &&
           (requested.second < range->second.first || requested.second > range->second.second);
  });
}

bool Session::is_guess(int i) const {
  if (i != state().shown) return false;
  const auto beyond = [](const Validity& v) { return v.expected_error.largest > greatest_known_error; };
  if (is_outside()) return true;
  const bool as_it_looks = is_look(state().coloring);  // colours of values are read as pages show them
  return as_it_looks && std::any_of(validity().begin(), validity().end(), beyond);
}

bool Session::shows_exactly() const {
  if (!study()) return true;
  const auto& values = study()->parameters(state().shown);
  return std::all_of(state().parameters.begin(), state().parameters.end(), [&](const auto& requested) {
    return values.number(requested.first).value_or(requested.second) == requested.second;
  });
}

bool Session::knows_brushed(int i) const {
  return std::all_of(state().brushes.begin(), state().brushes.end(), [&](const auto& brush) {
    return knows_figures(i) || opened_.cases->study().parameters(i).number(brush.first);
  });
}

bool Session::brushed(int i) {
  if (!state().where.empty() && !finding(i)) return false;
  return std::all_of(state().brushes.begin(), state().brushes.end(), [&](const auto& brush) {
    const double value = column_value(i, brush.first);
    return value >= brush.second.first && value <= brush.second.second;
  });
}

}  // namespace cleft
