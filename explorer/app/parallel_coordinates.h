// All cases as lines over parallel axes, one for each parameter that differs and each figure. Dragging along
// an axis keeps the cases in that range and fades the others; a click on the name of an axis removes the
// range.
#pragma once

#include <QCoreApplication>
#include <QPixmap>
#include <QWidget>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "explorer/app/panel.h"

namespace cleft {

class ParallelCoordinates : public QWidget, public Panel {
  Q_DECLARE_TR_FUNCTIONS(ParallelCoordinates)

 public:
  ParallelCoordinates(Session& session, Say say);
  void follow(const Changes& changes) override;
  /// To be called when further figures are known.
  void take_figures();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  struct Axis {
    std::string name;
    double least, greatest;
  };
  double x_of(std::size_t axis) const;
  double y_of(const Axis& axis, double value) const;
  double value_at(const Axis& axis, double y) const;
  std::optional<std::size_t> axis_at(double x) const;
  void say_brush(double y);
  void paint_lines();
  void paint_line(QPainter& painter, const std::vector<double>& values) const;
  std::vector<double> values_between() const;

  Session& session_;
  Say say_;
  std::vector<Axis> axes_;
  std::vector<std::vector<double>> rows_;  // of cases whose values are known
  std::vector<int> cases_;                 // their numbers
  QPixmap lines_;                          // none: to be drawn
  std::optional<std::size_t> dragged_;
  double pressed_y_ = 0;
};

}  // namespace cleft
