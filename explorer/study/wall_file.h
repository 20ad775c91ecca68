// The small pictures of a study's cases, in one file beside the study. They can be drawn again at any time:
// what cannot be read of the file is left out, and the file may be deleted.
#pragma once

#include <map>
#include <string>

#include "explorer/study/study.h"

namespace cleft {

/// A picture file (JPEG) by the hash of its case.
using WallPictures = std::map<std::string, std::string>;

/// study.wall in a study folder; STUDY.dffd.wall beside a study file.
std::string wall_file_of(const PublishedStudy& study);

/// The pictures of a file whose `look` is the same; none if there is no such file. A picture whose checksum
/// is wrong, and all after it, are left out.
WallPictures read_wall_file(const std::string& path, const std::string& look);

/// Completely or not at all. Throws InputError or std::runtime_error if it cannot be written.
void write_wall_file(const std::string& path, const std::string& look, const WallPictures& pictures);

}  // namespace cleft
