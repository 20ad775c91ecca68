// check_consistency: conditions between several parameters.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/text.h"
#include "params/parameters.h"

namespace cleft {

namespace {

constexpr double most_nodes = 1e7;  // unknowns and their neighbours are counted in 32 bits
constexpr double most_moved = 0.9;  // of the room between a cut and the patch's side
const double widest_half_angle = std::numbers::pi / 3;

std::string with_value(const std::string& name, const std::string& unit, double value) {
  return name + " = " + shortest(value) + (unit.empty() ? "" : " " + unit);
}

std::string with_mm(const std::string& name, double value) { return with_value(name, "mm", value); }

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
        length_name_(p.mesh.cut_length > 0 ? "mesh.cut_length" : "cut.length"),
        depth_name_(p.mesh.cut_depth > 0 ? "mesh.cut_depth" : "cut.depth"),
        length_(p.mesh.cut_length > 0 ? p.mesh.cut_length : p.cut.length),
        depth_(p.mesh.cut_depth > 0 ? p.mesh.cut_depth : p.cut.depth) {}

  /// The number of nodes the mesh will have, about.
  double check() {
    check_size();
    check_arc();
    check_elements();
    check_cuts_beside();
    check_room();
    check_nodes();
    check_materials();
    return nodes();
  }

 private:
  void need(bool good, const std::string& message) const {
    if (!good) throw InputError(where_ + ": " + message);
  }

  void check_size() const {
    need(p_.mesh.cut_length == 0 || p_.mesh.cut_length >= p_.cut.length,
         with_mm("mesh.cut_length", p_.mesh.cut_length) + ": must be at least " +
             with_mm("cut.length", p_.cut.length) + ", or 0 for a mesh of the case's own");
    need(p_.mesh.cut_depth == 0 || p_.mesh.cut_depth >= p_.cut.depth,
         with_mm("mesh.cut_depth", p_.mesh.cut_depth) + ": must be at least " +
             with_mm("cut.depth", p_.cut.depth) + ", or 0 for a mesh of the case's own");
    need(depth_ < p_.patch.height,
         with_mm(depth_name_, depth_) + ": must be less than " + with_mm("patch.height", p_.patch.height));
  }

  void check_arc() {
    const double radius = p_.cut.radius, least = length_ / 2 / widest_half_angle;
    need(radius == 0 || radius >= least,
         with_mm("cut.radius", radius) + ": an arc of " + with_mm(length_name_, length_) +
             " would turn by more than 60 degrees to either side; must be at least " +
             shortest(std::ceil(least * 1000) / 1000) + " mm, or 0 for a straight cut");
    span_ = radius > 0 ? 2 * radius * std::sin(length_ / 2 / radius) : length_;
    need(span_ < p_.patch.length, with_mm(length_name_, length_) +
                                      (radius > 0 ? ", " + rounded(span_) + " mm along u" : "") +
                                      ": must be less than " + with_mm("patch.length", p_.patch.length));
  }

  void check_elements() const {
    const double h = p_.mesh.element_size;
    need(2 * h <= p_.cut.length, with_mm("mesh.element_size", h) + ": at most half of " +
                                     with_mm("cut.length", p_.cut.length) +
                                     ", so that the cut has a node to open");
    need(p_.mesh.cut_depth == 0 || h < 2 * p_.cut.depth,
         with_mm("mesh.element_size", h) + ": must be less than twice " + with_mm("cut.depth", p_.cut.depth) +
             ", so that the cut has a node to open in the mesh of " +
             with_mm("mesh.cut_depth", p_.mesh.cut_depth));
    need(2 * h <= p_.patch.width,
         with_mm("mesh.element_size", h) + ": at most half of " + with_mm("patch.width", p_.patch.width));
  }

  void check_cuts_beside() {
    const double h = p_.mesh.element_size, count = p_.cut.count, branch = p_.cut.branch;
    need(branch == 0 || count == 1, with_mm("cut.branch", branch) + ": a branch leaves a single cut, not " +
                                        with_value("cut.count", "", count) +
                                        "; set cut.count = 1, or cut.branch = 0");
    need(branch == 0 || branch >= h, with_mm("cut.branch", branch) + ": must be at least " +
                                         with_mm("mesh.element_size", h) + ", or 0 for none");
    need(branch + h <= p_.patch.width / 2,
         with_mm("cut.branch", branch) + ": must leave an element of " + with_mm("mesh.element_size", h) +
             " to the patch's side; make it shorter, or raise " + with_mm("patch.width", p_.patch.width));
    const double across = (count - 1) * p_.cut.spacing;
    need(across + 2 * h <= p_.patch.width,
         with_value("cut.count", "", count) + ", " + with_mm("cut.spacing", p_.cut.spacing) +
             ": the cuts take " + rounded(across) + " mm and an element on either side, more than " +
             with_mm("patch.width", p_.patch.width) + "; make fewer, closer ones, or a wider patch");
    room_left_ = (p_.patch.width - across) / 2;
    room_right_ = room_left_ - branch;
    core_ = across + branch;
  }

  /// Curved and tilted cuts move the mesh toward the sides of the patch (solver/patch_mesh_grid.cpp).
  void check_room() {
    const double s = std::sin(p_.cut.radius > 0 ? length_ / 4 / p_.cut.radius : 0);
    const double tilted = std::tan(p_.cut.tilt * std::numbers::pi / 180) *
                          (depth_ + std::min(depth_, p_.patch.height - depth_) / 2);
    to_right_ = 2 * p_.cut.radius * s * s + std::max(tilted, 0.0);
    to_left_ = std::max(-tilted, 0.0);
    const auto need_room = [&](double moved, double room, const std::string& side) {
      need(moved <= most_moved * room,
           with_mm("cut.radius", p_.cut.radius) + ", " + with_value("cut.tilt", "degrees", p_.cut.tilt) +
               ": the mesh would move by " + rounded(moved) + " mm toward " + side + ", where there are " +
               rounded(room) +
               " mm beside the cut; at most nine tenths of that: make the cut straighter, or raise " +
               with_mm("patch.width", p_.patch.width));
    };
    need_room(to_right_, room_right_, "+v");
    need_room(to_left_, room_left_, "-v");
  }

  double nodes() const {
    const double h = p_.mesh.element_size, growth = p_.mesh.grading;
    const double along_u = length_ / h + 2 * count_of_elements((p_.patch.length - span_) / 2, h, growth);
    const double along_v = core_ / h + p_.cut.count + count_of_elements(room_left_ + to_right_, h, growth) +
                           count_of_elements(room_right_ + to_left_, h, growth);
    const double along_w = depth_ / h + count_of_elements(p_.patch.height - depth_, h, growth);
    return (along_u + 1) * along_v * (along_w + 1);
  }

  void check_nodes() const {
    const double count = nodes();
    need(count < most_nodes, with_mm("mesh.element_size", p_.mesh.element_size) + ", " +
                                 with_value("mesh.grading", "", p_.mesh.grading) +
                                 ": the patch would have about " + shortest(std::round(count)) +
                                 " nodes; at most " + shortest(most_nodes) +
                                 ": raise one of them, or make the patch smaller");
  }

  void check_materials() const {
    need(p_.foundation.stiffness > 0 || p_.foundation.side_stiffness > 0,
         "foundation.stiffness and foundation.side_stiffness = 0: the patch would float; hold it by one of "
         "them");
    need(p_.tissue.poisson_ratio <= 0.49 || p_.tissue.formulation == "mean-dilatation",
         with_value("tissue.poisson_ratio", "", p_.tissue.poisson_ratio) +
             ": above 0.49 linear wedges lock; set tissue.formulation = \"mean-dilatation\"");
    const Parameters::Skin& skin = p_.skin;
    need(skin.prestress_u * skin.prestress_v >= skin.prestress_uv * skin.prestress_uv &&
             skin.prestress_u >= 0 && skin.prestress_v >= 0,
         "skin.prestress_u, _v, _uv = " + shortest(skin.prestress_u) + ", " + shortest(skin.prestress_v) +
             ", " + shortest(skin.prestress_uv) +
             " MPa: the skin would be compressed in some direction; a membrane carries tension only");
  }

  const Parameters& p_;
  const std::string& where_;
  const std::string length_name_, depth_name_;
  const double length_, depth_;            // of the cut the mesh is made for
  double span_ = 0;                        // of the cut along u
  double core_ = 0;                        // across the parallel cuts, or the branch
  double room_left_ = 0, room_right_ = 0;  // beside them
  double to_left_ = 0, to_right_ = 0;      // how far the mesh is moved
};

}  // namespace

void check_consistency(const Parameters& parameters, const std::string& where) {
  ConsistencyCheck(parameters, where).check();
}

double estimated_nodes(const Parameters& parameters) { return ConsistencyCheck(parameters, "case").check(); }

}  // namespace cleft
