// The same sums of MUMPS's in every run on several ranks.
#pragma once

namespace cleft {

/// MUMPS's elimination of right-hand sides adds what other ranks contribute to a node when their messages
/// arrive, before or after contributions of its own rank: sums differ in their last bits from run to run.
/// While one of these lives, on all ranks, messages come in rounds: a rank works until it has nothing else to
/// do and waits for a message; then its round ends, and it says so to all others. When all have, a rank is
/// handed what they sent it in that round, in the order of the senders, and the next round begins. So each
/// does the same things in the same order in every run, on any fixed number of ranks. (MPI's calls that
/// receive, and the collective ones that end a sweep, are taken over for that, as its profiling interface
/// provides. Messages are taken from who sends them at once, so that nobody waits longer for it.)
class MessageOrder {
 public:
  MessageOrder();
  ~MessageOrder();
  MessageOrder(const MessageOrder&) = delete;
  MessageOrder& operator=(const MessageOrder&) = delete;
};

}  // namespace cleft
