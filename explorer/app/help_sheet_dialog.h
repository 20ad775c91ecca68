// Keys, mouse and all commands, on a sheet.
#pragma once

#include <QDialog>

namespace cleft {

class HelpSheet : public QDialog {
 public:
  explicit HelpSheet(QWidget* parent);
};

}  // namespace cleft
