// What a figure of the study depends on: shares of its variance (Sobol's indices) with their intervals, the
// cases as dots with their errors, and the mean over all other parameters with a band of its error.
#pragma once

#include <QComboBox>
#include <QPushButton>
#include <QWidget>

#include "explorer/app/panel.h"

namespace cleft {

class AnalysisPlot : public QWidget {
 public:
  AnalysisPlot(Session& session, Say say);
  /// The analysis that is shown; null: there is none yet.
  const StudyAnalysis* analysis() const;
  /// Where the dot of a case is drawn in the row of a parameter, pixels.
  QPointF dot_of(std::size_t row, int case_number) const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  struct Frame;
  Frame frame_of(std::size_t row) const;
  void paint_row(QPainter& painter, std::size_t row) const;
  void paint_shares(QPainter& painter, const StudyAnalysis::Effect& effect, const QRectF& room) const;
  void paint_cases(QPainter& painter, std::size_t row) const;

  Session& session_;
  Say say_;
};

class AnalysisPanel : public QWidget {
 public:
  AnalysisPanel(Session& session, const Say& say);
  void show_answers();

 private:
  Session& session_;
  QComboBox* figure_;
  QPushButton *analyze_, *fit_, *propose_;
  AnalysisPlot* plot_;
};

}  // namespace cleft
