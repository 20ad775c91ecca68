#include "explorer/session/session_state.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* format = "cleft-session";
constexpr int version = 1;

Json to_json(const Vec3& x) { return {x.x, x.y, x.z}; }
Vec3 to_vec3(const Json& j) { return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()}; }

Json to_json(const std::vector<CutState>& cuts) {
  Json list = Json::array();
  for (const CutState& cut : cuts) {
    Json points = Json::array();
    for (const ScalpelPath::Point& p : cut.points)
      points.push_back(
          {p.position.x, p.position.y, p.position.z, p.outward.x, p.outward.y, p.outward.z, p.depth});
    list.push_back(points);
  }
  return list;
}

std::vector<CutState> to_cuts(const Json& list) {
  std::vector<CutState> cuts;
  for (const Json& points : list) {
    cuts.emplace_back();
    for (const Json& p : points) {
      const auto x = p.get<std::vector<double>>();
      if (x.size() != 7) throw InputError("a point of a cut has x, y, z, nx, ny, nz and depth");
      cuts.back().points.push_back({{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6]});
    }
  }
  return cuts;
}

Json to_json(const CameraState& camera) {
  Json j{{"azimuth", camera.azimuth}, {"elevation", camera.elevation}, {"zoom", camera.zoom}};
  if (camera.pose)
    j["pose"] = {{"position", to_json(camera.pose->position)},
                 {"focal_point", to_json(camera.pose->focal_point)},
                 {"up", to_json(camera.pose->up)},
                 {"view_angle", camera.pose->view_angle}};
  if (camera.frame)
    j["frame"] = {{"middle", to_json(camera.frame->middle)},
                  {"outward", to_json(camera.frame->outward)},
                  {"along", to_json(camera.frame->along)}};
  return j;
}

Json to_json(const std::optional<SkinTension>& tension) {
  if (!tension) return nullptr;
  Json j{
      {"direction", to_json(tension->direction)}, {"larger", tension->larger}, {"smaller", tension->smaller}};
  if (tension->lines)
    for (const auto& [place, way] : *tension->lines)
      j["lines"].push_back({place.x, place.y, place.z, way.x, way.y, way.z});
  return j;
}

std::optional<SkinTension> to_tension(const Json& j) {
  if (j.is_null()) return std::nullopt;
  SkinTension tension{to_vec3(j.at("direction")), j.at("larger"), j.at("smaller")};
  if (j.contains("lines")) {
    std::vector<TensionLine> lines;
    for (const Json& one : j.at("lines"))
      lines.push_back(
          {to_vec3(one), {one.at(3).get<double>(), one.at(4).get<double>(), one.at(5).get<double>()}});
    tension.lines = std::make_shared<const std::vector<TensionLine>>(std::move(lines));
  }
  return tension;
}

Json to_json(const std::vector<TensionChange>& changes) {
  Json list = Json::array();
  for (const TensionChange& c : changes) list.push_back({{"cuts", c.cuts}, {"tension", to_json(c.tension)}});
  return list;
}

std::vector<TensionChange> to_changes(const Json& list) {
  std::vector<TensionChange> changes;
  for (const Json& c : list) changes.push_back({c.at("cuts"), to_tension(c.at("tension"))});
  return changes;
}

Json to_json(const std::vector<CutChange>& changes) {
  Json list = Json::array();
  for (const CutChange& c : changes)
    list.push_back(
        {{"cuts", c.cuts}, {"tensions", c.tensions}, {"cut", c.index + 1}, {"points", to_json({c.cut})[0]}});
  return list;
}

std::vector<CutChange> to_cut_changes(const Json& list, std::size_t cuts) {
  std::vector<CutChange> changes;
  for (const Json& c : list) {
    const auto cut = c.at("cut").get<std::size_t>();
    if (cut < 1 || cut > cuts) throw InputError(formatted("a change of cut %zu, which is not there", cut));
    changes.push_back(
        {c.at("cuts"), c.at("tensions"), cut - 1, to_cuts(Json::array({c.at("points")})).front()});
  }
  return changes;
}

CameraState to_camera(const Json& j) {
  CameraState camera{j.at("azimuth"), j.at("elevation"), j.at("zoom"), std::nullopt, std::nullopt};
  if (j.contains("frame")) {
    const Json& frame = j.at("frame");
    camera.frame = CameraState::Frame{to_vec3(frame.at("middle")), to_vec3(frame.at("outward")),
                                      to_vec3(frame.at("along"))};
  }
  if (j.contains("pose")) {
    const Json& pose = j.at("pose");
    camera.pose = CameraState::Pose{to_vec3(pose.at("position")), to_vec3(pose.at("focal_point")),
                                    to_vec3(pose.at("up")), pose.at("view_angle")};
  }
  return camera;
}

SessionState to_state(const Json& j) {
  SessionState s;
  s.study = j.at("study");
  s.shown = j.at("case").get<int>() - 1;
  s.parameters = j.at("parameters").get<std::map<std::string, double>>();
  s.between = j.value("between", false);  // sessions saved before there was one show the nearest case
  s.mesh = j.at("mesh");
  s.scale = j.at("scale");
  s.bone = j.value("bone", "");  // younger than other entries
  s.cuts = to_cuts(j.at("cuts"));
  s.undone = to_cuts(j.at("undone"));
  // Sessions saved before there were tensions have none.
  s.tension = to_tension(j.value("tension", Json()));
  s.tensions = to_changes(j.value("tensions", Json::array()));
  s.tensions_undone = to_changes(j.value("tensions_undone", Json::array()));
  const std::size_t all_cuts = s.cuts.size() + s.undone.size();
  s.edits = to_cut_changes(j.value("edits", Json::array()), all_cuts);
  s.edits_undone = to_cut_changes(j.value("edits_undone", Json::array()), all_cuts);
  s.handled = j.value("handles", 0) - 1;
  if (s.handled >= static_cast<int>(s.cuts.size())) throw InputError("handles of a cut that is not there");
  s.time = j.at("time");
  s.loop = j.at("loop");
  s.speed = j.at("speed");
  s.coloring = coloring_of(j.at("color"));
  if (!j.at("range").is_null()) s.range = j.at("range").get<std::pair<double, double>>();
  if (j.contains("percentiles")) s.percentiles = j["percentiles"].get<std::pair<double, double>>();
  s.map = j.value("map", "");
  s.warp = j.value("warp", 1.);
  s.edges = j.value("edges", false);
  s.lifelike = j.value("shading", "plain") == "skin";
  if (j.contains("clip")) s.clip = ClipState{to_vec3(j["clip"].at("place")), to_vec3(j["clip"].at("ahead"))};
  s.brushes = j.at("brushes").get<std::map<std::string, std::pair<double, double>>>();
  s.where = j.at("where");
  s.reference = j.at("reference").get<int>() - 1;
  for (const Json& c : j.at("compared")) s.compared.push_back(c.get<int>() - 1);
  s.camera = to_camera(j.at("camera"));
  s.dark = j.at("dark");
  if (j.contains("probe"))  // these too are younger
    s.probe =
        ProbeState{to_vec3(j["probe"].at("place")), static_cast<Side>(j["probe"].at("side").get<int>())};
  if (j.contains("zoom")) s.zoom = ZoomState{to_vec3(j["zoom"].at("place")), j["zoom"].at("radius")};
  for (const Json& place : j.value("ruler", Json::array())) s.ruler.push_back(to_vec3(place));
  s.figure = j.value("figure", "");
  s.filtered = j.value("filtered", false);
  s.wall = j.value("wall", false);
  s.sorted_by = j.value("sorted_by", "");
  s.descending = j.value("descending", false);
  for (const Json& c : j.value("selected", Json::array())) s.selected.push_back(c.get<int>() - 1);
  s.analyzed = j.value("analyzed", "");
  s.simulate = j.value("simulate", false);
  if (j.contains("detail")) s.detail = detail_of(j["detail"].get<std::string>());
  return s;
}

}  // namespace

std::string cut_line(const std::string& command, const CutState& cut) {
  std::string line = command;
  for (const ScalpelPath::Point& p : cut.points) {
    char text[160];
    std::snprintf(text, sizeof text, " %.3f,%.3f,%.3f,%.4f,%.4f,%.4f", p.position.x, p.position.y,
                  p.position.z, p.outward.x, p.outward.y, p.outward.z);
    line += text;
    if (p.depth > 0) line += "," + shortest(std::round(1e3 * p.depth) / 1e3);
  }
  return line;
}

std::string state_to_json(const SessionState& s) {
  Json compared = Json::array();
  for (const int c : s.compared) compared.push_back(c + 1);
  Json j{{"format", format},
         {"version", version},
         {"producer", producer()},
         {"study", s.study},
         {"case", s.shown + 1},
         {"parameters", s.parameters},
         {"between", s.between},
         {"mesh", s.mesh},
         {"scale", s.scale},
         {"cuts", to_json(s.cuts)},
         {"undone", to_json(s.undone)},
         {"time", s.time},
         {"loop", s.loop},
         {"speed", s.speed},
         {"color", text_of(s.coloring).name},
         {"range", s.range ? Json{s.range->first, s.range->second} : Json()},
         {"brushes", s.brushes},
         {"where", s.where},
         {"reference", s.reference + 1},
         {"compared", compared},
         {"camera", to_json(s.camera)},
         {"dark", s.dark}};
  if (!s.bone.empty()) j["bone"] = s.bone;
  if (s.tension) j["tension"] = to_json(s.tension);
  if (!s.tensions.empty()) j["tensions"] = to_json(s.tensions);
  if (!s.tensions_undone.empty()) j["tensions_undone"] = to_json(s.tensions_undone);
  if (!s.edits.empty()) j["edits"] = to_json(s.edits);
  if (!s.edits_undone.empty()) j["edits_undone"] = to_json(s.edits_undone);
  if (s.handled >= 0) j["handles"] = s.handled + 1;
  if (s.probe) j["probe"] = {{"place", to_json(s.probe->uvw)}, {"side", static_cast<int>(s.probe->side)}};
  if (s.zoom) j["zoom"] = {{"place", to_json(s.zoom->place)}, {"radius", s.zoom->radius}};
  for (const Vec3& place : s.ruler) j["ruler"].push_back(to_json(place));
  if (!s.figure.empty()) j["figure"] = s.figure;
  if (s.percentiles) j["percentiles"] = {s.percentiles->first, s.percentiles->second};
  if (!s.map.empty()) j["map"] = s.map;
  if (s.warp != 1) j["warp"] = s.warp;
  if (s.edges) j["edges"] = true;
  if (s.lifelike) j["shading"] = "skin";
  if (s.clip) j["clip"] = {{"place", to_json(s.clip->place)}, {"ahead", to_json(s.clip->ahead)}};
  if (s.filtered) j["filtered"] = true;
  if (s.wall) j["wall"] = true;
  if (!s.sorted_by.empty()) j["sorted_by"] = s.sorted_by;
  if (s.descending) j["descending"] = true;
  for (const int c : s.selected) j["selected"].push_back(c + 1);
  if (!s.analyzed.empty()) j["analyzed"] = s.analyzed;
  if (s.simulate) j["simulate"] = true;
  if (s.detail) j["detail"] = text_of(*s.detail);
  return j.dump(1) + "\n";
}

SessionState state_from_json(const std::string& json) {
  try {
    const Json j = Json::parse(json);
    if (j.value("format", "") != format) throw InputError("is no saved session of cleft explore");
    if (j.value("version", 0) != version)
      throw InputError("is a session of version " + std::to_string(j.value("version", 0)) +
                       "; this program reads version " + std::to_string(version));
    return to_state(j);
  } catch (const Json::exception& e) {
    throw InputError(std::string("is no whole saved session: ") + e.what());
  }
}

}  // namespace cleft
