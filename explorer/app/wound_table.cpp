#include "explorer/app/wound_table.h"

#include <QHeaderView>
#include <cmath>

namespace cleft {

WoundTable::WoundTable(Session& session, Say say) : session_(session), say_(std::move(say)) {
  setObjectName("wounds");
  setAccessibleName(tr("Wounds"));
  setTabKeyNavigation(false);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setToolTip(
      tr("The cuts as they are now; a click shows the handles of one (handles N), a double-click looks at it "
         "(wound N)"));
  const QStringList names{tr("length\nmm"), tr("depth\nmm"), tr("opening\nmm"), tr("area\nmm\u00b2"),
                          tr("volume\nmm\u00b3")};
  setColumnCount(static_cast<int>(names.size()));
  setHorizontalHeaderLabels(names);
  QFont small = font();
  small.setPointSizeF(0.85 * small.pointSizeF());
  setFont(small);
  horizontalHeader()->setFont(small);
  horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  const auto show_handles = [this](int row, int) { say_("handles " + std::to_string(row + 1)); };
  connect(this, &QTableWidget::cellClicked, this, show_handles);
  connect(this, &QTableWidget::cellActivated, this, show_handles);  // by the key Enter
  connect(this, &QTableWidget::cellDoubleClicked, this,
          [this](int row, int) { say_("wound " + std::to_string(row + 1)); });
}

void WoundTable::show_wounds() {
  const std::vector<WoundFigures> wounds = session_.mesh() && session_.has_scene()
                                               ? session_.scene()->wound_figures(session_.state().time)
                                               : std::vector<WoundFigures>{};
  const std::vector<Validity>& validity = session_.validity();
  setRowCount(static_cast<int>(wounds.size()));
  for (std::size_t i = 0; i < wounds.size(); ++i) {
    const WoundFigures& f = wounds[i];
    // Three digits, without an exponent.
    const auto number = [](double value) {
      return std::abs(value) < 1000 ? QString::number(value, 'g', 3)
                                    : QString::number(10 * std::round(value / 10), 'f', 0);
    };
    QString opening = number(f.widest), why;
    if (i < validity.size()) {
      opening += tr(" \u00b1 %1").arg(validity[i].expected_error.largest * f.widest, 0, 'g', 2);
      why = tr("Mostly uncertain because ") + QString::fromStdString(validity[i].expected_error.cause);
    }
    const QString texts[] = {number(f.length), number(f.depth), opening, number(f.area), number(f.volume)};
    for (int column = 0; column < columnCount(); ++column) {
      auto* item = new QTableWidgetItem(texts[column]);
      item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      item->setToolTip(why);
      setItem(static_cast<int>(i), column, item);
    }
  }
  const int handled = session_.mesh() ? session_.state().handled : -1;
  if (handled >= 0)
    selectRow(handled);
  else
    clearSelection();
}

}  // namespace cleft
