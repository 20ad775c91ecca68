#include "encoder/fit_store.h"

#include <algorithm>

namespace cleft {

namespace {

bool equal(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

bool equal(const std::vector<Sample>& a, const std::vector<Sample>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Sample& one, const Sample& other) {
    return equal(one.uvw, other.uvw) && one.side == other.side;
  });
}

bool equal(const CellCentres& a, const CellCentres& b) {
  return equal(a.samples, b.samples) && a.touches_plane == b.touches_plane && a.nodes == b.nodes &&
         a.first == b.first;
}

template <class Bases>
std::vector<double> knots_of(const Bases& bases, std::initializer_list<double> further) {
  std::vector<double> key;
  for (const BSplineBasis& basis : bases) {
    key.push_back(static_cast<double>(basis.knots().size()));
    key.insert(key.end(), basis.knots().begin(), basis.knots().end());
  }
  key.insert(key.end(), further);
  return key;
}

}  // namespace

FitStore::FitStore(const Series& series, std::shared_ptr<const Parametrization> parametrization, double bytes,
                   FrameFit::Hold hold)
    : series_(series), parametrization_(std::move(parametrization)), hold_(hold), left_(bytes) {}

std::shared_ptr<FitStore> FitStore::firm() {
  const std::lock_guard lock(mutex_);
  if (!firm_) {
    left_ /= 2;
    firm_ = std::make_shared<FitStore>(series_, parametrization_, left_, FrameFit::Hold::firm);
  }
  return firm_;
}

bool FitStore::serves(const Series& series) const {
  return series.nodes == series_.nodes && series.times == series_.times && series.arm == series_.arm &&
         series.round == series_.round && series.quadratic == series_.quadratic &&
         series.geometry == series_.geometry && equal(series.samples, series_.samples) &&
         equal(series.centres, series_.centres) && equal(series.middles, series_.middles) &&
         series.middles_hold == series_.middles_hold;
}

template <class Matrix, class Make>
std::shared_ptr<const Matrix> FitStore::find(Kept<Matrix>& kept, const Key& key, const Make& make) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = kept.find(key); found != kept.end()) return found->second;
  }
  auto made = std::make_shared<const Matrix>(make());
  const std::lock_guard lock(mutex_);
  if (const double bytes = made->bytes(); bytes <= left_ && kept.emplace(key, made).second) left_ -= bytes;
  return made;
}

std::shared_ptr<const FrameFit> FitStore::fit(const std::array<BSplineBasis, 3>& bases) {
  return find(fits_, knots_of(bases, {}), [&] { return FrameFit(series_, *parametrization_, bases, hold_); });
}

std::shared_ptr<const SpaceFit::Factor> FitStore::factor(const std::array<BSplineBasis, 3>& bases,
                                                         std::size_t frame, double strength,
                                                         const std::function<SpaceFit::Factor()>& make) {
  return find(factors_, knots_of(bases, {static_cast<double>(frame), strength}), make);
}

std::shared_ptr<const SeriesSystem> FitStore::system(const std::array<BSplineBasis, 4>& bases, int first,
                                                     double strength,
                                                     const std::function<SeriesSystem()>& make) {
  return find(systems_, knots_of(bases, {static_cast<double>(first), strength}), make);
}

}  // namespace cleft
