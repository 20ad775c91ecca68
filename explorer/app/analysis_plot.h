// What a figure of the study depends on: shares of its variance (Sobol's indices) with their intervals, the
// cases as dots with their errors, and the mean over all other parameters with a band of its error.
#pragma once

#include <QCoreApplication>
#include <QPolygonF>
#include <QWidget>

#include "explorer/app/panel.h"

namespace cleft {

class AnalysisPlot : public QWidget {
  Q_DECLARE_TR_FUNCTIONS(AnalysisPlot)

 public:
  AnalysisPlot(Session& session, Say say);
  /// The analysis that is shown; null: there is none yet.
  const StudyAnalysis* analysis() const;
  /// Grows to what all rows need to be read.
  void take_room();
  /// Where the dot of a case is drawn in the row of a parameter, pixels.
  QPointF dot_of(std::size_t row, int case_number) const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  struct Frame;
  Frame frame_of(std::size_t row) const;
  QPointF dot_in(const Frame& frame, std::size_t row, int case_number) const;
  void paint_row(QPainter& painter, std::size_t row) const;
  void paint_shares(QPainter& painter, const StudyAnalysis::Effect& effect, const QRectF& room) const;
  void paint_cases(QPainter& painter, std::size_t row) const;

  void paint_partner(QPainter& painter, const StudyAnalysis::Effect& effect, const Frame& frame) const;
  void show_nearest(const QPointF& place);
  void select_within_lasso(bool as_well);

  Session& session_;
  Say say_;
  QPolygonF lasso_;  // pixels; the way of the mouse since its button was pressed
};

}  // namespace cleft
