// What fits need that depends on the places and times of data alone, kept for further series of the same.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "encoder/frame_fit.h"
#include "encoder/series_system.h"

namespace cleft {

/// Cases of a study often have the same mesh: then their fits have the same matrices, and differ in the
/// right-hand sides. Results do not depend on whether a matrix was kept. All functions may be called from
/// several threads at once.
class FitStore {
 public:
  /// Of the places and times of `series`, to which it keeps a reference; its displacements, quantities and
  /// derivatives may be cleared. At most `bytes` of factors are kept, none of them for 0.
  FitStore(const Series& series, std::shared_ptr<const Parametrization> parametrization, double bytes = 0,
           FrameFit::Hold hold = FrameFit::Hold::as_usual);

  /// Whether another series has the same places, times and geometry, bit for bit.
  bool serves(const Series& series) const;
  const std::shared_ptr<const Parametrization>& parametrization() const { return parametrization_; }
  /// A store of fits that edges hold firmly, made once; it takes half of the bytes that are left.
  std::shared_ptr<FitStore> firm();

  std::shared_ptr<const FrameFit> fit(const std::array<BSplineBasis, 3>& bases);
  /// The Cholesky factor of the normal matrix of a frame, which `make` makes.
  std::shared_ptr<const SpaceFit::Factor> factor(const std::array<BSplineBasis, 3>& bases, std::size_t frame,
                                                 double strength,
                                                 const std::function<SpaceFit::Factor()>& make);
  /// The system of all frames from `first` on, 0 or 1, which `make` makes.
  std::shared_ptr<const SeriesSystem> system(const std::array<BSplineBasis, 4>& bases, int first,
                                             double strength, const std::function<SeriesSystem()>& make);

 private:
  using Key = std::vector<double>;  // knots, and what else a matrix depends on
  template <class Matrix>
  using Kept = std::map<Key, std::shared_ptr<const Matrix>>;

  template <class Matrix, class Make>
  std::shared_ptr<const Matrix> find(Kept<Matrix>& kept, const Key& key, const Make& make);

  const Series& series_;
  std::shared_ptr<const Parametrization> parametrization_;
  FrameFit::Hold hold_;
  double left_;  // bytes that may be kept in addition
  std::shared_ptr<FitStore> firm_;
  std::mutex mutex_;
  Kept<FrameFit> fits_;
  Kept<SpaceFit::Factor> factors_;
  Kept<SeriesSystem> systems_;
};

}  // namespace cleft
