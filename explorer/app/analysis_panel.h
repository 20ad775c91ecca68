// The study's answers in the window: what a figure depends on, what fits measurements, the next cases.
#pragma once

#include <QComboBox>
#include <QCoreApplication>
#include <QPushButton>

#include "explorer/app/analysis_plot.h"

namespace cleft {

class AnalysisPanel : public QWidget {
  Q_DECLARE_TR_FUNCTIONS(AnalysisPanel)

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
