#include "base/ranks/other_ranks.h"

#include <exception>
#include <stdexcept>

#include "base/error.h"
#include "base/message.h"

namespace cleft {

namespace {

enum class Answer : int { done, mistake, failure };

Packer told(Answer kind, const std::string& what) {
  Packer answer;
  answer.add(kind), answer.add(what);
  return answer;
}

}  // namespace

Unpacker answer_of(const Ranks& ranks, int rank) {
  Unpacker answer(ranks.receive(rank));
  const auto kind = answer.take<Answer>();
  if (kind == Answer::done) return answer;
  const std::string what = "process " + std::to_string(rank) + ": " + answer.take_text();
  if (kind == Answer::mistake) throw InputError(what);
  throw std::runtime_error(what);
}

void on_all_ranks(const Ranks& ranks, const Bytes& request, const std::function<void()>& here,
                  const std::function<void(int, Unpacker&)>& take) {
  for (int rank = 1; rank < ranks.count() && !request.empty(); ++rank) ranks.send(rank, request);
  std::exception_ptr failure;
  const auto attempt = [&](const auto& work) {
    try {
      work();
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  };
  attempt(here);
  for (int rank = 1; rank < ranks.count(); ++rank)
    attempt([&] {
      Unpacker answer = answer_of(ranks, rank);
      take(rank, answer);
    });
  if (failure) std::rethrow_exception(failure);
}

void serve(const Ranks& ranks, const AnswerRequest& answer_request) {
  for (;;) {
    Bytes bytes = ranks.receive(0);
    if (bytes.empty()) return;
    Unpacker request(std::move(bytes));
    Packer answer;
    answer.add(Answer::done);
    try {
      answer_request(request, answer);
    } catch (const std::exception& error) {
      answer = told(is_users_mistake(error) ? Answer::mistake : Answer::failure, message_of(error));
    }
    ranks.send(0, answer.bytes());
  }
}

std::string one_works(const Ranks& ranks, const std::string& does) {
  return "one of the " + std::to_string(ranks.count()) + " processes " + does + ", and the others wait";
}

OtherRanks::~OtherRanks() {
  for (int rank = 1; rank < ranks_.count(); ++rank) ranks_.send(rank, {});
}

}  // namespace cleft
