// Which keys belong to a control that has the focus, and which to the picture wherever the focus is.
#include <QAbstractButton>
#include <QAbstractSlider>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QTabBar>
#include <algorithm>

#include "explorer/app/main_window.h"

namespace cleft {

namespace {

bool is_one_of(int key, std::initializer_list<int> keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// Space and arrows play and step, except where a control could not be used without them.
bool keeps_for_itself(const QWidget* control, int key) {
  const bool arrow = is_one_of(key, {Qt::Key_Left, Qt::Key_Right, Qt::Key_Up, Qt::Key_Down});
  const bool page = is_one_of(key, {Qt::Key_PageUp, Qt::Key_PageDown, Qt::Key_Home, Qt::Key_End});
  if (qobject_cast<const QAbstractButton*>(control)) return key == Qt::Key_Space;
  if (qobject_cast<const QComboBox*>(control)) return key == Qt::Key_Space || arrow || page;
  if (qobject_cast<const QAbstractSlider*>(control))
    return control->objectName() != "time" && (arrow || page);  // that of time goes by steps of 1 mm
  return qobject_cast<const QTabBar*>(control) && arrow;
}

}  // namespace

bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  const auto type = event->type();
  if (type != QEvent::ShortcutOverride && type != QEvent::KeyPress)
    return QMainWindow::eventFilter(watched, event);
  auto* control = qobject_cast<QWidget*>(watched);
  if (!control || control->window() != this) return QMainWindow::eventFilter(watched, event);
  const auto* key = static_cast<QKeyEvent*>(event);
  const bool plain = (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
  if (type == QEvent::ShortcutOverride && plain && keeps_for_itself(control, key->key())) {
    event->accept();
    return true;
  }
  auto* button = qobject_cast<QAbstractButton*>(control);
  if (type == QEvent::KeyPress && button && plain && is_one_of(key->key(), {Qt::Key_Return, Qt::Key_Enter})) {
    button->click();
    return true;
  }
  return QMainWindow::eventFilter(watched, event);
}

}  // namespace cleft
