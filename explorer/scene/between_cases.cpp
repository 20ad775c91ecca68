#include "explorer/scene/between_cases.h"

#include <chrono>

#include "encoder/interpolate/study_interpolator.h"

namespace cleft {

BetweenCases::BetweenCases(const std::string& study)
    : prepared_(std::async(std::launch::async, [study] {
                  return std::make_shared<const StudyInterpolator>(study);
                }).share()) {}

bool BetweenCases::ready() const {
  return prepared_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::shared_ptr<const Field> BetweenCases::at(const std::map<std::string, double>& parameters) const {
  return std::make_shared<const Field>(prepared_.get()->at(parameters));
}

}  // namespace cleft
