#include "params/sampling/sampling.h"

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

struct Method {
  std::string name;
  Sampling sample;
};
const Method methods[] = {{"grid", sample_grid}, {"list", sample_list}};

}  // namespace

Sampling find_sampling(const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const Method& method : methods) {
    if (method.name == name) return method.sample;
    names.push_back(method.name);
  }
  std::string list;
  for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
  throw InputError(where + ": unknown sampling method '" + name + "'" + did_you_mean(name, names) +
                   "; known: " + list);
}

}  // namespace cleft
