#include "encoder/interpolate/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "encoder/interpolate/least_squares.h"

namespace cleft {

namespace {

constexpr double Prestress::*const prestress[] = {&Prestress::uu, &Prestress::vv, &Prestress::uv};

/// What the ratios are made of; a case that lacks one is none of the solver's.
std::array<const double*, 9> needed(const Parameters& p) {
  const Prestress& sigma = p.skin.prestress;
  return {&sigma.uu,
          &sigma.vv,
          &sigma.uv,
          &p.skin.thickness,
          &p.skin.young_modulus,
          &p.tissue.young_modulus,
          &p.foundation.stiffness,
          &p.foundation.side_stiffness,
          &p.cut.length};
}

/// Measured by its length: products, which may be negative.
std::array<const double*, 4> curvatures(const Parameters& p) {
  return {&p.cut.curvature, &p.skin.curvature_u, &p.skin.curvature_v, &p.skin.curvature_uv};
}

/// Measured in lengths of the cut.
std::array<const double*, 10> lengths(const Parameters& p) {
  return {&p.cut.depth,   &p.patch.length, &p.patch.width,       &p.patch.height,    &p.cut.radius,
          &p.cut.spacing, &p.cut.branch,   &p.mesh.element_size, &p.mesh.cut_length, &p.mesh.cut_depth};
}

template <class List>
bool is_in(const List& members, const void* member) {
  return std::find(members.begin(), members.end(), member) != members.end();
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text.append(text.empty() ? "" : " ").append(name);
  return text;
}

/// The member of a name; null where the name is none of the table's.
const void* member_of(const RecordedParameters& p, const std::string& name) {
  const Parameter* row = find_parameter(name);
  return row ? row->address(*p) : nullptr;
}

}  // namespace

bool is_prestress(const RecordedParameters& p, const void* member) {
  const Prestress& sigma = p->skin.prestress;
  return std::any_of(std::begin(prestress), std::end(prestress),
                     [&](double Prestress::*component) { return &(sigma.*component) == member; });
}

bool is_prestress(const RecordedParameters& p, const std::string& name) {
  return is_prestress(p, member_of(p, name));
}

std::vector<std::string> varying_parameters(const std::vector<RecordedParameters>& cases) {
  std::vector<std::string> names;
  for (const auto& [name, value] : cases.front().numbers())
    if (std::any_of(cases.begin(), cases.end(), [&, &n = name, v = value](const RecordedParameters& one) {
          return one.number(n).value() != v;
        }))
      names.push_back(name);
  return names;
}

std::vector<Features::Ratio> Features::ratios_of(const RecordedParameters& p) const {
  std::vector<Ratio> list;
  if (ours_) {
    const std::string &tissue = p.name_of(p->tissue.young_modulus), &cut = p.name_of(p->cut.length),
                      &skin = p.name_of(p->skin.thickness);
    const auto add = [&](const std::vector<std::string>& over, const std::vector<std::string>& under,
                         bool logarithm) {
      std::string name = joined(over);
      if (!under.empty()) name += " / " + (under.size() > 1 ? "(" + joined(under) + ")" : under.front());
      list.push_back({name, over, under, logarithm});
    };
    add({p.name_of(p->skin.young_modulus), skin}, {tissue, cut}, true);
    for (const double* k : {&p->foundation.stiffness, &p->foundation.side_stiffness})
      add({p.name_of(*k), cut}, {tissue}, true);
    for (const double* length : lengths(*p))
      if (p.has(*length)) add({p.name_of(*length)}, {cut}, true);
    for (const double* curvature : curvatures(*p))
      if (p.has(*curvature)) add({p.name_of(*curvature), cut}, {}, false);
    if (const double& rate = p->cut.curvature_rate; p.has(rate)) add({p.name_of(rate), cut, cut}, {}, false);
    if (loading_ == Loading::general)
      for (const auto component : prestress)
        add({p.name_of(p->skin.prestress.*component), skin}, {tissue, cut}, true);
    for (const std::string& name : varying_)
      if (const void* member = member_of(p, name);
          !is_in(needed(*p), member) && !is_in(lengths(*p), member) && !is_in(curvatures(*p), member) &&
          member != &p->cut.curvature_rate)
        list.push_back({name, {name}, {}, false});
  } else {
    for (const std::string& name : varying_) list.push_back({name, {name}, {}, true});
  }
  return list;
}

std::vector<double> Features::raw(const RecordedParameters& p) const {
  const auto product = [&](const std::vector<std::string>& names) {
    double value = 1;
    for (const std::string& name : names) value *= p.number(name).value();
    return value;
  };
  std::vector<double> values;
  for (const Ratio& ratio : ratios_) values.push_back(product(ratio.over) / product(ratio.under));
  return values;
}

Features::Features(const std::vector<RecordedParameters>& cases, Loading loading)
    : loading_(loading), varying_(varying_parameters(cases)) {
  const auto list = needed(*cases.front());
  ours_ =
      std::all_of(list.begin(), list.end(), [&](const double* member) { return cases.front().has(*member); });
  if (!ours_) loading_ = Loading::general;
  if (loading_ == Loading::superposed)
    for (const auto component : prestress)
      if (std::any_of(cases.begin(), cases.end(),
                      [&](const RecordedParameters& one) { return one->skin.prestress.*component != 0; }))
        components_.push_back(component);

  ratios_ = ratios_of(cases.front());
  const auto count = static_cast<Eigen::Index>(ratios_.size()), n = static_cast<Eigen::Index>(cases.size());
  positive_.assign(ratios_.size(), true);
  for (const RecordedParameters& one : cases) {
    const auto values = raw(one);
    for (std::size_t f = 0; f < values.size(); ++f)
      positive_[f] = positive_[f] && ratios_[f].logarithm && values[f] > 0;
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
    const Eigen::VectorXd combination = least_squares(kept, column).solution;
    if (!constant(f) && (kept * combination - column).cwiseAbs().maxCoeff() > 1e-6) {
      chosen_.push_back(static_cast<int>(f)), names_.push_back(ratios_[f].name);
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

Eigen::VectorXd Features::normalised(const RecordedParameters& parameters) const {
  const auto values = raw(parameters);
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  for (std::size_t f = 0; f < values.size(); ++f) {
    const auto i = static_cast<Eigen::Index>(f);
    const double value = positive_[f] ? std::log(std::max(values[f], 1e-300)) : values[f];
    result[i] = (value - middle_[i]) / half_[i];
  }
  return result;
}

Eigen::VectorXd Features::at(const RecordedParameters& parameters) const {
  return normalised(parameters)(chosen_);
}

double Features::off(const RecordedParameters& parameters) const {
  if (left_out_.empty()) return 0;
  const Eigen::VectorXd all = normalised(parameters);
  Eigen::VectorXd kept(follows_.cols());
  kept << 1, all(chosen_);
  const double distance = (follows_ * kept - all(left_out_)).norm();
  return distance > 1e-6 ? distance : 0;
}

Eigen::VectorXd Features::load(const RecordedParameters& p) const {
  if (components_.empty()) return Eigen::VectorXd::Ones(1);
  Eigen::VectorXd q(static_cast<Eigen::Index>(components_.size()));
  for (std::size_t k = 0; k < components_.size(); ++k)
    q[static_cast<Eigen::Index>(k)] = p->skin.prestress.*components_[k];
  return q.norm() > 0 ? Eigen::VectorXd(q / q.norm()) : q;
}

Features::Slope Features::slope(const RecordedParameters& parameters, const std::string& name) const {
  // Central differences of closed forms: off by 1e-8 or so, far below any fit.
  constexpr double part = 1e-4;
  const double at_case = parameters.number(name).value();
  double unit = std::abs(at_case);
  if (unit == 0 && is_prestress(parameters, name))
    for (const auto other : prestress) unit = std::max(unit, std::abs(parameters->skin.prestress.*other));
  Slope slope;
  slope.step = part * (unit > 0 ? unit : 1);
  RecordedParameters less = parameters, more = parameters;
  less.set(name, at_case - slope.step), more.set(name, at_case + slope.step);
  const double width = 2 * slope.step;
  slope.features = (at(more) - at(less)) / width, slope.load = (load(more) - load(less)) / width;
  slope.log_scale = std::log(scale(more) / scale(less)) / width;
  slope.leaves = off(more) > 0 || off(less) > 0;
  return slope;
}

double Features::scale(const RecordedParameters& p) const {
  if (!ours_) return 1;
  const auto [uu, vv, uv] = p->skin.prestress;
  const Eigen::Vector3d q = p->skin.thickness * Eigen::Vector3d(uu, vv, uv);
  return q.norm() / p->tissue.young_modulus;
}

}  // namespace cleft
