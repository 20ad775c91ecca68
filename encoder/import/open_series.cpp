// Which reader a series needs, by the ending of its name.
#include <array>
#include <cctype>
#include <filesystem>

#include "base/error.h"
#include "encoder/import/frame_files.h"

namespace cleft {

namespace {

struct Format {
  const char* ending;
  std::unique_ptr<FrameFiles> (*open)(const std::string& path);
};

constexpr std::array<Format, 16> formats{{{".pvd", open_pvd},
                                          {".series", open_listed},
                                          {".vtkhdf", open_vtkhdf},
                                          {".hdf", open_vtkhdf},
                                          {".h5", open_vtkhdf},
                                          {".hdf5", open_vtkhdf},
                                          {".e", open_exodus},
                                          {".exo", open_exodus},
                                          {".ex2", open_exodus},
                                          {".case", open_ensight},
                                          {".encas", open_ensight},
                                          {".cgns", open_cgns},
                                          {".frd", open_frd},
                                          {".xdmf", open_xdmf},
                                          {".xmf", open_xdmf},
                                          {".exii", open_exodus}}};

/// What to do with a file of another format.
struct Refusal {
  const char *ending, *what;
};

constexpr const char* one_frame =
    "is one frame, and a series needs 2; list the files with their times in a .pvd, or in NAME.series: "
    R"({"files": [{"name": "case_0.vtk", "time": 0}, ...]})";

constexpr std::array<Refusal, 13> refusals{{
    {".vtu", one_frame},
    {".pvtu", one_frame},
    {".vtp", one_frame},
    {".vtm", one_frame},
    {".vtk", one_frame},
    {".foam", "is OpenFOAM's mark of a case; run `foamToVTK` in its folder, and import VTK/CASE.vtm.series"},
    {".inp", "is the input of Abaqus or CalculiX; import the results, .frd of CalculiX (`ccx CASE`)"},
    {".odb",
     "is read by Abaqus alone; write its frames as .vtu with `abaqus python`, and list them in a .pvd"},
    {".dat", "is text for people; import CalculiX's .frd (*NODE FILE, *EL FILE)"},
    {".msh",
     "is a mesh of Gmsh or Fluent; write it in a format of series, such as "
     "`meshio convert CASE.msh CASE.xdmf`"},
    {".bp", "is of ADIOS2; write with FEniCSx's VTKFile or XDMFFile instead of VTXWriter"},
    {".vtpc", "is of several meshes; in ParaView: Merge Blocks, then Save Data as .pvd"},
    {".med", "is of Salome; in its ParaViS: Merge Blocks, then Save Data as .pvd"},
}};

/// In lower case; of NAME.e.4.0, the first of 4 pieces, that before the numbers.
std::string format_ending(const std::string& path) {
  std::filesystem::path name(path);
  std::string ending = name.extension().string();
  while (ending.size() > 1 && ending.find_first_not_of("0123456789", 1) == std::string::npos) {
    name = name.stem();
    ending = name.extension().string();
  }
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

std::unique_ptr<FrameFiles> open_one(const std::string& path) {
  const std::string ending = format_ending(path);
  for (const Format& format : formats)
    if (ending == format.ending) return format.open(path);
  for (const Refusal& refusal : refusals)
    if (ending == refusal.ending) throw InputError(path + ": " + refusal.what);
  std::string known;
  for (const Format& format : formats) known += std::string(" ") + format.ending;
  throw InputError(path + ": unknown ending '" + ending + "' of a series; known are" + known +
                   ". What ParaView reads it writes as a .pvd: pvpython -c \"from paraview.simple import *; "
                   "SaveData('case.pvd', OpenDataFile('" +
                   std::filesystem::path(path).filename().string() + "'), WriteTimeSteps=1)\"");
}

}  // namespace

std::unique_ptr<FrameFiles> open_series(const std::vector<std::string>& paths) {
  if (paths.size() == 1) return open_one(paths.front());
  std::vector<std::unique_ptr<FrameFiles>> series;
  series.reserve(paths.size());
  for (const std::string& path : paths) series.push_back(open_one(path));
  return joined(std::move(series), paths);
}

}  // namespace cleft
