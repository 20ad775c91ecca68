#include "params/run/estimates.h"

#include <algorithm>
#include <cmath>

#include "params/consistency.h"

namespace cleft {

namespace {

// The factor of a solid in nested dissection has about n^(4/3) entries; what a process holds without any, and
// bytes for each of them, were measured at 1,300 to 8,400 nodes.
constexpr double solver_base = 180e6, bytes_of_factor = 1000, encoder_base = 50e6, encoder_copies = 20;

double factor_entries(const CaseSize& size) { return std::pow(size.nodes, 4. / 3); }
double numbers(const CaseSize& size) { return 3 * size.nodes * (size.columns + 1); }
double work(const CaseSize& size) { return factor_entries(size) + numbers(size); }
double modelled_memory(const CaseSize& size) { return solver_base + bytes_of_factor * factor_entries(size); }

}  // namespace

CaseSize size_of(const Parameters& p) { return {estimated_nodes(p), p.cut.length / p.mesh.element_size}; }

Estimates::Estimates(const std::map<std::string, IndexedCase>& measured) {
  for (const auto& [hash, one] : measured) add(one);
}

void Estimates::add(const IndexedCase& one) {
  if (!(one.nodes > 0)) return;
  const CaseSize size{one.nodes, one.columns};
  seconds_.sum += one.seconds, seconds_.of += work(size);
  bytes_.sum += one.bytes, bytes_.of += numbers(size);
  memory_factor_ = std::max(memory_factor_, one.memory / modelled_memory(size));
}

std::optional<double> Estimates::Ratio::times(double work) const {
  if (!(of > 0)) return {};
  return sum / of * work;
}

std::optional<double> Estimates::seconds(const CaseSize& size) const { return seconds_.times(work(size)); }
std::optional<double> Estimates::bytes(const CaseSize& size) const { return bytes_.times(numbers(size)); }
double Estimates::solver_memory(const CaseSize& size) const { return memory_factor_ * modelled_memory(size); }
double Estimates::encoder_memory(const CaseSize& size) const {
  return encoder_base + encoder_copies * sizeof(double) * numbers(size);
}

}  // namespace cleft
