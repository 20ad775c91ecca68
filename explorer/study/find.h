// The cases of a study that fulfil a condition, the lengths cut, and the places along the cut.
//
// Names: gape (opening of the lips at a place, mm), t (length cut, mm), u (the place along the cut, mm),
// error (of the field as it is drawn, %), displacement (largest of the case, mm), and all numeric parameters.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "encoder/field/field.h"
#include "explorer/study/expression.h"
#include "explorer/study/study.h"

namespace cleft {

struct Finding {
  double first_t, last_t;       ///< lengths cut between which it holds somewhere (not always at all between)
  double least_u, greatest_u;   ///< places along the cut at which it holds for some of these lengths
  double best_t, best_u, gape;  ///< time and place of the widest gape among these, and that gape
  /// Confirmed at the nodes of the simulation in the nearest frame; none if the simulation was not kept.
  std::optional<bool> confirmed;
};

class Condition {
 public:
  /// Throws InputError as Expression does.
  explicit Condition(const std::string& text);

  /// Evaluates the field at 60 lengths cut and 80 places, as far as the condition needs them.
  std::optional<Finding> find(const Field& field) const;
  /// The same, confirmed from the case's snapshot, if that is next to its field file.
  std::optional<Finding> find(const Field& field, const std::string& snapshot) const;

 private:
  bool holds(std::vector<double>& values, double t, double u, double gape) const;

  Expression expression_;
};

/// The finding for case i of the study; none if the condition does not hold.
std::optional<Finding> find_in_case(const Condition& condition, const PublishedStudy& study, int i);

}  // namespace cleft
