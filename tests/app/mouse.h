// A user's hand: real events to widgets, and time for what they cause.
#pragma once

#include <QApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QPainter>
#include <QWidget>

namespace cleft {

/// Events and timers for a while, so that pictures are drawn and figures found.
inline void settle(int milliseconds = 300) {
  QElapsedTimer timer;
  timer.start();
  while (timer.elapsed() < milliseconds) QApplication::processEvents(QEventLoop::AllEvents, 20);
}

inline void mouse(QWidget& widget, QEvent::Type type, const QPointF& at,
                  Qt::MouseButton button = Qt::LeftButton) {
  const bool moves = type == QEvent::MouseMove, released = type == QEvent::MouseButtonRelease;
  QMouseEvent event(type, at, widget.mapToGlobal(at.toPoint()), moves ? Qt::NoButton : button,
                    released ? Qt::NoButton : button, Qt::NoModifier);
  QApplication::sendEvent(&widget, &event);
}

/// From a place to another, in parts of the widget's width and height, pressed.
inline void drag_over(QWidget& widget, double x0, double y0, double x1, double y1, int steps = 12) {
  const auto at = [&](double part) {
    return QPointF(widget.width() * (x0 + part * (x1 - x0)), widget.height() * (y0 + part * (y1 - y0)));
  };
  mouse(widget, QEvent::MouseButtonPress, at(0));
  for (int i = 1; i <= steps; ++i) {
    mouse(widget, QEvent::MouseMove, at(double(i) / steps));
    QApplication::processEvents();
  }
  mouse(widget, QEvent::MouseButtonRelease, at(1));
}

}  // namespace cleft
