#include "encoder/field/field_record.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "encoder/field/unknowns.h"

namespace cleft {

namespace {

constexpr const char* axis_names[] = {"along", "across", "height", "time"};
constexpr const char* domain_names[] = {"u", "v", "w", "t"};
constexpr double most_control_points = 1e8;

/// The report's figures by their names in the file.
struct Figure {
  const char* name;
  double FitReport::*value;
};
constexpr Figure figures[] = {
    {"relative_l2", &FitReport::relative_l2},   {"node_error", &FitReport::node_error},
    {"spline_error", &FitReport::spline_error}, {"gape_error", &FitReport::gape_error},
    {"false_gap", &FitReport::false_gap},       {"largest_displacement", &FitReport::largest_displacement},
    {"frame_error", &FitReport::frame_error},   {"worst_node", &FitReport::worst_node},
    {"worst_time", &FitReport::worst_time},     {"condition", &FitReport::condition}};

/// What nlohmann-json says of a header that lacks something, or has it of another type, as an InputError.
template <class Function>
auto reading(Function&& function) {
  try {
    return function();
  } catch (const Json::exception& e) {
    throw InputError(std::string("the header is not one of a field: ") + e.what());
  }
}

double number(const Json& value) {
  if (value.is_null()) return std::nan("");  // what a number that is none is written as
  return value.get<double>();
}

double finite(const Json& object, const char* name) {
  const double value = number(object.at(name));
  if (!std::isfinite(value)) throw InputError(std::string(name) + " is not a finite number");
  return value;
}

Json header_of(const Field& field, int slices) {
  Json header{{"case", field.case_hash},
              {"parametrization", field.parametrization().name()},
              {"quantum", field.quantum},
              {"slices", slices}};
  const FieldGeometry& geometry = field.parametrization().geometry();
  for (int axis = 0; axis < 4; ++axis) {
    const BSplineBasis& basis = field.basis(axis);
    header["bases"][axis_names[axis]] = {{"degree", basis.degree()}, {"knots", basis.knots()}};
    header["domain"][domain_names[axis]] = {geometry.domain[axis].front, geometry.domain[axis].back};
  }
  header["cut"] = {
      {"start", geometry.cut.start}, {"length", geometry.cut.length}, {"depth", geometry.cut.depth}};
  header["tip"] = {{"times", geometry.tip.times}, {"positions", geometry.tip.positions}};
  header["parameters"] = field.parameters.empty() ? Json::object() : Json(field.parameters);
  for (const Figure& figure : figures) header["report"][figure.name] = field.report.*figure.value;
  return header;
}

std::array<BSplineBasis, 4> bases_of(const Json& header) {
  const auto basis = [&](int axis) {
    const Json& entry = header.at("bases").at(axis_names[axis]);
    try {
      return BSplineBasis(entry.at("degree").get<int>(), entry.at("knots").get<std::vector<double>>());
    } catch (const InputError& e) {
      throw InputError(std::string("the basis ") + axis_names[axis] + ": " + e.what());
    }
  };
  std::array<BSplineBasis, 4> bases{basis(0), basis(1), basis(2), basis(3)};
  double count = 1;
  for (const BSplineBasis& b : bases) count *= b.size();
  if (count > most_control_points) throw InputError("more control points than a field may have");
  return bases;
}

FieldGeometry geometry_of(const Json& header) {
  FieldGeometry geometry;
  for (int axis = 0; axis < 4; ++axis) {
    const Json& ends = header.at("domain").at(domain_names[axis]);
    geometry.domain[axis] = {number(ends.at(0)), number(ends.at(1))};
    if (!(geometry.domain[axis].front < geometry.domain[axis].back) ||
        !std::isfinite(geometry.domain[axis].back - geometry.domain[axis].front))
      throw InputError(std::string("the domain in ") + domain_names[axis] + " is empty");
  }
  const Json& cut = header.at("cut");
  geometry.cut = {finite(cut, "start"), finite(cut, "length"), finite(cut, "depth")};
  auto& [times, positions] = geometry.tip;
  times = header.at("tip").at("times").get<std::vector<double>>();
  positions = header.at("tip").at("positions").get<std::vector<double>>();
  if (times.empty() || times.size() != positions.size() ||
      !std::is_sorted(positions.begin(), positions.end()) ||
      std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) != times.end())
    throw InputError("the tip's path is not one of increasing times and positions");
  return geometry;
}

void check_break(const BSplineBasis& across, const CanonicalCut& cut) {
  if (cut.length == 0) return;
  if (across.degree() < 1 || across.front() >= 0 || across.back() <= 0 ||
      across.evaluate(0, Limit::from_left).first + across.degree() >=
          across.evaluate(0, Limit::from_right).first)
    throw InputError("the basis across has no knot of full multiplicity at 0");
}

/// 32-bit floats as four planes of bytes, the least significant first: they pack better.
std::vector<std::uint8_t> float_planes(const std::vector<Vec3>& points) {
  const std::size_t count = 3 * points.size();
  std::vector<std::uint8_t> bytes(4 * count);
  for (std::size_t n = 0; n < count; ++n) {
    const auto bits =
        std::bit_cast<std::uint32_t>(static_cast<float>(points[n / 3][static_cast<int>(n % 3)]));
    for (int plane = 0; plane < 4; ++plane)
      bytes[plane * count + n] = static_cast<std::uint8_t>(bits >> 8 * plane);
  }
  return bytes;
}

std::vector<Vec3> from_float_planes(const std::vector<std::uint8_t>& bytes, std::size_t size) {
  const std::size_t count = 3 * size;
  if (bytes.size() != 4 * count)
    throw InputError("there are " + std::to_string(bytes.size()) + " bytes of coefficients, expected " +
                     std::to_string(4 * count));
  std::vector<Vec3> points(size);
  for (std::size_t n = 0; n < count; ++n) {
    std::uint32_t bits = 0;
    for (int plane = 3; plane >= 0; --plane) bits = bits << 8 | bytes[plane * count + n];
    const auto value = std::bit_cast<float>(bits);
    if (!std::isfinite(value)) throw InputError("a control point is not a finite number");
    points[n / 3][static_cast<int>(n % 3)] = value;
  }
  return points;
}

std::vector<std::int64_t> integers_of(const Unknowns& unknowns) {
  std::vector<std::int64_t> values;
  values.reserve(unknowns.values.size());
  for (const double x : unknowns.values) {
    CLEFT_CHECK(std::abs(x), <=, std::ldexp(1., 40));
    values.push_back(std::llround(x));
    CLEFT_CHECK(std::abs(x - static_cast<double>(values.back())), <=, 1e-3);
  }
  return values;
}

}  // namespace

FieldRecord record_of(const Field& field) {
  if (field.quantum == 0)
    return {header_of(field, field.basis(3).size()), float_planes(field.coefficients())};
  const std::array<BSplineBasis, 4> bases{field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
  const ControlTies ties = ties_of(field.parametrization().name(), bases);
  const CoefficientGrid places = places_of(ties, bases);
  const Unknowns unknowns = unknowns_of(field, places, field.quantum);
  const auto values = integers_of(unknowns);
  const auto again = control_points(ties, bases, values, field.quantum);
  for (std::size_t n = 0; n < again.size(); ++n)
    CLEFT_CHECK(norm(again[n] - field.coefficients()[n]), <=, 0.01 * field.quantum);
  return {header_of(field, unknowns.slices), encode_coefficients(places, unknowns.slices, values)};
}

Field field_of(const FieldRecord& record) {
  return reading([&] {
    const Json& header = record.header;
    const std::array<BSplineBasis, 4> bases = bases_of(header);
    FieldGeometry geometry = geometry_of(header);
    check_break(bases[1], geometry.cut);
    const std::string name = header.at("parametrization").get<std::string>();
    const auto parametrization = make_parametrization(name, std::move(geometry));
    const double quantum = finite(header, "quantum");
    if (quantum < 0) throw InputError("quantum is negative");
    std::vector<Vec3> points;
    if (quantum == 0) {
      std::size_t size = 1;
      for (const BSplineBasis& b : bases) size *= static_cast<std::size_t>(b.size());
      points = from_float_planes(record.coefficients, size);
    } else {
      const int slices = header.at("slices").get<int>(), T = bases[3].size();
      if (slices != T && slices != T - 1)
        throw InputError("slices is neither that of the basis nor one less");
      const ControlTies ties = ties_of(name, bases);
      const auto values = decode_coefficients(places_of(ties, bases), slices, record.coefficients);
      points = control_points(ties, bases, values, quantum);
    }
    Field field(parametrization, bases, std::move(points));
    field.quantum = quantum;
    field.case_hash = header.at("case").get<std::string>();
    field.parameters = parameters_of(header);
    field.report = report_of(header);
    return field;
  });
}

std::map<std::string, double> parameters_of(const Json& header) {
  return reading([&] {
    std::map<std::string, double> parameters;
    for (const auto& [name, value] : header.at("parameters").items()) parameters[name] = number(value);
    return parameters;
  });
}

FitReport report_of(const Json& header) {
  return reading([&] {
    FitReport report;
    for (const Figure& figure : figures) report.*figure.value = number(header.at("report").at(figure.name));
    return report;
  });
}

std::vector<std::uint8_t> header_bytes(const Json& header) {
  const std::string text = header.dump();
  return {text.begin(), text.end()};
}

Json header_from(std::span<const std::uint8_t> bytes) {
  return reading([&] { return Json::parse(bytes.begin(), bytes.end()); });
}

}  // namespace cleft
