#include "params/sampling/sampling.h"

#include "base/error.h"
#include "base/text.h"

namespace cleft {

// Each in the file of its name.
std::vector<Case> sample_grid(const Study& study);
std::vector<Case> sample_list(const Study& study);
std::vector<Case> sample_latin_hypercube(const Study& study);
std::vector<Case> sample_sobol(const Study& study);
std::vector<Case> sample_sparse_grid(const Study& study);

namespace {

const SamplingMethod methods[] = {{"grid", sample_grid, false},
                                  {"list", sample_list, false},
                                  {"latin-hypercube", sample_latin_hypercube, true},
                                  {"sobol", sample_sobol, true},
                                  {"sparse-grid", sample_sparse_grid, true, true},
                                  {"adaptive", sample_sobol, true, false, true}};

}  // namespace

const SamplingMethod& find_sampling(const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const SamplingMethod& method : methods) {
    if (method.name == name) return method;
    names.push_back(method.name);
  }
  std::string list;
  for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
  throw InputError(where + ": unknown sampling method '" + name + "'" + did_you_mean(name, names) +
                   "; known: " + list);
}

std::string drawing_methods() {
  std::string list;
  for (const SamplingMethod& method : methods)
    if (method.draws) list += (list.empty() ? "\"" : " or \"") + method.name + "\"";
  return list;
}

}  // namespace cleft
