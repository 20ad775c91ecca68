#include "encoder/interpolate/features.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

const std::vector<std::string> prestress = {"skin.prestress_u", "skin.prestress_v", "skin.prestress_uv"};
// What the ratios are made of; a case that lacks one is none of the solver's.
const std::vector<std::string> needed = {
    "skin.prestress_u",     "skin.prestress_v",          "skin.prestress_uv",
    "skin.thickness",       "skin.young_modulus",        "tissue.young_modulus",
    "foundation.stiffness", "foundation.side_stiffness", "cut.length"};
// Measured in lengths of the cut.
const std::vector<std::string> lengths = {
    "cut.depth",   "patch.length", "patch.width",       "patch.height",    "cut.radius",
    "cut.spacing", "cut.branch",   "mesh.element_size", "mesh.cut_length", "mesh.cut_depth"};

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<std::string> varying_parameters(const std::vector<CaseParameters>& cases) {
  std::vector<std::string> names;
  for (const auto& [name, value] : cases.front())
    if (std::any_of(cases.begin(), cases.end(),
                    [&, &n = name, v = value](const CaseParameters& one) { return one.at(n) != v; }))
      names.push_back(name);
  return names;
}

std::vector<Features::Raw> Features::raw(const CaseParameters& p) const {
  std::vector<Raw> list;
  if (ours_) {
    const double E = p.at("tissue.young_modulus"), L = p.at("cut.length"), t = p.at("skin.thickness");
    list.push_back({"skin.young_modulus skin.thickness / (tissue.young_modulus cut.length)",
                    p.at("skin.young_modulus") * t / (E * L), true});
    for (const char* name : {"foundation.stiffness", "foundation.side_stiffness"})
      list.push_back({std::string(name) + " cut.length / tissue.young_modulus", p.at(name) * L / E, true});
    for (const std::string& name : lengths)
      if (p.contains(name)) list.push_back({name + " / cut.length", p.at(name) / L, true});
    if (loading_ == Loading::general)
      for (const std::string& name : prestress)
        list.push_back(
            {name + " skin.thickness / (tissue.young_modulus cut.length)", p.at(name) * t / (E * L), true});
    for (const std::string& name : varying_)
      if (!is_in(needed, name) && !is_in(lengths, name)) list.push_back({name, p.at(name), false});
  } else {
    for (const std::string& name : varying_) list.push_back({name, p.at(name), true});
  }
  return list;
}

Features::Features(const std::vector<CaseParameters>& cases, Loading loading)
    : loading_(loading), varying_(varying_parameters(cases)) {
  ours_ = std::all_of(needed.begin(), needed.end(),
                      [&](const std::string& name) { return cases.front().contains(name); });
  if (!ours_) loading_ = Loading::general;
  if (loading_ == Loading::superposed)
    for (const std::string& name : prestress)
      if (std::any_of(cases.begin(), cases.end(),
                      [&](const CaseParameters& one) { return one.at(name) != 0; }))
        components_.push_back(name);

  const auto first = raw(cases.front());
  const auto count = static_cast<Eigen::Index>(first.size()), n = static_cast<Eigen::Index>(cases.size());
  positive_.assign(first.size(), true);
  for (const CaseParameters& one : cases) {
    const auto values = raw(one);
    for (std::size_t f = 0; f < values.size(); ++f)
      positive_[f] = positive_[f] && values[f].logarithm && values[f].value > 0;
  }
  middle_.setZero(count), half_.setOnes(count);
  Eigen::MatrixXd table(n, count);
  for (Eigen::Index i = 0; i < n; ++i) table.row(i) = normalised(cases[i]).transpose();
  const Eigen::VectorXd least = table.colwise().minCoeff(), greatest = table.colwise().maxCoeff();
  middle_ = 0.5 * (least + greatest), half_ = 0.5 * (greatest - least);
  const auto constant = [&](Eigen::Index f) {
    return greatest[f] - least[f] <= 1e-9 * std::max(1., std::abs(middle_[f]));
  };
  for (Eigen::Index f = 0; f < count; ++f)
    if (constant(f)) half_[f] = 1;

  // One after the other: kept where it does not follow from those before.
  Eigen::MatrixXd kept = Eigen::MatrixXd::Ones(n, 1);
  std::vector<Eigen::VectorXd> combinations;
  for (Eigen::Index f = 0; f < count; ++f) {
    const Eigen::VectorXd column = (table.col(f).array() - middle_[f]) / half_[f];
    const Eigen::VectorXd combination = kept.colPivHouseholderQr().solve(column);
    if (!constant(f) && (kept * combination - column).cwiseAbs().maxCoeff() > 1e-6) {
      chosen_.push_back(static_cast<int>(f)), names_.push_back(first[f].name);
      kept.conservativeResize(Eigen::NoChange, kept.cols() + 1);
      kept.rightCols(1) = column;
    } else {
      left_out_.push_back(static_cast<int>(f)), combinations.push_back(combination);
    }
  }
  follows_.setZero(static_cast<Eigen::Index>(left_out_.size()), kept.cols());
  for (std::size_t f = 0; f < left_out_.size(); ++f)
    follows_.row(static_cast<Eigen::Index>(f)).head(combinations[f].size()) = combinations[f].transpose();
}

Eigen::VectorXd Features::normalised(const CaseParameters& parameters) const {
  const auto values = raw(parameters);
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  for (std::size_t f = 0; f < values.size(); ++f) {
    const auto i = static_cast<Eigen::Index>(f);
    const double value = positive_[f] ? std::log(std::max(values[f].value, 1e-300)) : values[f].value;
    result[i] = (value - middle_[i]) / half_[i];
  }
  return result;
}

Eigen::VectorXd Features::at(const CaseParameters& parameters) const {
  return normalised(parameters)(chosen_);
}

double Features::off(const CaseParameters& parameters) const {
  if (left_out_.empty()) return 0;
  const Eigen::VectorXd all = normalised(parameters);
  Eigen::VectorXd kept(follows_.cols());
  kept << 1, all(chosen_);
  const double distance = (follows_ * kept - all(left_out_)).norm();
  return distance > 1e-6 ? distance : 0;
}

Eigen::VectorXd Features::load(const CaseParameters& p) const {
  if (components_.empty()) return Eigen::VectorXd::Ones(1);
  Eigen::VectorXd q(static_cast<Eigen::Index>(components_.size()));
  for (std::size_t k = 0; k < components_.size(); ++k) q[static_cast<Eigen::Index>(k)] = p.at(components_[k]);
  return q.norm() > 0 ? Eigen::VectorXd(q / q.norm()) : q;
}

Features::Slope Features::slope(const CaseParameters& parameters, const std::string& name) const {
  // Central differences of closed forms: off by 1e-8 or so, far below any fit.
  constexpr double part = 1e-4;
  double unit = std::abs(parameters.at(name));
  if (unit == 0 && is_in(prestress, name))
    for (const std::string& other : prestress) unit = std::max(unit, std::abs(parameters.at(other)));
  Slope slope;
  slope.step = part * (unit > 0 ? unit : 1);
  CaseParameters less = parameters, more = parameters;
  less[name] -= slope.step, more[name] += slope.step;
  const double width = 2 * slope.step;
  slope.features = (at(more) - at(less)) / width, slope.load = (load(more) - load(less)) / width;
  slope.log_scale = std::log(scale(more) / scale(less)) / width;
  slope.leaves = off(more) > 0 || off(less) > 0;
  return slope;
}

double Features::scale(const CaseParameters& p) const {
  if (!ours_) return 1;
  Eigen::Vector3d q;
  for (int k = 0; k < 3; ++k) q[k] = p.at(prestress[k]) * p.at("skin.thickness");
  return q.norm() / p.at("tissue.young_modulus");
}

}  // namespace cleft
