#include "encoder/command/encoder_progress.h"

#include <algorithm>
#include <map>

namespace cleft {

void EncoderProgress::operator()(const std::string& state) {
  // Where the steps of a displacement begin, of its time on the default case; a quantity takes a third of
  // it.
  static const std::map<std::string, double> begins{{"reading", 0},
                                                    {"trying knots", 0.05},
                                                    {"fitting all frames", 0.18},
                                                    {"choosing the coefficients' steps", 0.9},
                                                    {"measuring", 0.91},
                                                    {"coding what the spline leaves", 0.93}};
  if (state == "writing") return tell(state, 0.97);
  const double whole = 1 + static_cast<double>(quantities_) / 3;
  if (const auto found = begins.find(state); found != begins.end() && quantity_ == 0)
    part_ = found->second / whole;
  else if (state.starts_with("fitting ") && state != "fitting derivatives")
    part_ = (1 + static_cast<double>(quantity_++) / 3) / whole;
  const std::string of =
      pieces_ > 1 ? "piece " + std::to_string(piece_ + 1) + " of " + std::to_string(pieces_) + ": " : "";
  tell(of + state, 0.97 * (static_cast<double>(piece_) + std::min(part_, 1.)) / static_cast<double>(pieces_));
}

void EncoderProgress::tell(const std::string& state, double part) {
  const std::string of =
      files_ > 1 ? "snapshot " + std::to_string(file_ + 1) + " of " + std::to_string(files_) + ": " : "";
  progress_(of + state, (static_cast<double>(file_) + part) / static_cast<double>(files_));
}

}  // namespace cleft
