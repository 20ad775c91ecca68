// The solver's own laws of a case at one state of strain after another:
//   cleft-truth-law CASE.toml < STATES.csv > STRESSES.csv
// A state is kind,F_uu,F_uv,F_vu,F_vv,F_ww: "skin" or "tissue" and the deformation gradient, measured from
// the reference state. Its stress, MPa, is the first Piola-Kirchhoff stress P_uu,P_uv,P_vu,P_vv,P_ww (of the
// skin P_ww = 0); of the skin it includes the prestress. Then the tangent's component uuuu of the skin, by
// Green's strain.
#include <cstdio>
#include <exception>

#include "params/study.h"
#include "solver/material/regions.h"

using namespace cleft;

namespace {

struct Stress {
  Eigen::Matrix3d first_piola;
  double tangent = 0;
};

Stress of_skin(const FiniteSkin& law, const Eigen::Matrix3d& f) {
  const Eigen::Matrix2d plane = f.topLeftCorner<2, 2>(), right = plane.transpose() * plane;
  const SkinResponse r = law.at({(right(0, 0) - 1) / 2, (right(1, 1) - 1) / 2, right(0, 1)});
  Eigen::Matrix2d second;
  second << r.stress[0], r.stress[2], r.stress[2], r.stress[1];
  Stress stress{Eigen::Matrix3d::Zero(), r.tangent(0, 0)};
  stress.first_piola.topLeftCorner<2, 2>() = plane * second;
  return stress;
}

/// From the forces of a wedge whose deformation gradient is the same everywhere.
Stress of_tissue(const FiniteTissue& law, const Eigen::Matrix3d& f, bool mean) {
  const double c = 1 / std::sqrt(3.);
  std::vector<ReferencePoint> points;
  FiniteTissue::Displacements corners;
  corners << 0, 1, 0, 0, 1, 0,  //
      0, 0, 1, 0, 0, 1,         //
      0, 0, 0, 1, 1, 1;
  for (const double z : {(1 - c) / 2, (1 + c) / 2})
    for (const auto& [a, b] : {std::pair(1. / 6, 1. / 6), {2. / 3, 1. / 6}, {1. / 6, 2. / 3}}) {
      ReferencePoint& point = points.emplace_back();
      point.volume = 1. / 12;
      const double shape[3] = {1 - a - b, a, b}, along[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
      for (int i = 0; i < 3; ++i) {
        point.gradients.col(i) << along[i][0] * (1 - z), along[i][1] * (1 - z), -shape[i];
        point.gradients.col(3 + i) << along[i][0] * z, along[i][1] * z, shape[i];
      }
    }
  CellResponse response;
  law.response(points, (f - Eigen::Matrix3d::Identity()) * corners, Eigen::Matrix3d::Zero(), mean, false,
               response);
  Stress stress{Eigen::Matrix3d::Zero()};
  for (int node = 0; node < 6; ++node)  // forces times places add up to P times the volume, 1/2
    stress.first_piola += 2 * response.force.segment<3>(3 * node) * corners.col(node).transpose();
  return stress;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: cleft-truth-law CASE.toml < STATES.csv > STRESSES.csv\n");
    return 2;
  }
  const Parameters p = read_case(argv[1], {}).parameters;
  const FiniteMaterials materials(p);
  const bool mean = p.tissue.formulation == TissueFormulation::mean_dilatation;
  char kind[16];
  double uu, uv, vu, vv, ww;
  while (std::scanf(" %15[a-z],%lf,%lf,%lf,%lf,%lf", kind, &uu, &uv, &vu, &vv, &ww) == 6) {
    Eigen::Matrix3d f;
    f << uu, uv, 0, vu, vv, 0, 0, 0, ww;
    const Stress stress =
        kind[0] == 's' ? of_skin(materials.skin[0], f) : of_tissue(materials.tissue[0], f, mean);
    const Eigen::Matrix3d& s = stress.first_piola;
    std::printf("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", s(0, 0), s(0, 1), s(1, 0), s(1, 1), s(2, 2),
                stress.tangent);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "cleft-truth-law: error: %s\n", error.what());
  return 1;
}
