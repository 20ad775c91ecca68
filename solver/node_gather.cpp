#include "solver/node_gather.h"

namespace cleft {

std::vector<Vec3> gather_nodes(const PatchSystem& system, const PatchMesh& mesh, const double* column) {
  const auto& offsets = system.offsets();
  std::vector<int> counts;
  for (std::size_t r = 0; r + 1 < offsets.size(); ++r) counts.push_back(offsets[r + 1] - offsets[r]);
  const bool root = system.rank() == 0;
  std::vector<double> values(root ? static_cast<std::size_t>(system.size()) : 0);
  MPI_Gatherv(column, system.owned(), MPI_DOUBLE, values.data(), counts.data(), offsets.data(), MPI_DOUBLE, 0,
              system.communicator());
  std::vector<Vec3> displacement(root ? mesh.points.size() : 0);
  for (std::size_t n = 0; n < displacement.size(); ++n)
    for (int axis = 0; axis < 3; ++axis)
      displacement[n][axis] = values[system.unknown(static_cast<int>(n), axis)];
  if (root) fill_faces(mesh, displacement);
  return displacement;
}

}  // namespace cleft
