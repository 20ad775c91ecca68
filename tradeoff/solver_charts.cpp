#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "params/consistency.h"
#include "tradeoff/chain.h"
#include "tradeoff/measures.h"
#include "tradeoff/opening.h"

namespace cleft {

namespace {

Parameters with_elements(Parameters p, double size) {
  p.mesh.element_size = size;
  return p;
}

/// The finest element whose mesh has at most so many nodes, at most half as long as the case's own.
double finest(const Parameters& parameters, double most_nodes) {
  double size = parameters.mesh.element_size / 2;
  while (estimated_nodes(with_elements(parameters, size)) > most_nodes) size *= 1.1;
  return size;
}

struct SolverPanels {
  Chart unknowns{"solver.unknowns", "Simulation: error over unknowns", "unknowns",
                 "largest error of the opening / largest opening"};
  Chart seconds{"solver.seconds", "Simulation: error over time", "time to solve all frames, s",
                "largest error of the opening / largest opening"};

  void add(const std::string& series, double size, const Chain& solved, double error, bool standard) {
    const std::string setting = "elements " + shortest(std::round(size * 1e4) / 1e4) + " mm";
    unknowns.points.push_back({series, setting, solved.unknowns(), error, standard});
    seconds.points.push_back({series, setting, solved.wall_seconds(), error, standard});
  }
};

/// A slit in a sheet under the same tension on all sides: its middle opens by 4 a tension / E (a: half its
/// length) where the sheet has no end (Westergaard 1939). Here it ends ten slits away, and the tissue below
/// is next to nothing.
Parameters slit(double half_length, double size) {
  Parameters p;
  p.patch = {40 * half_length, 40 * half_length, 2};
  p.cut.length = 2 * half_length, p.cut.depth = 1;
  p.mesh = {.element_size = size, .grading = 1.15};
  p.skin.prestress.uu = p.skin.prestress.vv = 0.01;
  p.tissue.young_modulus = 1e-6, p.foundation = {1e-9, 100};
  return p;
}

void add_slit(SolverPanels& panels, const ChartOptions& options, const WorkFolder& work, MeshFront front) {
  constexpr double a = 8;
  for (const double parts : {2, 4, 8, 16}) {
    options.progress("solving a slit with elements of " + shortest(a / parts) + " mm");
    Parameters p = slit(a, a / parts);
    p.mesh.front = front;
    const Chain solved(p, work);
    const double expected = 4 * a * p.skin.prestress.vv / p.skin.young_modulus;
    panels.add(front == MeshFront::effective ? "slit, closed form" : "slit that ends at nodes, closed form",
               a / parts, solved, std::abs(norm(solved.opening().at(a, 2 * a)) / expected - 1), false);
  }
}

}  // namespace

std::vector<Chart> solver_charts(const ChartedCase& charted, const ChartOptions& options,
                                 const WorkFolder& work) {
  const double own = charted.parameters.mesh.element_size,
               least = finest(charted.parameters, options.most_nodes);
  std::vector<double> sizes;
  for (const double factor : {1.5, 2., 3., 4., 6.}) sizes.push_back(factor * least);
  if (own > 1.2 * least) sizes.push_back(own);
  std::sort(sizes.begin(), sizes.end());
  std::erase_if(sizes,
                [&](double size) { return size > charted.parameters.cut.length / 2; });  // no node to open
  options.progress("solving with elements of " + shortest(least) + " mm");
  const Opening truth = Chain(with_elements(charted.parameters, least), work).opening();
  SolverPanels panels;
  for (const double size : sizes) {
    options.progress("solving with elements of " + shortest(size) + " mm");
    const Chain solved(with_elements(charted.parameters, size), work);
    panels.add("against elements of " + shortest(std::round(least * 100) / 100) + " mm", size, solved,
               opening_error(solved.opening(), truth), size == own);
  }
  for (const MeshFront front : {MeshFront::effective, MeshFront::nodes})
    add_slit(panels, options, work, front);
  return {panels.unknowns, panels.seconds};
}

}  // namespace cleft
