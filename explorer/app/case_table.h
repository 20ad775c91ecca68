// The cases of the study, one row each: parameters that differ, and figures, which are computed when there is
// time.
#pragma once

#include <QAbstractTableModel>
#include <QLineEdit>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QTimer>
#include <QWidget>

#include "explorer/app/panel.h"

namespace cleft {

class CaseModel : public QAbstractTableModel {
 public:
  explicit CaseModel(Session& session) : session_(session) {}
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  void new_study();
  void row_changed(int i);

 private:
  bool known(int row, int column) const;

  Session& session_;
  std::vector<std::string> columns_;
  int parameters_ = 0;
};

class CaseTable : public QWidget, public Panel {
 public:
  CaseTable(Session& session, Say say, std::function<void()> figures_known);
  void follow(const Changes& changes) override;

 private:
  void find_next_figures();
  void fit_columns();

  Session& session_;
  Say say_;
  std::function<void()> figures_known_;
  CaseModel model_;
  QSortFilterProxyModel sorted_;
  QLineEdit* condition_;
  QTableView* table_;
  QTimer idle_;
  int next_ = 0;
};

}  // namespace cleft
