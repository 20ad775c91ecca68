#include "explorer/analysis/figure.h"

#include <algorithm>

#include "base/call_text.h"
#include "base/error.h"

namespace cleft {

namespace {

constexpr int along_cut = 60, along_skin = 24, across_skin = 9;

Eigen::Vector3d point(const Eigen::Ref<const Eigen::VectorXd>& displacements, Eigen::Index k) {
  return displacements.segment<3>(3 * k);
}

/// The lips, one after the other.
void add_lips(std::vector<Place>& places, double u, double t) {
  for (const Side side : {Side::left, Side::right}) places.push_back({{u, 0, 0}, side, t});
}

/// A part of the skin around the cut, finer next to it.
void add_skin(std::vector<Place>& places, const FieldGeometry& g, double t) {
  for (int i = 0; i <= along_skin; ++i)
    for (int j = 0; j < across_skin; ++j)
      for (const Side side : {Side::left, Side::right}) {
        const double edge = side == Side::left ? g.domain[1].front : g.domain[1].back,
                     part = 1. * j / across_skin;
        places.push_back(
            {{g.cut.start + g.cut.length * (i / (along_skin / 2.) - 0.5), edge * part * part, 0}, side, t});
      }
}

}  // namespace

Figure::Figure(const std::string& text) : text_(text) {
  const auto fail = [&](const std::string& why) {
    throw InputError(
        "figure '" + text + "': " + why +
        "; expected gape, gape(u), gape(u, t), field, displacement, displacement(u, v, w), or u, v or w in "
        "place of displacement for a component");
  };
  const CallText call = parse_call(text, "figure '" + text + "'");
  const std::string& name = call.name;
  at_ = call.numbers.value_or(std::vector<double>{});
  const std::size_t given = at_.size();
  if (name == "gape") {
    if (given > 2) fail("a gape has a place u along the cut and a length t that is cut, not more");
    kind_ = given == 0 ? Kind::widest : Kind::opening;
  } else if (name == "displacement" || name == "u" || name == "v" || name == "w") {
    const bool whole = name == "displacement";
    if (!(given == 3 || given == 4 || (whole && given == 0))) fail("a point has three coordinates u, v, w");
    kind_ = !whole ? Kind::component : given == 0 ? Kind::largest : Kind::distance;
    component_ = name == "u" ? 0 : name == "v" ? 1 : 2;
  } else if (name == "field") {
    if (given > 0) fail("the field has no place");
    kind_ = Kind::field;
  } else {
    fail("there is no figure '" + name + "'");
  }
}

std::vector<Place> Figure::places(const FieldGeometry& g) const {
  const CanonicalCut& cut = g.cut;
  const double all = g.domain[3].back;
  std::vector<Place> places;
  switch (kind_) {
    case Kind::widest:
      for (int i = 1; i < along_cut; ++i) add_lips(places, cut.start + cut.length * i / along_cut, all);
      break;
    case Kind::opening:
      add_lips(places, at_[0], at_.size() > 1 ? at_[1] : all);
      break;
    case Kind::largest:
      add_skin(places, g, all);
      break;
    case Kind::field:
      for (const double part : {0.5, 1.})
        add_skin(places, g, g.domain[3].front + part * (all - g.domain[3].front));
      break;
    default:
      places.push_back(
          {{at_[0], at_[1], at_[2]}, at_[1] < 0 ? Side::left : Side::right, at_.size() > 3 ? at_[3] : all});
  }
  for (Place& place : places) {
    place.uvw.x = std::clamp(place.uvw.x, g.domain[0].front, g.domain[0].back);
    place.t = std::clamp(place.t, g.domain[3].front, all);
  }
  return places;
}

double Figure::of(const Eigen::Ref<const Eigen::VectorXd>& displacements) const {
  return of_linear_part(linear_part(displacements));
}

Eigen::MatrixXd Figure::linear_part(const Eigen::Ref<const Eigen::MatrixXd>& displacements) const {
  if (kind_ == Kind::component) return displacements.row(component_);
  if (kind_ != Kind::widest && kind_ != Kind::opening) return displacements;
  Eigen::MatrixXd openings(displacements.rows() / 2, displacements.cols());
  for (Eigen::Index k = 0; k < openings.rows(); k += 3)  // of the left lip, then of the right one
    openings.middleRows<3>(k) = displacements.middleRows<3>(2 * k + 3) - displacements.middleRows<3>(2 * k);
  return openings;
}

double Figure::of_linear_part(const Eigen::Ref<const Eigen::VectorXd>& part) const {
  if (kind_ == Kind::component) return part[0];
  double most = 0;
  for (Eigen::Index k = 0; k < part.size() / 3; ++k) most = std::max(most, point(part, k).norm());
  return most;
}

double Figure::distance(const Eigen::Ref<const Eigen::VectorXd>& a,
                        const Eigen::Ref<const Eigen::VectorXd>& b) {
  double most = 0;
  for (Eigen::Index k = 0; k < a.size() / 3; ++k) most = std::max(most, (point(a, k) - point(b, k)).norm());
  return most;
}

double Figure::of(const Field& field) const { return of(displacements(field)); }

Eigen::VectorXd Figure::displacements(const Field& field) const {
  const std::vector<Place> at = places(field.parametrization().geometry());
  std::vector<Vec3> found(at.size());
  field.displacements(at, found);
  Eigen::VectorXd flat(static_cast<Eigen::Index>(3 * at.size()));
  for (std::size_t k = 0; k < at.size(); ++k)
    for (int c = 0; c < 3; ++c) flat[static_cast<Eigen::Index>(3 * k) + c] = found[k][c];
  return flat;
}

}  // namespace cleft
