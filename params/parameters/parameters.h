// The parameters of a case: the input of the solver. Their names in files, units and ranges are stated in
// params/parameters/table.cpp.
#pragma once

namespace cleft {

/// A frame of the series for every released column of node pairs, or for every pair.
enum class FrameEvery { column, pair };

/// How the tissue's elements are made: of displacements alone, or with one mean dilatation for each element.
enum class TissueFormulation { displacement, mean_dilatation };

/// Where a cut in a mesh ends: a little inside the first nodes that stay closed, where the simulated opening
/// behaves as if it ended, or at these nodes.
enum class MeshFront { effective, nodes };

/// Wedges of six nodes, in which displacements are linear; or of 15 nodes, in which they are quadratic.
enum class ElementOrder { linear, quadratic };

/// What pulls at the skin's edges on the patch's sides: the surrounding skin, which holds the closed patch in
/// equilibrium, so that only what the cut releases moves it; or nothing, as on a piece that was cut out.
enum class SkinEdges { held, free };

/// What holds the bottom of the patch: springs, or bone to which the tissue is grown.
enum class PatchBottom { springs, bone };

/// Small strains, in which all is linear; or finite ones.
enum class Model { small, finite };

/// Laws of finite strains.
enum class TissueLaw { neo_hookean, st_venant_kirchhoff };
enum class SkinLaw { st_venant_kirchhoff, neo_hookean, fung };

/// A plane stress of the skin, MPa: along the cut, across it, and shear.
struct Prestress {
  double uu = 0, vv = 0, uv = 0;
};

/// Lengths in mm, curvatures in 1/mm, stresses in MPa, springs in N/mm^3, angles in degrees.
struct Parameters {
  Model model = Model::small;
  struct Patch {
    double length = 100, width = 100, height = 8;
    double slope = 0;
    PatchBottom bottom = PatchBottom::springs;
  } patch;
  struct Cut {
    double length = 30, depth = 3;
    bool contact = false;
    double radius = 0, curvature = 0, curvature_rate = 0, tilt = 0, count = 1, spacing = 5, branch = 0;
    FrameEvery frames = FrameEvery::column;
    bool mirrored = false;
  } cut;
  struct Mesh {
    double element_size = 1, grading = 1.3;
    ElementOrder elements = ElementOrder::linear;
    MeshFront front = MeshFront::effective;
    double cut_length = 0, cut_depth = 0;
  } mesh;
  struct Skin {
    double thickness = 1.5, young_modulus = 0.13, poisson_ratio = 0.4;
    Prestress prestress{0.01, 0.03, 0};
    double curvature_u = 0, curvature_v = 0, curvature_uv = 0;
    SkinEdges edges = SkinEdges::held;
    bool initial_stress_stiffness = false;
    double turning_stiffness = 0;
    double bending_stiffness = 0;
    SkinLaw law = SkinLaw::st_venant_kirchhoff;
    double stiffening = 5;
    double fibre_share = 0, fibre_angle = 0, fibre_dispersion = 0;
  } skin;
  struct Tissue {
    double young_modulus = 0.02, poisson_ratio = 0.4;
    double prestress_share = 0;
    TissueFormulation formulation = TissueFormulation::displacement;
    TissueLaw law = TissueLaw::neo_hookean;
  } tissue;
  struct Foundation {
    double stiffness = 0.005, side_stiffness = 0.005;
  } foundation;
};

/// Whether the squares of a patch are halved like the colours of a chess board, with which nearly
/// incompressible tissue does not lock in the plane, and else in rows, whose fields are smoother: under a
/// tilted blade mean dilatation is for the thin lip, in any tissue.
inline bool has_chess_board(const Parameters& p) {
  return p.tissue.formulation == TissueFormulation::mean_dilatation &&
         (p.cut.tilt == 0 || p.tissue.poisson_ratio > 0.45);
}

/// Whether the skin's prestress is a part of the stiffness of the small model.
inline bool is_stiffened_by_prestress(const Parameters& p) {
  return p.skin.initial_stress_stiffness || p.skin.turning_stiffness > 0;
}

/// Whether displacements are linear in the skin's prestress, so that those under several prestresses
/// superpose.
inline bool is_linear_in_prestress(const Parameters& p) {
  return p.model == Model::small && !p.cut.contact && !is_stiffened_by_prestress(p);
}

/// Whether the cut curves in a patch that bends with it.
inline bool is_curved(const Parameters& p) { return p.cut.curvature != 0 || p.cut.curvature_rate != 0; }

/// Whether the patch is a box that is bent or whose bottom slopes (solver/patch_shape.h).
inline bool is_shaped(const Parameters& p) {
  return is_curved(p) || p.skin.curvature_u != 0 || p.skin.curvature_v != 0 || p.skin.curvature_uv != 0 ||
         p.patch.slope != 0;
}

/// Whether the nodes of a patch know their coordinates along and across the cut: where it is a single one
/// without a branch, and its radius is not that of cut.radius. Of an upright straight cut in a box these are
/// the nodes' places, and snapshots do not repeat them.
inline bool has_coordinates(const Parameters& p) {
  return is_shaped(p) || (p.cut.tilt != 0 && p.cut.radius == 0 && p.cut.count == 1 && p.cut.branch == 0);
}

}  // namespace cleft
