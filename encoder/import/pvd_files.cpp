#include <vtkDataArraySelection.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkLogger.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "base/vtk_listener.h"
#include "encoder/import/vtk_frames.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

std::string ending_of(const std::string& path) { return fs::path(path).extension().string(); }

bool is_frame(const std::string& ending) {
  return ending == ".pvtu" || ending == ".vtm" || ending == ".vtu" || ending == ".vtp" || ending == ".vtk" ||
         ending == ".frd";
}

vtkSmartPointer<vtkXMLReader> reader_of(const std::string& ending) {
  if (ending == ".pvtu") return vtkSmartPointer<vtkXMLPUnstructuredGridReader>::New();
  if (ending == ".vtp") return vtkSmartPointer<vtkXMLPolyDataReader>::New();
  if (ending == ".vtm") return vtkSmartPointer<vtkXMLMultiBlockDataReader>::New();
  return vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
}

/// One file of a frame, read as a whole or, where VTK's reader can, in part; of results of CalculiX the last.
class FrameFile {
 public:
  explicit FrameFile(const std::string& path) : path_(path) {
    if (!std::ifstream(path)) throw FileError(path, "cannot be opened: does it exist?");
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
    const std::string ending = ending_of(path);
    if (ending == ".frd") {
      results_ = open_frd(path);
      if (results_->times().empty()) throw FileError(path, "holds no results");
      return;
    }
    if (ending == ".vtk") {
      legacy_ = vtkSmartPointer<vtkGenericDataObjectReader>::New();
      reading_.emplace(legacy_.Get());
      legacy_->SetFileName(path.c_str());
      legacy_->ReadAllScalarsOn(), legacy_->ReadAllVectorsOn(), legacy_->ReadAllTensorsOn();
      legacy_->ReadAllFieldsOn(), legacy_->ReadAllNormalsOn();
      legacy_->Update();
    } else {
      xml_ = reader_of(ending);
      reading_.emplace(xml_.Get());
      xml_->SetFileName(path.c_str());
      if (ending == ".vtm")  // what its blocks hold shows when they are read
        xml_->Update();
      else
        xml_->UpdateInformation();
    }
    refuse_errors();
  }

  std::vector<std::string> point_arrays() {
    if (results_) return results_->point_arrays(last());
    return in_part() ? names_of(xml_->GetPointDataArraySelection()) : point_array_names(data());
  }
  std::vector<std::string> cell_arrays() {
    if (results_) return {};
    return in_part() ? names_of(xml_->GetCellDataArraySelection()) : cell_array_names(data());
  }

  /// Pieces have their own nodes where they meet; a grid and its patches are one.
  bool in_pieces() {
    const std::string ending = ending_of(path_);
    return ending == ".pvtu" || (ending == ".vtm" && has_pieces(data()));
  }

  SourceFrame read(const WantedArrays& wanted) {
    if (results_) return results_->read(last(), wanted);
    if (in_part()) {
      select(xml_->GetPointDataArraySelection(), wanted.points);
      select(xml_->GetCellDataArraySelection(), wanted.cells);
      xml_->Update();
      refuse_errors();
    }
    return frame_of(data(), wanted, path_);
  }

 private:
  std::size_t last() const { return results_->times().size() - 1; }
  bool in_part() const { return xml_ && ending_of(path_) != ".vtm"; }
  vtkDataObject* data() { return legacy_ ? legacy_->GetOutput() : xml_->GetOutputDataObject(0); }

  static std::vector<std::string> names_of(vtkDataArraySelection* selection) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(selection->GetNumberOfArrays()));
    for (int i = 0; i < selection->GetNumberOfArrays(); ++i) names.emplace_back(selection->GetArrayName(i));
    return names;
  }
  static void select(vtkDataArraySelection* selection, const std::vector<std::string>& names) {
    selection->DisableAllArrays();
    for (const std::string& name : names) selection->EnableArray(name.c_str());
  }

  void refuse_errors() const {
    if (reading_->failed())
      throw FileError(path_, "cannot be read as an unstructured grid: " + reading_->reason());
  }

  std::string path_;
  vtkSmartPointer<vtkXMLReader> xml_;
  vtkSmartPointer<vtkGenericDataObjectReader> legacy_;
  std::optional<VtkListener> reading_;
  std::unique_ptr<FrameFiles> results_;
};

/// Frames of one or more files each.
class ListedFiles : public FrameFiles {
 public:
  std::vector<std::string> files() const override {
    std::vector<std::string> all = {path_};
    for (const auto& frame : frames_) all.insert(all.end(), frame.begin(), frame.end());
    return all;
  }
  const std::vector<double>& times() const override { return times_; }
  bool in_pieces() const override {
    return in_parts_ || (!frames_.empty() && FrameFile(file(0)).in_pieces());
  }
  const std::string& file(std::size_t frame) const override { return frames_[frame].front(); }
  std::vector<std::string> point_arrays(std::size_t frame) const override {
    return FrameFile(file(frame)).point_arrays();
  }
  std::vector<std::string> cell_arrays(std::size_t frame) const override {
    return FrameFile(file(frame)).cell_arrays();
  }
  SourceFrame read(std::size_t frame, const WantedArrays& wanted) const override {
    SourceFrame all = FrameFile(file(frame)).read(wanted);
    for (std::size_t i = 1; i < frames_[frame].size(); ++i)
      append(all, FrameFile(frames_[frame][i]).read(wanted), frames_[frame][i]);
    return all;
  }

 protected:
  explicit ListedFiles(const std::string& path) : path_(path) {
    if (!std::ifstream(path)) throw FileError(path, "cannot be opened: does it exist?");
  }

  /// `part`: of the frame before, where it has the same time.
  void add(const std::string& where, const std::string& name, double time, bool part) {
    const std::string file = (fs::path(path_).parent_path() / name).string(), ending = ending_of(file);
    if (!is_frame(ending))
      throw InputError(where + ": '" + name +
                       "' is no .vtu file, nor a .pvtu, .vtp, .vtm, .vtk or .frd; write unstructured grids "
                       "or surfaces (in "
                       "ParaView: Merge Blocks, then Save Data as .pvd)");
    if (!fs::is_regular_file(file)) throw InputError(where + ": there is no file '" + file + "'");
    if (part && !times_.empty() && times_.back() == time) {
      frames_.back().push_back(file), in_parts_ = true;
      return;
    }
    frames_.push_back({file});
    times_.push_back(time);
  }

  std::string path_;

 private:
  std::vector<std::vector<std::string>> frames_;
  std::vector<double> times_;
  bool in_parts_ = false;  // files that are parts of one frame
};

class PvdFiles : public ListedFiles {
 public:
  explicit PvdFiles(const std::string& path) : ListedFiles(path) {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    const auto root =
        vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (!list) throw FileError(path, "is no .pvd file, which has a <Collection> of files, or is damaged");
    std::string part_before;
    for (int i = 0, entry = 1; i < list->GetNumberOfNestedElements(); ++i) {
      vtkXMLDataElement* element = list->GetNestedElement(i);
      if (element->GetName() != std::string("DataSet")) continue;
      const std::string where = path + ": entry " + std::to_string(entry++);
      const char *name = element->GetAttribute("file"), *time = element->GetAttribute("timestep"),
                 *part = element->GetAttribute("part");
      if (!name || !time) throw InputError(where + " lacks " + (name ? "timestep" : "file"));
      const bool another = part && part_before != part;
      add(where, name, parse_number(time, where + ", timestep"), another);
      part_before = part ? part : "";
    }
  }
};

/// ParaView's list of files: NAME.vtk.series and the like, in JSON.
class SeriesFiles : public ListedFiles {
 public:
  explicit SeriesFiles(const std::string& path) : ListedFiles(path) {
    try {
      std::ifstream stream(path);
      const nlohmann::json list = nlohmann::json::parse(stream);
      for (std::size_t i = 0; i < list.at("files").size(); ++i) {
        const nlohmann::json& entry = list.at("files").at(i);
        add(path + ": entry " + std::to_string(i + 1), entry.at("name").get<std::string>(),
            entry.at("time").get<double>(), false);
      }
    } catch (const nlohmann::json::exception&) {
      throw FileError(path,
                      "is no list of files with names and times, {\"files\": [{\"name\": \"case_0.vtk\", "
                      "\"time\": 0}, ...]}, or is damaged");
    }
  }
};

}  // namespace

SourceMesh read_vtu_mesh(const std::string& path) { return FrameFile(path).read({}).mesh; }

std::unique_ptr<FrameFiles> open_pvd(const std::string& path) { return std::make_unique<PvdFiles>(path); }

std::unique_ptr<FrameFiles> open_listed(const std::string& path) {
  return std::make_unique<SeriesFiles>(path);
}

}  // namespace cleft
