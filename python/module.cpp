// The compiled part of the Python module `cleft`: fields, studies, snapshots, cuts.
#include "base/error.h"
#include "base/h5/h5.h"
#include "base/version.h"
#include "python/arrays.h"

PYBIND11_MODULE(_cleft, module) {
  namespace py = pybind11;
  using namespace cleft::python;
  module.doc() = "The compiled part of the module cleft.";
  module.attr("__version__") = CLEFT_VERSION;
  const auto input = py::register_exception<cleft::InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<cleft::FileError>(module, "FileError", input.ptr());
  cleft::h5::read_apart();  // h5py and VTK use the same library
  module.def("hdf5_version", &cleft::h5::version);
  bind_field(module);
  bind_blended(module);
  bind_study(module);
  bind_snapshot(module);
  bind_encode(module);
  bind_cut(module);
}
