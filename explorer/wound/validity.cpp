#include "explorer/wound/validity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/text.h"
#include "explorer/study/case_figures.h"
#include "explorer/wound/prestress_fields.h"

namespace cleft {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Of the largest opening: an expected error that is warned of.
constexpr double greatest_expected = 0.1;
/// Prestresses along, across and in shear differ by no more than this part of them where a cut opens alike
/// whichever way it goes.
constexpr double greatest_difference = 0.05;
constexpr int path_samples = 128, opening_samples = 16;  ///< of bends and tilts, and of the widest opening
constexpr double before_ends = 1;                        // mm, of a cut
constexpr double least_junction_sine = 0.87;             // branches were compared at a right angle

double smallest_radius(const ScalpelPath& path) {
  double least = infinity;
  for (int i = 0; i <= path_samples; ++i)
    for (const bool right : {false, true})
      least = std::min(least, path.room(path.length() * i / path_samples, right));
  return least;
}

/// The path, but what lies ahead of a blade whose way is found as it goes.
ScalpelPath way_of(const Incision& incision) {
  return incision.extended_to() > 0 ? incision.path().until(incision.extended_to()) : incision.path();
}

double largest_tilt(const Wound& cut, double length) {
  double least = 1;  // cosine
  for (int i = 0; i <= path_samples; ++i) {
    const double s = length * i / path_samples;
    least = std::min(least, dot(cut.volume.skin_frame(s).outward, cut.incision->path().at(s).outward));
  }
  return std::acos(least) * 180 / std::numbers::pi;
}

/// When all of the path is cut, up to `length`, mm.
void find_held_back(const Wound& cut, double length, Validity& v) {
  const Field& field = cut.field.shape();
  for (int i = 0; i <= path_samples; ++i) {
    const double s = length * i / path_samples;
    const CanonicalPlace place = canonical_place(s, length, field.cut());
    const double t = std::clamp(length + place.time_offset, 0., field.cut().length);
    for (const Side side : {Side::left, Side::right}) {
      const double by = cut.volume.part_held_back(s / cut.scale(), side) *
                        norm(cut.field.displacement({place.u, 0, 0}, side, t, s));
      if (by > v.held_back) v.held_back = by, v.held_back_at = s;
    }
  }
}

/// The cut whose path a vertex is nearest to, and where along it, mm; none if no cut moves it.
std::optional<std::pair<std::size_t, double>> nearest_path(const std::vector<const Wound*>& cuts,
                                                           int vertex) {
  std::optional<std::pair<std::size_t, double>> nearest;
  double least = infinity;
  for (std::size_t i = 0; i < cuts.size(); ++i)
    if (const auto at = cuts[i]->volume.locate(vertex); at && std::abs(at->uvw.y) < least)
      least = std::abs(at->uvw.y), nearest = {i, at->s};
  return nearest;
}

/// Each vertex and triangle counts for the cut that it is nearest to. Returns for each cut by how much the
/// lips move otherwise, mm, without the millimetre before each end, which no error of an opening counts.
std::vector<double> find_guarded(const std::vector<const Wound*>& cuts, const Guard& guard,
                                 std::vector<Validity>& result) {
  std::vector<double> of_lips(cuts.size(), 0);
  for (const auto& [vertex, by] : guard.changes()) {
    const auto nearest = nearest_path(cuts, vertex);
    if (!nearest) continue;
    const auto& [k, s] = *nearest;
    const Wound& cut = *cuts[k];
    const double mm = by * cut.scale();
    ++result[k].guarded_vertices;
    if (mm > result[k].guarded) result[k].guarded = mm, result[k].guarded_at = s;
    const double length = cut.incision->path().length() * cut.scale();
    if (std::min(s, length - s) > before_ends && cut.volume.locate(vertex)->on_cut)
      of_lips[k] = std::max(of_lips[k], mm);
  }
  for (const Guard::Unsound& u : guard.unsound())
    if (const auto nearest = nearest_path(cuts, u.vertex))
      result[nearest->first].unsound.push_back({nearest->second, u.place, u.cut, u.s, u.torn});
  return of_lips;
}

std::string warning_of(const std::vector<Validity::Unsound>& unsound, bool several) {
  const Validity::Unsound& first = unsound.front();
  const auto number = [](double x) { return shortest(std::round(1000 * x) / 1000); };
  return std::to_string(unsound.size()) +
         (unsound.size() == 1 ? " triangle of the skin turns over or tears at "
                              : " triangles of the skin turn over or tear, the first at ") +
         number(first.at) + " mm of the path, in the mesh at " + number(first.place.x) + ", " +
         number(first.place.y) + ", " + number(first.place.z) + ", with the blade at " +
         number(first.blade_at) + " mm" + (several ? " of cut " + std::to_string(first.blade_in + 1) : "");
}

/// The opening of the canonical cut at its widest, when it has come to t, with the fields along a path's
/// start.
double opening(const VaryingField& field, double t) {
  const double start = field.shape().cut().start;
  double widest = 0;
  for (int i = 1; i < opening_samples; ++i) {
    const double s = t * i / opening_samples;
    const Vec3 place{start + s, 0, 0};
    widest = std::max(widest, norm(field.displacement(place, Side::right, t, s) -
                                   field.displacement(place, Side::left, t, s)));
  }
  return widest;
}

/// Aitken: openings at equal steps of length that near their limit by equal factors.
double length_defect(const VaryingField& field) {
  const double length = field.shape().cut().length, a = opening(field, length / 2),
               b = opening(field, 0.75 * length), c = opening(field, length);
  const double bend = (b - a) - (c - b);
  if (!(c > 0) || c <= b) return 0;
  return bend > 0 ? (c - b) * (c - b) / bend / c : infinity;
}

/// A place of a cut's path on the wound of another.
struct Junction {
  std::size_t other;
  double tension;   ///< along the other over across it
  double sine;      ///< of the angle between the two
  double from_end;  ///< mm: of the own path, to its nearer end
  bool opens_on;    ///< the own cut begins or ends in the other one (IncisionVolume::opens_into)

  /// Where it crosses the other, all four corners open as the cuts themselves do (corner_lean.h).
  bool is_crossing(double depth) const { return from_end > depth / 2; }
};

/// Of a cut's skin, along it over across it, at s mm; infinite where its field does not tell them, as where
/// nothing is known of how it pulls.
double tension_along_over_across(const Wound& cut, double s) {
  try {
    const double across = cut.field.prestress(&Prestress::vv, s);
    return across > 0 ? cut.field.prestress(&Prestress::uu, s) / across : infinity;
  } catch (const InputError&) {
    return infinity;
  }
}

std::vector<Junction> junctions_of(const std::vector<const Wound*>& cuts, std::size_t i) {
  const Incision& own = *cuts[i]->incision;
  std::vector<Junction> found;
  for (const auto& c : own.chain()) {
    const CutMesh::Vertex& vertex = own.mesh().vertex(c.left);
    for (std::size_t j = 0; j < cuts.size(); ++j) {
      if (j == i || vertex.cut != cuts[j]->incision->cut()) continue;
      const double s = vertex.s * cuts[j]->scale();
      const auto& mouth = cuts[i]->volume.mouth(c.s > own.path().length() / 2);
      const Vec3 along = cuts[j]->incision->path().at(vertex.s).along;
      found.push_back({j, tension_along_over_across(*cuts[j], s),
                       norm(cross(along, own.path().at(c.s).along)),
                       std::min(c.s, own.path().length() - c.s) * cuts[i]->scale(),
                       mouth && mouth->earlier == cuts[j]->incision});
    }
  }
  return found;
}

bool crosses_squarely(const std::vector<Junction>& junctions, std::size_t other) {
  return std::any_of(junctions.begin(), junctions.end(), [other](const Junction& x) {
    return x.other == other && x.sine >= least_junction_sine;
  });
}

double distance(const Wound& a, const Wound& b) {
  double least = infinity;
  for (const auto& p : a.incision->chain())
    for (const auto& q : b.incision->chain())
      least =
          std::min(least, norm(a.incision->mesh().position(p.left) - b.incision->mesh().position(q.left)));
  return least * a.scale();
}

/// Between the directions of two cuts from end to end, radians: at most a right angle.
double angle_between(const Wound& a, const Wound& b) {
  const auto direction = [](const Wound& cut) {
    const ScalpelPath way = way_of(*cut.incision);
    return way.at(way.length()).position - way.at(0).position;
  };
  const Vec3 one = direction(a), other = direction(b);
  return std::atan2(norm(cross(one, other)), std::abs(dot(one, other)));
}

bool pulled_alike(const Field& field) {
  const auto [uu, vv, uv] = prestress_of(field.parameters);
  return std::abs(uu - vv) + 2 * std::abs(uv) <= greatest_difference * (uu + vv);
}

}  // namespace

std::vector<Validity> validity_of(const std::vector<const Wound*>& cuts, bool turned, const Guard& guard) {
  std::vector<Validity> result(cuts.size());
  const std::vector<double> lips_guarded = find_guarded(cuts, guard, result);
  std::vector<std::vector<Junction>> junctions;
  for (std::size_t i = 0; i < cuts.size(); ++i) junctions.push_back(junctions_of(cuts, i));
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const Field& field = cuts[i]->field.shape();
    const ScalpelPath way = way_of(*cuts[i]->incision);
    const double scale = cuts[i]->scale(), canonical = field.cut().length, length = way.length() * scale;
    Validity& v = result[i];
    v.smallest_radius = smallest_radius(way) * scale;
    find_held_back(*cuts[i], length, v);
    v.largest_tilt = largest_tilt(*cuts[i], way.length());
    v.length_defect = length_defect(cuts[i]->field);
    v.nearest_cut = infinity;
    double nearest_beside = infinity;  // cuts that meet squarely are none beside each other
    for (std::size_t j = 0; j < cuts.size(); ++j) {
      if (j == i) continue;
      const double apart = distance(*cuts[i], *cuts[j]);
      v.nearest_cut = std::min(v.nearest_cut, apart);
      if (!crosses_squarely(junctions[i], j) && !crosses_squarely(junctions[j], i))
        nearest_beside = std::min(nearest_beside, apart);
    }
    double judged = 0, mouth = 0;
    for (const Junction& x : junctions[i]) {
      v.junction_tension = std::max(v.junction_tension.value_or(-infinity), x.tension);
      if (!x.is_crossing(field.cut().depth)) {
        double& most = x.opens_on ? mouth : judged;
        most = std::max(most, x.tension);
      }
    }
    const bool known = turned || pulled_alike(field);
    const double against_first = v.junction_tension ? 0 : angle_between(*cuts[0], *cuts[i]);
    const double widest = opening(cuts[i]->field, std::min(length, canonical));
    const double own = turned || !(widest > 0) ? 0 : error_of_gape(field).value_or(0) / widest;
    v.expected_error =
        opening_error_of(*cuts[i], known,
                         {nearest_beside, known ? judged : v.junction_tension.value_or(0), mouth,
                          v.length_defect, own, field.interpolation.has_value(), against_first,
                          widest > 0 ? std::max(v.held_back, lips_guarded[i]) / widest : 0});
    const bool several = cuts.size() > 1;
    const std::string which = several ? "cut " + std::to_string(i + 1) + ": " : "";
    if (!v.unsound.empty()) v.warnings.push_back(which + warning_of(v.unsound, several));
    if (v.expected_error.largest > greatest_expected)
      v.warnings.push_back(which + "its opening may be off by " +
                           shortest(std::round(100 * v.expected_error.largest) / 100) + ": " +
                           v.expected_error.cause);
  }
  return result;
}

}  // namespace cleft
