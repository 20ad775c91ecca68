// The same sums of MUMPS's in every run on two ranks.
#pragma once

namespace cleft {

/// MUMPS's elimination of right-hand sides adds what the other rank contributes to a node when its message
/// arrives, before or after contributions of its own rank: sums differ in their last bits from run to run.
/// While one of these lives, MUMPS is told of no message before it has nothing else to do and waits for one.
/// Of two ranks each then does the same things in the same order in every run, since there is one other rank,
/// whose messages keep their order. (MPI's receiving calls are taken over for that, as its profiling
/// interface provides. Messages are taken from who sends them at once, so that nobody waits longer for it.)
///
/// Of more ranks, which of the others' messages comes first remains open, and so do the last bits.
class MessageOrder {
 public:
  MessageOrder();
  ~MessageOrder();
  MessageOrder(const MessageOrder&) = delete;
  MessageOrder& operator=(const MessageOrder&) = delete;
};

}  // namespace cleft
