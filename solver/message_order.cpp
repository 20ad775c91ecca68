#include "solver/message_order.h"

#include <mpi.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <list>
#include <vector>

namespace cleft {

namespace {

// Marks among the messages, beyond MUMPS's tags: the end of a round, and that of a sweep, after which its
// sender sends nothing before all have come to the next collective call.
constexpr int end_of_round = 32766, end_of_sweep = 32767;

struct Message {
  MPI_Status status;
  std::vector<char> bytes;
};

/// The state of one communicator.
class Rounds {
 public:
  explicit Rounds(MPI_Comm communicator) : communicator_(communicator) {
    int ranks = 0;
    MPI_Comm_size(communicator, &ranks);
    MPI_Comm_rank(communicator, &rank_);
    arrived_.resize(ranks);
    has_left_.resize(arrived_.size(), false);
  }

  MPI_Comm communicator() const { return communicator_; }

  /// Receives all that is there.
  void take_what_is_there() {
    for (int there = 1; there;) {
      MPI_Status status;
      PMPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, communicator_, &there, &status);
      if (there) take(status);
    }
  }

  /// The first message to deliver; rounds pass until there is one. None if no rank will send one.
  const Message* next() {
    while (handed_.empty() && !all_have_left()) {
      mark(end_of_round);
      await_round();
    }
    settled_ = false;
    return handed_.empty() ? nullptr : &handed_.front();
  }

  /// Between sweeps: what these have left unread.
  const Message* left_over() const { return settled_ && !handed_.empty() ? &handed_.front() : nullptr; }

  /// Returns when all ranks have come here.
  void end_sweep() {
    mark(end_of_sweep);
    while (!all_have_left()) await_round();
    has_left_.assign(has_left_.size(), false);
    settled_ = true;
  }

  bool is_empty() const {
    return handed_.empty() &&
           std::all_of(arrived_.begin(), arrived_.end(), [](const auto& queue) { return queue.empty(); });
  }

  /// Takes a message out of those received, if it is there.
  bool get(int source, int tag, Message& message) {
    if (get(handed_, source, tag, message)) return true;
    return std::any_of(arrived_.begin(), arrived_.end(),
                       [&](auto& queue) { return get(queue, source, tag, message); });
  }

 private:
  static bool is_mark(const Message& message) { return message.status.MPI_TAG >= end_of_round; }

  bool get(std::deque<Message>& queue, int source, int tag, Message& message) {
    const auto found = std::find_if(queue.begin(), queue.end(), [&](const Message& m) {
      return !is_mark(m) && (source == MPI_ANY_SOURCE || source == m.status.MPI_SOURCE) &&
             (tag == MPI_ANY_TAG || tag == m.status.MPI_TAG);
    });
    if (found == queue.end()) return false;
    message = std::move(*found);
    queue.erase(found);
    return true;
  }

  void take(MPI_Status status) {
    int count = 0;
    PMPI_Get_count(&status, MPI_BYTE, &count);
    Message message{status, std::vector<char>(static_cast<std::size_t>(count))};
    PMPI_Recv(message.bytes.data(), count, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, communicator_,
              &message.status);
    arrived_[status.MPI_SOURCE].push_back(std::move(message));
  }

  void mark(int tag) const {
    for (int to = 0; to < static_cast<int>(arrived_.size()); ++to)
      if (to != rank_) PMPI_Send(nullptr, 0, MPI_BYTE, to, tag, communicator_);
  }

  bool is_in_sweep(std::size_t source) const {
    return static_cast<int>(source) != rank_ && !has_left_[source];
  }
  bool all_have_left() const {
    for (std::size_t source = 0; source < arrived_.size(); ++source)
      if (is_in_sweep(source)) return false;
    return true;
  }

  /// Hands out what the others have sent in their round, when all have ended it.
  void await_round() {
    for (std::size_t source = 0; source < arrived_.size(); ++source) {
      if (!is_in_sweep(source)) continue;
      auto& queue = arrived_[source];
      while (std::none_of(queue.begin(), queue.end(), is_mark)) {
        MPI_Status status;
        PMPI_Probe(MPI_ANY_SOURCE, MPI_ANY_TAG, communicator_, &status);
        take(status);
      }
      for (; !is_mark(queue.front()); queue.pop_front()) handed_.push_back(std::move(queue.front()));
      has_left_[source] = queue.front().status.MPI_TAG == end_of_sweep;
      queue.pop_front();
    }
  }

  MPI_Comm communicator_;
  int rank_ = 0;
  std::vector<std::deque<Message>> arrived_;  // by source: messages and marks
  std::deque<Message> handed_;
  std::vector<bool> has_left_;  // by source: the sweep
  bool settled_ = false;
};

bool active = false;
std::list<Rounds> all_rounds;

Rounds& rounds_in(MPI_Comm communicator) {
  for (Rounds& one : all_rounds)
    if (one.communicator() == communicator) return one;
  return all_rounds.emplace_back(communicator);
}

/// MUMPS ends every sweep by a collective call, after which its communicator may be freed.
void end_sweep(MPI_Comm communicator) {
  rounds_in(communicator).end_sweep();
  all_rounds.remove_if([](const Rounds& one) { return one.is_empty(); });
}

void give(const MPI_Status& status, MPI_Fint* to) {
  if (to != MPI_F_STATUS_IGNORE) PMPI_Status_c2f(&status, to);
}

}  // namespace

MessageOrder::MessageOrder() { active = true; }
MessageOrder::~MessageOrder() {
  active = false;
  all_rounds.clear();
}

}  // namespace cleft

// MPI's calls as Fortran makes them, in the place of the library's own.
extern "C" {

void mpi_iprobe_(MPI_Fint* source, MPI_Fint* tag, MPI_Fint* communicator, MPI_Fint* there, MPI_Fint* status,
                 MPI_Fint* error) {
  using namespace cleft;
  const MPI_Comm comm = PMPI_Comm_f2c(*communicator);
  *error = MPI_SUCCESS;
  *there = 0;
  if (active) {
    Rounds& rounds = rounds_in(comm);
    rounds.take_what_is_there();
    if (const Message* message = rounds.left_over()) *there = 1, give(message->status, status);
    return;
  }
  int flag = 0;
  MPI_Status found;
  *error = PMPI_Iprobe(*source, *tag, comm, &flag, &found);
  *there = flag;
  if (flag) give(found, status);
}

void mpi_probe_(MPI_Fint* source, MPI_Fint* tag, MPI_Fint* communicator, MPI_Fint* status, MPI_Fint* error) {
  using namespace cleft;
  const MPI_Comm comm = PMPI_Comm_f2c(*communicator);
  *error = MPI_SUCCESS;
  if (active && *source == MPI_ANY_SOURCE && *tag == MPI_ANY_TAG)
    if (const Message* message = rounds_in(comm).next()) return give(message->status, status);
  MPI_Status found;
  *error = PMPI_Probe(*source, *tag, comm, &found);
  give(found, status);
}

void mpi_recv_(void* data, MPI_Fint* count, MPI_Fint* type, MPI_Fint* source, MPI_Fint* tag,
               MPI_Fint* communicator, MPI_Fint* status, MPI_Fint* error) {
  using namespace cleft;
  const MPI_Comm comm = PMPI_Comm_f2c(*communicator);
  *error = MPI_SUCCESS;
  if (Message message; active && rounds_in(comm).get(*source, *tag, message)) {
    if (!message.bytes.empty()) std::memcpy(data, message.bytes.data(), message.bytes.size());
    return give(message.status, status);
  }
  MPI_Status found;
  *error = PMPI_Recv(data, *count, PMPI_Type_f2c(*type), *source, *tag, comm, &found);
  give(found, status);
}

// Fortran's, not C's: theirs know Fortran's constants for types and operations.
void pmpi_allreduce_(void*, void*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*, MPI_Fint*);
void pmpi_barrier_(MPI_Fint*, MPI_Fint*);

void mpi_allreduce_(void* send, void* receive, MPI_Fint* count, MPI_Fint* type, MPI_Fint* operation,
                    MPI_Fint* communicator, MPI_Fint* error) {
  if (cleft::active) cleft::end_sweep(PMPI_Comm_f2c(*communicator));
  pmpi_allreduce_(send, receive, count, type, operation, communicator, error);
}

void mpi_barrier_(MPI_Fint* communicator, MPI_Fint* error) {
  if (cleft::active) cleft::end_sweep(PMPI_Comm_f2c(*communicator));
  pmpi_barrier_(communicator, error);
}
}
