// What the field of a body tells of the tissue below the middle of its cut, from cleft body to the field read
// back: layers and thickness that are known.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "encoder/field/file/field_file.h"
#include "explorer/body/body_maker.h"
#include "haptic/surface_stiffness.h"
#include "tests/bodies/subjects.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// Of a cut along a cylinder, with three layers in 6 mm of tissue, or in what bone leaves of them.
Field field_of(double bone_below, const TemporaryFolder& folder) {
  const testing::Bend bend = testing::cylinder_along(60);
  BodyRequest request;
  request.skin = testing::sheet(bend, 30, 30, 2, 0.25);
  request.paths = {testing::path_on(bend, {{-8, 0}, {0, 0}, {8, 0}}, 2)};
  request.parameters.mesh.element_size = 1.5, request.parameters.mesh.grading = 1.5;
  request.parameters.patch.height = 6, request.reach = 15;
  if (bone_below > 0)
    request.bone = std::make_shared<SurfaceIndex>(
        testing::sheet(testing::below(bend, [&](double, double) { return bone_below; }), 30, 30, 2));
  request.layers = {{{"dermis", 0.08, {}}, 1.2}, {{"fat", {}, {}}, 3}, {{"muscle", 0.05, 0.45}, INFINITY}};
  Body body = make_body(request);
  write_body(folder / "body.h5", body);
  folder.write("case.toml", "[case]\npatch.height = 6\ntissue.young_modulus = 0.012\n");
  expect_success(run_cleft("solve", {folder / "case.toml", "--mesh", folder / "body.h5", "--out",
                                     folder / "case.h5", "--no-estimate"}));
  expect_success(run_cleft("encode", {folder / "case.h5", "--out", folder / "case.dffd"}));
  return read_field(folder / "case.dffd");
}

void expect_layers(const Field& field, double thickness, double foundation) {
  ASSERT_TRUE(field.tissue);
  EXPECT_NEAR(field.tissue->foundation, foundation, 1e-9 * foundation);
  const auto& layers = field.tissue->layers;
  ASSERT_EQ(layers.size(), 3U);
  const TissueLayerBelow expected[] = {{0.08, 0.4, 0.2}, {0.012, 0.4, 0.3}, {0.05, 0.45, 0.5}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(layers[i].young_modulus, expected[i].young_modulus) << i;
    EXPECT_DOUBLE_EQ(layers[i].poisson_ratio, expected[i].poisson_ratio) << i;
    EXPECT_NEAR(layers[i].height, expected[i].height * thickness, 0.02 * thickness) << i;
  }
}

}  // namespace

TEST(TissueBelow, OfLayersIsInTheField) {
  const TemporaryFolder folder, on_bone_folder;
  const Field plain = field_of(0, folder), on_bone = field_of(4.5, on_bone_folder);
  expect_layers(plain, 6, 0.005);
  expect_layers(on_bone, 4.5, 1000 * 0.012 / 6);
  EXPECT_GT(surface_stiffness(on_bone), 1.2 * surface_stiffness(plain));
}

}  // namespace cleft
