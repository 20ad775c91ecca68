#include <pybind11/stl.h>

#include <filesystem>
#include <map>
#include <optional>

#include "base/h5/h5.h"
#include "encoder/interpolate/study_interpolator.h"
#include "explorer/study/find.h"
#include "explorer/study/study.h"
#include "python/arrays.h"

namespace cleft::python {

namespace {

/// The cases of a study, and once something between them is asked for, what interpolates them. HDF5 is not
/// thread-safe: what reads files keeps the interpreter's lock.
class Study {
 public:
  explicit Study(const std::string& path) : study_(path) {}

  const PublishedStudy& study() const { return study_; }
  SharedField field(int i) {
    check(i);
    return {study_.field(i)};
  }
  void check(int i) const {
    if (i < 0 || i >= study_.size())
      throw py::index_error("case " + std::to_string(i) + ": " + study_.path() + " holds cases 0 to " +
                            std::to_string(study_.size() - 1));
  }
  const StudyInterpolator& interpolator() {
    if (!interpolator_) interpolator_.emplace(study_.path());
    return *interpolator_;
  }

 private:
  PublishedStudy study_;
  std::optional<StudyInterpolator> interpolator_;
};

SharedField interpolated(Study& self, const CaseParameters& values) {
  const StudyInterpolator& interpolator = self.interpolator();
  const py::gil_scoped_release unlocked;
  return {std::make_shared<const Field>(interpolator.at(values))};
}

py::list found(const Study& self, const std::string& where) {
  const Condition condition(where);
  py::list rows;
  for (int i = 0; i < self.study().size(); ++i) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const std::optional<Finding> one = find_in_case(condition, self.study(), i);
    if (!one) continue;
    py::dict row;
    row["case"] = i, row["hash"] = self.study().hash(i);
    row["first_t"] = one->first_t, row["last_t"] = one->last_t;
    row["least_u"] = one->least_u, row["greatest_u"] = one->greatest_u;
    row["gape"] = one->gape, row["at_t"] = one->best_t, row["at_u"] = one->best_u;
    row["confirmed"] = one->confirmed;
    rows.append(row);
  }
  return rows;
}

/// Dotted names by what Python takes for a keyword: skin_prestress_v.
std::map<std::string, std::string> keywords() {
  std::map<std::string, std::string> names;
  for (const std::string& name : parameter_names()) {
    std::string keyword = name;
    std::replace(keyword.begin(), keyword.end(), '.', '_');
    names[keyword] = name;
  }
  return names;
}

/// The numbers of the table of parameters, in its order.
py::list parameter_numbers() {
  py::list rows;
  for (const Parameter& one : parameter_table()) {
    if (one.is_text()) continue;
    py::dict row;
    row["name"] = one.name, row["unit"] = one.unit, row["help"] = one.help;
    rows.append(row);
  }
  return rows;
}

}  // namespace

void bind_study(py::module_& module) {
  using py::arg;
  py::class_<Study>(module, "Study")
      .def(py::init<std::string>(), arg("path"))
      .def("__len__", [](const Study& self) { return self.study().size(); })
      .def_property_readonly("path", [](const Study& self) { return self.study().path(); })
      .def_property_readonly("varying", [](const Study& self) { return self.study().varying(); })
      .def_property_readonly("damaged", [](const Study& self) { return self.study().damaged(); })
      .def_property_readonly("older", [](const Study& self) { return self.study().older(); })
      .def(
          "name", [](const Study& self, int i) { return self.check(i), self.study().name(i); }, arg("i"))
      .def(
          "hash", [](const Study& self, int i) { return self.check(i), self.study().hash(i); }, arg("i"))
      .def(
          "snapshot", [](const Study& self, int i) { return self.check(i), self.study().snapshot(i); },
          arg("i"))
      .def(
          "parameters",
          [](const Study& self, int i) { return self.check(i), dict_of(self.study().parameters(i)); },
          arg("i"))
      .def(
          "report", [](const Study& self, int i) { return self.check(i), dict_of(self.study().report(i)); },
          arg("i"))
      .def("field", &Study::field, arg("i"))
      .def("interpolated", &interpolated, arg("values"))
      .def("found", &found, arg("where"));
  module.def(
      "format_of",
      [](const std::string& path) -> std::string {
        if (std::filesystem::is_directory(path)) return "folder";
        if (!std::filesystem::exists(path))
          throw InputError(path +
                           ": no such file or folder (give a study folder, a study.dffd, a case.dffd or a "
                           "case.h5)");
        return cleft::format_of(path);
      },
      arg("path"));
  module.def("parameter_numbers", &parameter_numbers);
  module.def(
      "parameter_of_keyword",
      [](const std::string& word) {
        static const std::map<std::string, std::string> names = keywords();
        const auto known = names.find(word);
        return find_parameter(known == names.end() ? word : known->second, "sel").name;
      },
      arg("word"));
}

}  // namespace cleft::python
