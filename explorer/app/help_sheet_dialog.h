// Keys, mouse and all commands, on a sheet.
#pragma once

#include <QAction>
#include <QCoreApplication>
#include <QDialog>
#include <QList>

namespace cleft {

class HelpSheet : public QDialog {
  Q_DECLARE_TR_FUNCTIONS(HelpSheet)

 public:
  /// Of the menu entries in `actions` those with a key are listed.
  HelpSheet(QWidget* parent, const QList<QAction*>& actions);
};

}  // namespace cleft
