#include "encoder/field/file/coded_points.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "encoder/field/file/field_record.h"

namespace cleft {

namespace {

constexpr int at_once = 3;  // components that are coded together

double finite_member(const Json& entry, const char* name) {
  const double value = entry.at(name).get<double>();
  if (!std::isfinite(value)) throw InputError(std::string(name) + " is not a finite number");
  return value;
}

double positive(const Json& entry, const char* name) {
  const double value = finite_member(entry, name);
  if (!(value > 0)) throw InputError(std::string(name) + " is not above 0");
  return value;
}

std::size_t control_points_of(const std::array<BSplineBasis, 4>& bases) {
  std::size_t count = 1;
  for (const BSplineBasis& b : bases) count *= static_cast<std::size_t>(b.size());
  return count;
}

/// The entry's lengths of bytes, one for every three components.
std::vector<int> lengths_of(const Json& entry, std::size_t components) {
  const auto lengths = counts_from(entry.at("bytes"));
  if (lengths.size() != (components + at_once - 1) / at_once)
    throw InputError("bytes are not told for every three components");
  return lengths;
}

std::vector<Vec3> decoded(std::span<const std::uint8_t> bytes, int slices, double quantum,
                          const std::array<BSplineBasis, 4>& bases, const ControlTies& ties) {
  const int T = bases[3].size();
  if (slices != T && slices != T - 1) throw InputError("slices is neither that of the basis nor one less");
  if (static_cast<double>(control_points_of(bases)) > most_values_of(bytes.size()))
    throw InputError("there are fewer bytes of coefficients than control points take");
  return control_points(ties, bases, decode_coefficients(places_of(ties, bases), slices, bytes), quantum);
}

/// Three components of a quantity, from `first` on; 0 beyond its last.
std::vector<Vec3> triples(const Quantity& quantity, int first) {
  const std::size_t components = quantity.components;
  std::vector<Vec3> points(quantity.coefficients.size() / components);
  for (std::size_t n = 0; n < points.size(); ++n)
    for (int c = 0; c < std::min(at_once, quantity.components - first); ++c)
      points[n][c] = quantity.coefficients[n * components + static_cast<std::size_t>(first + c)];
  return points;
}

void append(std::vector<std::uint8_t>& bytes, const std::vector<std::uint8_t>& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

std::array<BSplineBasis, 4> all_bases(const Field& field) {
  return {field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
}

/// Knots, and what they tie.
struct Knots {
  std::array<BSplineBasis, 4> bases;
  ControlTies ties;
};
Knots knots_in(const Field& field) {
  const std::array<BSplineBasis, 4> bases = all_bases(field);
  return {bases, ties_of(field.parametrization().name(), bases)};
}

void append_quantity(Json& list, std::vector<std::uint8_t>& bytes, const Quantity& quantity,
                     const Knots& of_field) {
  Json entry = figures_of(quantity);
  if (quantity.own) entry["own"] = knots_of(*quantity.own);
  const Knots own = quantity.own ? knots_in(*quantity.own) : of_field;
  const auto& [bases, ties] = own;
  if (quantity.quantum == 0) {
    append_planes(bytes, std::vector<float>(quantity.coefficients.begin(), quantity.coefficients.end()));
  } else {
    entry["quantum"] = quantity.quantum;
    for (int first = 0; first < quantity.components; first += at_once) {
      const CodedPoints coded = coded_points(triples(quantity, first), ties, bases, quantity.quantum);
      entry["slices"].push_back(coded.slices), entry["bytes"].push_back(coded.bytes.size());
      append(bytes, coded.bytes);
    }
  }
  list.push_back(entry);
}

Quantity take_quantity(const Json& header, const Json& entry, std::span<const std::uint8_t>& bytes,
                       const Knots& of_field) {
  Quantity quantity{entry.at("name").get<std::string>(),
                    count_from(entry.at("components")),
                    {},
                    finite_member(entry, "largest"),
                    finite_member(entry, "error")};
  if (quantity.components < 1 || quantity.components > 100)
    throw InputError("a quantity has no number of components");
  quantity.spline_error =
      entry.contains("spline_error") ? finite_member(entry, "spline_error") : quantity.error;
  if (entry.contains("worst_node"))
    quantity.worst_node = finite_member(entry, "worst_node"),
    quantity.worst_time = finite_member(entry, "worst_time");
  if (entry.contains("time")) quantity.time = finite_member(entry, "time");
  if (entry.contains("between_nodes")) quantity.between_nodes = finite_member(entry, "between_nodes");
  quantity.scale = entry.contains("scale") ? finite_member(entry, "scale") : quantity.largest;
  if (entry.contains("own")) quantity.own = own_knots(header, entry.at("own"), bytes.size());
  const Knots own = quantity.own ? knots_in(*quantity.own) : of_field;
  const auto& [bases, ties] = own;
  const std::size_t components = quantity.components;
  const std::size_t count = components * control_points_of(bases);
  if (!entry.contains("quantum")) {
    const auto numbers = take_planes(bytes, count);
    quantity.coefficients.assign(numbers.begin(), numbers.end());
    return quantity;
  }
  quantity.quantum = positive(entry, "quantum");
  const std::vector<int> lengths = lengths_of(entry, components);
  const auto slices = counts_from(entry.at("slices"));
  if (slices.size() != lengths.size()) throw InputError("slices are not told for every three components");
  if (static_cast<double>(count) > most_values_of(bytes.size()))
    throw InputError("there are fewer bytes of coefficients than control points take");
  quantity.coefficients.resize(count);
  for (std::size_t group = lengths.size(); group-- > 0;) {
    const auto points = decoded(take_bytes(bytes, static_cast<std::size_t>(lengths[group])), slices[group],
                                quantity.quantum, bases, ties);
    for (std::size_t n = 0; n < points.size(); ++n)
      for (std::size_t c = at_once * group; c < std::min(components, at_once * (group + 1)); ++c)
        quantity.coefficients[n * components + c] = points[n][static_cast<int>(c - at_once * group)];
  }
  return quantity;
}

}  // namespace

void append_planes(std::vector<std::uint8_t>& bytes, std::span<const float> numbers) {
  for (int plane = 0; plane < 4; ++plane)
    for (const float number : numbers)
      bytes.push_back(static_cast<std::uint8_t>(std::bit_cast<std::uint32_t>(number) >> 8 * plane));
}

std::vector<float> take_planes(std::span<const std::uint8_t>& bytes, std::size_t count) {
  if (bytes.size() / 4 < count)
    throw InputError("there are " + std::to_string(bytes.size()) +
                     " bytes of coefficients, expected at least " + std::to_string(4 * count));
  const auto planes = take_bytes(bytes, 4 * count);
  std::vector<float> numbers(count);
  for (std::size_t n = 0; n < count; ++n) {
    std::uint32_t bits = 0;
    for (std::size_t plane = 4; plane-- > 0;) bits = bits << 8 | planes[plane * count + n];
    numbers[n] = std::bit_cast<float>(bits);
    if (!std::isfinite(numbers[n])) throw InputError("a control point is not a finite number");
  }
  return numbers;
}

std::span<const std::uint8_t> take_bytes(std::span<const std::uint8_t>& bytes, std::size_t count) {
  if (count > bytes.size())
    throw InputError("there are " + std::to_string(bytes.size()) +
                     " bytes of coefficients, expected at least " + std::to_string(count));
  const auto taken = bytes.last(count);
  bytes = bytes.first(bytes.size() - count);
  return taken;
}

CodedPoints coded_points(std::span<const Vec3> points, const ControlTies& ties,
                         const std::array<BSplineBasis, 4>& bases, double quantum) {
  const CoefficientGrid places = places_of(ties, bases);
  const Unknowns unknowns = unknowns_of(points, bases[3], places, quantum);
  std::vector<std::int64_t> values;
  values.reserve(unknowns.values.size());
  for (const double x : unknowns.values) {
    CLEFT_CHECK(std::abs(x), <=, std::ldexp(1., 40));
    values.push_back(std::llround(x));
    CLEFT_CHECK(std::abs(x - static_cast<double>(values.back())), <=, 1e-3);
  }
  const auto again = control_points(ties, bases, values, quantum);
  for (std::size_t n = 0; n < again.size(); ++n) CLEFT_CHECK(norm(again[n] - points[n]), <=, 0.01 * quantum);
  return {unknowns.slices, encode_coefficients(places, unknowns.slices, values)};
}

void append_extras(Json& header, std::vector<std::uint8_t>& bytes, const Field& field) {
  if (field.quantities.empty() && field.by_parameter.empty()) return;
  const Knots knots = knots_in(field);
  for (const Quantity& quantity : field.quantities)
    append_quantity(header["quantities"], bytes, quantity, knots);
  for (const ParameterDerivative& one : field.by_parameter) {
    const CodedPoints coded = coded_points(one.control_points, knots.ties, knots.bases, one.quantum);
    header["by_parameter"].push_back({{"parameter", one.parameter},
                                      {"quantum", one.quantum},
                                      {"slices", coded.slices},
                                      {"bytes", coded.bytes.size()},
                                      {"largest", one.largest},
                                      {"error", one.error}});
    append(bytes, coded.bytes);
  }
}

FieldExtras take_extras(const Json& header, std::span<const std::uint8_t>& bytes,
                        const std::array<BSplineBasis, 4>& bases) {
  FieldExtras extras;
  if (!header.contains("quantities") && !header.contains("by_parameter")) return extras;
  const Knots knots{bases, ties_of(header.at("parametrization").get<std::string>(), bases)};
  const auto reversed = [&](const char* name, const auto& take) {
    if (!header.contains(name)) return;
    const Json& list = header.at(name);
    for (std::size_t n = list.size(); n-- > 0;) take(list.at(n));
  };
  reversed("by_parameter", [&](const Json& entry) {
    ParameterDerivative& one = extras.by_parameter.emplace_back();
    one.parameter = entry.at("parameter").get<std::string>(), one.quantum = positive(entry, "quantum");
    one.largest = finite_member(entry, "largest"), one.error = finite_member(entry, "error");
    one.control_points = decoded(take_bytes(bytes, static_cast<std::size_t>(count_from(entry.at("bytes")))),
                                 count_from(entry.at("slices")), one.quantum, knots.bases, knots.ties);
  });
  reversed("quantities", [&](const Json& entry) {
    extras.quantities.push_back(take_quantity(header, entry, bytes, knots));
  });
  std::reverse(extras.quantities.begin(), extras.quantities.end());
  std::reverse(extras.by_parameter.begin(), extras.by_parameter.end());
  return extras;
}

}  // namespace cleft
