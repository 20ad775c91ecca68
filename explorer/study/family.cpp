#include "explorer/study/family.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "encoder/interpolate/case_modes.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

constexpr const char* height_name = "patch.height";
constexpr std::array shape_names = {"cut.curvature",     "cut.curvature_rate", "cut.tilt",
                                    "cut.depth",         "skin.curvature_u",   "skin.curvature_v",
                                    "skin.curvature_uv", height_name};
/// The choice between springs and bone, and the number that stands for it.
constexpr std::array bottom_names = {"patch.bottom", on_bone_name};
constexpr std::array prestress_names = {"skin.prestress_u", "skin.prestress_v", "skin.prestress_uv"};
/// What modes leave of each case, root mean square: a fraction of the error of its fit.
constexpr double error_of_modes = 2e-3;

template <class List>
bool is_in(const List& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

struct Family::Parts {
  explicit Parts(const std::string& study) : between(study), modes(between, error_of_modes) {}
  StudyInterpolator between;
  CaseModes modes;
};

bool Family::describes(const std::vector<std::string>& varying) {
  bool any_shape = false;
  std::size_t components = 0;
  for (const std::string& name : varying)
    if (is_in(shape_names, name))
      any_shape = true;
    else if (is_in(prestress_names, name))
      ++components;
    else if (!is_in(bottom_names, name))
      return false;
  return any_shape && components == prestress_names.size();
}

Family::Family(const std::string& study) : parts_(std::make_unique<Parts>(study)) {
  std::vector<std::string> varying;
  for (const auto& [name, least, greatest] : parts_->between.varying()) {
    varying.push_back(name);
    if (is_in(shape_names, name)) shapes_[name] = {least, greatest};
  }
  if (!describes(varying)) {
    std::string list;
    for (const std::string& name : varying) list += (list.empty() ? "" : ", ") + name;
    throw InputError(
        study + ": its cases differ in " + list +
        "; those of a family differ in the shape of the skin or the cut (cut.curvature, ...) and "
        "in unit tensions (sampling.unit_tensions), but in nothing else");
  }
  for (const CommonCase& one : parts_->between.cases().cases())
    if (const auto number = one.parameters.number(on_bone_name)) {
      on_bone_ = true;
      if (*number == 0) whole_height_ = one.parameters->patch.height;
    }
  std::map<std::string, double> middle;
  for (const auto& [name, range] : shapes_)
    middle[name] = name == height_name                     ? std::numeric_limits<double>::infinity()
                   : range.least < 0 && range.greatest > 0 ? 0
                                                           : (range.least + range.greatest) / 2;
  Prestress across;
  for (const CommonCase& one : parts_->between.cases().cases())
    across.vv = std::max(across.vv, one.parameters->skin.prestress.vv);
  middle_ = at(middle, across).field;
}

Family::~Family() = default;

Family::Member Family::at(std::map<std::string, double> shapes, const Prestress& prestress) const {
  double beyond = 0;
  CaseParameters values;
  for (const auto& [name, range] : shapes_) {
    const double wanted = shapes.at(name), value = std::clamp(wanted, range.least, range.greatest);
    if (std::isfinite(wanted))
      beyond = std::max(beyond, std::abs(wanted - value) / ((range.greatest - range.least) / 2));
    values[name] = value;
  }
  if (on_bone_) {
    const bool bone = shapes.at(height_name) < whole_height_;
    values[on_bone_name] = bone;
    if (!bone) values[height_name] = whole_height_;
  }
  const std::array components = {prestress.uu, prestress.vv, prestress.uv};
  const auto recorded = parts_->between.cases().cases().front().parameters.numbers();
  for (std::size_t k = 0; k < components.size(); ++k)
    if (recorded.contains(prestress_names[k])) values[prestress_names[k]] = components[k];
  return {std::make_shared<const Field>(parts_->modes.at(values)), beyond};
}

}  // namespace cleft
