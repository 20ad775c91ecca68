#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "params/consistency.h"
#include "tradeoff/chain.h"
#include "tradeoff/measures.h"
#include "tradeoff/opening.h"

namespace cleft {

namespace {

constexpr double finite_costs_more = 8;  // nodes of the finest mesh, for small strains over finite ones

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

/// Small and finite strains over what they cost, against finite ones in the finest mesh of fewer nodes.
Chart model_chart(const Parameters& parameters, const ChartOptions& options, const WorkFolder& work) {
  Chart chart{"solver.models", "Simulation: small and finite strains",
              "processor time to solve all frames, s", "largest error of the opening / largest opening"};
  Parameters p = parameters;
  p.model = Model::finite;
  try {
    check_consistency(p, "finite strains");
  } catch (const InputError&) {  // the finite model does not have what the case needs
    return chart;
  }
  const double least = finest(p, options.most_nodes / finite_costs_more);
  options.progress("solving with finite strains and elements of " + shortest(least) + " mm");
  const Opening truth = Chain(with_elements(p, least), work).opening();
  for (const Model model : {Model::small, Model::finite})
    for (const double factor : {1., 1.5, 2., 3., 4., 6.}) {
      const double size = factor * least;
      if (size > p.cut.length / 2 || (model == Model::finite && factor == 1)) continue;
      p.model = model;
      const std::string name = model == Model::small ? "small strains" : "finite strains";
      options.progress("solving with " + name + " and elements of " + shortest(size) + " mm");
      const Chain solved(with_elements(p, size), work);
      chart.points.push_back({name, "elements " + shortest(std::round(size * 1e4) / 1e4) + " mm",
                              solved.solve_seconds(), opening_error(solved.opening(), truth), false});
    }
  return chart;
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
  std::vector<Chart> charts = {panels.unknowns, panels.seconds};
  if (Chart models = model_chart(charted.parameters, options, work); !models.points.empty())
    charts.push_back(std::move(models));
  return charts;
}

}  // namespace cleft
