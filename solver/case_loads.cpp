#include "solver/case_loads.h"

#include "params/parameters/table.h"

namespace cleft {

namespace {

Eigen::Vector3d prestress(const Parameters& p) {
  return {p.skin.prestress.uu, p.skin.prestress.vv, p.skin.prestress.uv};
}

/// Of the largest load of an equal prestress in another direction: less is rounding, and of the places of
/// nodes, and moves nothing.
constexpr double least_load = 1e-6;

double largest_on_all_ranks(const Eigen::Ref<const Eigen::MatrixXd>& values, MPI_Comm communicator) {
  double largest = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0;
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return largest;
}

bool is_linear(const Parameters& p) { return !p.cut.contact; }

}  // namespace

std::array<std::string, 3> prestress_names() {
  const Parameters p;
  const Prestress& sigma = p.skin.prestress;
  return {row_of(p, sigma.uu).name, row_of(p, sigma.vv).name, row_of(p, sigma.uv).name};
}

CaseLoads::CaseLoads(const PatchSystem& system, const std::vector<const Parameters*>& parameters,
                     bool with_units, bool every_unit)
    : by_units(with_units) {
  std::vector<Eigen::VectorXd> columns;
  if (by_units) {
    Eigen::Vector3d used = Eigen::Vector3d::Constant(every_unit ? 1. : 0.);
    for (const Parameters* p : parameters)
      if (is_linear(*p)) used += prestress(*p).cwiseAbs();
    for (int d = 0; d < 3; ++d)
      if (used(d) > 0) {
        units.push_back(d);
        columns.emplace_back(system.unit_loads().col(d));
      }
  }
  parts.emplace_back(0, columns.size());
  contact.assign(columns.size(), false);
  for (const Parameters* p : parameters) {
    Case& member = cases.emplace_back();
    if (by_units && is_linear(*p)) continue;
    columns.emplace_back(system.load(p->skin));
    contact.push_back(!is_linear(*p));
    if (by_units) {
      member.part = parts.size();
      parts.emplace_back(columns.size() - 1, columns.size());
    } else {
      parts.front().second = columns.size();
    }
  }
  loads.resize(system.owned(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) loads.col(static_cast<Eigen::Index>(i)) = columns[i];
  Eigen::Index own = static_cast<Eigen::Index>(units.size());
  const double of_unit = largest_on_all_ranks(system.unit_loads(), system.communicator());
  for (std::size_t c = 0; c < cases.size(); ++c) {
    Case& member = cases[c];
    member.share = Eigen::VectorXd::Zero(loads.cols());
    if (!by_units || !is_linear(*parameters[c]))
      member.share(own++) = 1;
    else
      for (std::size_t i = 0; i < units.size(); ++i)
        member.share(static_cast<Eigen::Index>(i)) = prestress(*parameters[c])(units[i]);
    member.largest_load = largest_on_all_ranks(loads * member.share, system.communicator());
    if (member.largest_load <= least_load * of_unit * prestress(*parameters[c]).cwiseAbs().maxCoeff())
      member.largest_load = 0, member.share.setZero();
  }
}

}  // namespace cleft
