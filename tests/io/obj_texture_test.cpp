// Textures of .obj files as colours of the points: the image is drawn such that each point has the colour of
// its place, though the texture has a seam.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkJPEGWriter.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "base/text.h"
#include "explorer/io/mesh_file.h"
#include "tests/incision/meshes.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

constexpr double island = 0.4;  ///< of the image's width, for each half of the plate

std::array<double, 3> color_of_place(double x, double y) {
  return {0.5 + 0.03 * x, 0.5 - 0.02 * y, 0.4 + 0.01 * (x + y)};
}

/// Texels of 600 x 300: the left half of the plate of 20 x 20 at the left, the right half at the right, a gap
/// between them; `squares` adds a pattern with as many squares in a row.
template <class Writer>
void write_image(const std::string& file, int squares = 0) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(600, 300, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int j = 0; j < 300; ++j)
    for (int i = 0; i < 600; ++i) {
      const double u = (i + 0.5) / 600, v = (j + 0.5) / 300;
      const double x =
          u < 0.5 ? std::min(0., 10 * (u / island - 1)) : std::max(0., 10 * ((u - 1) / island + 1));
      const auto color = color_of_place(x, 20 * v - 10);
      const bool dark = squares > 0 && (int(squares * u) + int(squares * v)) % 2 == 0;
      for (int k = 0; k < 3; ++k)
        image->SetScalarComponentFromDouble(i, j, 0, k, dark ? 0 : std::round(255 * color[k]));
    }
  vtkNew<Writer> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(image);
  writer->Write();
}

/// The plate of 20 x 20, whose points at x = 0 have two places in the texture.
std::string obj_of_plate(const std::string& library, double turns = 0) {
  const SurfaceMesh plate = testing::grid(20, 20, -10, -10, 1);
  std::ostringstream out;
  out << "mtllib " << library << "\nusemtl skin\n";
  for (const Vec3& p : plate.points) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const double side : {-1., 1.})
    for (const Vec3& p : plate.points)
      out << "vt " << (side < 0 ? island * (p.x / 10 + 1) : 1 + island * (p.x / 10 - 1)) + turns << ' '
          << (p.y + 10) / 20 << '\n';
  for (const auto& t : plate.triangles) {
    const double middle = plate.points[t[0]].x + plate.points[t[1]].x + plate.points[t[2]].x;
    out << 'f';
    for (const int corner : t)
      out << ' ' << corner + 1 << '/' << corner + 1 + (middle < 0 ? 0 : plate.points.size());
    out << '\n';
  }
  return out.str();
}

double off_places(const SurfaceMesh& mesh) {
  if (mesh.colors.size() != mesh.points.size()) return HUGE_VAL;
  double most = 0;
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    for (std::size_t k = 0; k < 3 && mesh.points[p].z == 0; ++k)
      most =
          std::max(most, std::abs(mesh.colors[p][k] - color_of_place(mesh.points[p].x, mesh.points[p].y)[k]));
  return most;
}

class ObjTexture : public ::testing::Test {
 protected:
  SurfaceMesh read(const std::string& obj) const { return read_mesh(in.write("plate.obj", obj)); }
  TemporaryFolder in;
};

// Bytes of the image and of the points: half of one each. At the edges of the islands half of what is taken
// the mean of has the colour of the edge: an eighth of an edge's length, 0.125 x 0.03.
constexpr double tolerance = 1 / 255. + 0.125 * 0.03 + 1e-3;

TEST_F(ObjTexture, GivesEachPointTheColorOfItsPlace) {
  std::filesystem::create_directory(in / "maps");
  write_image<vtkPNGWriter>(in / "maps/skin of a head.png");
  in.write("a.mtl",
           "newmtl other\nmap_Kd none.png\nnewmtl skin\nKd 1 0 0\nmap_Kd maps\\skin of a head.png\n");
  const SurfaceMesh mesh = read(obj_of_plate("a.mtl"));
  EXPECT_EQ(mesh.points.size(), 441u) << "the seam's points are one again";
  EXPECT_LT(off_places(mesh), tolerance);
  EXPECT_NE(mesh.note.find("skin of a head.png is drawn as colours of the points"), std::string::npos)
      << mesh.note;
  EXPECT_LT(off_places(read(obj_of_plate("a.mtl", 3))), tolerance) << "the image is repeated";
}

TEST_F(ObjTexture, IsReadFromJpegAndBehindOptions) {
  write_image<vtkJPEGWriter>(in / "skin.jpg");
  in.write("a.mtl", "newmtl skin\nmap_Kd -s 1 1 1 -clamp on skin.jpg\n");
  EXPECT_LT(off_places(read(obj_of_plate("a.mtl"))), tolerance + 4 / 255.) << "whose colours are not exact";
}

TEST_F(ObjTexture, SurvivesTheCut) {
  write_image<vtkPNGWriter>(in / "skin.png");
  in.write("a.mtl", "newmtl skin\nmap_Kd skin.png\n");
  const Outcome outcome = expect_success(
      run_cleft("cut", {"--mesh", in.write("plate.obj", obj_of_plate("a.mtl")), "--path",
                        in.write("path.csv", "x,y,z,nx,ny,nz\n-4.2,0.73,0,0,0,1\n4.1,0.31,0,0,0,1\n"),
                        "--rest", "--depth", "2", "--out", in / "cut.ply"}));
  EXPECT_NE(outcome.output.find("skin.png is drawn as colours"), std::string::npos) << outcome.output;
  const SurfaceMesh cut = read_mesh(in / "cut.ply");
  EXPECT_GT(cut.points.size(), 500u);
  EXPECT_LT(off_places(cut), tolerance + 1 / 255.);
}

TEST_F(ObjTexture, FinerThanTheTrianglesIsLeftOutAndSaidToBe) {
  write_image<vtkPNGWriter>(in / "skin.png", 60);
  in.write("a.mtl", "newmtl skin\nmap_Kd skin.png\n");
  const SurfaceMesh mesh = read(obj_of_plate("a.mtl"));
  EXPECT_TRUE(mesh.colors.empty());
  EXPECT_NE(mesh.note.find("is left out"), std::string::npos) << mesh.note;
}

TEST_F(ObjTexture, ThatCannotBeReadLeavesTheMeshWithoutColors) {
  const auto note = [&](const std::string& library) {
    in.write("a.mtl", library);
    const SurfaceMesh mesh = read(obj_of_plate("a.mtl"));
    EXPECT_EQ(mesh.triangles.size(), 800u);
    EXPECT_TRUE(mesh.colors.empty());
    return mesh.note;
  };
  EXPECT_EQ(note("newmtl skin\nKd 1 1 1\n"), "");
  EXPECT_NE(note("newmtl skin\nmap_Kd gone.png\n").find("gone.png is not there"), std::string::npos);
  in.write("bad.png", "no image");
  EXPECT_NE(note("newmtl skin\nmap_Kd bad.png\n").find("bad.png is no image"), std::string::npos);
  EXPECT_EQ(read(obj_of_plate("gone.mtl")).note, "");
  write_image<vtkPNGWriter>(in / "skin.png");
  in.write("a.mtl", "newmtl skin\nmap_Kd skin.png\nnewmtl lips\nKd 1 0 0\n");
  const SurfaceMesh two = read(obj_of_plate("a.mtl") +
                               "usemtl lips\nv 20 0 0\nv 21 0 0\nv 21 1 0\n"
                               "f -3/1 -2/1 -1/1\n");
  EXPECT_TRUE(two.colors.empty());
  EXPECT_NE(two.note.find("2 textures or none"), std::string::npos) << two.note;
  const SurfaceMesh bare = read(obj_of_plate("a.mtl") + "v 20 0 0\nv 21 0 0\nv 21 1 0\nf -3/1 -2 -1/1\n");
  EXPECT_TRUE(bare.colors.empty());
  EXPECT_NE(bare.note.find("no place in it"), std::string::npos) << bare.note;
}

/// VTK's own reader ends the program there.
TEST_F(ObjTexture, ThatIsDamagedIsToldOf) {
  write_image<vtkPNGWriter>(in / "skin.png");
  in.write("a.mtl", "newmtl skin\nmap_Kd skin.png\n");
  std::string image = read_text_file(in / "skin.png");
  const std::size_t data = image.find("IDAT");
  ASSERT_NE(data, std::string::npos);
  for (std::size_t at = data + 20; at < data + 60; ++at) image[at] = '\x55';
  in.write("skin.png", image);
  const SurfaceMesh mesh = read(obj_of_plate("a.mtl"));
  EXPECT_TRUE(mesh.colors.empty());
  EXPECT_NE(mesh.note.find("skin.png is no image that can be read"), std::string::npos) << mesh.note;
}

}  // namespace
}  // namespace cleft
