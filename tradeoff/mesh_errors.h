// How far openings of a case are off in meshes of one kind of element, and what they cost: from cheap meshes.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/scratch_folder.h"
#include "encoder/field/field.h"
#include "tradeoff/chain.h"
#include "tradeoff/model_error.h"
#include "tradeoff/samples.h"
#include "tradeoff/setting.h"

namespace cleft {

/// Of the encoder: those that are tried, the loosest first.
constexpr double tolerances[] = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
constexpr double tightest_tolerance = tolerances[std::size(tolerances) - 1];

/// A case in a mesh with so many elements along the cut, in a patch with a margin over the cut's length.
Parameters coarse(const Parameters& parameters, ElementOrder elements, double count, double margin);

/// Of a mesh of so many nodes, from those of coarse ones.
double expected_seconds(const std::vector<ChainCost>& costs, double nodes);

class MeshErrors {
 public:
  /// Takes seconds. `margin`: of the patch, over the cut's length. `work`: a folder for intermediate files.
  MeshErrors(const Parameters& parameters, ElementOrder elements, double margin, const std::string& work,
             const std::function<void(const std::string&)>& progress);

  ElementOrder elements() const { return elements_; }
  double largest_opening() const { return largest_; }  ///< mm
  const Field& field() const { return *field_; }       ///< of the finest mesh and the tightest tolerance

  /// What the opening is off in elements of a size, mm: as the size, as the energy of a crack is; of
  /// quadratic elements as its power 1.5.
  Samples mesh(double size) const;
  /// What the first open node next to a front is off, mm: as the root of the size, as its opening. Meshes of
  /// one kind do not show it against each other, because it is the same part of that opening in all of them.
  double first_node(double size) const;
  /// Of the field against its own mesh, where the lips close. Of a measured size that is near, as large as it
  /// is at this size: straight in logarithms between them.
  Samples tip(double size) const;
  /// Processor seconds to solve and encode a mesh of so many nodes.
  double seconds(double nodes) const;

  /// What a looser tolerance of the encoder brings, in the finest mesh.
  struct Code {
    double error, bytes;  ///< error: mm beyond the mesh's
    std::array<int, 4> control_points;
  };
  /// Encodes when it is asked for a tolerance the first time, which takes seconds.
  const Code& code(double tolerance) const;

 private:
  Samples apart(const Field& field) const;  // from the finest mesh
  Code code_of(const Chain::Encoded& encoded) const;

  ElementOrder elements_;
  double first_opening_ = 0;       // of the first node next to the start, in the finest mesh, mm
  double largest_ = 0, size_ = 0;  // element size of the finest mesh
  Samples difference_;             // of it and one twice as coarse
  std::vector<std::pair<double, Samples>> tips_;  // by element size, coarsest first
  std::shared_ptr<const ScratchFolder> kept_;     // of the finest mesh's files
  std::optional<Chain> finest_;
  Samples finest_samples_;
  mutable std::map<double, Code> codes_;  // by tolerance
  std::vector<ChainCost> costs_;
  std::optional<Field> field_;
};

}  // namespace cleft
