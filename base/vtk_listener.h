// VTK's errors as values. The only header of base that includes VTK, for sources that read or write with it.
#pragma once

#include <vtkCallbackCommand.h>
#include <vtkDataObject.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace cleft {

/// VTK reports errors as events. This object keeps the first error of a reader or writer, and nothing is
/// printed.
class VtkListener {
 public:
  template <class Algorithm>
  explicit VtkListener(Algorithm* algorithm) {
    command_->SetClientData(&message_);
    command_->SetCallback([](vtkObject*, unsigned long, void* message, void* text) {
      auto& first = *static_cast<std::string*>(message);
      if (first.empty()) first = text ? static_cast<const char*>(text) : "unknown error";
    });
    algorithm->AddObserver("ErrorEvent", command_);
    algorithm->GetExecutive()->AddObserver("ErrorEvent", command_);
    vtkNew<vtkCallbackCommand> silent;  // the result shows the effect of a warning
    silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
    algorithm->AddObserver("WarningEvent", silent);
    if constexpr (requires { algorithm->SetParserErrorObserver(command_); })
      algorithm->SetParserErrorObserver(command_);
  }
  ~VtkListener() {
    if (window_) window_->RemoveObserver(command_);
  }
  VtkListener(const VtkListener&) = delete;
  VtkListener& operator=(const VtkListener&) = delete;

  /// Keeps errors of what the algorithm makes itself too: VTK tells of these in its output window alone.
  void listen_to_output_window() {
    window_ = vtkOutputWindow::GetInstance();
    window_->AddObserver("ErrorEvent", command_);
  }

  bool failed() const { return !message_.empty(); }
  /// The essential part of the message, on one line.
  std::string reason() const {
    const auto colon = message_.rfind("): ");
    std::string text = colon == std::string::npos ? message_ : message_.substr(colon + 3);
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
  }

 private:
  vtkNew<vtkCallbackCommand> command_;
  vtkSmartPointer<vtkOutputWindow> window_;
  std::string message_;
};

/// The text of a file that `writer`, a vtkXMLWriter, makes of `data`; for messages about `path`. (Over a full
/// disk VTK's writers crash.) Arrays are binary: raw appended data are no XML, and ParaView with a strict
/// parser cannot read them.
template <class Writer>
std::string xml_of(Writer* writer, vtkDataObject* data, const std::string& path) {
  const VtkListener writing(writer);
  writer->SetDataModeToBinary();
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  if (writer->Write() == 0 || writing.failed())
    throw std::runtime_error(path + ": could not be written: " + writing.reason());
  return writer->GetOutputString();
}

}  // namespace cleft
