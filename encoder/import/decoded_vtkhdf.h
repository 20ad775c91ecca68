// A decoded series as one VTKHDF file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/h5/h5.h"
#include "encoder/import/source_mesh.h"

namespace cleft {

/// A temporal VTKHDF 2.0 UnstructuredGrid: the mesh once, and of each frame the values at its nodes as 64-bit
/// floats, uncompressed.
class DecodedVtkHdf {
 public:
  DecodedVtkHdf(const std::string& path, const SourceMesh& mesh, const std::vector<double>& times);
  /// `numbers`: nodes times the components, node by node. Frames are written in order.
  /// `unit`: "" where it is not known, else an attribute of the array.
  void write(std::size_t frame, const std::string& name, int components, std::span<const double> numbers,
             const std::string& unit);
  void close() { file_.close(); }

 private:
  h5::File file_;
  std::size_t nodes_, frames_;
};

}  // namespace cleft
