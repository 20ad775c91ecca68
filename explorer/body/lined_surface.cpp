#include "explorer/body/lined_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/error.h"
#include "explorer/body/edge_distances.h"
#include "explorer/incision/cut_surface.h"

namespace cleft {

namespace {

using Edge = std::pair<int, int>;

/// The skin of a cut mesh with its lips joined.
class Joining {
 public:
  explicit Joining(const CutMesh& mesh) : mesh_(mesh), point_of_(mesh.vertices().size(), -1) {}

  LinedSurface join(std::size_t cuts) {
    LinedSurface result;
    result.cuts.resize(cuts);
    for (int t = 0; t < static_cast<int>(mesh_.triangles().size()); ++t) {
      if (!mesh_.is_skin(t)) continue;
      const CutMesh::Triangle& triangle = mesh_.triangle(t);
      std::array<int, 3> corners;
      for (int i = 0; i < 3; ++i) corners[i] = point(triangle.vertex[i], result);
      result.mesh.triangles.push_back(corners);
      for (int i = 0; i < 3; ++i) {
        const int beyond = triangle.neighbor[i], next = (i + 1) % 3;
        if (beyond == CutMesh::boundary) result.outline[corners[i]] = result.outline[corners[next]] = true;
        if (!mesh_.is_wall(beyond) || mesh_.triangle(beyond).region != Region::left_wall) continue;
        const CutMesh::Triangle& wall = mesh_.triangle(beyond);
        CutLine line{corners[i], corners[next], mesh_.wall_s(beyond, wall.corner(triangle.vertex[i])),
                     mesh_.wall_s(beyond, wall.corner(triangle.vertex[next]))};
        if (line.s_from > line.s_to) std::swap(line.from, line.to), std::swap(line.s_from, line.s_to);
        result.cuts[mesh_.sheets()[wall.sheet].cut].push_back(line);
      }
    }
    for (auto& lines : result.cuts)
      std::sort(lines.begin(), lines.end(),
                [](const CutLine& a, const CutLine& b) { return a.s_from < b.s_from; });
    return result;
  }

 private:
  /// Vertices of cuts at one place are one point.
  int point(int vertex, LinedSurface& result) {
    int& known = point_of_[vertex];
    if (known >= 0) return known;
    const CutMesh::Vertex& v = mesh_.vertex(vertex);
    const int next = static_cast<int>(result.mesh.points.size());
    known = v.cut < 0 ? next
                      : at_place_.try_emplace({v.position.x, v.position.y, v.position.z}, next).first->second;
    if (known == next) result.mesh.points.push_back(v.position), result.outline.push_back(false);
    return known;
  }

  const CutMesh& mesh_;
  std::vector<int> point_of_;  // by vertex
  std::map<std::array<double, 3>, int> at_place_;
};

/// Along edges from the points of all cuts.
std::vector<double> distances(const LinedSurface& surface) {
  std::vector<int> from;
  for (const auto& lines : surface.cuts)
    for (const CutLine& line : lines) from.insert(from.end(), {line.from, line.to});
  return edge_distances(surface.mesh.points, surface.mesh.triangles, from);
}

/// A point in the middle of something on an edge: all triangles and lines of the edge are divided.
class EdgeDivision {
 public:
  explicit EdgeDivision(LinedSurface& surface) : surface_(surface) {
    for (int t = 0; t < static_cast<int>(surface.mesh.triangles.size()); ++t) note(t);
  }

  int divide(int a, int b, double part) {
    SurfaceMesh& mesh = surface_.mesh;
    const int middle = static_cast<int>(mesh.points.size());
    mesh.points.push_back(lerp(mesh.points[a], mesh.points[b], part));
    surface_.outline.push_back(surface_.outline[a] && surface_.outline[b] &&
                               triangles_[key(a, b)].size() == 1);
    for (const int t : std::vector<int>(triangles_[key(a, b)])) {
      const auto old = mesh.triangles[t];
      forget(t);
      auto first = old, second = old;
      std::replace(first.begin(), first.end(), b, middle);
      std::replace(second.begin(), second.end(), a, middle);
      mesh.triangles[t] = first;
      mesh.triangles.push_back(second);
      note(t), note(static_cast<int>(mesh.triangles.size()) - 1);
    }
    return middle;
  }

 private:
  static Edge key(int a, int b) { return std::minmax(a, b); }
  void note(int t) {
    const auto& c = surface_.mesh.triangles[t];
    for (int i = 0; i < 3; ++i) triangles_[key(c[i], c[(i + 1) % 3])].push_back(t);
  }
  void forget(int t) {
    const auto& c = surface_.mesh.triangles[t];
    for (int i = 0; i < 3; ++i) std::erase(triangles_[key(c[i], c[(i + 1) % 3])], t);
  }

  LinedSurface& surface_;
  std::map<Edge, std::vector<int>> triangles_;
};

}  // namespace

LinedSurface lined_surface(const SurfaceMesh& mesh, const std::vector<ScalpelPath>& paths, double reach) {
  CutMesh cut(mesh);
  for (std::size_t k = 0; k < paths.size(); ++k) try {
      IncisionOptions options;
      options.max_edge = 0, options.reach = 0;
      Incision incision(cut, paths[k], options);
      incision.advance_to(paths[k].length());
    } catch (const InputError& e) {
      throw InputError("cut " + std::to_string(k + 1) + ": " + e.what());
    }
  const LinedSurface all = Joining(cut).join(paths.size());
  const std::vector<double> distance = distances(all);
  std::vector<bool> beyond;
  for (const auto& t : all.mesh.triangles)
    beyond.push_back(std::min({distance[t[0]], distance[t[1]], distance[t[2]]}) > reach);
  return without(all, beyond);
}

LinedSurface without(const LinedSurface& all, const std::vector<bool>& taken_out) {
  LinedSurface part;
  std::vector<int> number(all.mesh.points.size(), -1);
  for (std::size_t n = 0; n < all.mesh.triangles.size(); ++n) {
    if (taken_out[n]) continue;
    std::array<int, 3> corners;
    for (int i = 0; i < 3; ++i) {
      const int p = all.mesh.triangles[n][i];
      int& known = number[p];
      if (known < 0) {
        known = static_cast<int>(part.mesh.points.size());
        part.mesh.points.push_back(all.mesh.points[p]), part.outline.push_back(all.outline[p]);
      }
      corners[i] = known;
    }
    part.mesh.triangles.push_back(corners);
  }
  for (const auto& lines : all.cuts) {
    part.cuts.emplace_back();
    for (const CutLine& line : lines)
      part.cuts.back().push_back({number[line.from], number[line.to], line.s_from, line.s_to});
  }
  return part;
}

std::vector<bool> place_stations(LinedSurface& surface, double size) {
  std::map<int, int> degree;  // by point: edges of cuts
  for (const auto& lines : surface.cuts)
    for (const CutLine& line : lines) ++degree[line.from], ++degree[line.to];
  EdgeDivision division(surface);
  std::vector<bool> station(surface.mesh.points.size(), false);
  for (auto& lines : surface.cuts) {
    std::vector<CutLine> divided;
    for (std::size_t first = 0; first < lines.size();) {
      // A stretch ends at a crossing, at the cut's end, and where the cut is interrupted.
      std::size_t end = first + 1;
      while (end < lines.size() && lines[end].from == lines[end - 1].to && degree[lines[end].from] == 2 &&
             lines[end].from != lines[first].from)
        ++end;
      double length = 0;
      std::vector<double> lengths;
      for (std::size_t i = first; i < end; ++i)
        lengths.push_back(norm(surface.mesh.points[lines[i].to] - surface.mesh.points[lines[i].from])),
            length += lengths.back();
      const int parts = std::max(1, static_cast<int>(std::ceil(length / size - 1e-6)));
      station.resize(surface.mesh.points.size(), false);
      station[lines[first].from] = station[lines[end - 1].to] = true;
      double passed = 0;
      int next = 1;
      for (std::size_t i = first; i < end; ++i) {
        CutLine rest = lines[i];
        double left = lengths[i - first];
        const double least = 1e-3 * length / parts;  // a point nearer than that is the station
        for (; next < parts && next * length / parts < passed + left + least; ++next) {
          const double to_go = next * length / parts - passed;
          int point = -1;
          if (to_go < least) {
            point = rest.from;
          } else if (to_go > left - least) {
            if (i + 1 < end || to_go < left + least) point = rest.to;
          } else {
            point = division.divide(rest.from, rest.to, to_go / left);
            const double s = std::lerp(rest.s_from, rest.s_to, to_go / left);
            divided.push_back({rest.from, point, rest.s_from, s});
            rest = {point, rest.to, s, rest.s_to};
            passed += to_go, left -= to_go;
          }
          station.resize(surface.mesh.points.size(), false);
          if (point >= 0) station[point] = true;
        }
        divided.push_back(rest);
        passed += left;
      }
      first = end;
    }
    lines = std::move(divided);
  }
  station.resize(surface.mesh.points.size(), false);
  return station;
}

}  // namespace cleft
