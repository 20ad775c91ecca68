// [sampling] and [vary] of a study file.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "base/error.h"
#include "params/study.h"

namespace cleft {

/// Reads both into the study; errors are added to `mistakes`. `path`: of the file, for messages.
void read_sampling(const toml::table& file, const std::string& path, Study& study, Mistakes& mistakes);

}  // namespace cleft
