// A page for browsers: the fields of a study, or one field, in one HTML file that needs nothing else.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "explorer/study/study.h"

namespace cleft {

struct PageFigures {
  int cases = 0;
  std::size_t bytes = 0;
};

/// Called with what is being done, as a Progress.
using ReportState = std::function<void(const std::string& state)>;

/// Writes the page, completely or not at all. Throws the errors of PublishedStudy::read().
PageFigures write_page(const PublishedStudy& study, const std::string& path, const ReportState& report = {});

}  // namespace cleft
