#include "explorer/io/obj_texture.h"

#include <vtkCellArray.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "base/text.h"
#include "base/vtk_listener.h"

namespace cleft {

namespace {

using Rgb = std::array<double, 3>;
using Uv = std::array<double, 2>;

std::string rest_of(std::istringstream& line) {
  std::string rest;
  std::getline(line >> std::ws, rest);
  while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest.back()))) rest.pop_back();
  return rest;
}

/// Calls use(first word, the rest) for each line of a file; nothing where it cannot be opened.
template <class Use>
void for_each_line(const std::filesystem::path& file, const Use& use) {
  if (!std::filesystem::is_regular_file(file)) return;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first;
    if (words >> first) use(first, words);
  }
}

/// The images of the materials that faces use; "" stands for a material without one.
std::set<std::filesystem::path> images_of(const std::filesystem::path& obj) {
  std::vector<std::string> libraries;
  std::set<std::string> used;
  std::string material;
  for_each_line(obj, [&](const std::string& first, std::istringstream& line) {
    if (first == "mtllib") libraries.push_back(rest_of(line));
    if (first == "usemtl") material = rest_of(line);
    if (first == "f") used.insert(material);
  });
  std::map<std::string, std::filesystem::path> image_of;
  for (const std::string& library : libraries) {
    std::string current;
    for_each_line(obj.parent_path() / library, [&](const std::string& first, std::istringstream& line) {
      if (first == "newmtl") current = rest_of(line);
      if (first != "map_Kd") return;
      std::string name = rest_of(line);
      if (name.starts_with("-")) name = name.substr(name.find_last_of(" \t") + 1);  // options come first
      std::replace(name.begin(), name.end(), '\\', '/');
      image_of[current] = obj.parent_path() / name;
    });
  }
  std::set<std::filesystem::path> images;
  for (const std::string& name : used) images.insert(image_of[name]);
  return images;
}

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
    const int n = std::clamp(static_cast<int>(std::ceil(texels)), 1, 16);
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

/// Calls use(corners) for each polygon.
template <class Use>
void for_each_polygon(vtkPolyData* data, const Use& use) {
  vtkCellArray* cells = data->GetPolys();
  vtkIdType size;
  const vtkIdType* corners;
  for (cells->InitTraversal(); cells->GetNextCell(size, corners);)
    if (size >= 3) use(std::vector<vtkIdType>(corners, corners + size));
}

}  // namespace

std::string add_texture_colors(const std::string& path, vtkPolyData* data) {
  vtkDataArray* const places = data->GetPointData()->GetTCoords();
  if (!places) return "";
  const std::set<std::filesystem::path> images = images_of(path);
  if (images.empty() || *images.rbegin() == "") return "";
  if (images.size() > 1)
    return "its materials have " + std::to_string(images.size()) +
           " textures or none, and colours are read from one: give every face the same (a texture atlas)";
  const std::string file = images.begin()->string();
  const std::string what = "its texture " + file;
  if (!std::filesystem::is_regular_file(file)) return what + " is not there";
  const vtkSmartPointer<vtkImageReader2> reader =
      vtkSmartPointer<vtkImageReader2>::Take(vtkImageReader2Factory::CreateImageReader2(file.c_str()));
  if (!reader) return what + " is no image that can be read: make it a .png or .jpg";
  reader->SetFileName(file.c_str());
  const VtkListener reading(reader.Get());
  reader->Update();
  if (reading.failed() || reader->GetOutput()->GetNumberOfPoints() == 0)
    return what + " is no image that can be read: " + reading.reason();
  const Texture texture(reader->GetOutput());

  // Beyond 0 and 1 the image is repeated: a point's place is in the repetition that its polygon is in.
  const auto count = static_cast<std::size_t>(data->GetNumberOfPoints());
  std::vector<Uv> place(count);
  std::vector<double> half(count, std::numeric_limits<double>::infinity());
  for_each_polygon(data, [&](const std::vector<vtkIdType>& corners) {
    const auto uv = [&](std::size_t i, int k) {
      const double x = places->GetComponent(corners[i % corners.size()], k);
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
      for (const vtkIdType p : {corners[i], corners[(i + 1) % corners.size()]})
        half[p] = std::min(half[p], length / 2);
      place[corners[i]] = {uv(i, 0) - repetition[0], uv(i, 1) - repetition[1]};
    }
  });
  std::vector<Rgb> colors(count);
  for (std::size_t p = 0; p < count; ++p)
    if (std::isfinite(half[p])) colors[p] = texture.mean(place[p], half[p]);

  // At odd places, since patterns of an image may be even.
  double lost = 0, compared = 0;
  constexpr double weights[6][3] = {{0.62, 0.27, 0.11}, {0.27, 0.62, 0.11}, {0.11, 0.62, 0.27},
                                    {0.11, 0.27, 0.62}, {0.27, 0.11, 0.62}, {0.62, 0.11, 0.27}};
  for_each_polygon(data, [&](const std::vector<vtkIdType>& corners) {
    for (const auto& weight : weights) {
      Uv there{};
      Rgb between{};
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 2; ++k) there[k] += weight[i] * place[corners[i]][k];
        for (int c = 0; c < 3; ++c) between[c] += weight[i] * colors[corners[i]][c];
      }
      const Rgb image = texture.at(there);
      for (int c = 0; c < 3; ++c) lost += std::abs(image[c] - between[c]), compared += 1;
    }
  });
  lost /= std::max(compared, 1.);
  const std::string off = formatted("%.2g", 100 * lost) + " % of the full range off in the mean";
  if (lost > most_lost)
    return what + " is left out: as colours of the points it would be " + off +
           "; divide the triangles until they are as fine as the image";
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName("RGB");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  for (std::size_t p = 0; p < count; ++p)
    for (int c = 0; c < 3; ++c)
      array->SetTypedComponent(
          static_cast<vtkIdType>(p), c,
          static_cast<unsigned char>(std::lround(255 * std::clamp(colors[p][c], 0., 1.))));
  data->GetPointData()->AddArray(array);
  return what + " is drawn as colours of the points, " + off;
}

}  // namespace cleft
