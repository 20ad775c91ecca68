#include "encoder/interpolate/common_cases.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>

#include "base/error.h"
#include "base/parallel.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"
#include "encoder/field/knot_insertion.h"
#include "params/parameters/lip_formulation.h"
#include "params/parameters/mirror_image.h"

namespace cleft {

namespace {

namespace fs = std::filesystem;

StudyMember member_of(const std::string& name, Field field, const RecordedParameters& choices) {
  for (const auto& [choice, value] : choices.texts()) field.parameters.set(choice, value);
  return {name, std::move(field)};
}

void for_each_member(const std::string& study, const std::function<void(StudyMember)>& take,
                     const ReportPart& report = {}) {
  const auto begin = [&](std::size_t i, std::size_t count) {
    if (report) report(static_cast<double>(i) / static_cast<double>(count));
  };
  if (fs::is_directory(study)) {
    std::vector<std::string> damaged;  // published_study_cases() tells them
    const std::vector<StudyCase> cases = published_study_cases(study, nullptr, &damaged);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      begin(i, cases.size());
      take(member_of(cases[i].name, read_field(cases[i].field_file), cases[i].choices));
    }
    return;
  }
  if (!fs::exists(study)) throw InputError(study + ": no such study folder or study.dffd");
  const StudyFile file(study);
  for (int i = 0; i < file.size(); ++i) {
    begin(static_cast<std::size_t>(i), static_cast<std::size_t>(file.size()));
    take({file.name(i), file.field(i)});
  }
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

std::vector<float> floats_of(const std::vector<Vec3>& points) {
  std::vector<float> flat;
  flat.reserve(3 * points.size());
  for (const Vec3& point : points)
    for (int c = 0; c < 3; ++c) flat.push_back(static_cast<float>(point[c]));
  return flat;
}

/// At the other side of the cut.
BSplineBasis mirrored(const BSplineBasis& basis) {
  constexpr double nearly = 1e-9;
  const std::vector<double>& knots = basis.knots();
  std::vector<double> turned(knots.rbegin(), knots.rend());
  bool same = true;
  for (std::size_t n = 0; n < knots.size(); ++n) {
    turned[n] = -turned[n];
    same = same && std::abs(turned[n] - knots[n]) < nearly;
  }
  return same ? basis : BSplineBasis(basis.degree(), std::move(turned));
}

/// Control points on these bases.
std::vector<float> mirrored(const std::vector<float>& points, const std::array<BSplineBasis, 4>& bases) {
  const std::size_t across = static_cast<std::size_t>(bases[1].size());
  const std::size_t row = 3ul * static_cast<std::size_t>(bases[2].size() * bases[3].size());
  std::vector<float> turned(points.size());
  for (std::size_t begin = 0; begin < points.size(); begin += across * row)
    for (std::size_t j = 0; j < across; ++j)
      for (std::size_t n = 0; n < row; ++n) {
        const float number = points[begin + j * row + n];
        turned[begin + (across - 1 - j) * row + n] = n % 3 == 1 ? -number : number;
      }
  return turned;
}

void number_bottom(RecordedParameters& p) {
  const bool bone = p->patch.bottom == PatchBottom::bone;
  p.erase(p.name_of(p->patch.bottom));
  p.set(on_bone_name, bone ? 1. : 0.);
}

std::string both(const std::string& a, const std::string& b) { return "the cases " + a + " and " + b; }

}  // namespace

RecordedParameters parameters_as_solved(const Field& field) {
  RecordedParameters p = field.parameters;
  const auto put = [&](const double& of_mesh, const double& of_cut, double solved) {
    if (of_mesh > 0 && p.has(of_cut)) p.set(of_cut, solved);
  };
  put(p->mesh.cut_length, p->cut.length, field.cut().length);
  put(p->mesh.cut_depth, p->cut.depth, field.cut().depth);
  return p;
}

struct CommonCases::Own {
  CommonCase kept;
  RecordedParameters parameters;  // as asked for
  std::string parametrization;
  std::array<BSplineBasis, 4> bases;
  std::vector<float> points;
  struct Derivative {
    std::string parameter;
    double error;
    std::vector<float> points;
  };
  std::vector<Derivative> derivatives;
};

CommonCases::Own CommonCases::own_of(const StudyMember& member) {
  const Field& field = member.field;
  Own own{{member.name, parameters_as_solved(field), field.parametrization().geometry(), field.report},
          field.parameters,
          field.parametrization().name(),
          normal_bases(field),
          floats_of(field.coefficients()),
          {}};
  for (const ParameterDerivative& one : field.by_parameter)
    own.derivatives.push_back({one.parameter, one.error * one.largest, floats_of(one.control_points)});
  return own;
}

std::vector<CommonCases::Own> CommonCases::own_of(const std::vector<StudyMember>& members) {
  std::vector<Own> all;
  for (const StudyMember& member : members) all.push_back(own_of(member));
  return all;
}

CommonCases::Own CommonCases::mirror_image_of(const Own& own) {
  Own image = own;
  image.kept.name += ", mirrored";
  for (RecordedParameters* p : {&image.parameters, &image.kept.parameters})
    for (const auto& [name, value] : p->numbers())
      if (changes_sign_in_mirror(name) && value != 0) p->set(name, -value);
  auto& [left, right] = image.kept.geometry.domain[1];
  std::swap(left, right);
  left = -left, right = -right;
  image.bases[1] = mirrored(own.bases[1]);
  image.points = mirrored(own.points, own.bases);
  for (Own::Derivative& one : image.derivatives) {
    one.points = mirrored(one.points, own.bases);
    if (changes_sign_in_mirror(one.parameter))
      for (float& number : one.points) number = -number;
  }
  return image;
}

std::vector<CommonCases::Own> CommonCases::with_mirror_images(std::vector<Own> all) {
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i)
    if (const Parameters& p = *all[i].parameters; p.cut.mirrored && mirror_image_tells(p))
      all.push_back(mirror_image_of(all[i]));
  return all;
}

void CommonCases::check_alike(const Own& a, const Own& b) {
  const std::string pair = both(a.kept.name, b.kept.name);
  if (a.parametrization != b.parametrization)
    throw InputError(pair + " are encoded with different parametrisations ('" + a.parametrization +
                     "' and '" + b.parametrization + "'); encode all cases with the same");
  const auto texts = b.parameters.texts();
  for (const auto& [name, value] : a.parameters.texts())
    if (const auto other = texts.find(name); other != texts.end() && other->second != value)
      throw InputError(pair + " differ in " + name + " (\"" + value + "\" and \"" + other->second +
                       "\"), between which nothing lies; make a study of each");
  const auto numbers = a.parameters.numbers();
  for (const auto& [name, value] : numbers)
    if (!b.parameters.number(name))
      throw InputError("case " + b.kept.name + " has no parameter " + name + ", which case " + a.kept.name +
                       " has");
  if (numbers.size() != b.parameters.numbers().size()) check_alike(b, a);
}

/// Cases of an older version, without a parameter that is 0 by default, are those with 0; a choice that
/// differs becomes a number, where it can; and how tissue is discretised is no choice of what is simulated.
std::vector<CommonCases::Own> CommonCases::made_alike(std::vector<Own> all) {
  bool springs = false, bone = false;
  for (Own& own : all)
    for (RecordedParameters* p : {&own.parameters, &own.kept.parameters}) {
      if (p->has((*p)->cut.curvature) && !p->has((*p)->cut.curvature_rate))
        p->set((*p)->cut.curvature_rate, 0);
      if (p->has((*p)->skin.bending_stiffness) && !p->has((*p)->skin.turning_stiffness))
        p->set((*p)->skin.turning_stiffness, 0);
      if (p->has((*p)->patch.bottom)) ((*p)->patch.bottom == PatchBottom::bone ? bone : springs) = true;
    }
  const auto formulation = [](const Own& own) { return own.parameters->tissue.formulation; };
  if (std::ranges::adjacent_find(all, std::ranges::not_equal_to(), formulation) != all.end())
    for (Own& own : all)
      for (RecordedParameters* p : {&own.parameters, &own.kept.parameters}) p->erase(formulation_name);
  if (springs && bone)
    for (Own& own : all)
      for (RecordedParameters* p : {&own.parameters, &own.kept.parameters}) number_bottom(*p);
  return all;
}

std::array<BSplineBasis, 4> CommonCases::common_bases(const std::vector<Own>& all) {
  constexpr const char* axes[] = {"along the cut", "across it", "in height", "in time"};
  if (all.empty()) throw InputError("the study holds no case; run it, or cleft pack it again");
  for (const Own& own : all) check_alike(all.front(), own);
  std::array<BSplineBasis, 4> bases = all.front().bases;
  for (const Own& own : all)
    for (int axis = 0; axis < 4; ++axis) try {
        bases[axis] = common_basis(bases[axis], own.bases[axis]);
      } catch (const InputError& e) {
        throw InputError(
            both(all.front().kept.name, own.kept.name) + " have no common knots " + axes[axis] + ": " +
            e.what() +
            "; all cuts of a study must end within the patch, or all at the same of its edges, and "
            "cases have at least four frames");
      }
  return bases;
}

/// All but those of the same parameters that are fitted worse.
std::vector<bool> CommonCases::distinct(const std::vector<Own>& all) {
  std::map<std::map<std::string, double>, const Own*> best;
  for (const Own& own : all) {
    const Own*& kept = best[own.kept.parameters.numbers()];
    if (!kept || own.kept.report.spline_error < kept->kept.report.spline_error) kept = &own;
  }
  std::vector<bool> list;
  for (const Own& own : all) list.push_back(best[own.kept.parameters.numbers()] == &own);
  return list;
}

void name_bottom(RecordedParameters& p) {
  const auto number = p.number(on_bone_name);
  if (!number) return;
  p.erase(on_bone_name);
  p.set(p.name_of(p->patch.bottom), std::string(*number > 0.5 ? "bone" : "springs"));
}

std::vector<StudyMember> read_members(const std::string& study) {
  std::vector<StudyMember> members;
  for_each_member(study, [&](StudyMember member) { members.push_back(std::move(member)); });
  return members;
}

CommonCases CommonCases::of_study(const std::string& study, const ReportPart& report) {
  std::vector<Own> all;
  for_each_member(
      study, [&](const StudyMember& member) { all.push_back(own_of(member)); }, report);
  return CommonCases(made_alike(with_mirror_images(std::move(all))));
}

CommonCases CommonCases::of_records(const std::vector<const StudyRecord*>& records) {
  std::vector<Own> all;
  for (const StudyRecord* one : records)
    told_of_file("cases/" + one->name + "/case.dffd", [&] {
      all.push_back(own_of(member_of(one->name, cleft::field_of(one->record), one->choices)));
    });
  return CommonCases(made_alike(std::move(all)));
}

CommonCases::CommonCases(const std::vector<StudyMember>& members)
    : CommonCases(made_alike(with_mirror_images(own_of(members)))) {}

CommonCases::CommonCases(std::vector<Own> all) : bases_(common_bases(all)) {
  parametrization_ = all.front().parametrization;
  const std::vector<bool> is_kept = distinct(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Own own = std::move(all[i]);
    if (!is_kept[i]) continue;
    const auto raised = [&](std::vector<float>& points) {
      return own.bases == bases_ ? std::move(points)
                                 : floats_of(insert_knots(points_of(points), own.bases, bases_));
    };
    cases_.push_back(own.kept);
    const double strength = own.kept.report.regularisation;
    fitted_alike_ = fitted_alike_ && own.bases == bases_ && strength > 0 &&
                    strength == cases_.front().report.regularisation;
    points_.push_back(raised(own.points));
    for (Own::Derivative& one : own.derivatives) {
      derivatives_.push_back({size() - 1, one.parameter, one.error});
      derivative_points_.push_back(raised(one.points));
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

std::vector<Vec3> sum_of(const std::vector<Summand>& summands) {
  constexpr std::size_t piece = 3 * 1024;  // stays in the nearest cache
  const std::size_t size = summands.front().values.size();
  std::vector<Vec3> sum(size / 3);
  parallel_for(static_cast<int>((size + piece - 1) / piece), [&](int number) {
    const std::size_t begin = static_cast<std::size_t>(number) * piece;
    const std::size_t count = std::min(piece, size - begin);
    std::array<double, piece> to{};
    for (const auto& [weight, values] : summands) {
      if (weight == 0) continue;
      const float* from = values.data() + begin;
      for (std::size_t n = 0; n < count; ++n) to[n] += weight * static_cast<double>(from[n]);
    }
    for (std::size_t n = 0; n < count; ++n) sum[(begin + n) / 3][static_cast<int>(n % 3)] = to[n];
  });
  return sum;
}

std::array<BSplineBasis, 4> CommonCases::bases_in(const FieldGeometry& geometry) const {
  std::array<BSplineBasis, 4> bases = bases_;
  if (make_parametrization(parametrization_, geometry)->moves()) return bases;
  for (int axis = 0; axis < 4; ++axis) {
    const Scale scale = scale_of(geometry, axis);
    bases[axis] = mapped(bases[axis], [&](double knot) { return scale.own(knot); });
  }
  return bases;
}

Field CommonCases::field_of(const std::vector<Vec3>& points, FieldGeometry geometry) const {
  std::array<BSplineBasis, 4> bases = bases_in(geometry);
  return {make_parametrization(parametrization_, std::move(geometry)), std::move(bases), points};
}

}  // namespace cleft
