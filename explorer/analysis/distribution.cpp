#include "explorer/analysis/distribution.h"

#include <algorithm>
#include <cmath>
#include <openturns/Distribution.hxx>
#include <openturns/LogUniform.hxx>
#include <openturns/Normal.hxx>
#include <openturns/Triangular.hxx>
#include <openturns/Uniform.hxx>
#include <openturns/UserDefined.hxx>

#include "base/call_text.h"
#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

constexpr double decade = 10;

OT::Distribution of_file(const std::string& file, const std::string& name) {
  const NumberTable table = read_csv(file);
  const int column = table.columns.size() == 1 ? 0 : table.column(name);
  if (column < 0) throw InputError(file + ": has no column '" + name + "'");
  if (table.rows.empty()) throw InputError(file + ": holds no value of " + name);
  OT::Sample values(table.rows.size(), 1);
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    values(i, 0) = table.rows[i][static_cast<std::size_t>(column)];
  return OT::UserDefined(values);
}

OT::Distribution law_of(const std::string& kind, const std::vector<double>& p, const std::string& where) {
  const auto need = [&](std::size_t count, bool in_order, const char* expected) {
    if (p.size() != count || !in_order) throw InputError(where + ": expected " + expected);
  };
  if (kind == "uniform") {
    need(2, p.size() == 2 && p[0] < p[1], "uniform(from, to) with from below to");
    return OT::Uniform(p[0], p[1]);
  }
  if (kind == "loguniform") {
    need(2, p.size() == 2 && 0 < p[0] && p[0] < p[1], "loguniform(from, to) with 0 < from < to");
    return OT::LogUniform(std::log(p[0]), std::log(p[1]));
  }
  if (kind == "normal") {
    need(2, p.size() == 2 && p[1] > 0, "normal(mean, deviation) with a deviation above 0");
    return OT::Normal(p[0], p[1]);
  }
  if (kind == "triangular") {
    need(3, p.size() == 3 && p[0] <= p[1] && p[1] <= p[2] && p[0] < p[2],
         "triangular(from, peak, to) in ascending order");
    return OT::Triangular(p[0], p[1], p[2]);
  }
  throw InputError(where + ": there is no distribution '" + kind +
                   "'; expected uniform, loguniform, normal, triangular or the name of a CSV file");
}

}  // namespace

InputDistribution::InputDistribution(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError("distribution '" + text + "': expected NAME=uniform(from, to), for example");
  name_ = text.substr(0, equals), text_ = text.substr(equals + 1);
  const std::string where = "distribution '" + text + "'";
  const CallText call = parse_call(text_, where);
  law_ = std::make_shared<OT::Distribution>(call.numbers ? law_of(call.name, *call.numbers, where)
                                                         : of_file(text_, name_));
}

InputDistribution::InputDistribution(const std::string& name, double least, double greatest)
    : InputDistribution(name + (least > 0 && greatest >= decade * least ? "=loguniform(" : "=uniform(") +
                        shortest(least) + ", " + shortest(greatest) + ")") {}

double InputDistribution::quantile(double part) const { return law_->computeScalarQuantile(part); }

std::vector<InputDistribution> distributions_of(const std::vector<RangeOfName>& ranges,
                                                const std::vector<std::string>& given) {
  std::vector<std::string> names(ranges.size());
  std::transform(ranges.begin(), ranges.end(), names.begin(),
                 [](const RangeOfName& one) { return one.name; });
  std::vector<InputDistribution> read;
  Mistakes mistakes;
  for (const std::string& text : given)
    mistakes.collect([&] {
      InputDistribution one(text);
      if (std::find(names.begin(), names.end(), one.name()) == names.end())
        throw InputError("distribution '" + text + "': " + one.name() + " does not vary in this study" +
                         did_you_mean(one.name(), names));
      for (const InputDistribution& other : read)
        if (other.name() == one.name())
          throw InputError("distribution '" + text + "': " + one.name() + " is given twice");
      read.push_back(std::move(one));
    });
  mistakes.throw_if_any();
  std::vector<InputDistribution> all;
  for (const RangeOfName& range : ranges) {
    const auto found =
        std::find_if(read.begin(), read.end(), [&](const auto& one) { return one.name() == range.name; });
    all.push_back(found != read.end() ? *found : InputDistribution(range.name, range.least, range.greatest));
  }
  return all;
}

}  // namespace cleft
