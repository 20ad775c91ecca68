// Reproducible sums of MUMPS on several ranks.
#pragma once

namespace cleft {

/// MUMPS's elimination of right-hand sides adds what other ranks contribute to a node when their messages
/// arrive, before or after contributions of its own rank: sums differ in their last bits from run to run.
/// While an object of this class exists on all ranks, messages are delivered in rounds: a rank works until it
/// waits for a message; then it ends its round and announces this to all others. When all rounds have ended,
/// each rank receives the messages of that round in the order of the senders, and the next round begins. Each
/// rank therefore does the same work in the same order in every run with the same number of ranks. (MPI's
/// receiving calls, and the collective calls that end a sweep, are replaced through its profiling interface.
/// Messages are accepted from their senders at once, so that no sender waits longer.)
class MessageOrder {
 public:
  MessageOrder();
  ~MessageOrder();
  MessageOrder(const MessageOrder&) = delete;
  MessageOrder& operator=(const MessageOrder&) = delete;
};

}  // namespace cleft
