// The table of mesh formats is what help texts, errors and dialogs say, and endings are compared without
// regard to case.
#include "explorer/io/formats/mesh_formats.h"

#include <gtest/gtest.h>

#include <sstream>

#include "base/error.h"
#include "base/text.h"
#include "explorer/io/mesh_file.h"
#include "explorer/io/volume_mesh.h"
#include "tests/pipeline/commands.h"
#include "tests/support/flat_plate.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

class MeshFormats : public ::testing::Test {
 protected:
  std::string path() const { return in.write("path.csv", "x,y,z,nx,ny,nz\n-4,0.7,0,0,0,1\n4,0.7,0,0,0,1\n"); }
  Outcome cut(const std::string& mesh, const std::string& out) const {
    return run_cleft("cut", {"--mesh", mesh, "--path", path(), "--rest", "--depth", "2", "--out", out});
  }
  /// 4 x 4 x 2 hexahedra under z = 0.
  std::string box(const std::string& name) const {
    const int nx = 4, ny = 4, nz = 2;
    std::ostringstream points, cells, offsets, types;
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
          points << 4 * (i - 2) << ' ' << 4 * (j - 2) << ' ' << 4 * (k - nz) << ' ';
    const auto at = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
    int count = 0;
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          for (const int z : {k, k + 1})
            cells << at(i, j, z) << ' ' << at(i + 1, j, z) << ' ' << at(i + 1, j + 1, z) << ' '
                  << at(i, j + 1, z) << ' ';
          offsets << 8 * ++count << ' ';
          types << "12 ";
        }
    return in.write(
        name,
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid><Piece "
        "NumberOfPoints=\"" +
            std::to_string((nx + 1) * (ny + 1) * (nz + 1)) + "\" NumberOfCells=\"" + std::to_string(count) +
            "\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
            "format=\"ascii\">" +
            points.str() +
            "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
            "format=\"ascii\">" +
            cells.str() + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" +
            offsets.str() + "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" +
            types.str() + "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>");
  }
  const std::string surfaces = mesh_endings(MeshKind::surface, MeshUse::read),
                    written = mesh_endings(MeshKind::surface, MeshUse::write),
                    volumes = mesh_endings(MeshKind::volume, MeshUse::read);
  TemporaryFolder in;
};

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "missing '" << part << "' in: " << text;
}

TEST_F(MeshFormats, AreTheOnesThatTextsName) {
  EXPECT_EQ(surfaces, ".stl .obj .ply .vtp .glb .gltf");
  EXPECT_EQ(written, ".stl .obj .ply .vtp");
  EXPECT_EQ(volumes, ".vtu");
  EXPECT_EQ(mesh_endings_with_arrays(), ".vtp .vtu");
  EXPECT_EQ(surface_filter(MeshUse::read), "Surface meshes (*.stl *.obj *.ply *.vtp *.glb *.gltf)");
  EXPECT_EQ(surface_filter(MeshUse::write), "Surface meshes (*.stl *.obj *.ply *.vtp)");
  const std::string cut_help = run_cleft("cut", {"--help"}).output;
  expect_in(cut_help, "surface mesh: " + surfaces + "; or a mesh of volume: " + volumes);
  expect_in(cut_help, "the cut mesh: " + written + ", or of volume " + volumes +
                          "; with point arrays: " + mesh_endings_with_arrays());
  expect_in(run_cleft("haptic", {"--help"}).output, "surface mesh: " + surfaces);
  expect_in(read_text_file(CLEFT_SOURCE "/README.md"), "(" + surfaces + ")");
}

TEST_F(MeshFormats, ErrorsNameThemAll) {
  const std::string other = in.write("mesh.3ds", "");
  const Outcome read = cut(other, in / "cut.vtp"), write = cut(in / "mesh.stl", in / "cut.3ds"),
                kinds = cut(box("box.vtu"), in / "cut.vtp");
  for (const Outcome& outcome : {read, write, kinds}) EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  expect_in(read.output, "unknown ending '.3ds' of a mesh; known are " + surfaces);
  expect_in(write.output, "unknown ending '.3ds' of a mesh to write; known are " + written);
  expect_in(kinds.output, "a mesh of volume, " + volumes);
  expect_in(kinds.output, written);
}

TEST_F(MeshFormats, EveryRowIsReadAndWrittenInCapitalsToo) {
  for (const MeshFormat& format : mesh_formats) {
    std::string name = "HEAD" + std::string(format.ending);
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_EQ(ending_of(name), format.ending);
    EXPECT_TRUE(is_mesh(name, format.kind));
    if (format.kind == MeshKind::volume || !format.written) continue;
    write_mesh(in / name, flat_plate());
    EXPECT_EQ(read_mesh(in / name).triangles.size(), flat_plate().triangles.size()) << name;
  }
}

TEST_F(MeshFormats, CutReadsAndWritesEndingsInCapitals) {
  write_mesh(in / "HEAD.STL", flat_plate());
  expect_success(cut(in / "HEAD.STL", in / "CUT.VTP"));
  EXPECT_GT(read_mesh(in / "CUT.VTP").triangles.size(), flat_plate().triangles.size());
  const std::string volume = box("BOX.VTU");
  expect_success(cut(volume, in / "CUT.VTU"));
  EXPECT_GT(VolumeMesh(in / "CUT.VTU").cells(), VolumeMesh(volume).cells());
}

}  // namespace
}  // namespace cleft
