#include "encoder/command/warnings.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "base/text.h"

namespace cleft {

namespace {

constexpr double worth_a_warning = 2;  // tolerances
constexpr double folds = 2.6;          // radians, of a path that comes back

std::string digits(double x) {
  std::ostringstream text;
  text << std::setprecision(3) << x;
  return text.str();
}

std::string percent(double part) { return digits(100 * part) + " %"; }

struct Place {
  double node, t;
};

const Vec3& at(const Series& series, const Place& place) {
  return series.node_samples()[static_cast<std::size_t>(place.node)].uvw;
}

std::string told(const Series& series, const Place& place) {
  const Vec3& p = at(series, place);
  return " at node " + shortest(place.node) + " (u = " + digits(p.x) + ", v = " + digits(p.y) +
         ", w = " + digits(p.z) + " mm) and t = " + digits(place.t) + ": ";
}

constexpr const char* no_solid =
    "the series has only the surface of a body, which does not tell of its inside, where the field is fitted "
    "too; "
    "give the solid's cells (tetrahedra, hexahedra), not its skin";

/// Why no field of the series is exact so far across the cut, whatever its knots, and what helps; empty if
/// one may be.
std::string cause_in_series(const Series& series, double across) {
  if (series.surface_only) return no_solid;
  const bool beyond_bend = series.bends && std::abs(across) > series.tightest.radius;
  if (series.turning <= folds && !beyond_bend) return "";
  return "the path of the cut turns by " + digits(std::round(series.turning * 180 / std::numbers::pi)) +
         " degrees, most tightly on a radius of " + digits(series.tightest.radius) + " mm at (" +
         digits(series.tightest.at.x) + ", " + digits(series.tightest.at.y) + ", " +
         digits(series.tightest.at.z) + "), and coordinates along it fold within its bends" +
         (series.turning <= folds ? " beyond the middle of their circle," : ",") +
         " so that no field is exact there between the nodes; a path that bends less has one, and what cleft "
         "cut --simulate and simulate on show is the "
         "simulation, and needs no field";
}

/// Why knots of its own do not follow a field there, and what helps.
std::string cause_of(const Field& field, const Series& series, const Place& place) {
  if (std::string cause = cause_in_series(series, at(series, place).y); !cause.empty()) return cause;
  const CanonicalCut& cut = field.cut();
  if (cut.length == 0)
    return "the field has no break; where the data jump, import them with the plane of the jump (cleft "
           "import "
           "--break), or with a smaller --open-at";
  const Vec3& p = at(series, place);
  const double tip = field.parametrization().geometry().tip.at(place.t);
  if (std::min(std::abs(p.x - tip), std::abs(p.x - cut.start)) < 0.1 * cut.length)
    return "beside the front of the break the knots are as dense as the nodes allow; refine the mesh there, "
           "or "
           "write more frames";
  if (p.y == 0)
    return "on the break, away from its ends; see whether all of it opens as one (cleft info, cleft import "
           "--open-at)";
  if (series.in_parts)
    return "the mesh has parts that share no nodes, and the field goes on smoothly from one to the other; "
           "import each part by itself";
  return "away from the break the nodes do not determine more knots; refine the mesh there";
}

/// Of a quantity beside a displacement.
std::string cause_of(const Quantity& quantity) {
  if (quantity.own)
    return "it has knots of its own, at even distances, as dense as nodes and frames determine; refine the "
           "mesh there, or write more frames";
  std::string knots =
      "neither do the knots of the displacement follow it there, nor even ones of its own, as dense as nodes "
      "and frames determine; refine the mesh there, or ask for a smaller error of the displacement, whose "
      "knots are denser then (--tolerance displacement=0.1%)";
  if (quantity.name == Series::at_start)
    return knots + ", or import the series from a frame on in which nothing has moved yet";
  return knots;
}

double scale_of(const Quantity& quantity) { return quantity.scale > 0 ? quantity.scale : 1; }

std::string warning_of(const Quantity& quantity, const Field& field, const Series& series,
                       const EncodeOptions& options) {
  const double scale = scale_of(quantity), limit = options.tolerance_of(quantity.name).limit(scale),
               error = quantity.spline_error * scale;
  if (error <= worth_a_warning * limit) return "";
  const bool start = quantity.name == Series::at_start;
  const Place place{quantity.worst_node, quantity.worst_time};
  return quantity.name + (start ? " (the displacement of frame 0)" : "") +
         ": the spline, which is what is drawn between the nodes, is off by " +
         percent(quantity.spline_error) +
         (start && series.largest_displacement > 0 ? " of the largest displacement, "
                                                   : " of its largest value or range, ") +
         digits(error / limit) + " times the tolerance," + told(series, place) +
         (series.largest_displacement > 0 && !series.surface_only ? cause_of(quantity)
                                                                  : cause_of(field, series, place));
}

std::string warning_of_displacement(const Field& field, const Series& series, const EncodeOptions& options) {
  const FitReport& report = field.report;
  const double scale = report.largest_displacement,
               limit = options.tolerance_of("displacement").limit(scale > 0 ? scale : 1);
  const bool spline = report.spline_error * scale > worth_a_warning * limit;
  if (!spline && report.gape_error * scale <= worth_a_warning * limit) return "";
  const double error = spline ? report.spline_error : report.gape_error;
  const Place place{report.worst_node, report.worst_time};
  return (spline ? "the spline, which is what is drawn between the nodes, is off by "
                 : "the opening of the break, as the spline has it between the nodes, is off by ") +
         percent(error) + " of the largest displacement, " + digits(error * scale / limit) +
         " times the tolerance" + (spline ? "," : "; the spline is worst") + told(series, place) +
         cause_of(field, series, place);
}

/// `of`: "" for the displacement, else the quantity's name and a colon.
std::string warning_between(const std::string& of, const BetweenNodes& between, double scale, double limit,
                            const Series& series) {
  if (between.error <= worth_a_warning * limit) return "";
  const std::string cause = cause_in_series(series, between.at.y);
  return of + "between the nodes the spline goes astray by " + percent(between.error / scale) +
         (of.empty() ? " of the largest displacement" : " of its largest value or range") +
         ", beyond what the values of the cell's nodes span (at u = " + digits(between.at.x) +
         ", v = " + digits(between.at.y) + ", w = " + digits(between.at.z) +
         " mm and t = " + digits(between.time) + "): " +
         (!cause.empty() ? cause
                         : "knots are denser than nodes there; refine the mesh there, or take fewer knots "
                           "(--control-points, or a larger --tolerance)");
}

}  // namespace

std::vector<std::string> warnings_of(const Field& field, const std::vector<BetweenNodes>& between,
                                     const Series& series, const EncodeOptions& options) {
  if (options.rung) return {};
  std::vector<std::string> warnings = {warning_of_displacement(field, series, options)};
  if (const double scale = field.report.largest_displacement; scale > 0)
    warnings.push_back(warning_between("", between.front(), scale,
                                       options.tolerance_of("displacement").limit(scale), series));
  for (std::size_t q = 0; q < field.quantities.size(); ++q) {
    const Quantity& quantity = field.quantities[q];
    const double scale = scale_of(quantity), limit = options.tolerance_of(quantity.name).limit(scale);
    warnings.push_back(warning_of(quantity, field, series, options));
    warnings.push_back(warning_between(quantity.name + ": ", between[q + 1], scale, limit, series));
  }
  std::erase(warnings, "");
  return warnings;
}

}  // namespace cleft
