#include "params/consistency.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/text.h"
#include "params/meshed_cut.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

constexpr double most_nodes = 1e7;   // unknowns and their neighbours are counted in 32 bits
constexpr double most_moved = 0.9;   // of the room between a cut and the patch's side
constexpr double most_turned = 1.3;  // radians, of half a curved cut
const double widest_half_angle = std::numbers::pi / 3;

/// Text of a computed length.
std::string rounded(double length) { return shortest(std::round(length * 1000) / 1000); }

/// Elements of a stretch whose first is h long, each longer by the growth than the one before it.
double count_of_elements(double length, double h, double growth) {
  const double uniform = length / h;
  return 1 + (growth > 1 ? std::log1p((growth - 1) * uniform) / std::log(growth) : uniform);
}

/// The rules of check_consistency, and what they need to know of the mesh.
class ConsistencyCheck {
 public:
  ConsistencyCheck(const Parameters& p, const std::string& where)
      : p_(p),
        where_(where),
        length_(p.mesh.cut_length > 0 ? p.mesh.cut_length : p.cut.length),
        depth_(p.mesh.cut_depth > 0 ? p.mesh.cut_depth : p.cut.depth),
        meshed_(meshed_cut(p)) {}

  /// The number of nodes the mesh will have, about.
  double check() {
    check_size();
    check_arc();
    check_shape();
    if (p_.cut.mirrored) check_mirrored();
    check_elements();
    check_cuts_beside();
    check_room();
    check_nodes();
    check_materials();
    if (p_.model == Model::finite) check_finite();
    if (p_.mesh.elements == ElementOrder::quadratic) check_quadratic();
    return nodes();
  }

 private:
  void need(bool good, const std::string& message) const {
    if (!good) throw InputError(where_ + ": " + message);
  }

  /// Refuses what a member of p_ is, with the member that it does not go with.
  template <class Member>
  void refuse(bool present, const Member& member, const std::string& remedy, const std::string& with) const {
    need(!present, row_of(p_, member).name + " = " + text_of(p_, member) + ": not with " + with +
                       " so far; set " + remedy);
  }

  /// "cut.length = 30 mm" of a member of p_.
  std::string named(const double& member) const {
    const Parameter& row = row_of(p_, member);
    return row.name + " = " + shortest(member) + (row.unit.empty() ? "" : " " + row.unit);
  }

  /// Where the mesh's cut, and it alone, is too long or too deep.
  static std::string in_mesh(double own, double meshed, double limit) {
    return own < limit ? ", " + rounded(meshed) + " mm to the mesh's closed nodes" : "";
  }

  void check_size() const {
    need(p_.mesh.cut_length == 0 || p_.mesh.cut_length >= p_.cut.length,
         named(p_.mesh.cut_length) + ": must be at least " + named(p_.cut.length) +
             ", or 0 for a mesh of the case's own");
    need(p_.mesh.cut_depth == 0 || p_.mesh.cut_depth >= p_.cut.depth,
         named(p_.mesh.cut_depth) + ": must be at least " + named(p_.cut.depth) +
             ", or 0 for a mesh of the case's own");
    need(meshed_.depth < p_.patch.height, named(depth_) + in_mesh(depth_, meshed_.depth, p_.patch.height) +
                                              ": must be less than " + named(p_.patch.height));
  }

  void check_arc() {
    const double radius = p_.cut.radius, least = meshed_.length / 2 / widest_half_angle;
    need(radius == 0 || radius >= least,
         named(p_.cut.radius) + ": an arc of " + named(length_) +
             " would turn by more than 60 degrees to either side; must be at least " +
             shortest(std::ceil(least * 1000) / 1000) + " mm, or 0 for a straight cut");
    span_ = radius > 0 ? 2 * radius * std::sin(meshed_.length / 2 / radius) : meshed_.length;
    need(span_ < p_.patch.length, named(length_) + in_mesh(length_, meshed_.length, p_.patch.length) +
                                      (radius > 0 ? ", " + rounded(span_) + " mm along u" : "") +
                                      ": must be less than " + named(p_.patch.length));
  }

  /// What is not known of patches whose shape is not a box, and what a bend cannot be.
  void check_shape() const {
    const double half = meshed_.length / 2, rate = std::abs(p_.cut.curvature_rate);
    // At most: where curvature and rate have different signs on a side, they turn it by less.
    const double half_angle = std::abs(p_.cut.curvature) * half + rate * half * half / 2;
    const double& bend = p_.cut.curvature != 0 ? p_.cut.curvature : p_.cut.curvature_rate;
    need(!is_curved(p_) || p_.cut.radius == 0,
         named(bend) + ", " + named(p_.cut.radius) + ": a cut curves by one of them; set the other to 0");
    need(half_angle <= most_turned, named(bend) + ": " + named(length_) + " would turn by " +
                                        rounded(half_angle) + " rad to either side; at most " +
                                        shortest(most_turned) +
                                        ": make the curvature smaller, or the cut shorter");
    if (!is_shaped(p_)) return;
    const auto& skin = p_.skin;
    const std::string& shape = row_of(p_, is_curved(p_)            ? bend
                                          : skin.curvature_u != 0  ? skin.curvature_u
                                          : skin.curvature_v != 0  ? skin.curvature_v
                                          : skin.curvature_uv != 0 ? skin.curvature_uv
                                                                   : p_.patch.slope)
                                   .name;
    const auto refuse = [&](bool present, const auto& member, const std::string& remedy) {
      this->refuse(present, member, remedy + ", or " + shape + " to 0", shape);
    };
    refuse(p_.model == Model::finite, p_.model, "it to small");
    refuse(skin.bending_stiffness > 0, skin.bending_stiffness, "it to 0");
    refuse(skin.edges == SkinEdges::free, skin.edges, "it to held");
    refuse(p_.tissue.prestress_share > 0, p_.tissue.prestress_share, "it to 0");
    refuse(p_.cut.radius > 0, p_.cut.radius, "cut.curvature in its place");
    refuse(p_.cut.count > 1, p_.cut.count, "it to 1");
    refuse(p_.cut.branch > 0, p_.cut.branch, "it to 0");
  }

  /// What has no mirror image among the cases.
  void check_mirrored() const {
    const auto refuse = [&](bool present, const auto& member, const std::string& remedy) {
      this->refuse(present, member, remedy + ", or cut.mirrored to false", "cut.mirrored = true");
    };
    refuse(p_.cut.radius > 0, p_.cut.radius, "cut.curvature in its place");
    refuse(p_.cut.count > 1, p_.cut.count, "it to 1");
    refuse(p_.cut.branch > 0, p_.cut.branch, "it to 0");
    refuse(p_.skin.fibre_share > 0, p_.skin.fibre_share, "it to 0");
  }

  void check_elements() const {
    const double h = p_.mesh.element_size;
    need(2 * h <= p_.cut.length, named(p_.mesh.element_size) + ": at most half of " + named(p_.cut.length) +
                                     ", so that the cut has a node to open");
    need(p_.mesh.cut_depth == 0 || h < 2 * p_.cut.depth,
         named(p_.mesh.element_size) + ": must be less than twice " + named(p_.cut.depth) +
             ", so that the cut has a node to open in the mesh of " + named(p_.mesh.cut_depth));
    need(2 * h <= p_.patch.width, named(p_.mesh.element_size) + ": at most half of " + named(p_.patch.width));
  }

  void check_cuts_beside() {
    const double h = p_.mesh.element_size, count = p_.cut.count, branch = p_.cut.branch;
    need(branch == 0 || count == 1, named(p_.cut.branch) + ": a branch leaves a single cut, not " +
                                        named(p_.cut.count) + "; set cut.count = 1, or cut.branch = 0");
    need(branch == 0 || branch >= h,
         named(p_.cut.branch) + ": must be at least " + named(p_.mesh.element_size) + ", or 0 for none");
    need(meshed_.branch + h <= p_.patch.width / 2,
         named(p_.cut.branch) + ": must leave an element of " + named(p_.mesh.element_size) +
             " to the patch's side; make it shorter, or raise " + named(p_.patch.width));
    const double across = (count - 1) * p_.cut.spacing;
    need(across + 2 * h <= p_.patch.width,
         named(p_.cut.count) + ", " + named(p_.cut.spacing) + ": the cuts take " + rounded(across) +
             " mm and an element on either side, more than " + named(p_.patch.width) +
             "; make fewer, closer ones, or a wider patch");
    room_left_ = (p_.patch.width - across) / 2;
    room_right_ = room_left_ - meshed_.branch;
    core_ = across + meshed_.branch;
  }

  /// Curved and tilted cuts move the mesh toward the sides of the patch (solver/patch_mesh_grid.cpp).
  void check_room() {
    const double s = std::sin(p_.cut.radius > 0 ? meshed_.length / 4 / p_.cut.radius : 0);
    const double depth = meshed_.depth;
    const double tilted = std::tan(p_.cut.tilt * std::numbers::pi / 180) *
                          (depth + std::min(depth, p_.patch.height - depth) / 2);
    to_right_ = 2 * p_.cut.radius * s * s + std::max(tilted, 0.0);
    to_left_ = std::max(-tilted, 0.0);
    const auto need_room = [&](double moved, double room, const std::string& side) {
      need(moved <= most_moved * room,
           named(p_.cut.radius) + ", " + named(p_.cut.tilt) + ": the mesh would move by " + rounded(moved) +
               " mm toward " + side + ", where there are " + rounded(room) +
               " mm beside the cut; at most nine tenths of that: make the cut straighter, or raise " +
               named(p_.patch.width));
    };
    need_room(to_right_, room_right_, "+v");
    need_room(to_left_, room_left_, "-v");
  }

  double nodes() const {
    const double h = p_.mesh.element_size, growth = p_.mesh.grading;
    const double along_u =
        meshed_.length / h + 2 * count_of_elements((p_.patch.length - span_) / 2, h, growth);
    const double along_v = core_ / h + p_.cut.count + count_of_elements(room_left_ + to_right_, h, growth) +
                           count_of_elements(room_right_ + to_left_, h, growth);
    const double along_w = meshed_.depth / h + count_of_elements(p_.patch.height - meshed_.depth, h, growth);
    const double halves = p_.mesh.elements == ElementOrder::quadratic ? 2 : 1;
    return (halves * along_u + 1) * (halves * (along_v - 1) + 1) * (halves * along_w + 1);
  }

  void check_nodes() const {
    const double count = nodes();
    need(count < most_nodes, named(p_.mesh.element_size) + ", " + named(p_.mesh.grading) +
                                 ": the patch would have about " + shortest(std::round(count)) +
                                 " nodes; at most " + shortest(most_nodes) +
                                 ": raise one of them, or make the patch smaller");
  }

  void check_materials() const {
    need(p_.foundation.stiffness > 0 || p_.foundation.side_stiffness > 0 ||
             p_.patch.bottom == PatchBottom::bone,
         "foundation.stiffness and foundation.side_stiffness = 0: the patch would float; hold it by one of "
         "them");
    need(p_.tissue.poisson_ratio <= 0.49 || p_.tissue.formulation == TissueFormulation::mean_dilatation,
         named(p_.tissue.poisson_ratio) +
             ": above 0.49 linear wedges lock; set tissue.formulation = \"mean-dilatation\"");
    need(p_.skin.turning_stiffness == 0 || !p_.skin.initial_stress_stiffness,
         named(p_.skin.turning_stiffness) +
             ": is a part of skin.initial_stress_stiffness = true; set it to 0, or that to false");
    check_tension(p_, where_);
  }

  /// What the finite model does not have.
  void check_finite() const {
    const std::string finite = " with model = \"finite\"";
    need(!p_.skin.initial_stress_stiffness,
         "skin.initial_stress_stiffness = true: the prestress stiffens the skin anyway" + finite +
             "; set it to false");
    need(p_.skin.turning_stiffness == 0, named(p_.skin.turning_stiffness) +
                                             ": skin under tension resists turning anyway" + finite +
                                             "; set it to 0");
    need(p_.tissue.formulation == TissueFormulation::displacement || p_.tissue.law == TissueLaw::neo_hookean,
         "tissue.formulation = \"mean-dilatation\", tissue.law = " + text_of(p_, p_.tissue.law) +
             ": this law has no part of the change of volume alone; set tissue.law to \"neo-hookean\"");
  }

  /// What quadratic elements are not made for.
  void check_quadratic() const {
    const auto refuse = [&](bool present, const auto& member, const std::string& remedy) {
      this->refuse(present, member, remedy + ", or mesh.elements to linear", "mesh.elements = quadratic");
    };
    refuse(p_.model == Model::finite, p_.model, "it to small");
    refuse(p_.tissue.formulation == TissueFormulation::mean_dilatation, p_.tissue.formulation,
           "it to displacement");
    refuse(p_.cut.frames == FrameEvery::pair, p_.cut.frames, "it to column");
    const auto& skin = p_.skin;
    for (const double* shape :
         {&p_.cut.radius, &p_.cut.curvature, &p_.cut.curvature_rate, &p_.cut.tilt, &p_.patch.slope,
          &skin.curvature_u, &skin.curvature_v, &skin.curvature_uv, &skin.bending_stiffness})
      refuse(*shape != 0, *shape, "it to 0");
  }

  const Parameters& p_;
  const std::string& where_;
  const double &length_, &depth_;  // of the cut the mesh is made for
  const MeshedCut meshed_;
  double span_ = 0;                        // of the cut along u
  double core_ = 0;                        // across the parallel cuts, or the branch
  double room_left_ = 0, room_right_ = 0;  // beside them
  double to_left_ = 0, to_right_ = 0;      // how far the mesh is moved
};

}  // namespace

void check_tension(const Parameters& parameters, const std::string& where) {
  const auto [uu, vv, uv] = parameters.skin.prestress;
  if (uu * vv >= uv * uv && uu >= 0 && vv >= 0) return;
  throw InputError(where + ": skin.prestress_u, _v, _uv = " + shortest(uu) + ", " + shortest(vv) + ", " +
                   shortest(uv) +
                   " MPa: the skin would be compressed in some direction; a membrane carries tension only");
}

void check_consistency(const Parameters& parameters, const std::string& where) {
  ConsistencyCheck(parameters, where).check();
}

double estimated_nodes(const Parameters& parameters) { return ConsistencyCheck(parameters, "case").check(); }

}  // namespace cleft
