// Stiffness K and load f of the open patch: every duplicated node free, no constraints.
#pragma once

#include <mpi.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "params/parameters/parameters.h"
#include "solver/patch_mesh.h"

class Epetra_CrsMatrix;

namespace cleft {

class PatchElements;

/// Vectors of unknowns, one in each column: the rows that this rank owns.
using Block = Eigen::MatrixXd;

enum class WedgeRule {
  full,  ///< three points in the triangle by two along the axis: exact for wedges with parallel faces
  centroid_by_two,  ///< one by two, as CalculiX integrates its C3D6, for comparison with it
};

/// The library that divides the elements among the ranks.
enum class Partitioner { metis, zorder, zoltan };

/// Whether a system keeps its elements, for reassemble().
enum class KeepElements { no, yes };

struct Discretization {
  WedgeRule rule = WedgeRule::full;
  Partitioner partitioner = Partitioner::metis;
};

/// A matrix times a block; all rows distributed alike. Collective.
Block multiply(const Epetra_CrsMatrix& matrix, const Block& block);

/// Assembled in parallel; the mesh's elements, K and all blocks are distributed over the ranks of a
/// communicator, and all calls except accessors are collective. Unknowns are numbered by deal.II, those of a
/// rank contiguously.
class PatchSystem {
 public:
  /// Keeps a reference to the mesh.
  PatchSystem(const PatchMesh& mesh, const Parameters& parameters, MPI_Comm communicator,
              const Discretization& discretization = {}, KeepElements keep = KeepElements::no);
  ~PatchSystem();
  /// K and loads for other moduli, springs and tensions (of one pattern_key()), with elements that were kept.
  void reassemble(const Parameters& parameters);

  MPI_Comm communicator() const;
  int rank() const;
  int size() const;   ///< number of unknowns, three for each node
  int first() const;  ///< this rank owns the unknowns first() .. first() + owned() - 1
  int owned() const;  ///<
  /// Row of an unknown in this rank's blocks; -1 if another rank owns it.
  int row(int unknown) const {
    const int local = unknown - first();
    return local >= 0 && local < owned() ? local : -1;
  }
  int unknown(int node, int axis) const;    ///< of any node, known on every rank
  const std::vector<int>& offsets() const;  ///< first() of every rank, then size()

  /// The loads of the unit prestresses (1 MPa) uu, vv, uv: three columns, N. With skin.edges = "held" these
  /// are the forces that the cut releases: on the copies of a node they add up to 0, and to all other nodes
  /// none is applied, because the closed patch is in equilibrium.
  const Block& unit_loads() const;
  /// The load f of a case: its prestress times the unit loads, N.
  Block load(const Parameters::Skin& prestress) const;

  const Epetra_CrsMatrix& stiffness() const;
  Block multiply(const Block& block) const;  ///< K block

  /// Lower triangle of this rank's rows of K, 0-based.
  struct Entries {
    std::vector<int> row, column;
    std::vector<double> value;
  };
  Entries lower_triangle() const;
  static Entries lower_triangle(const Epetra_CrsMatrix& matrix);  ///< of another matrix of these unknowns

  /// The elements once more, divided among the ranks as they were, with the same numbers of the unknowns.
  std::unique_ptr<PatchElements> elements(const Parameters& parameters) const;

  /// Positions of the owned unknowns: the node's coordinates, mm, and the axis, as owned() rows (u, v, w,
  /// axis).
  Eigen::MatrixX4d places() const;

  /// dK/dp block - df/dp for a parameter of skin, tissue or foundation, by differences of fourth order of the
  /// assembled system: exact up to rounding if K is linear in p.
  class Derivative;
  std::unique_ptr<Derivative> derivative(const Parameters& parameters, const std::string& name) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Values of a parameter around that of a case, and the weights with which a function's values there add up
/// to its derivative: differences of fourth order.
std::vector<std::pair<double, double>> differences_by(const Parameters& parameters, const std::string& name);

class PatchSystem::Derivative {
 public:
  virtual ~Derivative() = default;
  virtual Block multiply(const Block& block) const = 0;  ///< dK/dp block
  virtual Block load() const = 0;                        ///< df/dp, a column
};

}  // namespace cleft
