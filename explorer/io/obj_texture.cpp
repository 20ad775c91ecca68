#include "explorer/io/obj_texture.h"

#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "base/text.h"
#include "base/vtk_listener.h"
#include "explorer/io/memory_image.h"

namespace cleft {

namespace {

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

/// Null, with the reason, if it cannot be read.
vtkSmartPointer<vtkImageData> image_in(const std::string& file, std::string& why) {
  if (const std::string bytes = read_text_file(file); is_memory_image(bytes)) return memory_image(bytes, why);
  const vtkSmartPointer<vtkImageReader2> reader =
      vtkSmartPointer<vtkImageReader2>::Take(vtkImageReader2Factory::CreateImageReader2(file.c_str()));
  if (!reader) return why = "make it a .png or .jpg", nullptr;
  reader->SetFileName(file.c_str());
  const VtkListener reading(reader.Get());
  reader->Update();
  if (!reading.failed() && reader->GetOutput()->GetNumberOfPoints() > 0) return reader->GetOutput();
  why = reading.reason();
  return nullptr;
}

}  // namespace

std::string add_texture_colors(const std::string& path, const std::vector<Uv>& places, MeshPolygons& mesh) {
  const std::set<std::filesystem::path> images = images_of(path);
  if (images.empty() || *images.rbegin() == "") return "";
  if (images.size() > 1)
    return "its materials have " + std::to_string(images.size()) +
           " textures or none, and colours are read from one: give every face the same (a texture atlas)";
  const std::string file = images.begin()->string();
  const std::string what = "its texture " + file;
  if (!std::filesystem::is_regular_file(file)) return what + " is not there";
  std::string why;
  const vtkSmartPointer<vtkImageData> image = image_in(file, why);
  if (!image) return what + " is no image that can be read: " + why;
  if (std::any_of(places.begin(), places.end(), [](const Uv& place) { return std::isnan(place[0]); }))
    return what + " is left out: corners of faces have no place in it";
  const auto [colors, lost] = texture_colors(image, places, mesh.polygons);
  const std::string off = text_of_lost(lost);
  if (lost > most_lost)
    return what + " is left out: as colours of the points it would be " + off +
           "; divide the triangles until they are as fine as the image";
  for (const Rgb& color : colors)
    mesh.colors.push_back(
        {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])});
  return what + " is drawn as colours of the points, " + off;
}

}  // namespace cleft
