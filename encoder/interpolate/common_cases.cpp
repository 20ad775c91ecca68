#include "encoder/interpolate/common_cases.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "encoder/field/field_file.h"
#include "encoder/field/knot_insertion.h"
#include "encoder/field/study_file.h"

namespace cleft {

namespace {

namespace fs = std::filesystem;

std::vector<StudyMember> members_of_folder(const std::string& path) {
  std::vector<StudyMember> members;
  for (const StudyCase& one : published_study_cases(path))
    members.push_back({one.name, read_field(one.field_file), one.choices});
  return members;
}

std::vector<StudyMember> members_of_file(const std::string& path) {
  const StudyFile file(path);
  std::vector<StudyMember> members;
  for (int i = 0; i < file.size(); ++i) members.push_back({file.name(i), file.field(i), file.choices(i)});
  return members;
}

/// The cut ends at nodes: where the mesh was made for another one, not where it was asked to.
std::map<std::string, double> parameters_as_solved(const Field& field) {
  auto parameters = field.parameters;
  const auto put = [&](const char* mesh, const char* cut, double solved) {
    const auto of_mesh = parameters.find(mesh);
    if (of_mesh != parameters.end() && of_mesh->second > 0 && parameters.contains(cut))
      parameters[cut] = solved;
  };
  put("mesh.cut_length", "cut.length", field.cut().length);
  put("mesh.cut_depth", "cut.depth", field.cut().depth);
  return parameters;
}

/// A map of an axis onto one that is the same in all cases: linear, on each side of the cut across it.
struct Scale {
  double front, middle, back;  ///< go to -1, 0, 1; to 0 and 1 where there is no middle

  double normal(double x) const {
    if (std::isnan(middle)) return (x - front) / (back - front);
    return (x - middle) / (x < middle ? middle - front : back - middle);
  }
  double own(double x) const {
    if (std::isnan(middle)) return x == 1 ? back : front + x * (back - front);
    return x == -1 ? front : x == 1 ? back : middle + x * (x < 0 ? middle - front : back - middle);
  }
};

template <class Map>
BSplineBasis mapped(const BSplineBasis& basis, const Map& map) {
  std::vector<double> knots = basis.knots();
  for (double& knot : knots) knot = map(knot);
  return {basis.degree(), std::move(knots)};
}

Scale scale_of(const FieldGeometry& geometry, int axis) {
  const auto [front, back] = geometry.domain[axis];
  return {front, axis == 1 && geometry.cut.length > 0 ? 0 : std::nan(""), back};
}

std::array<BSplineBasis, 4> normal_bases(const Field& field) {
  std::array<BSplineBasis, 4> bases{field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
  if (field.parametrization().moves()) return bases;  // it has normalised them itself
  for (int axis = 0; axis < 4; ++axis) {
    const Scale scale = scale_of(field.parametrization().geometry(), axis);
    // Rounded, so that knots at the same places of different bodies are the same.
    bases[axis] =
        mapped(bases[axis], [&](double knot) { return std::round(scale.normal(knot) * 0x1p40) * 0x1p-40; });
  }
  return bases;
}

std::string both(const StudyMember& a, const StudyMember& b) {
  return "the cases " + a.name + " and " + b.name;
}

void check_alike(const StudyMember& a, const StudyMember& b) {
  const std::string of_a = a.field.parametrization().name(), of_b = b.field.parametrization().name();
  if (of_a != of_b)
    throw InputError(both(a, b) + " are encoded with different parametrisations ('" + of_a + "' and '" +
                     of_b + "'); encode all cases with the same");
  for (const auto& [name, value] : a.choices)
    if (const auto other = b.choices.find(name); other != b.choices.end() && other->second != value)
      throw InputError(both(a, b) + " differ in " + name + " (\"" + value + "\" and \"" + other->second +
                       "\"), between which nothing lies; make a study of each");
  for (const auto& [name, value] : a.field.parameters)
    if (!b.field.parameters.contains(name))
      throw InputError("case " + b.name + " has no parameter " + name + ", which case " + a.name + " has");
  if (a.field.parameters.size() != b.field.parameters.size()) check_alike(b, a);
}

std::array<BSplineBasis, 4> common_bases(const std::vector<StudyMember>& members) {
  constexpr const char* axes[] = {"along the cut", "across it", "in height", "in time"};
  std::array<BSplineBasis, 4> bases = normal_bases(members.front().field);
  for (const StudyMember& member : members) {
    const auto own = normal_bases(member.field);
    for (int axis = 0; axis < 4; ++axis) try {
        bases[axis] = common_basis(bases[axis], own[axis]);
      } catch (const InputError& e) {
        throw InputError(
            both(members.front(), member) + " have no common knots " + axes[axis] + ": " + e.what() +
            "; all cuts of a study must end within the patch, or all at the same of its edges, and "
            "cases have at least four frames");
      }
  }
  return bases;
}

/// Without those of the same parameters that are fitted worse.
std::vector<const StudyMember*> distinct(const std::vector<StudyMember>& members) {
  std::map<std::map<std::string, double>, const StudyMember*> best;
  for (const StudyMember& member : members) {
    const StudyMember*& kept = best[parameters_as_solved(member.field)];
    if (!kept || member.field.report.spline_error < kept->field.report.spline_error) kept = &member;
  }
  std::vector<const StudyMember*> list;
  for (const StudyMember& member : members)
    if (best[parameters_as_solved(member.field)] == &member) list.push_back(&member);
  return list;
}

}  // namespace

std::vector<StudyMember> read_members(const std::string& study) {
  if (fs::is_directory(study)) return members_of_folder(study);
  if (!fs::exists(study)) throw InputError(study + ": no such study folder or study.dffd");
  return members_of_file(study);
}

CommonCases::CommonCases(const std::vector<StudyMember>& members)
    : bases_{
          members.empty()
              ? throw InputError("the study holds no case; run it, or cleft pack it again")
              : common_bases((std::for_each(members.begin(), members.end(),
                                            [&](const StudyMember& m) { check_alike(members.front(), m); }),
                              members))} {
  parametrization_ = members.front().field.parametrization().name();
  choices_ = members.front().choices;
  for (const StudyMember* member : distinct(members)) {
    const Field& field = member->field;
    cases_.push_back(
        {member->name, parameters_as_solved(field), field.parametrization().geometry(), field.report});
    const auto own = normal_bases(field);
    const auto raised = [&](const std::vector<Vec3>& control_points) {
      std::vector<float> points;
      for (const Vec3& point : insert_knots(control_points, own, bases_))
        for (int c = 0; c < 3; ++c) points.push_back(static_cast<float>(point[c]));
      return points;
    };
    points_.push_back(raised(field.coefficients()));
    for (const ParameterDerivative& one : field.by_parameter) {
      derivatives_.push_back({size() - 1, one.parameter, one.error * one.largest});
      derivative_points_.push_back(raised(one.control_points));
    }
  }
  if (cases_.size() < 2)
    throw InputError(
        "the study holds one case (of different parameters); nothing lies between fewer than two");
}

std::vector<Vec3> CommonCases::points(int i) const { return points_of(control_points(i)); }

std::vector<Vec3> points_of(std::span<const float> flat) {
  std::vector<Vec3> points(flat.size() / 3);
  for (std::size_t n = 0; n < flat.size(); ++n)
    points[n / 3][static_cast<int>(n % 3)] = static_cast<double>(flat[n]);
  return points;
}

Field CommonCases::field_of(const std::vector<Vec3>& points, FieldGeometry geometry) const {
  std::array<BSplineBasis, 4> bases = bases_;
  auto parametrization = make_parametrization(parametrization_, std::move(geometry));
  if (!parametrization->moves())
    for (int axis = 0; axis < 4; ++axis) {
      const Scale scale = scale_of(parametrization->geometry(), axis);
      bases[axis] = mapped(bases[axis], [&](double knot) { return scale.own(knot); });
    }
  return {std::move(parametrization), std::move(bases), points};
}

}  // namespace cleft
