#include "encoder/field/parametrization/tip.h"

namespace cleft {

Parametrization::Along TipParametrization::along(double u, double t) const {
  const auto [front, back] = domain()[0];
  const double start = geometry().cut.start, tip = geometry().tip.at(t);
  if (u <= start) {
    const double length = start - front;
    return length > 0 ? Along{(u - front) / length, 1 / length, 0} : Along{1, 0, 0};
  }
  const double speed = geometry().tip.speed(t);
  if (u < tip) {
    const double part = (u - start) / (tip - start);
    return {1 + part, 1 / (tip - start), -part * speed / (tip - start)};
  }
  const double length = back - tip;
  if (length <= 0) return {2, 0, 0};
  const double part = (u - tip) / length;
  return {2 + part, 1 / length, (part - 1) * speed / length};
}

Parametrization::Single TipParametrization::across(double v) const {
  const auto [front, back] = domain()[1];
  const double width = v < 0 ? -front : back;
  return {v / width, 1 / width};
}

Parametrization::Single TipParametrization::height(double w) const {
  const double bottom = domain()[2].front, depth = geometry().cut.depth;
  if (depth >= -bottom) return {w / -bottom, 1 / -bottom};
  if (depth > 0 && w > -depth) return {w / depth, 1 / depth};
  const double below = -bottom - depth;
  return {-1 + (w + depth) / below, 1 / below};
}

Parametrization::Single TipParametrization::time(double t) const {
  const double duration = domain()[3].back;
  return {t / duration, 1 / duration};
}

double TipParametrization::u_at(double along, double t) const {
  const auto [front, back] = domain()[0];
  const double start = geometry().cut.start, tip = geometry().tip.at(t);
  if (along <= 1) return front + along * (start - front);
  if (along <= 2) return start + (along - 1) * (tip - start);
  return tip + (along - 2) * (back - tip);
}

double TipParametrization::v_at(double across) const {
  const auto [front, back] = domain()[1];
  return across * (across < 0 ? -front : back);
}

double TipParametrization::w_at(double height) const {
  const double bottom = domain()[2].front, depth = geometry().cut.depth;
  if (depth >= -bottom) return height * -bottom;
  return height > -1 ? height * depth : -depth + (height + 1) * (-bottom - depth);
}

double TipParametrization::time_at(double parameter) const { return parameter * domain()[3].back; }

}  // namespace cleft
