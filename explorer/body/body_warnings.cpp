#include "explorer/body/body_warnings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "explorer/body/skin_coordinates.h"

namespace cleft {

namespace {

constexpr double least_angle = 5, most_off_blade = 10;  // degrees
constexpr double least_held = 0.02;                     // of the opening, that is told
constexpr double degrees = 180 / std::numbers::pi;

double rounded(double x) { return std::round(1e4 * x) / 1e4; }
std::string hundredths(double x) { return shortest(std::round(100 * x) / 100); }

std::string triangles_at(std::size_t count, const Vec3& first) {
  if (count == 1) return "1 triangle of the skin at " + place_text(first) + " mm";
  return std::to_string(count) + " triangles of the skin, the first at " + place_text(first) + " mm,";
}

}  // namespace

std::vector<std::string> warnings_of(const BodyReport& r) {
  std::vector<std::string> warnings;
  if (r.thinned > 0)
    warnings.push_back("the tissue is thinner than patch.height below " + std::to_string(r.thinned) +
                       " points of the skin, down to " + shortest(rounded(r.least_thickness)) +
                       " mm, because the skin is bent too strongly there");
  if (r.least_depth > 0)
    warnings.push_back("the cut is only " + shortest(rounded(r.least_depth)) +
                       " mm deep where the tissue is thin");
  if (r.blade_turn > most_off_blade)
    warnings.push_back(
        "the cut's wall at " + place_text(r.blade_turned_at) + " mm is turned by " +
        hundredths(r.blade_turn) +
        " degrees from the blade, because the skin is bent or the blade turns too fast there, or "
        "it is too flat: check the path's directions (nx, ny, nz)");
  if (r.stiff_tilt > 0)
    warnings.push_back("the blade tilts by " + hundredths(r.stiff_tilt) +
                       " degrees against the skin, over whose thin lip the tissue is too stiff: set "
                       "tissue.formulation = \"mean-dilatation\" here and for cleft solve");
  if (r.left_out > 0)
    warnings.push_back(triangles_at(r.left_out, r.left_out_at) + (r.left_out == 1 ? " is" : " are") +
                       " left out of the body, which ends there: the skin is bent too strongly");
  if (r.least_angle < least_angle)
    warnings.push_back(
        "a triangle of the skin at " + place_text(r.sharpest) + " mm has an angle of only " +
        hundredths(r.least_angle) +
        " degrees: what is simulated there is less accurate; smooth the mesh or the path there");
  for (const OffPath& p : r.off_paths) {
    const std::string cut = "cut " + std::to_string(p.cut + 1);
    if (p.far)
      warnings.push_back(cut + ": its path is " + hundredths(p.off) + " mm off the skin at " +
                         place_text(p.at) + " mm; check that it is of this mesh, and --scale");
    if (p.leaves)
      warnings.push_back(cut + " is made along " + hundredths(p.made) + " of the " + hundredths(p.length) +
                         " mm of its path: there is no skin below the rest of it");
  }
  return warnings;
}

std::string warning_of_turn(const Turn& most, double share) {
  return "in small strains the skin at " + place_text(most.at) + " mm would turn by " +
         shortest(std::round(most.angle * degrees)) +
         " degrees: it is simulated with a share of the stiffness against turning that its tension gives it "
         "(skin.turning_stiffness = " +
         shortest(std::max(0.01, std::round(100 * share) / 100)) + "), with which wounds open less";
}

std::string warning_of_guard(const CutMesh& mesh, const Guard& guard, double gape, double scale) {
  const auto& changes = guard.changes();
  const auto most = std::max_element(changes.begin(), changes.end(),
                                     [](const auto& a, const auto& b) { return a.by < b.by; });
  if (most == changes.end() || scale * most->by < least_held * gape) return "";
  return std::to_string(changes.size()) +
         (changes.size() == 1 ? " vertex of the skin moves" : " vertices of the skin move") +
         " otherwise than in this simulation, by up to " + hundredths(scale * most->by) + " mm at " +
         place_text(scale * mesh.position(most->vertex)) +
         " mm, so that no triangle turns over: the skin is bent or thin there, or strains are too large to "
         "be small";
}

std::string warning_of_turned(const CutMesh& mesh, const std::vector<int>& turned, double scale) {
  if (turned.empty()) return "";
  const auto& corners = mesh.triangle(turned.front()).vertex;
  Vec3 middle;
  for (const int v : corners) middle += scale / 3 * mesh.position(v);
  return triangles_at(turned.size(), middle) +
         (turned.size() == 1 ? " turns over or folds up" : " turn over or fold up") +
         " in this simulation: the skin is bent or thin there, or strains are too large to be small; try "
         "model = finite, a shallower cut or a smaller mesh.element_size";
}

}  // namespace cleft
