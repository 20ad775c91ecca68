// A page for browsers: the fields of a study, or one field, in one HTML file that needs nothing else.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "explorer/study/study.h"
#include "explorer/web/mesh_motion.h"

namespace cleft {

struct PageFigures {
  int cases = 0;
  std::size_t bytes = 0;
  int modes = 0;            ///< of which fields between the cases are sums; 0: there are none
  double modes_error = 0;   ///< what the modes leave of a case, at most, over its largest displacement
  std::string not_between;  ///< why there are no fields between the cases; empty if there are
};

/// Called with what is being done, as a Progress.
using ReportState = std::function<void(const std::string& state)>;

/// Writes the page, completely or not at all; of a mesh that the cases open, if one is given. Throws the
/// errors of PublishedStudy::read() and of mesh_motion_data().
PageFigures write_page(const PublishedStudy& study, const std::string& path, const ReportState& report = {},
                       const MeshMotion* mesh = nullptr);

}  // namespace cleft
