// The cases of the study, one row each: parameters that differ, and figures, which are computed when there is
// time.
#pragma once

#include <QAbstractTableModel>
#include <QCheckBox>
#include <QCoreApplication>
#include <QLabel>
#include <QLineEdit>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QTimer>
#include <QWidget>

#include "explorer/app/panel.h"

namespace cleft {

class CaseModel : public QAbstractTableModel {
  Q_DECLARE_TR_FUNCTIONS(CaseModel)

 public:
  explicit CaseModel(Session& session) : session_(session) {}
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  void new_study();
  void row_changed(int i);
  /// Column 0 is the number of the case, as the name "" is.
  int column_of(const std::string& name) const;
  std::string name_of(int column) const;

 private:
  bool known(int row, int column) const;

  Session& session_;
  std::vector<std::string> columns_;
  int parameters_ = 0;
};

/// Sorted, and while a filter is on without the cases that are faded.
class ShownCases : public QSortFilterProxyModel {
 public:
  explicit ShownCases(Session& session) : session_(session) {}
  void filter_anew() { invalidateFilter(); }

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

 private:
  Session& session_;
};

class CaseTable : public QWidget, public Panel {
  Q_DECLARE_TR_FUNCTIONS(CaseTable)

 public:
  CaseTable(Session& session, Say say, std::function<void()> figures_known);
  void follow(const Changes& changes) override;
  std::vector<int> selected() const;  ///< cases, ascending

  // For another view of the same cases, in the same order, with the same selection.
  QAbstractItemModel* model() { return &sorted_; }
  QItemSelectionModel* selection() const { return table_->selectionModel(); }
  int case_of(const QModelIndex& index) const { return sorted_.mapToSource(index).row(); }

 private:
  void find_next_figures();
  void go_to(int i);
  void count_found();
  void mark_shown();
  void say_selection();
  void sort();
  void fit_columns();

  Session& session_;
  Say say_;
  std::function<void()> figures_known_;
  CaseModel model_;
  ShownCases sorted_;
  QLineEdit* condition_;
  QLabel* count_;
  QCheckBox* filter_;
  QTableView* table_;
  QTimer idle_;
  int next_ = 0;
  bool following_ = false;  // the selection is put to what is shown, and asks for nothing
  bool selecting_ = false;  // it is asked for here
};

}  // namespace cleft
