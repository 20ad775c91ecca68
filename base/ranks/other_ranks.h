// Work that several ranks share: the first one asks, and the others answer.
#pragma once

#include <functional>
#include <string>

#include "base/ranks/packed.h"

namespace cleft {

/// Reads a request and adds the answer.
using AnswerRequest = std::function<void(Unpacker& request, Packer& answer)>;

/// What all ranks but the first do as long as its OtherRanks live. What `answer` throws, the first one
/// throws.
void serve(const Ranks& ranks, const AnswerRequest& answer);

class OtherRanks {
 public:
  explicit OtherRanks(const Ranks& ranks) : ranks_(ranks) {}
  ~OtherRanks();
  OtherRanks(const OtherRanks&) = delete;
  OtherRanks& operator=(const OtherRanks&) = delete;

 private:
  const Ranks& ranks_;
};

/// Sends a request, unless it is empty, to all others, works here meanwhile, and takes their answers. What
/// fails is thrown when all have answered: what was thrown here, or else InputError or std::runtime_error
/// with the number of the process.
void on_all_ranks(const Ranks& ranks, const Bytes& request, const std::function<void()>& here,
                  const std::function<void(int rank, Unpacker& answer)>& take);

/// Waits for the answer to what was sent to one of them. Throws what failed there, as on_all_ranks does.
Unpacker answer_of(const Ranks& ranks, int rank);

/// "one of the 3 processes encodes, and the others wait": for warnings.
std::string one_works(const Ranks& ranks, const std::string& does);

}  // namespace cleft
