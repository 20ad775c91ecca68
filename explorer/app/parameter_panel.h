// A slider for each parameter that varies in the study, and the case that is shown.
#pragma once

#include <QCoreApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <QTimer>
#include <QVBoxLayout>
#include <QWidget>
#include <vector>

#include "explorer/app/panel.h"

namespace cleft {

class ParameterPanel : public QWidget, public Panel {
  Q_DECLARE_TR_FUNCTIONS(ParameterPanel)

 public:
  ParameterPanel(Session& session, Say say);
  void follow(const Changes& changes) override;

 private:
  void make_rows();
  void show_values();
  void show_preparing();
  QString note_between() const;
  QString note_of_case();

  struct Row {
    std::string name, unit;
    double least, greatest;
    QLabel* text;
    QSlider* slider;
  };
  Session& session_;
  Say say_;
  QVBoxLayout* column_;
  QWidget* rows_widget_ = nullptr;
  QLabel* note_;
  QTimer waiting_;  ///< for fields between the cases
  QWidget* preparing_;
  QProgressBar* prepared_;
  std::vector<Row> rows_;
};

}  // namespace cleft
