// The cuts in the mesh, one row each: length, depth, opening with its expected error, area, volume.
#pragma once

#include <QCoreApplication>
#include <QTableWidget>

#include "explorer/app/panel.h"

namespace cleft {

class WoundTable : public QTableWidget {
  Q_DECLARE_TR_FUNCTIONS(WoundTable)

 public:
  WoundTable(Session& session, Say say);
  void show_wounds();  ///< as they are at the shown length cut

 private:
  Session& session_;
  Say say_;
};

}  // namespace cleft
