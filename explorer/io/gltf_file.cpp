#include "explorer/io/gltf_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "explorer/io/gltf_data.h"
#include "explorer/io/memory_image.h"
#include "explorer/io/texture_colors.h"

namespace cleft {

using Json = nlohmann::json;

namespace {

/// Column by column, as files have it.
using Matrix = std::array<double, 16>;
constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) c[4 * j + i] += a[4 * k + i] * b[4 * j + k];
  return c;
}

Vec3 moved(const Matrix& m, const Vec3& x) {
  Vec3 y;
  for (std::size_t i = 0; i < 3; ++i)
    y[static_cast<int>(i)] = m[i] * x.x + m[4 + i] * x.y + m[8 + i] * x.z + m[12 + i];
  return y;
}

bool mirrors(const Matrix& m) {
  const Vec3 a{m[0], m[1], m[2]}, b{m[4], m[5], m[6]}, c{m[8], m[9], m[10]};
  return dot(a, cross(b, c)) < 0;
}

double linear_of(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}
double srgb_of(double linear) {
  const double x = std::clamp(linear, 0., 1.);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

class Reader {
 public:
  explicit Reader(const std::string& path) : data_(path) {}

  MeshPolygons read() {
    try {
      const Json& json = data_.json();
      if (data_.count("scenes") > 0) {
        const Json& scene = data_.entry("scenes", data_.natural(json, "scene", "file", 0));
        for (const std::size_t node : numbers(scene, "nodes", "scene")) place(node, identity);
      } else {
        for (std::size_t i = 0; i < data_.count("meshes"); ++i) add_mesh(i, identity);
      }
    } catch (const Json::exception& e) {
      data_.refuse(std::string("has an entry that is none of a glTF: ") + e.what());
    }
    tell_of_textures();
    if (!colored_ || too_coarse_) result_.colors.clear();
    return std::move(result_);
  }

 private:
  std::vector<std::size_t> numbers(const Json& object, const char* name, const std::string& where) const {
    std::vector<std::size_t> list;
    if (!object.contains(name)) return list;
    for (const Json& one : object.at(name)) {
      if (!one.is_number_unsigned()) data_.refuse("its " + where + " has '" + name + "' that are no numbers");
      list.push_back(one.get<std::size_t>());
    }
    return list;
  }

  template <std::size_t size>
  std::array<double, size> reals(const Json& object, const char* name, std::array<double, size> otherwise,
                                 const std::string& where) const {
    if (!object.contains(name)) return otherwise;
    const auto list = object.at(name).get<std::vector<double>>();
    if (list.size() != size ||
        !std::all_of(list.begin(), list.end(), [](double x) { return std::isfinite(x); }))
      data_.refuse("its " + where + " has a '" + name + "' that is none");
    std::copy(list.begin(), list.end(), otherwise.begin());
    return otherwise;
  }

  Matrix placement(const Json& node, const std::string& where) const {
    if (node.contains("matrix")) return reals<16>(node, "matrix", identity, where);
    const auto [x, y, z, w] = reals<4>(node, "rotation", {0, 0, 0, 1}, where);
    const auto scale = reals<3>(node, "scale", {1, 1, 1}, where),
               at = reals<3>(node, "translation", {0, 0, 0}, where);
    const double turn[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
                            2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
                            2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y)};
    Matrix m = identity;
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i) m[4 * j + i] = scale[j] * turn[3 * j + i];
    std::copy(at.begin(), at.end(), m.begin() + 12);
    return m;
  }

  /// A node with its children. Nodes are trees: none comes twice, so this ends.
  void place(std::size_t root, const Matrix& above) {
    std::vector<std::pair<std::size_t, Matrix>> left{{root, above}};
    while (!left.empty()) {
      const auto [number, outer] = left.back();
      left.pop_back();
      const std::string where = "node " + std::to_string(number);
      const Json& node = data_.entry("nodes", number);
      if (!placed_.insert(number).second) data_.refuse("its " + where + " has two parents");
      const Matrix here = product(outer, placement(node, where));
      if (node.contains("mesh")) add_mesh(data_.natural(node, "mesh", where), here);
      for (const std::size_t child : numbers(node, "children", where)) left.emplace_back(child, here);
    }
  }

  void add_mesh(std::size_t number, const Matrix& to) {
    const std::string where = "mesh " + std::to_string(number);
    const Json& mesh = data_.entry("meshes", number);
    if (!mesh.contains("primitives")) data_.refuse("its " + where + " has no 'primitives'");
    for (const Json& primitive : mesh.at("primitives")) {
      constexpr std::size_t triangles = 4, fan = 6;
      const std::size_t mode = data_.natural(primitive, "mode", where, triangles);
      if (mode >= triangles && mode <= fan) add_triangles(primitive, mode, to, where);
    }
  }

  void add_triangles(const Json& primitive, std::size_t mode, const Matrix& to, const std::string& where) {
    const Json& attributes = primitive.at("attributes");
    const GltfData::Numbers places = attribute(attributes, "POSITION", 3, 3, where);
    const std::vector<std::vector<int>> polygons =
        corners(primitive, mode, places.size(), mirrors(to), where);
    MeshPolygons& mesh = result_;
    const int first = static_cast<int>(mesh.points.size());
    corners_ += 3 * polygons.size() + places.size();
    if (corners_ > most_gltf_corners) data_.refuse("places more triangles than can be read");
    for (std::size_t p = 0; p < places.size(); ++p) {
      const Vec3 x = moved(to, {places.values[3 * p], places.values[3 * p + 1], places.values[3 * p + 2]});
      if (!std::isfinite(x.x + x.y + x.z)) data_.refuse("its " + where + " has a point that is no number");
      mesh.points.push_back(x);
    }
    add_colors(primitive, polygons, places.size(), where);
    for (std::vector<int> polygon : polygons) {
      for (int& corner : polygon) corner += first;
      mesh.polygons.push_back(std::move(polygon));
    }
  }

  /// Elements of between `least` and `most` components, one for each point.
  GltfData::Numbers attribute(const Json& attributes, const std::string& name, std::size_t least,
                              std::size_t most, const std::string& where) const {
    GltfData::Numbers found = data_.numbers(data_.natural(attributes, name.c_str(), where));
    if (found.components < least || found.components > most)
      data_.refuse("its " + where + " has " + name + " of " + std::to_string(found.components) + " numbers");
    return found;
  }

  std::vector<std::vector<int>> corners(const Json& primitive, std::size_t mode, std::size_t points,
                                        bool turned, const std::string& where) const {
    std::vector<int> order;
    if (primitive.contains("indices")) {
      const GltfData::Numbers list = data_.numbers(data_.natural(primitive, "indices", where));
      if (list.components != 1) data_.refuse("its " + where + " has indices that are no numbers");
      for (const double index : list.values) {
        if (!(index >= 0 && index < static_cast<double>(points) && index == std::floor(index)))
          data_.refuse("its " + where + " names a point that it does not have; it has " +
                       std::to_string(points));
        order.push_back(static_cast<int>(index));
      }
    } else {
      for (std::size_t p = 0; p < points; ++p) order.push_back(static_cast<int>(p));
    }
    std::vector<std::vector<int>> polygons;
    constexpr std::size_t triangles = 4, strip = 5;
    for (std::size_t i = 0; i + 2 < order.size(); i += mode == triangles ? 3 : 1) {
      std::vector<int> t{order[i], order[i + 1], order[i + 2]};
      if (mode == strip && i % 2 == 1) std::swap(t[0], t[1]);
      if (mode > strip) t[0] = order[0];
      if (turned) std::swap(t[1], t[2]);
      polygons.push_back(std::move(t));
    }
    return polygons;
  }

  void add_colors(const Json& primitive, const std::vector<std::vector<int>>& polygons, std::size_t points,
                  const std::string& where) {
    std::vector<Rgb> linear(points, {1, 1, 1});
    const auto multiply = [&](std::size_t p, std::size_t k, double by) { linear[p][k] *= by; };
    const Json& attributes = primitive.at("attributes");
    if (attributes.contains("COLOR_0")) {
      const GltfData::Numbers own = attribute(attributes, "COLOR_0", 3, 4, where);
      if (own.size() != points) data_.refuse("its " + where + " has colours of other points");
      for (std::size_t p = 0; p < points; ++p)
        for (std::size_t k = 0; k < 3; ++k) multiply(p, k, own.values[own.components * p + k]);
      colored_ = true;
    }
    if (primitive.contains("material")) {
      const std::size_t number = data_.natural(primitive, "material", where);
      const Json& material = data_.entry("materials", number);
      const Json surface = material.value("pbrMetallicRoughness", Json::object());
      const auto base =
          reals<4>(surface, "baseColorFactor", {1, 1, 1, 1}, "material " + std::to_string(number));
      for (std::size_t p = 0; p < points; ++p)
        for (std::size_t k = 0; k < 3; ++k) multiply(p, k, base[k]);
      colored_ = colored_ || base[0] != 1 || base[1] != 1 || base[2] != 1;
      if (surface.contains("baseColorTexture")) {
        const auto texels = texture(surface.at("baseColorTexture"), attributes, polygons, points, where);
        for (std::size_t p = 0; texels && p < points; ++p)
          for (std::size_t k = 0; k < 3; ++k) multiply(p, k, linear_of((*texels)[p][k]));
      }
    }
    for (const Rgb& c : linear)
      result_.colors.push_back({static_cast<float>(srgb_of(c[0])), static_cast<float>(srgb_of(c[1])),
                                static_cast<float>(srgb_of(c[2]))});
  }

  /// The image's colours of points; none where it cannot be read.
  std::optional<std::vector<Rgb>> texture(const Json& of, const Json& attributes,
                                          const std::vector<std::vector<int>>& polygons, std::size_t points,
                                          const std::string& where) {
    const std::string places = "TEXCOORD_" + std::to_string(data_.natural(of, "texCoord", where, 0));
    const Json& one = data_.entry("textures", data_.natural(of, "index", where));
    if (!attributes.contains(places) || !one.contains("source")) return std::nullopt;
    const GltfData::Numbers uv = attribute(attributes, places, 2, 2, where);
    if (uv.size() != points) data_.refuse("its " + where + " has places in its texture of other points");
    constexpr double farthest = 1e6;  // repetitions of an image
    std::vector<Uv> at(points);
    for (std::size_t p = 0; p < points; ++p) {
      at[p] = {uv.values[2 * p], 1 - uv.values[2 * p + 1]};  // from the upper left in files
      if (!(std::abs(at[p][0]) < farthest && std::abs(at[p][1]) < farthest))
        data_.refuse("its " + where + " has a place in its texture that is none");
    }
    const std::size_t number = data_.natural(one, "source", where);
    const auto [known, fresh] = images_.try_emplace(number);
    if (fresh) known->second = memory_image(data_.image(number), unread_);
    if (!known->second) return std::nullopt;
    auto [colors, lost] = texture_colors(known->second, at, polygons);
    lost_ += lost * static_cast<double>(polygons.size()), textured_ += static_cast<double>(polygons.size());
    return std::move(colors);
  }

  void tell_of_textures() {
    const std::string what = images_.size() == 1 ? "its texture" : "its textures";
    if (!unread_.empty()) {
      result_.note = what + " cannot be read: " + unread_;
    } else if (textured_ > 0) {
      const double lost = lost_ / textured_;
      too_coarse_ = lost > most_lost, colored_ = true;
      result_.note = too_coarse_
                         ? what + " left out: as colours of the points it would be " + text_of_lost(lost) +
                               "; divide the triangles until they are as fine as the image"
                         : what + " drawn as colours of the points, " + text_of_lost(lost);
    }
  }

  GltfData data_;
  MeshPolygons result_;
  std::set<std::size_t> placed_;
  std::map<std::size_t, vtkSmartPointer<vtkImageData>> images_;
  std::string unread_;
  std::size_t corners_ = 0;
  double lost_ = 0, textured_ = 0;
  bool colored_ = false, too_coarse_ = false;
};

}  // namespace

MeshPolygons read_gltf(const std::string& path) { return Reader(path).read(); }

}  // namespace cleft
