#include "encoder/command/figures.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "base/h5/h5.h"
#include "base/text.h"
#include "encoder/field/blended_field.h"
#include "encoder/field/file/field_record.h"

namespace cleft {

namespace {

Json control_points_of(const Field& field) {
  return {field.basis(0).size(), field.basis(1).size(), field.basis(2).size(), field.basis(3).size()};
}

}  // namespace

Json figures_of(const std::vector<Field>& pieces, std::size_t nodes, const std::string& out) {
  const Field& field = pieces.front();
  const double bytes = static_cast<double>(std::filesystem::file_size(out));
  FitReport report = report_of(pieces);
  const double raw = raw_bytes(field) * static_cast<double>(nodes) / report.nodes;
  report.nodes = static_cast<double>(nodes);
  Json figures = shown(report);
  double fit_seconds = 0, measure_seconds = 0;
  for (const Field& piece : pieces)
    fit_seconds += piece.report.fit_seconds, measure_seconds += piece.report.measure_seconds;
  figures.update({{"control_points", control_points_of(field)},
                  {"fit_seconds", fit_seconds},
                  {"measure_seconds", measure_seconds},
                  {"quantum_mm", field.quantum},
                  {"parametrization", field.parametrization().name()},
                  {"bytes", bytes},
                  {"ratio_to_32_bit", raw / bytes}});
  if (field.tissue) {
    figures["tissue_below_cut"]["foundation_n_per_mm3"] = field.tissue->foundation;
    for (const TissueLayerBelow& layer : field.tissue->layers)
      figures["tissue_below_cut"]["layers"].push_back({{"young_modulus_mpa", layer.young_modulus},
                                                       {"poisson_ratio", layer.poisson_ratio},
                                                       {"height_mm", layer.height}});
  }
  for (std::size_t p = 0; p < pieces.size() && pieces.size() > 1; ++p)
    figures["pieces"].push_back({{"nodes", pieces[p].report.nodes},
                                 {"control_points", control_points_of(pieces[p])},
                                 {"spline_error", pieces[p].report.spline_error},
                                 {"gape_error", pieces[p].report.gape_error}});
  figures["versions"] = {
      {"cleft", producer()},
      {"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                    std::to_string(EIGEN_MINOR_VERSION)},
      {"HDF5", h5::version()}};
  for (const Quantity& quantity : field.quantities)
    figures["quantities"].push_back({{"name", quantity.name},
                                     {"scale", quantity.scale},
                                     {"error", quantity.error},
                                     {"spline_error", quantity.spline_error}});
  for (const ParameterDerivative& one : field.by_parameter)
    figures["by_parameter"].push_back({{"parameter", one.parameter}, {"error", one.error}});
  return figures;
}

std::string warning_of(const Field& field, const Series& series, const EncodeOptions& options) {
  const FitReport& report = field.report;
  const double scale = report.largest_displacement,
               limit = options.tolerance_of("displacement").limit(scale > 0 ? scale : 1);
  if (options.rung || report.spline_error * scale <= 2 * limit) return "";
  const Vec3& at = series.node_samples()[static_cast<std::size_t>(report.worst_node)].uvw;
  const CanonicalCut& cut = field.cut();
  const double tip = field.parametrization().geometry().tip.at(report.worst_time);
  const bool beside_front = std::min(std::abs(at.x - tip), std::abs(at.x - cut.start)) < 0.1 * cut.length;
  const auto digits = [](double x) {
    std::ostringstream text;
    text << std::setprecision(3) << x;
    return text.str();
  };
  const std::string cause =
      cut.length == 0 ? "the field has no break; where the data jump, import them with the plane of the jump "
                        "(cleft import "
                        "--break), or with a smaller --open-at"
      : beside_front
          ? "beside the front of the break the knots are as dense as the nodes allow; refine the mesh "
            "there, or write more frames"
      : at.y == 0 ? "on the break, away from its ends; see whether all of it opens as one (cleft info, cleft "
                    "import --open-at)"
                  : "away from the break the nodes do not determine more knots; refine the mesh there";
  return "the spline, which is what is drawn between the nodes, is off by " +
         digits(100 * report.spline_error) + " % of the largest displacement, " +
         digits(report.spline_error * scale / limit) + " times the tolerance, at node " +
         shortest(report.worst_node) + " (u = " + digits(at.x) + ", v = " + digits(at.y) +
         ", w = " + digits(at.z) + " mm) and t = " + digits(report.worst_time) + ": " + cause;
}

}  // namespace cleft
