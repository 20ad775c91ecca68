#include "base/ranks/ranks.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/ranks/launcher.h"

namespace cleft {

namespace {

constexpr std::size_t at_once = std::size_t{1} << 30;  // bytes: MPI counts with an int
enum Tag { size_tag, bytes_tag };

/// MPI's own waiting would take a processor from the threads of the process that works.
void wait_for(int from, int tag) {
  using namespace std::chrono_literals;
  std::chrono::microseconds pause = 20us;
  for (int there = 0;;) {
    MPI_Iprobe(from, tag, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
    if (there) return;
    std::this_thread::sleep_for(pause);
    pause = std::min<std::chrono::microseconds>(2 * pause, 5ms);
  }
}

}  // namespace

Ranks::Ranks(int& argc, char**& argv) {
  started_ = started_together();
  if (started_ == 1) return;
  end_with_launcher();
  MPI_Init(&argc, &argv);
  begun_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

void Ranks::check() const {
  if (started_ == 1 || count_ > 1) return;
  throw InputError(std::to_string(started_) +
                   " processes were started together, but each of them finds itself alone, and all would "
                   "write the same file; start them with mpirun, or with srun --mpi=pmix");
}

Ranks::~Ranks() {
  if (begun_) MPI_Finalize();
}

void Ranks::send(int to, std::span<const std::byte> message) const {
  const std::uint64_t size = message.size();
  MPI_Send(&size, 1, MPI_UINT64_T, to, size_tag, MPI_COMM_WORLD);
  for (std::size_t sent = 0; sent < message.size(); sent += at_once) {
    const auto part = message.subspan(sent, std::min(at_once, message.size() - sent));
    MPI_Send(part.data(), static_cast<int>(part.size()), MPI_BYTE, to, bytes_tag, MPI_COMM_WORLD);
  }
}

Bytes Ranks::receive(int from) const {
  wait_for(from, size_tag);
  std::uint64_t size = 0;
  MPI_Recv(&size, 1, MPI_UINT64_T, from, size_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  Bytes message(size);
  for (std::size_t got = 0; got < size; got += at_once)
    MPI_Recv(message.data() + got, static_cast<int>(std::min(at_once, size - got)), MPI_BYTE, from, bytes_tag,
             MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return message;
}

}  // namespace cleft
