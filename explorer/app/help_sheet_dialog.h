// Keys, mouse and all commands, on a sheet.
#pragma once

#include <QAction>
#include <QDialog>
#include <QList>

namespace cleft {

class HelpSheet : public QDialog {
 public:
  /// Of the menu entries in `actions` those with a key are listed.
  HelpSheet(QWidget* parent, const QList<QAction*>& actions);
};

}  // namespace cleft
