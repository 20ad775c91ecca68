// Files with all frames in them, by VTK's readers: Exodus, EnSight, CGNS.
#include <vtkCGNSReader.h>
#include <vtkDataObject.h>
#include <vtkExodusIIReader.h>
#include <vtkGenericEnSightReader.h>
#include <vtkInformation.h>
#include <vtkLogger.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "base/error.h"
#include "base/vtk_listener.h"
#include "encoder/import/read_apart.h"
#include "encoder/import/vtk_frames.h"

namespace cleft {

namespace {

using Algorithm = vtkSmartPointer<vtkAlgorithm>;

/// Displacements that are part of the data move no points.
Algorithm exodus(const std::string& path) {
  auto reader = vtkSmartPointer<vtkExodusIIReader>::New();
  if (reader->CanReadFile(path.c_str()) == 0) throw FileError(path, "is no Exodus file, or is damaged");
  reader->SetFileName(path.c_str());
  reader->ApplyDisplacementsOff();
  reader->UpdateInformation();
  for (int i = 0; i < reader->GetNumberOfPointResultArrays(); ++i)
    reader->SetPointResultArrayStatus(reader->GetPointResultArrayName(i), 1);
  for (int i = 0; i < reader->GetNumberOfElementResultArrays(); ++i)
    reader->SetElementResultArrayStatus(reader->GetElementResultArrayName(i), 1);
  return reader;
}

Algorithm ensight(const std::string& path) {
  auto reader = vtkSmartPointer<vtkGenericEnSightReader>::New();
  reader->SetCaseFileName(path.c_str());
  reader->ReadAllVariablesOn();
  return reader;
}

Algorithm cgns(const std::string& path) {
  auto reader = vtkSmartPointer<vtkCGNSReader>::New();
  if (reader->CanReadFile(path.c_str()) == 0) throw FileError(path, "is no CGNS file, or is damaged");
  reader->SetFileName(path.c_str());
  reader->UpdateInformation();
  reader->EnableAllBases();
  reader->EnableAllPointArrays();
  reader->EnableAllCellArrays();
  return reader;
}

/// NAME.e.4.0, ..., NAME.e.4.3 of the one that is named; or that one alone.
std::vector<std::string> pieces_of(const std::string& path) {
  const std::filesystem::path name(path);
  const auto digits = [](const std::string& ending) {
    return ending.size() > 1 && ending.size() < 8 &&
           ending.find_first_not_of("0123456789", 1) == std::string::npos;
  };
  const std::string own = name.extension().string(), of = name.stem().extension().string();
  if (!digits(own) || !digits(of)) return {path};
  std::vector<std::string> pieces;
  const int count = std::stoi(of.substr(1));
  for (int i = 0; i < count; ++i) {
    std::string number = std::to_string(i);
    if (number.size() + 1 < own.size()) number.insert(0, own.size() - 1 - number.size(), '0');
    pieces.push_back((name.parent_path() / name.stem()).string() + "." + number);
    if (!std::filesystem::is_regular_file(pieces.back()))
      throw InputError(path + ": is one of " + std::to_string(count) + " pieces, and there is no file '" +
                       pieces.back() + "'");
  }
  if (pieces.empty()) throw InputError(path + ": is one of 0 pieces");
  return pieces;
}

/// One file, open.
class ReaderFile {
 public:
  ReaderFile(const std::string& path, Algorithm (*open)(const std::string&)) : path_(path) {
    if (!std::ifstream(path)) throw FileError(path, "cannot be opened: does it exist?");
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
    reader_ = open(path);
    reading_.emplace(reader_.Get());
    reading_->listen_to_output_window();  // EnSight's reader has others read
    reader_->UpdateInformation();
    refuse_errors();
    vtkInformation* information = reader_->GetOutputInformation(0);
    auto* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
    if (information->Has(key))
      times_.assign(information->Get(key), information->Get(key) + information->Length(key));
  }

  const std::string& path() const { return path_; }
  const std::vector<double>& times() const { return times_; }
  vtkDataObject* data(std::size_t frame) const {
    reader_->UpdateTimeStep(times_[frame]);
    refuse_errors();
    return reader_->GetOutputDataObject(0);
  }

 private:
  void refuse_errors() const {
    if (reading_->failed()) throw FileError(path_, "cannot be read: " + reading_->reason());
  }

  std::string path_;
  Algorithm reader_;
  std::optional<VtkListener> reading_;
  std::vector<double> times_;
};

/// The libraries behind these readers may end the program on damaged files: each file is read once before, in
/// a process that may.
class ReaderFiles : public FrameFiles {
 public:
  ReaderFiles(const std::string& path, Algorithm (*open)(const std::string&)) {
    const std::vector<std::string> pieces = pieces_of(path);
    for (const std::string& piece : pieces)
      read_apart(piece, [&] {
        const ReaderFile file(piece, open);
        for (std::size_t j = 0; j < file.times().size(); ++j)
          if (vtkDataObject* data = file.data(j);
              point_array_names(data).empty() && cell_array_names(data).empty())
            throw FileError(piece, "holds no fields in frame " + std::to_string(j) + ", or is damaged");
      });
    for (const std::string& piece : pieces)
      if (files_.push_back(std::make_unique<ReaderFile>(piece, open)); files_.back()->times() != times())
        throw FileError(piece, "has other times than " + files_.front()->path());
    in_pieces_ = files_.size() > 1 || (!times().empty() && has_pieces(files_.front()->data(0)));
  }

  std::vector<std::string> files() const override {
    std::vector<std::string> paths;
    for (const auto& file : files_) paths.push_back(file->path());
    return paths;
  }
  const std::vector<double>& times() const override { return files_.front()->times(); }
  bool in_pieces() const override { return in_pieces_; }
  const std::string& file(std::size_t) const override { return files_.front()->path(); }
  std::vector<std::string> point_arrays(std::size_t frame) const override {
    return point_array_names(files_.front()->data(frame));
  }
  std::vector<std::string> cell_arrays(std::size_t frame) const override {
    return cell_array_names(files_.front()->data(frame));
  }
  SourceFrame read(std::size_t frame, const WantedArrays& wanted) const override {
    SourceFrame all = frame_of(files_.front()->data(frame), wanted, files_.front()->path());
    for (std::size_t i = 1; i < files_.size(); ++i)
      append(all, frame_of(files_[i]->data(frame), wanted, files_[i]->path()), files_[i]->path());
    return all;
  }

 private:
  std::vector<std::unique_ptr<ReaderFile>> files_;
  bool in_pieces_ = false;
};

}  // namespace

std::unique_ptr<FrameFiles> open_exodus(const std::string& path) {
  return std::make_unique<ReaderFiles>(path, exodus);
}
std::unique_ptr<FrameFiles> open_ensight(const std::string& path) {
  return std::make_unique<ReaderFiles>(path, ensight);
}
std::unique_ptr<FrameFiles> open_cgns(const std::string& path) {
  return std::make_unique<ReaderFiles>(path, cgns);
}

}  // namespace cleft
