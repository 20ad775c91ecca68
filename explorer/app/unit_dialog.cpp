#include "explorer/app/unit_dialog.h"

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QRadioButton>
#include <QVBoxLayout>

#include "explorer/wound/mesh_unit.h"

namespace cleft {

UnitDialog::UnitDialog(QWidget* parent, double extent, double cut_length) : QDialog(parent) {
  setObjectName("unit_dialog");
  setWindowTitle(tr("The unit of the mesh"));
  auto* column = new QVBoxLayout(this);
  auto* question = new QLabel(
      QString(
          tr("A mesh file does not tell its unit. This mesh is %1 units long; the cut of the fields is %2 mm "
             "long. In which unit is the mesh?"))
          .arg(extent, 0, 'g', 3)
          .arg(cut_length, 0, 'g', 3));
  question->setWordWrap(true);
  column->addWidget(question);
  units_ = new QButtonGroup(this);
  const double guess = guessed_unit(extent, cut_length);
  for (std::size_t i = 0; i < length_units().size(); ++i) {
    const LengthUnit& unit = length_units()[i];
    auto* button = new QRadioButton(tr("%1: the mesh is %2 mm long%3")
                                        .arg(QString::fromStdString(unit.name))
                                        .arg(extent * unit.mm, 0, 'g', 3)
                                        .arg(unit.mm == guess ? tr(" (a guess by its size)") : ""));
    button->setObjectName("unit_" + QString::fromStdString(unit.name));
    button->setChecked(unit.mm == guess);
    units_->addButton(button, static_cast<int>(i));
    column->addWidget(button);
  }
  auto* row = new QHBoxLayout;
  auto* of_its_own = new QRadioButton(tr("mm in a unit:"));
  of_its_own->setObjectName("unit_other");
  units_->addButton(of_its_own, static_cast<int>(length_units().size()));
  other_ = new QDoubleSpinBox;
  other_->setObjectName("unit_mm");
  other_->setDecimals(4);
  other_->setRange(0.0001, 1e6);
  other_->setValue(guess);
  auto* size = new QLabel;
  const auto tell_size = [=](double mm) { size->setText(tr("%1 mm long").arg(extent * mm, 0, 'g', 3)); };
  tell_size(guess);
  connect(other_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, [=](double mm) {
    of_its_own->setChecked(true);
    tell_size(mm);
  });
  row->addWidget(of_its_own);
  row->addWidget(other_);
  row->addWidget(size, 1);
  column->addLayout(row);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
}

double UnitDialog::mm() const {
  const auto chosen = static_cast<std::size_t>(units_->checkedId());
  return chosen < length_units().size() ? length_units()[chosen].mm : other_->value();
}

}  // namespace cleft
