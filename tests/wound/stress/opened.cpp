#include "tests/wound/stress/opened.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace cleft::stress {

namespace {

constexpr double shrunk = 0.2;         // of its area at rest: a triangle that is nearly flattened
constexpr double nearly_shrunk = 0.4;  // likewise, by the gradient of the field at a corner
constexpr double near = 0.5;           // mm: ends of an edge that belong together
constexpr double apart = 1;            // mm
constexpr double too_far = 1.1;        // of the field's largest displacement
constexpr double too_much_strain = 3;  // of the field's largest
constexpr double passed = 0.05;        // mm
constexpr double as_far = 1.25;        // nearly the same length
constexpr int samples_along = 120, samples_across = 24;  // of the field
constexpr int places_along = 48, places_across = 12;     // of a family's fields

/// The area of a triangle over that at rest; negative if it has turned by more than 90 degrees.
double determinant(const Vec3 (&rest)[3], const Vec3 (&now)[3]) {
  const Vec3 before = cross(rest[1] - rest[0], rest[2] - rest[0]),
             after = cross(now[1] - now[0], now[2] - now[0]);
  return std::copysign(norm(after) / norm(before), dot(before, after));
}

/// Whether a triangle keeps its side and a fifth of its area.
bool kept(const Vec3 (&rest)[3], const Vec3 (&now)[3]) { return determinant(rest, now) >= shrunk; }

/// The place in the flat patch: by s and not by u, which does not change between the halves of a path longer
/// than the canonical cut.
Vec3 in_patch(const ActiveVertex& a) { return {a.s, a.uvw.y, a.uvw.z}; }

class Look {
 public:
  Look(const ReplayedWounds& wounds, const FieldLimits& limits)
      : wounds_(wounds), limits_(limits), mesh_(wounds[0].incision->mesh()), scale_(wounds[0].scale()) {
    for (std::size_t k = 0; k < wounds.size(); ++k)
      for (const ActiveVertex& a : wounds.active(k)) place_[{a.vertex, k}] = &a;
    for (std::size_t t = 0; t < mesh_.triangles().size(); ++t)
      if (mesh_.is_skin(static_cast<int>(t))) skin_.push_back(static_cast<int>(t));
    turned_.resize(mesh_.triangles().size()), edge_.resize(3 * mesh_.triangles().size());
    spike_.resize(mesh_.vertices().size());
  }

  Opened run(int count) {
    std::vector<Vec3> now(wounds_.vertex_count()), again(now.size());
    std::vector<std::vector<Vec3>> all;
    for (int k = 1; k <= count; ++k) {
      const double t = wounds_.duration() * k / count;
      wounds_.positions(t, now);
      look(t, now);
      all.push_back(now);
    }
    for (std::size_t k = 0; k < wounds_.size(); ++k)
      for (const auto& c : wounds_[k].incision->chain())
        found_.opening += scale_ * norm(now[c.right] - now[c.left]);
    for (int k = count; k >= 1; --k) {
      wounds_.positions(wounds_.duration() * k / count, again);
      found_.unsteady +=
          !std::equal(again.begin(), again.end(), all[static_cast<std::size_t>(k - 1)].begin());
    }
    found_.positions = count;
    return found_;
  }

 private:
  void look(double t, const std::vector<Vec3>& now) {
    for (const int triangle : skin_) look_at_triangle(triangle, t, now);
    for (std::size_t v = 0; v < now.size(); ++v) {
      const double d = scale_ * norm(now[v] - wounds_.rest()[v]) / limits_.displacement;
      found_.largest = std::max(found_.largest, d);
      if (!(d <= too_far) && !spike_[v] && !(d <= too_far * lifted(static_cast<int>(v))))
        spike_[v] = true, ++found_.spikes;
    }
    const ReplayedWounds::Blade blade = wounds_.blade(t);
    for (std::size_t k = 0; k <= blade.cut; ++k)
      for (const auto& c : wounds_[k].incision->chain()) look_at_pair(wounds_[k], c, now);
  }

  /// The largest displacement over the field's, in the directions of a vertex: a tilted blade lifts what
  /// moves across the cut (ipv.h).
  double lifted(int v) const {
    const auto at = place_.find({v, 0});
    if (wounds_.size() > 1) return static_cast<double>(wounds_.size());
    if (at == place_.end() || norm(at->second->across) < 1 + 1e-6) return 1;
    ActiveVertex a = *at->second;
    a.weight = 1;
    double largest = 0;
    for (const Vec3& d : limits_.large) largest = std::max(largest, norm(a.in_mesh(d)));
    return largest / limits_.displacement;
  }

  void look_at_triangle(int t, double time, const std::vector<Vec3>& now) {
    const auto& v = mesh_.triangle(t).vertex;
    const Vec3 rest[3] = {mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])},
               moved[3] = {now[v[0]], now[v[1]], now[v[2]]};
    found_.least_determinant = std::min(found_.least_determinant, determinant(rest, moved));
    if (!turned_[t] && !kept(rest, moved)) {
      turned_[t] = true;
      found_.unnamed += !named(t);
      if (field_turns(t, time)) {
        ++found_.turned_by_field;
      } else {
        if (found_.turned++ == 0)
          found_.first_turned = rest[0], found_.first_is = described(t, time, rest, moved);
      }
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double length = scale_ * norm(rest[j] - rest[i]),
                   jump = scale_ * norm((moved[j] - rest[j]) - (moved[i] - rest[i]));
      const bool torn = length < near && jump > apart,
                 stretched = jump > too_much_strain * limits_.strain * length + passed;
      if ((!torn && !stretched) || edge_[3 * t + i]) continue;
      edge_[3 * t + i] = true;
      if (found_.torn + found_.stretched + found_.torn_by_field + found_.turned == 0)
        found_.first_is = described(t, time, rest, moved);
      if (field_stretches(t, i, jump, time))
        ++found_.torn_by_field;
      else
        found_.torn += torn, found_.stretched += stretched;
    }
  }

  bool named(int t) const {
    const auto& all = wounds_.guard().unsound();
    const auto& v = mesh_.triangle(t).vertex;
    const Vec3 middle = 1. / 3 * (mesh_.position(v[0]) + mesh_.position(v[1]) + mesh_.position(v[2]));
    return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.place == middle; });
  }

  /// The corners of a triangle, and where the blade is.
  std::string described(int t, double time, const Vec3 (&rest)[3], const Vec3 (&moved)[3]) const {
    const ReplayedWounds::Blade blade = wounds_.blade(time);
    std::string text = "\n      with the blade at " + std::to_string(blade.s) + " mm of cut " +
                       std::to_string(blade.cut) + ":";
    for (int i = 0; i < 3; ++i) {
      const int v = mesh_.triangle(t).vertex[i];
      char line[300];
      const Vec3 d = scale_ * (moved[i] - rest[i]), p = scale_ * (rest[i] - rest[0]);
      std::snprintf(
          line, sizeof line, "\n      vertex %d kind %d cut %d at %.4g %.4g %.4g mm moves %.3g %.3g %.3g", v,
          static_cast<int>(mesh_.vertex(v).kind), mesh_.vertex(v).cut, p.x, p.y, p.z, d.x, d.y, d.z);
      text += line;
      for (std::size_t k = 0; k < wounds_.size(); ++k) {
        const auto at = place_.find({v, k});
        if (at == place_.end()) continue;
        const ActiveVertex& a = *at->second;
        std::snprintf(line, sizeof line,
                      "\n        %zu: u %.4g v %.4g s %.4g side %d weight %.3g along %.2g %.2g %.2g across "
                      "%.2g %.2g %.2g",
                      k, a.uvw.x, a.uvw.y, a.s, static_cast<int>(a.side), a.weight, a.along.x, a.along.y,
                      a.along.z, a.across.x, a.across.y, a.across.z);
        text += line;
      }
    }
    return text;
  }

  /// Whether the field turns the triangle in its own patch, or where it has no room.
  bool field_turns(int t, double time) const {
    if (wounds_.size() != 1) return false;
    Vec3 rest[3], now[3];
    bool steep = false;
    const auto& v = mesh_.triangle(t).vertex;
    for (int i = 0; i < 3; ++i) {
      const auto at = place_.find({v[i], 0});
      if (at == place_.end()) return false;
      const ActiveVertex& a = *at->second;
      const double length = wounds_[0].field.shape().cut().length;
      const Side side = a.on_cut && a.s >= time ? Side::both : a.side;
      rest[i] = in_patch(a);
      const double own = std::clamp(time + a.time_offset, 0., length);
      const Derivatives d = wounds_[0].field.derivatives(a.uvw, side, own, a.s);
      now[i] = rest[i] + d.value;
      const Vec3 area = cross(Vec3{1, 0, 0} + d.by_u, Vec3{0, 1, 0} + d.by_v);
      steep = steep || area.z < nearly_shrunk;
    }
    return steep || !kept(rest, now);
  }

  /// Whether the field moves the ends of an edge apart by nearly as much in its own patch.
  bool field_stretches(int t, int edge, double jump, double time) const {
    if (wounds_.size() != 1) return false;
    const auto& v = mesh_.triangle(t).vertex;
    Vec3 at[2], moved[2];
    for (int i = 0; i < 2; ++i) {
      const auto place = place_.find({v[(edge + i) % 3], 0});
      if (place == place_.end()) return false;
      const ActiveVertex& a = *place->second;
      const Side side = a.on_cut && a.s >= time ? Side::both : a.side;
      const double own = std::clamp(time + a.time_offset, 0., wounds_[0].field.shape().cut().length);
      at[i] = in_patch(a), moved[i] = wounds_[0].field.displacement(a.uvw, side, own, a.s);
    }
    const double rest = scale_ * norm(mesh_.position(v[(edge + 1) % 3]) - mesh_.position(v[edge]));
    return norm(at[1] - at[0]) < as_far * rest && norm(moved[1] - moved[0]) * as_far > jump;
  }

  void look_at_pair(const Wound& wound, const Incision::ChainVertex& c, const std::vector<Vec3>& now) {
    if (c.left == c.right) return;
    const PathFrame frame = wound.incision->path().at(c.s);
    const double past = -scale_ * dot(now[c.right] - now[c.left], frame.across);
    found_.passed = std::max(found_.passed, past);
    if (past > passed) ++found_.crossed;
  }

  const ReplayedWounds& wounds_;
  const FieldLimits& limits_;
  const CutMesh& mesh_;
  double scale_;
  std::map<std::pair<int, std::size_t>, const ActiveVertex*> place_;  // by vertex and wound
  std::vector<int> skin_;
  std::vector<bool> turned_, edge_, spike_;
  Opened found_;
};

}  // namespace

FieldLimits::FieldLimits(const Field& field) {
  const auto at = [](const Interval& x, int i) {
    return x.front + (x.back - x.front) * (i + 0.5) / samples_along;
  };
  for (int i = 0; i < samples_along; ++i)
    for (int j = 0; j <= samples_across; ++j)
      for (int l = 1; l <= 4; ++l) {
        const double t = std::min(field.duration(), field.cut().length) * l / 4;
        for (const Side side : {Side::left, Side::right})
          for (const double w : {0., -field.cut().depth / 2}) {
            const double v =
                field.domain(1).back * j * j / (samples_across * samples_across);  // closer near the cut
            const Vec3 place{at(field.domain(0), i), side == Side::left ? -v : v, w};
            const Derivatives d = field.derivatives(place, side, t);
            take(d);
          }
      }
  keep_large();
}

FieldLimits::FieldLimits(const std::vector<Wound>& wounds) {
  for (const Wound& wound : wounds) {
    const Field& shape = wound.field.shape();
    const double length = wound.complete();
    for (int i = 0; i <= places_along; ++i)
      for (int j = 0; j <= places_across; ++j)
        for (int l = 1; l <= 4; ++l)
          for (const Side side : {Side::left, Side::right}) {
            const double s = length * i / places_along,
                         v = shape.domain(1).back * j * j / (places_across * places_across);
            const Vec3 place{canonical_place(s, length, shape.cut()).u, side == Side::left ? -v : v, 0};
            take(wound.field.derivatives(place, side, std::min(length, shape.cut().length) * l / 4, s));
          }
  }
  keep_large();
}

void FieldLimits::take(const Derivatives& d) {
  displacement = std::max(displacement, norm(d.value));
  strain = std::max({strain, std::hypot(norm(d.by_u), norm(d.by_v))});
  large.push_back(d.value);
}

void FieldLimits::keep_large() {
  std::erase_if(large, [this](const Vec3& d) { return norm(d) < displacement / 3; });
}

void Opened::add(const Opened& o) {
  positions += o.positions, turned += o.turned, turned_by_field += o.turned_by_field, torn += o.torn;
  stretched += o.stretched, spikes += o.spikes, crossed += o.crossed, unsteady += o.unsteady;
  torn_by_field += o.torn_by_field, unnamed += o.unnamed, opening += o.opening;
  largest = std::max(largest, o.largest);
  least_determinant = std::min(least_determinant, o.least_determinant);
  passed = std::max(passed, o.passed);
}

Opened look_at_opened(const ReplayedWounds& wounds, const FieldLimits& limits, int count) {
  return Look(wounds, limits).run(count);
}

std::string text_of(const Opened& o) {
  char text[400];
  std::snprintf(
      text, sizeof text,
      "%ld turned (first at %.6g %.6g %.6g), %ld turned by the field, %ld not named, %ld torn, %ld "
      "stretched, %ld "
      "of either by the field, %ld spikes, %ld lips crossed (by at most %.3g mm), %ld unsteady, least "
      "determinant %.3g, largest %.3g of the "
      "field's, openings %.6g mm",
      o.turned, o.first_turned.x, o.first_turned.y, o.first_turned.z, o.turned_by_field, o.unnamed, o.torn,
      o.stretched, o.torn_by_field, o.spikes, o.crossed, o.passed, o.unsteady, o.least_determinant, o.largest,
      o.opening);
  return text + o.first_is;
}

}  // namespace cleft::stress
