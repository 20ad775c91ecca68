#include "encoder/field/field_file.h"

#include <cmath>

#include "base/error.h"
#include "base/h5.h"
#include "base/output_file.h"

namespace cleft {

namespace {

constexpr const char* parametrization = "fixed";
constexpr const char* axis_names[] = {"u", "v", "w", "t"};

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

BSplineBasis read_basis(const h5::File& file, const std::string& axis) {
  const std::string name = "/basis/" + axis;
  try {
    return {static_cast<int>(file.read_number(name, "degree")), file.read<double>(name, {0})};
  } catch (const FileError&) {
    throw;
  } catch (const InputError& e) {
    throw FileError(file.path(), name + ": " + e.what());
  }
}

void check_format(const h5::File& file) {
  if (!file.has_attribute("/", "format") || file.read_text("/", "format") != "cleft-field")
    throw FileError(file.path(),
                    "is not a field file (no attribute format = \"cleft-field\"); cleft encode writes one");
  const double found = file.read_number("/", "version");
  if (found != field_format_version)
    throw FileError(file.path(), "field format version " + std::to_string(static_cast<int>(found)) +
                                     "; this program reads version " + std::to_string(field_format_version));
}

std::map<std::string, double> read_parameters(const h5::File& file) {
  std::map<std::string, double> parameters;
  for (const std::string& name : file.attribute_names("/parameters"))
    parameters[name] = file.read_number("/parameters", name);
  return parameters;
}

}  // namespace

void write_field(const std::string& path, const Field& field) {
  OutputFile out(path);
  h5::File file = h5::File::create(out.path());
  file.write_text("/", "format", "cleft-field");
  file.write_number("/", "version", field_format_version);
  file.write_text("/", "units", "mm N MPa");
  file.write_text("/", "case", field.case_hash);
  file.write_text("/", "parametrization", parametrization);
  file.create_group("/basis");
  h5::Shape shape;
  for (int axis = 0; axis < 4; ++axis) {
    const BSplineBasis& basis = field.basis(axis);
    const std::string name = std::string("/basis/") + axis_names[axis];
    file.write<double>(name, basis.knots(), {basis.knots().size()});
    file.write_number(name, "degree", basis.degree());
    shape.push_back(static_cast<hsize_t>(basis.size()));
  }
  shape.push_back(3);
  std::vector<float> packed;
  packed.reserve(3 * field.coefficients().size());
  for (const Vec3& c : field.coefficients())
    for (int i = 0; i < 3; ++i) packed.push_back(static_cast<float>(c[i]));
  file.write<float>("/control_points", packed, shape, h5::Packing::deflate);
  file.create_group("/cut");
  file.write_number("/cut", "start", field.cut().start);
  file.write_number("/cut", "length", field.cut().length);
  file.write_number("/cut", "depth", field.cut().depth);
  file.create_group("/parameters");
  for (const auto& [name, value] : field.parameters) file.write_number("/parameters", name, value);
  file.create_group("/report");
  for (const Figure& figure : figures) file.write_number("/report", figure.name, field.report.*figure.value);
  file.close();
  out.commit();
}

Field read_field(const std::string& path) {
  const h5::File file = h5::File::open(path);
  check_format(file);
  BSplineBasis u = read_basis(file, "u"), v = read_basis(file, "v"), w = read_basis(file, "w"),
               t = read_basis(file, "t");
  if (const std::string found = file.read_text("/", "parametrization"); found != parametrization)
    throw FileError(path, "parametrization '" + found + "'; this program reads '" + parametrization + "'");
  if (v.front() >= 0 || v.back() <= 0 ||
      v.evaluate(0, Limit::from_left).first + v.degree() >= v.evaluate(0, Limit::from_right).first)
    throw FileError(path, "/basis/v has no knot of full multiplicity at 0");
  const auto size = [](const BSplineBasis& basis) { return static_cast<hsize_t>(basis.size()); };
  const auto packed = file.read<float>("/control_points", {size(u), size(v), size(w), size(t), 3});
  std::vector<Vec3> coefficients(packed.size() / 3);
  for (std::size_t i = 0; i < packed.size(); ++i) {
    if (!std::isfinite(packed[i])) throw FileError(path, "a control point is not a finite number");
    coefficients[i / 3][static_cast<int>(i % 3)] = packed[i];
  }
  const CanonicalCut cut{file.read_number("/cut", "start"), file.read_number("/cut", "length"),
                         file.read_number("/cut", "depth")};
  Field field(std::move(u), std::move(v), std::move(w), std::move(t), std::move(coefficients), cut);
  field.case_hash = file.read_text("/", "case");
  field.parameters = read_parameters(file);
  for (const Figure& figure : figures) field.report.*figure.value = file.read_number("/report", figure.name);
  return field;
}

std::map<std::string, double> read_field_parameters(const std::string& path) {
  const h5::File file = h5::File::open(path);
  check_format(file);
  return read_parameters(file);
}

}  // namespace cleft
