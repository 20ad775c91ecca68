#include "explorer/scene/validity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/text.h"

namespace cleft {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// In lengths of the canonical cut, of the figures in tests/truth/README.md.
constexpr double least_radius = 2. / 3, least_radius_not_turned = 2.7, least_spacing = 0.4;
constexpr double greatest_tilt = 45, greatest_defect = 0.1;

std::string rounded(double x) { return shortest(std::round(10 * x) / 10); }

double smallest_radius(const ScalpelPath& path) {
  double least = infinity;
  for (int i = 0; i <= 128; ++i)
    for (const bool right : {false, true})
      least = std::min(least, path.room_beside(path.length() * i / 128, right));
  return least;
}

double largest_tilt(const CutInTension& cut) {
  const double length = cut.incision->path().length();
  double least = 1;  // cosine
  for (int i = 0; i <= 128; ++i) {
    const double s = length * i / 128;
    least = std::min(least, dot(cut.volume->skin_frame(s).outward, cut.incision->path().at(s).outward));
  }
  return std::acos(least) * 180 / std::numbers::pi;
}

/// The opening of the canonical cut at its widest, when it has come to t.
double opening(const Field& field, double t) {
  double widest = 0;
  for (int i = 1; i < 16; ++i) {
    const Vec3 place{field.cut().start + t * i / 16, 0, 0};
    widest = std::max(
        widest, norm(field.displacement(place, Side::right, t) - field.displacement(place, Side::left, t)));
  }
  return widest;
}

/// Aitken: openings at equal steps of length that near their limit by equal factors.
double length_defect(const Field& field) {
  const double length = field.cut().length, a = opening(field, length / 2), b = opening(field, 0.75 * length),
               c = opening(field, length);
  const double bend = (b - a) - (c - b);
  if (!(c > 0) || c <= b) return 0;
  return bend > 0 ? (c - b) * (c - b) / bend / c : infinity;
}

double nearest_cut(const std::vector<CutInTension>& cuts, std::size_t i) {
  double least = infinity;
  for (std::size_t j = 0; j < cuts.size(); ++j) {
    if (j == i) continue;
    for (const auto& a : cuts[i].incision->chain())
      for (const auto& b : cuts[j].incision->chain())
        least = std::min(least, norm(cuts[i].incision->mesh().position(a.left) -
                                     cuts[j].incision->mesh().position(b.left)));
  }
  return least;
}

bool pulled_alike(const Field& field) {
  const auto value = [&](const char* name) {
    const auto found = field.parameters.find(name);
    return found == field.parameters.end() ? 0 : found->second;
  };
  const double u = value("skin.prestress_u"), v = value("skin.prestress_v");
  return std::abs(u - v) + 2 * std::abs(value("skin.prestress_uv")) <= 0.05 * (u + v);
}

}  // namespace

std::vector<Validity> validity_of(const std::vector<CutInTension>& cuts, bool turned) {
  std::vector<Validity> result;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const Field& field = cuts[i].field->shape();
    const double scale = cuts[i].volume->scale(), canonical = field.cut().length,
                 length = cuts[i].incision->path().length() * scale;
    Validity& v = result.emplace_back();
    v.smallest_radius = smallest_radius(cuts[i].incision->path()) * scale;
    v.largest_tilt = largest_tilt(cuts[i]);
    v.length_defect = length_defect(field);
    v.nearest_cut = nearest_cut(cuts, i) * scale;
    const std::string which = cuts.size() > 1 ? "cut " + std::to_string(i + 1) + ": " : "";
    const auto warn = [&](const std::string& what) {
      v.warnings.push_back(which + what + ": its opening may be off by more than a tenth");
    };
    const bool known = turned || pulled_alike(field);
    const double radius = canonical * (known ? least_radius : least_radius_not_turned);
    if (v.smallest_radius < radius)
      warn("the path bends with a radius of " + rounded(v.smallest_radius) + " mm, below " + rounded(radius) +
           (known ? "" : " where the tension does not turn with it (give --tension)"));
    if (v.largest_tilt > greatest_tilt)
      warn("the blade is tilted by " + rounded(v.largest_tilt) + " degrees, above " + rounded(greatest_tilt));
    if (length > canonical * (1 + 1e-9) && v.length_defect > greatest_defect)
      warn("the path is " + rounded(length) + " mm long, and the field's cut of " + rounded(canonical) +
           " mm is too short for its opening to have come to its width");
    if (v.nearest_cut < least_spacing * canonical)
      warn("another cut comes as near as " + rounded(v.nearest_cut) + " mm, below " +
           rounded(least_spacing * canonical));
  }
  return result;
}

}  // namespace cleft
