// Play, pause, step, scrub, loop and speed; shows the length cut.
#pragma once

#include <QCheckBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QSlider>
#include <QTimer>
#include <QToolButton>
#include <QWidget>

#include "explorer/app/panel.h"

namespace cleft {

class TimeBar : public QWidget, public Panel {
  Q_DECLARE_TR_FUNCTIONS(TimeBar)

 public:
  TimeBar(Session& session, Say say);
  void follow(const Changes& changes) override;
  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QToolButton* button(const char* name, const QString& tip);

  void paint_icons();

  Session& session_;
  Say say_;
  QToolButton *back_, *play_, *forward_;
  QSlider* slider_;
  QCheckBox* loop_;
  QDoubleSpinBox* speed_;
  QLabel* label_;
  QTimer clock_;
  QElapsedTimer since_;
};

}  // namespace cleft
