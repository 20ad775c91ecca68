#include "encoder/field/file/field_record.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/rounded.h"
#include "base/text.h"
#include "encoder/field/file/coded_points.h"

namespace cleft {

namespace {

constexpr const char* axis_names[] = {"along", "across", "height", "time"};
constexpr const char* domain_names[] = {"u", "v", "w", "t"};
constexpr double most_control_points = 1e8;
constexpr int digits = 7;  // of a figure of the report, more than it means

/// The report's figures: their names in the file, and the unit that commands add where they show them.
enum class Stored {
  always,
  of_late,  // earlier files lack it
  if_not_zero
};
struct Figure {
  const char *name, *unit;
  double FitReport::*value;
  Stored stored = Stored::always;
};
constexpr Figure figures[] = {
    {"relative_l2", "", &FitReport::relative_l2},
    {"node_error", "", &FitReport::node_error},
    {"spline_error", "", &FitReport::spline_error},
    {"between_nodes", "", &FitReport::between_nodes, Stored::of_late},
    {"gape_error", "", &FitReport::gape_error},
    {"false_gap", "", &FitReport::false_gap},
    {"largest_displacement", "_mm", &FitReport::largest_displacement},
    {"frame_error", "", &FitReport::frame_error},
    {"worst_node", "", &FitReport::worst_node},
    {"worst_time", "", &FitReport::worst_time},
    {"condition", "", &FitReport::condition},
    {"regularisation", "", &FitReport::regularisation, Stored::if_not_zero},
    {"crease", "_degrees", &FitReport::crease},
    {"overlap", "_mm", &FitReport::overlap},
    {"least_volume", "", &FitReport::least_volume},
    {"nodes", "", &FitReport::nodes, Stored::of_late},
    {"frames", "", &FitReport::frames, Stored::of_late}};  // no times: equal fields, equal files

bool is_stored(const Figure& figure, const FitReport& report) {
  return figure.stored != Stored::if_not_zero || report.*figure.value != 0;
}

/// The same of an interpolation.
struct InterpolationFigure {
  const char* name;
  double Interpolation::*value;
};
constexpr InterpolationFigure interpolation_figures[] = {
    {"cases", &Interpolation::cases},
    {"estimated_error", &Interpolation::estimated_error},
    {"interpolation_error", &Interpolation::interpolation_error},
    {"outside", &Interpolation::outside}};

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

void put_bases(Json& header, const std::array<BSplineBasis, 4>& bases) {
  for (int axis = 0; axis < 4; ++axis)
    header["bases"][axis_names[axis]] = {{"degree", bases[axis].degree()}, {"knots", bases[axis].knots()}};
}

std::array<BSplineBasis, 4> bases_of(const Field& field) {
  return {field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
}

Json numbers_of(const Vec3& v) { return {v.x, v.y, v.z}; }

void put_source(Json& header, const FieldSource& source) {
  Json& entry = header["source"];
  entry = {{"file", source.file}, {"origin", numbers_of(source.origin)}};
  for (const Vec3& axis : source.axes) entry["axes"].push_back(numbers_of(axis));
  entry["times"] = source.times, entry["fields"] = source.fields;
  if (source.map) entry["map"] = source.map->numbers();
  if (source.extent) entry["extent"] = source.extent->numbers();
}

Vec3 vector_of(const Json& list) {
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = number(list.at(static_cast<std::size_t>(i)));
  if (!std::isfinite(squared_norm(v))) throw InputError("the source's place is not finite");
  return v;
}

std::optional<FieldSource> source_of(const Json& header) {
  if (!header.contains("source")) return {};
  const Json& entry = header.at("source");
  FieldSource source;
  source.file = entry.at("file").get<std::string>();
  source.origin = vector_of(entry.at("origin"));
  for (std::size_t i = 0; i < 3; ++i) source.axes[i] = vector_of(entry.at("axes").at(i));
  source.times = entry.at("times").get<std::vector<double>>();
  source.fields = entry.at("fields").get<std::vector<std::string>>();
  if (entry.contains("map")) source.map = BreakMap::from(entry.at("map").get<std::vector<double>>());
  if (entry.contains("extent"))
    source.extent = BreakExtent::from(entry.at("extent").get<std::vector<double>>());
  return source;
}

std::optional<TissueBelow> tissue_of(const Json& header) {
  if (!header.contains("tissue")) return {};
  const Json& entry = header.at("tissue");
  TissueBelow below{{}, entry.at("foundation").get<double>()};
  bool good = below.foundation > 0 && std::isfinite(below.foundation) && !entry.at("layers").empty();
  for (const Json& one : entry.at("layers")) {
    const TissueLayerBelow layer{one.at(0).get<double>(), one.at(1).get<double>(), one.at(2).get<double>()};
    good = good && layer.young_modulus > 0 && layer.height > 0 && layer.poisson_ratio > -1 &&
           layer.poisson_ratio <= 0.5;
    below.layers.push_back(layer);
  }
  if (!good) throw InputError("the layers of tissue below the cut are none");
  return below;
}

Json header_of(const Field& field, int slices) {
  Json header{{"case", field.case_hash},
              {"parametrization", field.parametrization().name()},
              {"quantum", field.quantum},
              {"slices", slices}};
  const FieldGeometry& geometry = field.parametrization().geometry();
  put_bases(header, bases_of(field));
  for (int axis = 0; axis < 4; ++axis)
    header["domain"][domain_names[axis]] = {geometry.domain[axis].front, geometry.domain[axis].back};
  header["cut"] = {
      {"start", geometry.cut.start}, {"length", geometry.cut.length}, {"depth", geometry.cut.depth}};
  header["tip"] = {{"times", geometry.tip.times}, {"positions", geometry.tip.positions}};
  header["parameters"] = Json::object();
  for (const auto& [name, value] : field.parameters.numbers()) header["parameters"][name] = value;
  for (const auto& [name, value] : field.parameters.texts()) header["choices"][name] = value;
  for (const Figure& figure : figures)
    if (is_stored(figure, field.report)) header["report"][figure.name] = field.report.*figure.value;
  if (field.source) put_source(header, *field.source);
  if (field.tissue) {
    header["tissue"]["foundation"] = field.tissue->foundation;
    for (const TissueLayerBelow& layer : field.tissue->layers)
      header["tissue"]["layers"].push_back({layer.young_modulus, layer.poisson_ratio, layer.height});
  }
  if (field.interpolation) {
    header["interpolation"]["method"] = field.interpolation->method;
    for (const auto& figure : interpolation_figures)
      header["interpolation"][figure.name] = *field.interpolation.*figure.value;
  }
  return header;
}

std::optional<Interpolation> interpolation_of(const Json& header) {
  if (!header.contains("interpolation")) return {};
  const Json& entry = header.at("interpolation");
  Interpolation interpolation;
  interpolation.method = entry.at("method").get<std::string>();
  for (const auto& figure : interpolation_figures)
    interpolation.*figure.value = number(entry.at(figure.name));
  return interpolation;
}

std::array<BSplineBasis, 4> bases_of(const Json& header) {
  const auto basis = [&](int axis) {
    const Json& entry = header.at("bases").at(axis_names[axis]);
    try {
      return BSplineBasis(count_from(entry.at("degree")), entry.at("knots").get<std::vector<double>>());
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
  const Interval& u = geometry.domain[0];
  const double first = std::min(geometry.cut.start, positions.front()),
               last = std::max(geometry.cut.start + geometry.cut.length, positions.back()),
               rounding = 1e-6 * (u.back - u.front);
  if (first < u.front - rounding || last > u.back + rounding)
    throw InputError("the cut, from u = " + shortest(first) + " to " + shortest(last) +
                     " mm, is not within the domain in u, " + shortest(u.front) + " to " + shortest(u.back) +
                     " mm");
  return geometry;
}

void check_break(const BSplineBasis& across, const CanonicalCut& cut) {
  if (cut.length == 0) return;
  if (across.degree() < 1 || across.front() >= 0 || across.back() <= 0 ||
      across.evaluate(0, Limit::from_left).first + across.degree() >=
          across.evaluate(0, Limit::from_right).first)
    throw InputError("the basis across has no knot of full multiplicity at 0");
}

std::vector<float> as_floats(const std::vector<Vec3>& points) {
  std::vector<float> numbers;
  for (const Vec3& point : points)
    for (int c = 0; c < 3; ++c) numbers.push_back(static_cast<float>(point[c]));
  return numbers;
}

std::vector<Vec3> as_points(const std::vector<float>& numbers) {
  std::vector<Vec3> points(numbers.size() / 3);
  for (std::size_t n = 0; n < numbers.size(); ++n) points[n / 3][static_cast<int>(n % 3)] = numbers[n];
  return points;
}

/// Control points in all. Throws InputError where that many cannot be coded in so few bytes.
std::size_t count_of(const std::array<BSplineBasis, 4>& bases, std::size_t bytes) {
  double count = 1;
  for (const BSplineBasis& b : bases) count *= b.size();
  if (count > most_values_of(bytes))
    throw InputError("there are fewer bytes of coefficients than " + shortest(count) +
                     " control points take");
  return static_cast<std::size_t>(count);
}

}  // namespace

FieldRecord record_of_sum(const Json& header, const std::array<BSplineBasis, 4>& bases, int slices) {
  FieldRecord record{header, {}};
  record.header["quantum"] = 0., record.header["slices"] = slices;
  put_bases(record.header, bases);
  return record;
}

Json figures_of(const Quantity& quantity) {
  Json figures{{"name", quantity.name},
               {"components", quantity.components},
               {"largest", quantity.largest},
               {"scale", quantity.scale},
               {"error", quantity.error},
               {"spline_error", quantity.spline_error},
               {"worst_node", quantity.worst_node},
               {"worst_time", quantity.worst_time},
               {"between_nodes", quantity.between_nodes}};
  if (quantity.time) figures["time"] = *quantity.time;
  return figures;
}

FieldRecord record_of(const Field& field) {
  const std::array<BSplineBasis, 4> bases = bases_of(field);
  FieldRecord record;
  if (field.quantum == 0) {
    record.header = header_of(field, bases[3].size());
    append_planes(record.coefficients, as_floats(field.coefficients()));
  } else {
    const ControlTies ties = ties_of(field.parametrization().name(), bases);
    CodedPoints coded = coded_points(field.coefficients(), ties, bases, field.quantum);
    record = {header_of(field, coded.slices), std::move(coded.bytes)};
  }
  append_extras(record.header, record.coefficients, field);
  return record;
}

Json knots_of(const Field& own) {
  Json entry{{"parametrization", own.parametrization().name()}};
  put_bases(entry, bases_of(own));
  return entry;
}

std::shared_ptr<const Field> own_knots(const Json& header, const Json& entry, std::size_t bytes) {
  const std::array<BSplineBasis, 4> bases = bases_of(entry);
  FieldGeometry geometry = standing(geometry_of(header));
  check_break(bases[1], geometry.cut);
  std::vector<Vec3> none(count_of(bases, bytes));
  return std::make_shared<const Field>(
      make_parametrization(entry.at("parametrization").get<std::string>(), std::move(geometry)), bases,
      std::move(none));
}

UnknownPlaces unknown_places(const Json& header, std::size_t bytes) {
  return reading([&] {
    const std::array<BSplineBasis, 4> bases = bases_of(header);
    count_of(bases, bytes);
    const int slices = count_from(header.at("slices")), T = bases[3].size();
    if (slices != T && slices != T - 1) throw InputError("slices is neither that of the basis nor one less");
    const std::string name = header.at("parametrization").get<std::string>();
    return UnknownPlaces{places_of(ties_of(name, bases), bases), slices};
  });
}

namespace {

/// The field of a header and of what gives its control points, once all else there is known to be sound.
template <class Points>
Field field_of(const Json& header, Points&& points_of) {
  return reading([&] {
    const std::array<BSplineBasis, 4> bases = bases_of(header);
    FieldGeometry geometry = geometry_of(header);
    check_break(bases[1], geometry.cut);
    const std::string name = header.at("parametrization").get<std::string>();
    const auto parametrization = make_parametrization(name, std::move(geometry));
    Field field(parametrization, bases, points_of(bases, ties_of(name, bases)));
    field.case_hash = header.at("case").get<std::string>();
    field.parameters = parameters_of(header);
    field.report = report_of(header);
    field.interpolation = interpolation_of(header);
    field.source = source_of(header);
    field.tissue = tissue_of(header);
    return field;
  });
}

}  // namespace

Field field_of(const FieldRecord& record) {
  const Json& header = record.header;
  FieldExtras extras;
  double quantum = 0;
  Field field = field_of(header, [&](const std::array<BSplineBasis, 4>& bases, const ControlTies& ties) {
    quantum = finite(header, "quantum");
    if (quantum < 0) throw InputError("quantum is negative");
    const std::size_t size = count_of(bases, record.coefficients.size());
    std::span<const std::uint8_t> bytes = record.coefficients;
    extras = take_extras(header, bytes, bases);
    if (quantum > 0) {
      const auto [places, slices] = unknown_places(header, record.coefficients.size());
      return control_points(ties, bases, decode_coefficients(places, slices, bytes), quantum);
    }
    std::vector<Vec3> points = as_points(take_planes(bytes, 3 * size));
    if (!bytes.empty()) throw InputError("there are more bytes of coefficients than control points");
    return points;
  });
  field.quantum = quantum;
  field.quantities = std::move(extras.quantities), field.by_parameter = std::move(extras.by_parameter);
  return field;
}

Field field_of(const FieldRecord& record, std::span<const double> unknowns) {
  if (!record.coefficients.empty()) throw InputError("a sum of modes has coefficients of its own");
  return field_of(record.header, [&](const std::array<BSplineBasis, 4>& bases, const ControlTies& ties) {
    const auto [places, slices] = unknown_places(record.header, unknowns.size());
    if (unknowns.size() != 3ul * static_cast<std::size_t>(slices) * static_cast<std::size_t>(places.unknowns))
      throw InputError("its unknowns are not those of the modes");
    return control_points(ties, bases, unknowns);
  });
}

RecordedParameters parameters_of(const Json& header) {
  return reading([&] {
    RecordedParameters parameters;
    for (const auto& [name, value] : header.at("parameters").items()) parameters.set(name, number(value));
    if (header.contains("choices")) record_texts(header.at("choices"), parameters);
    return parameters;
  });
}

void record_texts(const Json& object, RecordedParameters& parameters) {
  for (const auto& [name, value] : object.items())
    if (value.is_string()) parameters.set(name, value.get<std::string>());
}

FitReport report_of(const Json& header) {
  return reading([&] {
    FitReport report;
    report.between_nodes = std::nan("");  // of earlier files it is not known
    for (const Figure& figure : figures)
      if (figure.stored == Stored::always || header.at("report").contains(figure.name))
        report.*figure.value = number(header.at("report").at(figure.name));
    return report;
  });
}

FitReport rounded_report(FitReport report) {
  for (const Figure& figure : figures) report.*figure.value = rounded_to_digits(report.*figure.value, digits);
  return report;
}

Json shown(const FitReport& report) {
  Json list = Json::object();
  for (const Figure& figure : figures)
    if (is_stored(figure, report)) list[std::string(figure.name) + figure.unit] = report.*figure.value;
  return list;
}

std::vector<std::uint8_t> header_bytes(const Json& header) {
  const std::string text = header.dump();
  return {text.begin(), text.end()};
}

Json header_from(std::span<const std::uint8_t> bytes) {
  return reading([&] { return Json::parse(bytes.begin(), bytes.end()); });
}

int count_from(const Json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > INT_MAX)
    throw InputError("the header has " + value.dump() + " in the place of a count");
  return value.get<int>();
}

std::vector<int> counts_from(const Json& list) {
  if (!list.is_array()) throw InputError("the header has " + list.dump() + " in the place of counts");
  std::vector<int> counts;
  for (const Json& value : list) counts.push_back(count_from(value));
  return counts;
}

}  // namespace cleft
