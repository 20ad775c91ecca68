// Images that are part of another file. Private to this folder.
#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace cleft {

/// Whether bytes begin as those of a .png or .jpg.
bool is_memory_image(const std::string& bytes);

/// The image in the bytes of a .png or .jpg. Null, with the reason in `why`, where it is none, is damaged, or
/// declares more pixels than most_pixels or than its bytes can hold.
vtkSmartPointer<vtkImageData> memory_image(const std::string& bytes, std::string& why);

inline constexpr double most_pixels = 1 << 26;  ///< 8192 x 8192

}  // namespace cleft
