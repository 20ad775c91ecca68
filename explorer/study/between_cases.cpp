#include "explorer/study/between_cases.h"

#include <chrono>

#include "base/error.h"
#include "encoder/interpolate/study_interpolator.h"

namespace cleft {

BetweenCases::BetweenCases(const std::string& study)
    : prepared_(std::async(std::launch::async, [this, study] {
                  return std::make_shared<const StudyInterpolator>(study, [&](double part) {
                    part_ = part;
                    if (unwanted_) throw InputError(study + ": no longer wanted");
                  });
                }).share()) {}

BetweenCases::~BetweenCases() { unwanted_ = true; }

bool BetweenCases::ready() const {
  return prepared_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void BetweenCases::wait(const std::function<void(double part)>& go_on) const {
  constexpr std::chrono::milliseconds moment(50);
  while (prepared_.wait_for(moment) != std::future_status::ready) go_on(part_);
}

std::shared_ptr<const Field> BetweenCases::at(const std::map<std::string, double>& parameters) const {
  return std::make_shared<const Field>(prepared_.get()->at(parameters));
}

}  // namespace cleft
