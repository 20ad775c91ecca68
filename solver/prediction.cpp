#include "solver/prediction.h"

#include <map>
#include <numeric>

namespace cleft {

Prediction::Prediction(const PatchMesh& mesh, const PatchSystem& system, const Release& release)
    : mesh_(mesh), system_(system), release_(release), base_(mesh.points.size()), behind_(base_.size()) {
  std::iota(base_.begin(), base_.end(), 0);
  if (mesh.is_body()) return;                // it has no grid whose columns follow each other
  std::map<std::pair<int, int>, int> right;  // by incision and node of the grid
  for (const NodePair& pair : mesh.pairs) {  // a right node is the left one of later pairs only
    base_[pair.right] = base_[pair.left];
    right[{pair.incision, base_[pair.right]}] = pair.right;
  }
  const auto node_behind = [&](int node) { return node % mesh.grid[0] > 0 ? node - 1 : node; };
  for (std::size_t n = 0; n < base_.size(); ++n) behind_[n] = node_behind(base_[n]);
  for (const NodePair& pair : mesh.pairs)
    if (const auto found = right.find({pair.incision, behind_[pair.right]}); found != right.end())
      behind_[pair.right] = found->second;
}

int Prediction::column(int pair) const { return base_[mesh_.pairs[pair].left] % mesh_.grid[0]; }

bool Prediction::possible(int frame) const {
  if (frame < 2 || mesh_.is_body()) return false;
  const auto released = [&](int f) {  // the first pair that a frame releases
    return release_.order[release_.released[f - 1]];
  };
  const int now = released(frame), before = released(frame - 1);
  return mesh_.pairs[now].incision == mesh_.pairs[before].incision && column(now) == column(before) + 1;
}

Block Prediction::predict(const Block& before_last, const Block& last) const {
  const auto& offsets = system_.offsets();
  std::vector<int> counts;
  for (std::size_t r = 0; r + 1 < offsets.size(); ++r) counts.push_back(offsets[r + 1] - offsets[r]);
  const Block own = last - before_last;
  std::vector<double> change(static_cast<std::size_t>(system_.size()));
  MPI_Allgatherv(own.data(), system_.owned(), MPI_DOUBLE, change.data(), counts.data(), offsets.data(),
                 MPI_DOUBLE, system_.communicator());
  Block next = last;
  for (std::size_t n = 0; n < behind_.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      if (const int row = system_.row(system_.unknown(static_cast<int>(n), axis)); row >= 0)
        next(row) += change[system_.unknown(behind_[n], axis)];
  return next;
}

}  // namespace cleft
