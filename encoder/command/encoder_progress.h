// How far cleft encode is.
#pragma once

#include <string>

#include "base/command/command.h"

namespace cleft {

/// Tells how far the encoder is, which names its steps.
class EncoderProgress {
 public:
  EncoderProgress(Progress& progress, std::size_t files) : progress_(progress), files_(files) {}
  void begin_file(std::size_t file) { file_ = file, piece_ = 0, part_ = 0; }
  /// The pieces of the body, and further quantities of each.
  void expect(std::size_t pieces, std::size_t quantities) { pieces_ = pieces, quantities_ = quantities; }
  void begin_piece(std::size_t piece) { piece_ = piece, quantity_ = 0; }

  void operator()(const std::string& state);

 private:
  void tell(const std::string& state, double part);

  Progress& progress_;
  std::size_t files_, file_ = 0, pieces_ = 1, quantities_ = 0, piece_ = 0, quantity_ = 0;
  double part_ = 0;
};

}  // namespace cleft
