// What a case will take, from what measured ones took.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "params/parameters/parameters.h"
#include "params/run/study_index.h"

namespace cleft {

/// How large a case is, before it is run.
struct CaseSize {
  double nodes;    ///< of its mesh, about
  double columns;  ///< of nodes that the cut opens, about: a frame each, or a few
};
CaseSize size_of(const Parameters& parameters);

class Estimates {
 public:
  Estimates() = default;
  explicit Estimates(const std::map<std::string, IndexedCase>& measured);
  void add(const IndexedCase& measured);

  /// Seconds of one process, and bytes on disk: known once a case has been measured.
  std::optional<double> seconds(const CaseSize& size) const;
  std::optional<double> bytes(const CaseSize& size) const;
  /// Bytes that its solver and its encoder hold at most.
  double solver_memory(const CaseSize& size) const;
  double encoder_memory(const CaseSize& size) const;

 private:
  struct Ratio {
    double sum = 0, of = 0;
    std::optional<double> times(double work) const;
  };
  Ratio seconds_, bytes_;
  double memory_factor_ = 1;
};

}  // namespace cleft
