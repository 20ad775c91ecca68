// glTF: places of nodes, colours of vertices, materials and textures against their definitions, and damaged
// files.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkJPEGWriter.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "base/error.h"
#include "base/text.h"
#include "explorer/io/mesh_file.h"
#include "tests/incision/meshes.h"
#include "tests/io/glb_bytes.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

using testing::GltfBuffer;

const SurfaceMesh& plate() {
  static const SurfaceMesh mesh = testing::grid(10, 8, -10, -8, 2);
  return mesh;
}

std::vector<float> floats_of(const std::vector<Vec3>& points) {
  std::vector<float> all;
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) all.push_back(static_cast<float>(p[k]));
  return all;
}

template <class Index>
std::vector<Index> corners_of(const SurfaceMesh& mesh) {
  std::vector<Index> all;
  for (const auto& t : mesh.triangles)
    for (const int corner : t) all.push_back(static_cast<Index>(corner));
  return all;
}

/// A mesh of points 0 and indices 1, of a node.
std::string entries(const std::string& of_primitive = "", const std::string& of_node = "",
                    const std::string& of_attributes = "") {
  return "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0" + of_node +
         "}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0" + of_attributes +
         "},\"indices\":1" + of_primitive + "}]}]";
}

GltfBuffer plate_buffer() {
  GltfBuffer buffer;
  buffer.add(floats_of(plate().points), 3);
  buffer.add(corners_of<std::uint16_t>(plate()), 1);
  return buffer;
}

Vec3 normal_of(const SurfaceMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles.at(t);
  return normalized(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
}

/// The place of every point of the plate is that of one point of the mesh, and the other way round.
void expect_places(const SurfaceMesh& mesh, const std::function<Vec3(const Vec3&)>& to) {
  ASSERT_EQ(mesh.points.size(), plate().points.size());
  ASSERT_EQ(mesh.triangles.size(), plate().triangles.size());
  for (const Vec3& p : plate().points) {
    double nearest = HUGE_VAL;
    for (const Vec3& q : mesh.points) nearest = std::min(nearest, norm(q - to(p)));
    EXPECT_LT(nearest, 1e-5) << "single precision";
  }
}

class Gltf : public ::testing::Test {
 protected:
  SurfaceMesh read(const std::string& bytes, const std::string& name = "x.glb") const {
    return read_mesh(in.write(name, bytes));
  }
  std::string refused(const std::string& bytes, const std::string& name = "x.glb") const {
    try {
      read(bytes, name);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  template <class Writer>
  std::string image(const std::function<std::array<double, 3>(double, double)>& color, int size = 200) const {
    vtkNew<vtkImageData> image;
    image->SetDimensions(size, size, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) {
        const auto c = color((i + 0.5) / size, (j + 0.5) / size);
        for (int k = 0; k < 3; ++k) image->SetScalarComponentFromDouble(i, j, 0, k, std::round(255 * c[k]));
      }
    vtkNew<Writer> writer;
    writer->SetFileName((in / "image").c_str());
    writer->SetInputData(image);
    writer->Write();
    return read_text_file(in / "image");
  }
  TemporaryFolder in;
};

TEST_F(Gltf, TrianglesOfEveryKindOfIndexAreRead) {
  const auto same = [](const Vec3& p) { return p; };
  GltfBuffer bytes, words;
  for (GltfBuffer* buffer : {&bytes, &words}) buffer->add(floats_of(plate().points), 3);
  bytes.add(corners_of<std::uint8_t>(plate()), 1);
  words.add(corners_of<std::uint32_t>(plate()), 1);
  for (const std::string& file :
       {bytes.glb(entries()), words.glb(entries()), plate_buffer().glb(entries())}) {
    const SurfaceMesh mesh = read(file);
    expect_places(mesh, same);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) EXPECT_GT(normal_of(mesh, t).z, 0.99);
    EXPECT_TRUE(mesh.colors.empty()) << "white is no colour of its own";
  }
  GltfBuffer strip;  // zigzag over 2 x 5 points
  std::vector<Vec3> points;
  points.reserve(10);
  for (int column = 0; column < 5; ++column)
    for (const double y : {1, 0}) points.push_back({double(column), y, 0});
  strip.add(floats_of(points), 3);
  strip.add(std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, 1);
  const SurfaceMesh band = read(strip.glb(entries(",\"mode\":5")));
  ASSERT_EQ(band.triangles.size(), 8u);
  for (std::size_t t = 0; t < 8; ++t) EXPECT_GT(normal_of(band, t).z, 0.99) << t;
}

TEST_F(Gltf, NodesPlaceTheirMeshesAndMirrorsTurnTriangles) {
  const GltfBuffer buffer = plate_buffer();
  const double h = std::sqrt(0.5);  // a quarter turn about x
  const std::string turn =
      ",\"rotation\":[" + shortest(h) + ",0,0," + shortest(h) + "],\"translation\":[1,2,3],\"scale\":[2,1,1]";
  const SurfaceMesh turned = read(buffer.glb(entries("", turn)));
  expect_places(turned, [](const Vec3& p) { return Vec3{1 + 2 * p.x, 2 - p.z, 3 + p.y}; });
  EXPECT_LT(normal_of(turned, 0).y, -0.99) << "z has become -y";
  const SurfaceMesh mirrored =
      read(buffer.glb(entries("", ",\"matrix\":[-1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]")));
  expect_places(mirrored, [](const Vec3& p) { return Vec3{5 - p.x, p.y, p.z}; });
  EXPECT_GT(normal_of(mirrored, 0).z, 0.99) << "its outside stays outside";
  const std::string nested =
      "\"scenes\":[{\"nodes\":[1]}],\"nodes\":[{\"mesh\":0,\"translation\":[1,0,0]},{\"children\":[0],"
      "\"scale\":[3,3,3]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]";
  expect_places(read(buffer.glb(nested)), [](const Vec3& p) { return 3 * (p + Vec3{1, 0, 0}); });
  std::string loop = nested;
  loop.replace(loop.find("\"mesh\":0"), 8, "\"mesh\":0,\"children\":[1]");
  EXPECT_NE(refused(buffer.glb(loop)).find("two parents"), std::string::npos);
}

/// IEC 61966-2-1, backwards.
double srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

TEST_F(Gltf, ColoursOfVerticesAndMaterialsAreMultipliedAsLight) {
  GltfBuffer buffer = plate_buffer();
  std::vector<float> colors;
  for (const Vec3& p : plate().points)
    for (const double part : {0.5 + p.x / 40, 0.5 - p.y / 40, 0.25})
      colors.push_back(static_cast<float>(part));
  buffer.add(colors, 3);
  const std::string material =
      ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,1,1,1]}}]";
  const SurfaceMesh mesh = read(buffer.glb(entries(",\"material\":0", "", ",\"COLOR_0\":2") + material));
  ASSERT_EQ(mesh.colors.size(), mesh.points.size());
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const Vec3& x = mesh.points[p];
    const double expected[] = {srgb(0.5 * (0.5 + x.x / 40)), srgb(0.5 - x.y / 40), srgb(0.25)};
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mesh.colors[p][k], expected[k], 0.51 / 255) << "a byte each";
  }
  const SurfaceMesh even = read(buffer.glb(entries(",\"material\":0") + material));
  ASSERT_FALSE(even.colors.empty());
  EXPECT_NEAR(even.colors[3][0], srgb(0.5), 0.51 / 255);
  EXPECT_EQ(even.colors[3][1], 1);
  in.write("x.glb", buffer.glb(entries(",\"material\":0", "", ",\"COLOR_0\":2") + material));
  const auto cut = run_cleft("cut", {"--mesh", in / "x.glb", "--path",
                                     in.write("path.csv", "x,y,z,nx,ny,nz\n-4,0.7,0,0,0,1\n4,0.7,0,0,0,1\n"),
                                     "--rest", "--depth", "2", "--out", in / "cut.ply"});
  EXPECT_EQ(cut.exit_code, 0) << cut.output;
  EXPECT_EQ(read_mesh(in / "cut.ply").colors.size(), read_mesh(in / "cut.ply").points.size());
}

TEST_F(Gltf, TexturesAreColoursOfThePointsFromTheUpperLeft) {
  const auto color_at = [](double u, double v) { return std::array{0.2 + 0.6 * u, 0.3, 0.2 + 0.6 * v}; };
  GltfBuffer buffer = plate_buffer();
  std::vector<float> places;  // v downwards
  for (const Vec3& p : plate().points)
    for (const double uv : {(p.x + 10) / 20, 1 - (p.y + 8) / 16}) places.push_back(static_cast<float>(uv));
  buffer.add(places, 2);
  const int view = buffer.add_view(image<vtkPNGWriter>(color_at));
  const std::string textured =
      ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{"
      "\"source\":0}],\"images\":[{\"mimeType\":\"image/png\",\"bufferView\":" +
      std::to_string(view) + "}]";
  const std::string primitive = entries(",\"material\":0", "", ",\"TEXCOORD_0\":2");
  const SurfaceMesh mesh = read(buffer.glb(primitive + textured));
  ASSERT_EQ(mesh.colors.size(), mesh.points.size()) << mesh.note;
  EXPECT_NE(mesh.note.find("drawn as colours of the points"), std::string::npos);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const Vec3& x = mesh.points[p];
    if (std::abs(x.x) > 9 || std::abs(x.y) > 7) continue;  // beyond its edge an image is not known
    const auto expected = color_at((x.x + 10) / 20, (x.y + 8) / 16);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mesh.colors[p][k], expected[k], 1.1 / 255) << "a byte, twice";
  }
  std::string broken = buffer.bytes();
  const std::string lone = GltfBuffer(buffer).json(primitive + textured);
  broken[broken.find("IHDR") + 4] = 0x7f;  // the width, 2 x 10^9
  const SurfaceMesh plain = read(testing::glb_of(lone, broken));
  EXPECT_TRUE(plain.colors.empty());
  EXPECT_NE(plain.note.find("cannot be read: it is said to have 213"), std::string::npos) << plain.note;
}

TEST_F(Gltf, TextFilesNameTheirBytesOrHoldThem) {
  const GltfBuffer buffer = plate_buffer();
  in.write("my bytes.bin", buffer.bytes());
  expect_places(read(buffer.json(entries(), "my%20bytes.bin"), "x.gltf"), [](const Vec3& p) { return p; });
  GltfBuffer triangle;
  triangle.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
  const std::string data =  // by base64 of coreutils
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  const std::string alone =
      "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]";  // no scene, no indices
  const SurfaceMesh one = read(triangle.json(alone, data), "one.gltf");
  ASSERT_EQ(one.triangles.size(), 1u);
  EXPECT_EQ(one.points[1], (Vec3{1, 0, 0}));
  EXPECT_NE(refused(buffer.json(entries(), "../my.bin"), "x.gltf").find("not beside it"), std::string::npos);
  EXPECT_NE(refused(buffer.json(entries(), "/etc/passwd"), "x.gltf").find("not beside it"),
            std::string::npos);
  EXPECT_NE(refused(buffer.json(entries(), "gone.bin"), "x.gltf").find("not there"), std::string::npos);
  EXPECT_NE(refused(buffer.json(entries()), "x.gltf").find("bytes"), std::string::npos) << "no bytes at all";
}

TEST_F(Gltf, WhatIsWrongIsNamed) {
  const GltfBuffer buffer = plate_buffer();
  const auto with = [&](const std::string& what, const std::string& instead) {
    std::string json = buffer.json(entries());
    EXPECT_NE(json.find(what), std::string::npos) << what;
    json.replace(json.find(what), what.size(), instead);
    return refused(testing::glb_of(json, buffer.bytes()));
  };
  EXPECT_NE(
      with("\"count\":" + std::to_string(plate().points.size()), "\"count\":1000000000").find("ends beyond"),
      std::string::npos);
  EXPECT_NE(with("\"count\":" + std::to_string(plate().points.size()), "\"count\":20")
                .find("names a point that it does not have; it has 20"),
            std::string::npos);
  EXPECT_NE(
      with("\"count\":" + std::to_string(plate().points.size()), "\"count\":-1").find("no natural number"),
      std::string::npos);
  EXPECT_NE(with("\"byteLength\":", "\"byteLength\":9").find("are promised"), std::string::npos);
  EXPECT_NE(with("\"version\":\"2.0\"", "\"version\":\"1.0\"").find("version '1.0'"), std::string::npos);
  EXPECT_NE(with("\"asset\"", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"asset\"")
                .find("KHR_draco_mesh_compression"),
            std::string::npos);
  EXPECT_NE(with("\"indices\":1", "\"indices\":7").find("names entry 7 of 'accessors'; there are 2"),
            std::string::npos);
  EXPECT_NE(with("\"VEC3\"", "\"MAT4\"").find("no place in a mesh"), std::string::npos);
  EXPECT_NE(with("{\"mesh\":0", "{\"mesh\":\"0\"").find("no natural number"), std::string::npos);
  EXPECT_NE(with("\"nodes\":[0]", "\"nodes\":[4]").find("names entry 4 of 'nodes'"), std::string::npos);
  EXPECT_NE(with("{\"asset\"", "{\"asset").find("JSON is damaged"), std::string::npos);
  EXPECT_NE(refused("glTF").find("no binary glTF"), std::string::npos);
  EXPECT_NE(refused("solid").find("JSON is damaged"), std::string::npos);
}

class DamagedGltf : public Gltf, public ::testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(Images, DamagedGltf, ::testing::Bool(),
                         [](const auto& of) { return of.param ? "Jpeg" : "Png"; });

TEST_P(DamagedGltf, CutShortOrEditedItIsReadOrRefused) {
  GltfBuffer buffer = plate_buffer();
  std::vector<float> places(2 * plate().points.size(), 0.5F);
  buffer.add(places, 2);
  const auto colors = [](double u, double v) { return std::array{u, v, 0.5}; };
  const int view =
      buffer.add_view(GetParam() ? image<vtkJPEGWriter>(colors, 40) : image<vtkPNGWriter>(colors, 12));
  const std::string sound = buffer.glb(
      entries(",\"material\":0", "", ",\"TEXCOORD_0\":2") +
      ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{"
      "\"source\":0}],\"images\":[{\"bufferView\":" +
      std::to_string(view) + "}]");
  ASSERT_EQ(refused(sound), "");
  for (std::size_t size = 0; size < sound.size(); size += 7)
    EXPECT_NE(refused(sound.substr(0, size)), "") << size << " bytes";
  std::mt19937 random(11);
  int read = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = sound;
    for (unsigned edits = 1 + random() % 4; edits > 0; --edits) {
      char& byte = bytes[12 + random() % (bytes.size() - 12)];
      byte =
          static_cast<char>(byte >= '0' && byte <= '9' && random() % 2 == 0 ? '0' + random() % 10 : random());
    }
    SCOPED_TRACE(i);
    ASSERT_NO_THROW(read += refused(bytes).empty());
  }
  EXPECT_GT(read, 20) << "some edits change a point only";
  EXPECT_LT(read, 1990);
}

}  // namespace
}  // namespace cleft
