#include "encoder/field/parametrization.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "encoder/field/parametrization/fixed.h"
#include "encoder/field/parametrization/front.h"
#include "encoder/field/parametrization/tip.h"

namespace cleft {

double TipPath::at(double t) const {
  if (t <= times.front()) return positions.front();
  if (t >= times.back()) return positions.back();
  const auto i = std::upper_bound(times.begin(), times.end(), t) - times.begin();
  return positions[i - 1] + (t - times[i - 1]) * speed(t);
}

double TipPath::speed(double t) const {
  if (times.size() < 2) return 0;
  const auto last = static_cast<std::ptrdiff_t>(times.size()) - 1;
  const auto i =
      std::clamp<std::ptrdiff_t>(std::upper_bound(times.begin(), times.end(), t) - times.begin(), 1, last);
  return (positions[i] - positions[i - 1]) / (times[i] - times[i - 1]);
}

double TipPath::passes(double u) const {
  if (u <= positions.front()) return times.front();
  const auto i = std::lower_bound(positions.begin(), positions.end(), u) - positions.begin();
  if (i == static_cast<std::ptrdiff_t>(positions.size())) return std::numeric_limits<double>::infinity();
  return times[i - 1] +
         (u - positions[i - 1]) / (positions[i] - positions[i - 1]) * (times[i] - times[i - 1]);
}

namespace {

template <class T>
std::shared_ptr<const Parametrization> make(FieldGeometry geometry) {
  return std::make_shared<const T>(std::move(geometry));
}

struct Entry {
  const char* name;
  std::shared_ptr<const Parametrization> (*make)(FieldGeometry);
};
constexpr Entry entries[] = {{FrontParametrization::id, make<FrontParametrization>},
                             {TipParametrization::id, make<TipParametrization>},
                             {FixedParametrization::id, make<FixedParametrization>}};

}  // namespace

FieldGeometry standing(FieldGeometry geometry) {
  std::vector<double>& tip = geometry.tip.positions;
  const double end = std::clamp(geometry.cut.start + geometry.cut.length, tip.back(),
                                std::max(geometry.domain[0].back, tip.back()));
  std::fill(tip.begin(), tip.end(), end);
  return geometry;
}

std::shared_ptr<const Parametrization> make_parametrization(const std::string& name, FieldGeometry geometry) {
  for (const Entry& entry : entries)
    if (name == entry.name) return entry.make(std::move(geometry));
  throw InputError("parametrisation '" + name + "': must be front, tip or fixed");
}

const std::vector<std::string>& parametrization_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Entry& entry : entries) list.push_back(entry.name);
    return list;
  }();
  return names;
}

}  // namespace cleft
