// The image that a surface is drawn with, as colours of its points: vertices at the seams of a texture have
// several places in it, and cuts would tear triangles apart there, while colours of points survive every cut.
// Private to this folder.
#pragma once

#include <array>
#include <string>
#include <vector>

class vtkImageData;

namespace cleft {

using Rgb = std::array<double, 3>;  ///< red, green, blue, 0 to 1
using Uv = std::array<double, 2>;  ///< a place in an image, 0 to 1 from its lower left; beyond it is repeated

struct TextureColors {
  std::vector<Rgb> colors;  ///< of each point the mean of the image over half the way to its neighbours
  double lost = 0;          ///< how far colours between points are from the image, on the mean
};

/// `polygons`: corners, indices into `places`, the places of points.
TextureColors texture_colors(vtkImageData* image, const std::vector<Uv>& places,
                             const std::vector<std::vector<int>>& polygons);

inline constexpr double most_lost = 0.06;  ///< of the full range, 0 to 1: beyond it colours are left out

/// "1.2 % of the full range off in the mean"
std::string text_of_lost(double lost);

}  // namespace cleft
