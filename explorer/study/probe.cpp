#include "explorer/study/probe.h"

#include "base/text.h"

namespace cleft {

Motion motion_of(const Field& field, const Vec3& uvw, Side side, const RawCase* raw) {
  constexpr int pieces = 120;
  Motion motion;
  const auto add = [](std::array<Curve, 3>& curves, double t, const Vec3& d) {
    for (int k = 0; k < 3; ++k) {
      curves[k].x.push_back(t);
      curves[k].y.push_back(d[k]);
    }
  };
  for (int i = 0; i <= pieces; ++i) {
    const double t = field.duration() * i / pieces;
    add(motion.field, t, field.displacement(uvw, side, t));
  }
  const int node = raw ? raw->nearest_node(uvw, side) : -1;
  if (node < 0) return motion;
  motion.node = raw->snapshot().points[node];
  for (const double t : motion.field[0].x) add(motion.at_node, t, field.displacement(*motion.node, side, t));
  for (std::size_t j = 0; j < raw->snapshot().frames(); ++j)
    add(motion.raw, raw->snapshot().times[j], raw->displacements(j, std::array{node}).front());
  return motion;
}

std::string motion_as_csv(const Field& field, const Vec3& uvw, Side side, const Motion& motion) {
  const bool raw = motion.node.has_value();
  const std::vector<double>& times = raw ? motion.raw[0].x : motion.field[0].x;
  std::string text = std::string("t,du,dv,dw") +
                     (raw ? ",node_du,node_dv,node_dw,at_node_du,at_node_dv,at_node_dw" : "") + "\n";
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Vec3 d = field.displacement(uvw, side, times[i]);
    text += shortest(times[i]) + "," + shortest(d.x) + "," + shortest(d.y) + "," + shortest(d.z);
    for (std::size_t k = 0; raw && k < 3; ++k) text += "," + shortest(motion.raw[k].y[i]);
    const Vec3 beside = raw ? field.displacement(*motion.node, side, times[i]) : Vec3{};
    for (std::size_t k = 0; raw && k < 3; ++k) text += "," + shortest(beside[k]);
    text += "\n";
  }
  return text;
}

}  // namespace cleft
