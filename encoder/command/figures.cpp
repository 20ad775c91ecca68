#include "encoder/command/figures.h"

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>

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
  for (std::size_t q = 0; q < field.quantities.size(); ++q) {
    double error = 0, spline_error = 0, between = 0;
    for (const Field& piece : pieces)
      error = std::max(error, piece.quantities[q].error),
      spline_error = std::max(spline_error, piece.quantities[q].spline_error),
      between = std::max(between, piece.quantities[q].between_nodes);
    figures["quantities"].push_back({{"name", field.quantities[q].name},
                                     {"scale", field.quantities[q].scale},
                                     {"error", error},
                                     {"spline_error", spline_error},
                                     {"between_nodes", between}});
  }
  for (const ParameterDerivative& one : field.by_parameter)
    figures["by_parameter"].push_back({{"parameter", one.parameter}, {"error", one.error}});
  return figures;
}

}  // namespace cleft
