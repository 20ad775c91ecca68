// How much of a figure's spread two parameters make together beyond what each makes alone, and how the figure
// depends on one of them where the other is small or large.
#pragma once

#include "explorer/analysis/sensitivity.h"

namespace cleft {

struct Interaction {
  std::size_t one = 0, other = 0;    ///< numbers of the parameters
  Estimate share;                    ///< of the variance: Sobol's index of second order
  std::vector<double> at, other_at;  ///< values of the two, increasing
  Eigen::MatrixXd mean;              ///< at.size() x other_at.size(): of the figure there, over all others
};

/// Of all pairs, the largest share first; of more than six parameters those six whose total and first indices
/// differ most. By Gauss's quadrature in the two parameters, over draws of the others; the intervals hold
/// what the draws and, with `alternatives`, the data leave open (sensitivities_of()).
std::vector<Interaction> interactions_of(const std::vector<InputDistribution>& distributions,
                                         const FigureFunction& figure, const AlternativeFigures& alternatives,
                                         const Sensitivities& found);

}  // namespace cleft
