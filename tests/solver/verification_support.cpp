#include "tests/solver/verification_support.h"

#include <Eigen/MetisSupport>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>
#include <random>

#include "base/error.h"

namespace cleft {

std::vector<double> even_lines(double from, double to, int count) {
  std::vector<double> lines(count + 1);
  for (int i = 0; i <= count; ++i) lines[i] = from + (to - from) * i / count;
  return lines;
}

PatchMesh box_mesh(TissueFormulation formulation, const std::vector<double>& u, const std::vector<double>& v,
                   const std::vector<double>& w) {
  const int nu = static_cast<int>(u.size()), nv = static_cast<int>(v.size()), nw = static_cast<int>(w.size());
  PatchMesh mesh;
  for (int k = 0; k < nw; ++k)
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        mesh.points.push_back({u[i], v[j], w[k]});
        mesh.skin_above.push_back(((nw - 1) * nv + j) * nu + i);
      }
  const auto add_column = [&](std::array<int, 3> corners) {
    const auto at = [&](int k) {
      std::array<int, 3> nodes = corners;
      for (int& n : nodes) n += k * nv * nu;
      return nodes;
    };
    mesh.bottom.push_back(at(0));
    mesh.skin.push_back(at(nw - 1));
    for (int k = 0; k + 1 < nw; ++k) {
      const auto below = at(k), above = at(k + 1);
      mesh.wedges.push_back({below[0], below[1], below[2], above[0], above[1], above[2]});
    }
  };
  for (int j = 0; j + 1 < nv; ++j)
    for (int i = 0; i + 1 < nu; ++i) {
      const int a = j * nu + i, b = a + 1, c = b + nu, d = a + nu;
      if (diagonal_rises(formulation == TissueFormulation::mean_dilatation, i, j))
        add_column({a, b, c}), add_column({a, c, d});
      else
        add_column({a, b, d}), add_column({b, c, d});
    }
  return mesh;
}

PatchMesh sheet_of(const PatchMesh& mesh, double height) {
  PatchMesh sheet;
  std::vector<int> place(mesh.points.size(), -1);
  for (const auto& triangle : mesh.skin)
    for (const int n : triangle)
      if (place[n] < 0) {
        place[n] = static_cast<int>(sheet.points.size());
        sheet.points.push_back(mesh.points[n]);
      }
  const int count = static_cast<int>(sheet.points.size());
  for (int n = 0; n < count; ++n) sheet.points.push_back(sheet.points[n] - Vec3{0, 0, height});
  for (int n = 0; n < 2 * count; ++n) sheet.skin_above.push_back(n % count);
  for (const auto& triangle : mesh.skin) {
    const int a = place[triangle[0]], b = place[triangle[1]], c = place[triangle[2]];
    sheet.skin.push_back({a, b, c});
    sheet.bottom.push_back({a + count, b + count, c + count});
    sheet.wedges.push_back({a + count, b + count, c + count, a, b, c});
  }
  for (NodePair pair : mesh.pairs)
    if (pair.depth == 0) {
      pair.left = place[pair.left], pair.right = place[pair.right];
      sheet.pairs.push_back(pair);
    }
  return sheet;
}

std::vector<bool> on_surface(const PatchMesh& mesh) {
  Vec3 least = mesh.points.front(), most = least;
  for (const Vec3& p : mesh.points)
    for (int i = 0; i < 3; ++i) least[i] = std::min(least[i], p[i]), most[i] = std::max(most[i], p[i]);
  std::vector<bool> surface;
  for (const Vec3& p : mesh.points) {
    bool on = false;
    for (int i = 0; i < 3; ++i) on = on || p[i] == least[i] || p[i] == most[i];
    surface.push_back(on);
  }
  return surface;
}

void jitter(PatchMesh& mesh, double part, double edge) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-part * edge, part * edge);
  const std::vector<bool> surface = on_surface(mesh);
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    if (!surface[n]) mesh.points[n] += {shift(random), shift(random), shift(random)};
  for (const NodePair& pair : mesh.pairs) mesh.points[pair.right] = mesh.points[pair.left];
}

Eigen::VectorXd areas_of_nodes(const PatchMesh& mesh, const std::vector<std::array<int, 3>>& triangles) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.points.size()));
  for (const auto& t : triangles) {
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    for (const int n : t) areas[n] += norm(cross(b - a, c - a)) / 6;
  }
  return areas;
}

Conditions::Conditions(const PatchSystem& system)
    : system_(system),
      parent_(system.size()),
      fixed_(system.size(), false),
      value_(Eigen::VectorXd::Zero(system.size())) {
  CLEFT_CHECK(system.owned(), ==, system.size());
  std::iota(parent_.begin(), parent_.end(), 0);
}

int Conditions::group(int unknown) const {
  while (parent_[unknown] != unknown) unknown = parent_[unknown] = parent_[parent_[unknown]];
  return unknown;
}

void Conditions::fix(int node, int axis, double value) {
  const int g = group(system_.unknown(node, axis));
  fixed_[g] = true, value_[g] = value;
}

void Conditions::tie(int node, int other, int axis) { tie(node, axis, other, axis); }

void Conditions::tie(int node, int axis, int other, int other_axis) {
  const int a = group(system_.unknown(node, axis)), b = group(system_.unknown(other, other_axis));
  if (a == b) return;
  CLEFT_CHECK(fixed_[a] || fixed_[b], ==, false);
  parent_[a] = b;
}

Eigen::VectorXd Conditions::solve(const Eigen::VectorXd& load) const {
  std::vector<int> place(parent_.size(), -1);  // of a group among the free ones
  int free = 0;
  for (int i = 0; i < system_.size(); ++i)
    if (group(i) == i && !fixed_[i]) place[i] = free++;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(free);
  for (int i = 0; i < system_.size(); ++i)
    if (const int p = place[group(i)]; p >= 0) right[p] += load[i];
  std::vector<Eigen::Triplet<double>> triplets;
  const PatchSystem::Entries entries = system_.lower_triangle();
  const auto add = [&](int row, int column, double k) {
    const int r = place[group(row)], c = place[group(column)];
    if (r >= 0 && c >= 0)
      triplets.emplace_back(r, c, k);
    else if (r >= 0)
      right[r] -= k * value_[group(column)];
  };
  for (std::size_t e = 0; e < entries.value.size(); ++e) {
    add(entries.row[e], entries.column[e], entries.value[e]);
    if (entries.row[e] != entries.column[e]) add(entries.column[e], entries.row[e], entries.value[e]);
  }
  Eigen::SparseMatrix<double> k(free, free);
  k.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::MetisOrdering<int>> factor(k);
  CLEFT_CHECK(static_cast<int>(factor.info()), ==, static_cast<int>(Eigen::Success));
  const Eigen::VectorXd solution = factor.solve(right);
  Eigen::VectorXd u(system_.size());
  for (int i = 0; i < system_.size(); ++i)
    u[i] = place[group(i)] >= 0 ? solution[place[group(i)]] : value_[group(i)];
  return u;
}

}  // namespace cleft
