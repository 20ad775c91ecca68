// Cases whose displacements follow a formula, as a model of figures reads them.
#pragma once

#include <random>
#include <vector>

#include "explorer/analysis/figure_model.h"
#include "tests/interpolate/made_study.h"

namespace cleft {

/// Of moduli, depths and tensions anywhere in a box.
inline std::vector<CaseParameters> drawn(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> modulus(0.01, 0.04), depth(2, 5), tension(0.02, 0.05);
  std::vector<CaseParameters> list;
  for (int i = 0; i < count; ++i)
    list.push_back({{"tissue.young_modulus", modulus(random)},
                    {"cut.depth", depth(random)},
                    {"skin.prestress_v", tension(random)}});
  return list;
}

/// The cases of these values.
inline FigureModel::Cases cases_with(const std::vector<CaseParameters>& list,
                                     const std::vector<Figure>& figures) {
  FigureModel::Cases cases;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Field field = made_field(list[i]);
    std::vector<double> flat;
    for (const Figure& figure : figures)
      for (const Place& p : figure.places(field.parametrization().geometry())) {
        const Vec3 d = field.displacement(p.uvw, p.side, p.t);
        flat.insert(flat.end(), {d.x, d.y, d.z});
      }
    cases.displacements.conservativeResize(std::ssize(flat), static_cast<Eigen::Index>(i) + 1);
    cases.displacements.rightCols(1) = Eigen::Map<Eigen::VectorXd>(flat.data(), std::ssize(flat));
    cases.parameters.push_back(field.parameters);
    cases.parameters.back().set("cut.contact", "false");
    cases.parameters.back().set("skin.edges", "held");
  }
  cases.fit_errors.setZero(std::ssize(figures), cases.displacements.cols());
  return cases;
}

/// The same with the derivatives by the tissue's modulus, by central differences of the formula.
inline FigureModel::Cases cases_with_slopes(const std::vector<CaseParameters>& list,
                                            const std::vector<Figure>& figures) {
  const std::string name = "tissue.young_modulus";
  constexpr double step = 1e-4;  // of the modulus: off by its square, and by rounding over it
  FigureModel::Cases cases = cases_with(list, figures);
  std::vector<CaseParameters> more = list, less = list;
  for (CaseParameters& one : more) one[name] *= 1 + step;
  for (CaseParameters& one : less) one[name] *= 1 - step;
  cases.derivatives = cases_with(more, figures).displacements - cases_with(less, figures).displacements;
  for (std::size_t i = 0; i < list.size(); ++i) {
    cases.derivatives.col(static_cast<Eigen::Index>(i)) /= 2 * step * list[i].at(name);
    cases.derivative_of.push_back(static_cast<int>(i)), cases.by.push_back(name);
  }
  return cases;
}

}  // namespace cleft
