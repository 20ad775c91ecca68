#include "encoder/command/spread_nodes.h"

#include <filesystem>
#include <map>

#include "base/ranks/other_ranks.h"
#include "encoder/command/packed_field.h"

namespace cleft {

namespace {

enum class Request : int { keep, errors, code, forget };

/// Those of a part, which are taken.
void add(Packer& message, const NodesInFile& nodes) {
  message.add(nodes.file), message.add(nodes.points);
  message.add(nodes.taken->nodes), message.add(nodes.taken->axes), message.add(nodes.axes);
  message.add(nodes.quantities.size());
  for (const SnapshotArray& one : nodes.quantities)
    message.add(one.name), message.add(one.components), message.add(one.varies);
}

NodesInFile take_nodes(Unpacker& message) {
  NodesInFile nodes;
  nodes.file = message.take_text(), nodes.points = message.take<std::size_t>();
  nodes.taken.emplace();
  nodes.taken->nodes = message.take_list<std::int32_t>(), nodes.taken->axes = message.take<AxesInSpace>();
  nodes.axes = message.take_list<AxesInSpace>();
  nodes.quantities.resize(message.take<std::size_t>());
  for (SnapshotArray& one : nodes.quantities)
    one.name = message.take_text(), one.components = message.take<std::size_t>(),
    one.varies = message.take<bool>();
  return nodes;
}

void add(Packer& message, const NodeSpline& spline) {
  message.add(spline.field), message.add(spline.components), message.add(spline.parts.size());
  for (const Field& part : spline.parts) add(message, part);
}

NodeSpline take_spline(Unpacker& message) {
  NodeSpline spline{message.take<int>(), message.take<int>(), {}};
  for (std::size_t part = message.take<std::size_t>(); part > 0; --part)
    spline.parts.push_back(take_field(message));
  return spline;
}

void add_kind(Packer& message, const CodedResidual& kind) {
  message.add(kind.quantum), message.add(kind.nodes), message.add(kind.frames);
  message.add(kind.components), message.add(kind.first_frame), message.add(kind.block);
}

CodedResidual take_kind(Unpacker& message) {
  CodedResidual kind;
  kind.quantum = message.take<double>(), kind.nodes = message.take<int>(), kind.frames = message.take<int>();
  kind.components = message.take<int>(), kind.first_frame = message.take<int>();
  kind.block = message.take<int>();
  return kind;
}

void add(Packer& message, const std::vector<CodedBlock>& blocks) {
  message.add(blocks.size());
  for (const CodedBlock& block : blocks) message.add(block.bytes), message.add(block.largest);
}

std::vector<CodedBlock> take_blocks(Unpacker& message) {
  std::vector<CodedBlock> blocks(message.take<std::size_t>());
  for (CodedBlock& block : blocks)
    block.bytes = message.take_list<std::uint8_t>(), block.largest = message.take<double>();
  return blocks;
}

/// A range of a series' nodes, in a process that serves.
class KeptNodes {
 public:
  explicit KeptNodes(Unpacker& message)
      : samples_(message.take_list<Sample>()),
        times_(message.take_list<double>()),
        block_(message.take<std::size_t>()),
        work_(samples_, times_, block_, reading(std::make_shared<NodeValues>(take_nodes(message)))) {}

  const NodeWork& work() const { return work_; }

 private:
  std::vector<Sample> samples_;
  std::vector<double> times_;
  std::size_t block_;
  NodeWorkHere work_;
};

/// What it answers to the requests of the first rank.
class Server {
 public:
  void answer(Unpacker& message, Packer& answer) {
    const auto request = message.take<Request>();
    const int number = message.take<int>();
    if (request == Request::keep) {
      kept_.emplace(number, std::make_unique<KeptNodes>(message));
    } else if (request == Request::forget) {
      kept_.erase(number);
    } else {
      const NodeWork& work = kept_.at(number)->work();
      const NodeSpline spline = take_spline(message);
      if (request == Request::errors)
        answer.add(work.errors(spline));
      else
        add(answer, work.code(spline, take_kind(message)));
    }
  }

 private:
  std::map<int, std::unique_ptr<KeptNodes>> kept_;
};

Packer request_of(Request request, int number) {
  Packer message;
  message.add(request), message.add(number);
  return message;
}

}  // namespace

NodeWorkHere::Read reading(std::shared_ptr<const NodeValues> values) {
  return [values = std::move(values)](int field, std::size_t frame, std::size_t first, std::size_t count) {
    return Eigen::MatrixXd(values->values(field, frame, first, count));
  };
}

SpreadNodes::SpreadNodes(const Ranks& ranks, std::shared_ptr<const NodeValues> values,
                         std::span<const Sample> nodes, std::span<const double> times, std::size_t block)
    : ranks_(ranks),
      block_(block),
      blocks_((nodes.size() - 1) / block + 1),
      frames_(times.size()),
      times_(times.begin(), times.end()) {
  static int series = 0;
  number_ = series++;
  const auto first_of = [&](int rank) { return std::min(first_block(rank) * block, nodes.size()); };
  for (int rank = 1; rank < ranks.count(); ++rank) {
    const std::size_t first = first_of(rank), count = first_of(rank + 1) - first;
    Packer message = request_of(Request::keep, number_);
    message.add(nodes.subspan(first, count)), message.add(times_), message.add(block);
    NodesInFile part = values->nodes().part(first, count);
    part.file = std::filesystem::absolute(part.file);
    add(message, part);
    ranks.send(rank, message.bytes());
  }
  here_ = std::make_unique<NodeWorkHere>(nodes.subspan(0, first_of(1)), times_, block,
                                         reading(std::move(values)));
  on_all_ranks(
      ranks, {}, [] {}, [](int, Unpacker&) {});
}

SpreadNodes::~SpreadNodes() {
  for (int rank = 1; rank < ranks_.count(); ++rank) {
    ranks_.send(rank, request_of(Request::forget, number_).bytes());
    ranks_.receive(rank);
  }
}

std::size_t SpreadNodes::first_block(int rank) const {
  return blocks_ * static_cast<std::size_t>(rank) / static_cast<std::size_t>(ranks_.count());
}

std::vector<NodeErrors> SpreadNodes::errors(const NodeSpline& spline) const {
  std::vector<NodeErrors> all(frames_ * blocks_);
  const auto put = [&](int rank, const std::vector<NodeErrors>& some) {
    const std::size_t first = first_block(rank), count = first_block(rank + 1) - first;
    for (std::size_t i = 0; i < some.size(); ++i) {
      NodeErrors& errors = all[i / count * blocks_ + first + i % count];
      errors = some[i];
      errors.worst_node += first * block_;
    }
  };
  Packer request = request_of(Request::errors, number_);
  add(request, spline);
  on_all_ranks(
      ranks_, request.bytes(), [&] { put(0, here_->errors(spline)); },
      [&](int rank, Unpacker& answer) { put(rank, answer.take_list<NodeErrors>()); });
  return all;
}

std::vector<CodedBlock> SpreadNodes::code(const NodeSpline& spline, const CodedResidual& kind) const {
  std::vector<CodedBlock> all(blocks_);
  const auto put = [&](int rank, std::vector<CodedBlock> some) {
    std::move(some.begin(), some.end(), all.begin() + static_cast<std::ptrdiff_t>(first_block(rank)));
  };
  Packer request = request_of(Request::code, number_);
  add(request, spline), add_kind(request, kind);
  on_all_ranks(
      ranks_, request.bytes(), [&] { put(0, here_->code(spline, kind)); },
      [&](int rank, Unpacker& answer) { put(rank, take_blocks(answer)); });
  return all;
}

void serve_nodes(const Ranks& ranks) {
  Server server;
  serve(ranks, [&](Unpacker& request, Packer& answer) { server.answer(request, answer); });
}

}  // namespace cleft
