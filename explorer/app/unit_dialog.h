// Asks for the unit of a mesh, with the size that the mesh has in each.
#pragma once

#include <QButtonGroup>
#include <QCoreApplication>
#include <QDialog>
#include <QDoubleSpinBox>

namespace cleft {

class UnitDialog : public QDialog {
  Q_DECLARE_TR_FUNCTIONS(UnitDialog)

 public:
  /// Of a mesh `extent` of its units long, to be cut by fields of cuts `cut_length` mm long.
  UnitDialog(QWidget* parent, double extent, double cut_length);
  double mm() const;  ///< in a unit, as chosen

 private:
  QButtonGroup* units_;
  QDoubleSpinBox* other_;
};

}  // namespace cleft
