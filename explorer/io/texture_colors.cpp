#include "explorer/io/texture_colors.h"

#include <vtkImageData.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"

namespace cleft {

namespace {

class Texture {
 public:
  explicit Texture(vtkImageData* image)
      : image_(image),
        size_{image->GetDimensions()[0], image->GetDimensions()[1]},
        whole_(image->GetScalarType() == VTK_FLOAT || image->GetScalarType() == VTK_DOUBLE
                   ? 1
                   : image->GetScalarTypeMax()) {}

  /// Linear between the centres of texels.
  Rgb at(const Uv& uv) const {
    double x[2], part[2];
    int low[2], high[2];
    for (int k = 0; k < 2; ++k) {
      x[k] = std::clamp(uv[k] * size_[k] - 0.5, 0., size_[k] - 1.);
      low[k] = static_cast<int>(x[k]), high[k] = std::min(low[k] + 1, size_[k] - 1);
      part[k] = x[k] - low[k];
    }
    Rgb color;
    const int last = image_->GetNumberOfScalarComponents() - 1;
    for (int c = 0; c < 3; ++c) {
      const auto texel = [&](int i, int j) {
        return image_->GetScalarComponentAsDouble(i, j, 0, last < 2 ? 0 : c);  // one or two: grey
      };
      color[c] = ((1 - part[1]) * ((1 - part[0]) * texel(low[0], low[1]) + part[0] * texel(high[0], low[1])) +
                  part[1] * ((1 - part[0]) * texel(low[0], high[1]) + part[0] * texel(high[0], high[1]))) /
                 whole_;
    }
    return color;
  }
  /// The mean over `half` to all sides.
  Rgb mean(const Uv& uv, double half) const {
    const double texels = 2 * half * std::max(size_[0], size_[1]);
    const int n = std::max(static_cast<int>(std::ceil(std::min(texels, 16.))), 1);
    Rgb sum{};
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto from_middle = [&](int k) { return half * ((2 * k + 1.) / n - 1); };
        const Rgb one = at({uv[0] + from_middle(i), uv[1] + from_middle(j)});
        for (int c = 0; c < 3; ++c) sum[c] += one[c] / (n * n);
      }
    return sum;
  }

 private:
  vtkImageData* image_;
  std::array<int, 2> size_;
  double whole_;  // that is white
};

}  // namespace

TextureColors texture_colors(vtkImageData* image, const std::vector<Uv>& places,
                             const std::vector<std::vector<int>>& polygons) {
  const Texture texture(image);
  // Beyond 0 and 1 the image is repeated: a point's place is in the repetition that its polygon is in.
  const std::size_t count = places.size();
  std::vector<Uv> place(count);
  std::vector<double> half(count, std::numeric_limits<double>::infinity());
  for (const std::vector<int>& corners : polygons) {
    const auto uv = [&](std::size_t i, int k) {
      const double x = places[corners[i % corners.size()]][k];
      return std::isfinite(x) ? x : 0;
    };
    double repetition[2];
    for (int k = 0; k < 2; ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < corners.size(); ++i) sum += uv(i, k);
      repetition[k] = std::floor(sum / static_cast<double>(corners.size()));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const double length = std::max(std::abs(uv(i, 0) - uv(i + 1, 0)), std::abs(uv(i, 1) - uv(i + 1, 1)));
      for (const int p : {corners[i], corners[(i + 1) % corners.size()]})
        half[p] = std::min(half[p], length / 2);
      place[corners[i]] = {uv(i, 0) - repetition[0], uv(i, 1) - repetition[1]};
    }
  }
  std::vector<Rgb> colors(count);
  for (std::size_t p = 0; p < count; ++p)
    if (std::isfinite(half[p])) colors[p] = texture.mean(place[p], half[p]);

  // At odd places, since patterns of an image may be even.
  double lost = 0, compared = 0;
  constexpr double weights[6][3] = {{0.62, 0.27, 0.11}, {0.27, 0.62, 0.11}, {0.11, 0.62, 0.27},
                                    {0.11, 0.27, 0.62}, {0.27, 0.11, 0.62}, {0.62, 0.11, 0.27}};
  for (const std::vector<int>& corners : polygons) {
    for (const auto& weight : weights) {
      Uv there{};
      Rgb between{};
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 2; ++k) there[k] += weight[i] * place[corners[i]][k];
        for (int c = 0; c < 3; ++c) between[c] += weight[i] * colors[corners[i]][c];
      }
      const Rgb drawn = texture.at(there);
      for (int c = 0; c < 3; ++c) lost += std::abs(drawn[c] - between[c]), compared += 1;
    }
  }
  return {std::move(colors), lost / std::max(compared, 1.)};
}

std::string text_of_lost(double lost) {
  return formatted("%.2g", 100 * lost) + " % of the full range off in the mean";
}

}  // namespace cleft
