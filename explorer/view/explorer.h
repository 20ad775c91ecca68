// A study shown case by case: on its canonical patch, or as a wound in a surface mesh.
#pragma once

#include <memory>
#include <string>

#include "explorer/scene/study.h"
#include "explorer/view/wound_view.h"

namespace cleft {

struct ExplorerInput {
  std::string study;       ///< study folder or case.dffd
  std::string mesh, path;  ///< a surface mesh and the scalpel's path over it; both empty: the canonical patch
  double scale = 1;        ///< mm in a unit of the mesh and the path
};

class Explorer {
 public:
  /// Opens everything and shows the first case. Throws InputError where a file is missing or wrong.
  explicit Explorer(const ExplorerInput& input);
  ~Explorer();

  /// Shows case i (0 .. size - 1) at the same length cut as before, as far as it goes.
  void show_case(int i);
  int shown_case() const { return shown_; }

  PublishedStudy& study() { return study_; }
  WoundView& view() { return view_; }

 private:
  struct Patient;  ///< the mesh to cut and the path, in mm

  PublishedStudy study_;
  std::unique_ptr<Patient> patient_;
  WoundView view_;
  int shown_ = -1;
};

}  // namespace cleft
