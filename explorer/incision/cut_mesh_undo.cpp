// What a CutMesh remembers of its changes, and going back.
#include <algorithm>
#include <type_traits>

#include "explorer/incision/cut_mesh.h"

namespace cleft {

CutMesh::Checkpoint CutMesh::checkpoint() const {
  return {triangles_.size(),    vertices_.size(),   sheets_.size(),
          triangle_log_.size(), vertex_log_.size(), sheet_log_.size()};
}

std::vector<int> CutMesh::changed_since(const Checkpoint& checkpoint) const {
  std::vector<int> changed;
  for (std::size_t i = checkpoint.triangle_log; i < triangle_log_.size(); ++i)
    if (triangle_log_[i].first < static_cast<int>(checkpoint.triangles))
      changed.push_back(triangle_log_[i].first);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (std::size_t t = checkpoint.triangles; t < triangles_.size(); ++t)
    changed.push_back(static_cast<int>(t));
  return changed;
}

int CutMesh::euler_change_since(const Checkpoint& checkpoint) const {
  // Two triangles to each edge but those of the boundary: E = (3 F + B) / 2.
  const auto free_edges = [](const Triangle& t) {
    return static_cast<int>(std::count(t.neighbor.begin(), t.neighbor.end(), boundary));
  };
  int free = 0;
  std::vector<int> seen;  // only a triangle's oldest value counts
  for (std::size_t i = checkpoint.triangle_log; i < triangle_log_.size(); ++i) {
    const auto& [t, old] = triangle_log_[i];
    if (t >= static_cast<int>(checkpoint.triangles)) continue;
    if (std::find(seen.begin(), seen.end(), t) != seen.end()) continue;
    seen.push_back(t);
    free += free_edges(triangles_[t]) - free_edges(old);
  }
  for (std::size_t t = checkpoint.triangles; t < triangles_.size(); ++t) free += free_edges(triangles_[t]);
  const int faces = static_cast<int>(triangles_.size() - checkpoint.triangles);
  const int vertices = static_cast<int>(vertices_.size() - checkpoint.vertices);
  return vertices - (3 * faces + free) / 2 + faces;
}

template <class T>
void CutMesh::undo(std::vector<T>& items, std::vector<std::pair<int, T>>& log, std::size_t count,
                   std::size_t entries, std::vector<T>* taken, std::vector<std::pair<int, T>>* taken_log) {
  for (; log.size() > entries; log.pop_back()) {
    auto& [i, old] = log.back();
    std::swap(items[i], old);
    if constexpr (std::is_same_v<T, Triangle>) note(i);
    if (taken_log) taken_log->push_back(log.back());
  }
  if constexpr (std::is_same_v<T, Triangle>)
    for (std::size_t i = count; i < items.size(); ++i) note(static_cast<int>(i));
  if (taken) taken->assign(items.begin() + static_cast<std::ptrdiff_t>(count), items.end());
  items.resize(count);
}

void CutMesh::roll_back(const Checkpoint& to) {
  undo<Triangle>(triangles_, triangle_log_, to.triangles, to.triangle_log, nullptr, nullptr);
  undo<Vertex>(vertices_, vertex_log_, to.vertices, to.vertex_log, nullptr, nullptr);
  undo<Sheet>(sheets_, sheet_log_, to.sheets, to.sheet_log, nullptr, nullptr);
}

CutMesh::Undone CutMesh::undo(const Checkpoint& to) {
  Undone undone;
  undo<Triangle>(triangles_, triangle_log_, to.triangles, to.triangle_log, &undone.triangles,
                 &undone.triangle_log);
  undo<Vertex>(vertices_, vertex_log_, to.vertices, to.vertex_log, &undone.vertices, &undone.vertex_log);
  undo<Sheet>(sheets_, sheet_log_, to.sheets, to.sheet_log, &undone.sheets, &undone.sheet_log);
  return undone;
}

void CutMesh::redo(const Undone& undone) {
  const auto again = [this](auto& items, auto& log, const auto& taken, const auto& taken_log) {
    items.insert(items.end(), taken.begin(), taken.end());
    for (auto entry = taken_log.rbegin(); entry != taken_log.rend(); ++entry) {
      log.push_back({entry->first, items[entry->first]});
      items[entry->first] = entry->second;
    }
  };
  const auto first = static_cast<int>(triangles_.size());
  again(triangles_, triangle_log_, undone.triangles, undone.triangle_log);
  again(vertices_, vertex_log_, undone.vertices, undone.vertex_log);
  again(sheets_, sheet_log_, undone.sheets, undone.sheet_log);
  for (int t = first; t < static_cast<int>(triangles_.size()); ++t) note(t);
  for (const auto& [t, value] : undone.triangle_log) note(t);
}

}  // namespace cleft
