#include "explorer/app/case_table.h"

#include <QApplication>
#include <QHeaderView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "params/parameters/table.h"

namespace cleft {

void CaseModel::new_study() {
  beginResetModel();
  columns_.clear();
  if (session_.study()) columns_ = session_.column_names();
  parameters_ = session_.study() ? static_cast<int>(session_.study()->varying().size()) : 0;
  endResetModel();
}

int CaseModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() || !session_.study() || columns_.empty() ? 0 : session_.study()->size();
}

int CaseModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(columns_.size()) + 1;
}

bool CaseModel::known(int row, int column) const {
  return column <= parameters_ || session_.knows_figures(row);
}

QVariant CaseModel::data(const QModelIndex& index, int role) const {
  if (role == Qt::TextAlignmentRole) return int(Qt::AlignRight | Qt::AlignVCenter);
  if (role == Qt::ForegroundRole && !(session_.state().brushes.empty() && session_.state().where.empty())) {
    if (!session_.knows_brushed(index.row())) return {};
    return session_.brushed(index.row()) ? QVariant()
                                         : QVariant(QApplication::palette().color(QPalette::PlaceholderText));
  }
  if (role != Qt::DisplayRole && role != Qt::UserRole) return {};
  if (index.column() == 0) return index.row() + 1;
  if (!known(index.row(), index.column()))
    return role == Qt::UserRole ? QVariant(-HUGE_VAL) : QVariant(QStringLiteral("..."));
  const double value =
      session_.column_value(index.row(), columns_[static_cast<std::size_t>(index.column()) - 1]);
  return role == Qt::UserRole ? QVariant(value) : QVariant(QString::number(value, 'g', 4));
}

QVariant CaseModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (section == 0)
    return role == Qt::DisplayRole   ? QVariant("#")
           : role == Qt::ToolTipRole ? QVariant(tr("Number of the case, as `case N` takes it"))
                                     : QVariant();
  const std::string& name = columns_[static_cast<std::size_t>(section) - 1];
  std::string unit, help;
  if (section <= parameters_) {
    const Parameter& row = find_parameter(name, "cases");
    unit = row.unit, help = row.help;
  } else {
    const FigureText& figure = figure_texts()[section - 1 - parameters_];
    unit = figure.unit, help = figure.help;
  }
  if (role == Qt::ToolTipRole)
    return QString::fromStdString(name + (unit.empty() ? "" : ", " + unit) + ": " + help);
  if (role != Qt::DisplayRole) return {};
  const std::size_t dot = name.find('.');
  std::string last = dot == std::string::npos ? name : name.substr(0, dot) + "\n" + name.substr(dot + 1);
  std::replace(last.begin(), last.end(), '_', '\n');
  return QString::fromStdString(last + (unit.empty() ? "" : "\n" + unit));
}

void CaseModel::row_changed(int i) { emit dataChanged(index(i, 0), index(i, columnCount() - 1)); }

int CaseModel::column_of(const std::string& name) const {
  return name.empty()
             ? 0
             : static_cast<int>(std::find(columns_.begin(), columns_.end(), name) - columns_.begin()) + 1;
}

std::string CaseModel::name_of(int column) const {
  return column == 0 ? "" : columns_.at(static_cast<std::size_t>(column) - 1);
}

bool ShownCases::filterAcceptsRow(int row, const QModelIndex&) const {
  return !session_.state().filtered || !session_.study() || session_.brushed(row);
}

CaseTable::CaseTable(Session& session, Say say, std::function<void()> figures_known)
    : session_(session),
      say_(std::move(say)),
      figures_known_(std::move(figures_known)),
      model_(session),
      sorted_(session) {
  sorted_.setSourceModel(&model_);
  sorted_.setSortRole(Qt::UserRole);
  condition_ = new QLineEdit(this);
  condition_->setObjectName("find");
  condition_->setAccessibleName(tr("Find cases"));
  condition_->setClearButtonEnabled(true);
  condition_->setPlaceholderText(tr("Find: gape > 3 and t < 20"));
  condition_->setToolTip(
      tr("Fades the cases where this holds nowhere. gape (of the lips at a place, mm), t (length cut, mm), u "
         "(place along "
         "the cut, mm), error (%), displacement (mm), parameters; and or not, < <= > >= = !=, + - * / and "
         "brackets"));
  connect(condition_, &QLineEdit::returnPressed, this, [this] {
    say_(condition_->text().isEmpty() ? "find clear" : "find " + condition_->text().toStdString());
  });
  table_ = new QTableView(this);
  table_->setObjectName("cases");
  table_->setAccessibleName(tr("Cases"));
  table_->setTabKeyNavigation(false);  // Tab goes on to the next panel
  table_->setModel(&sorted_);
  table_->setSortingEnabled(true);
  table_->sortByColumn(0, Qt::AscendingOrder);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + 6);
  table_->horizontalHeader()->setMinimumSectionSize(30);
  table_->setAlternatingRowColors(true);
  QFont small = table_->font();
  small.setPointSizeF(0.85 * small.pointSizeF());
  table_->setFont(small);
  table_->horizontalHeader()->setFont(small);
  table_->horizontalHeader()->setHighlightSections(false);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(condition_);
  auto* row = new QHBoxLayout;
  count_ = new QLabel(this);
  count_->setObjectName("found");
  row->addWidget(count_, 1);
  filter_ = new QCheckBox(tr("Only these"), this);
  filter_->setObjectName("filter");
  filter_->setToolTip(tr("Leave the faded cases out of this list (filter on)"));
  connect(filter_, &QCheckBox::clicked, this, [this](bool on) { say_(on ? "filter on" : "filter off"); });
  row->addWidget(filter_);
  column->addLayout(row);
  column->addWidget(table_);
  connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now, const QModelIndex&) {
            if (now.isValid() && !following_) go_to(sorted_.mapToSource(now).row());
          });
  connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    if (!following_) say_selection();
  });
  connect(table_->horizontalHeader(), &QHeaderView::sortIndicatorChanged, this,
          [this](int sorted, Qt::SortOrder order) {
            if (following_ || !session_.study() || sorted >= model_.columnCount()) return;
            const std::string name = model_.name_of(sorted);
            say_("sort " + (name.empty() ? "none" : name) + (order == Qt::DescendingOrder ? " down" : ""));
          });
  connect(&idle_, &QTimer::timeout, this, [this] { find_next_figures(); });
}

/// A case that `find` has found is shown where the condition holds.
void CaseTable::go_to(int i) {
  const SessionState& s = session_.state();
  if (i == s.shown && session_.shows_exactly() && s.where.empty()) return;
  const bool found = !s.where.empty() && session_.finding(i);
  say_((found ? "found " : "case ") + std::to_string(i + 1));
}

std::vector<int> CaseTable::selected() const {
  std::vector<int> cases;
  for (const QModelIndex& row : table_->selectionModel()->selectedRows())
    cases.push_back(sorted_.mapToSource(row).row());
  std::sort(cases.begin(), cases.end());
  return cases;
}

/// One row alone is the case that is shown.
void CaseTable::say_selection() {
  const std::vector<int> cases = selected();
  if (cases.size() < 2 && session_.state().selected.empty()) return;
  std::string line = "select";
  for (const int i : cases) line += " " + std::to_string(i + 1);
  selecting_ = true;
  say_(cases.size() < 2 ? "select none" : line);
  selecting_ = false;
}

void CaseTable::sort() {
  following_ = true;
  const SessionState& s = session_.state();
  table_->sortByColumn(model_.column_of(s.sorted_by),
                       s.descending ? Qt::DescendingOrder : Qt::AscendingOrder);
  following_ = false;
}

/// How many cases are left by the condition and the brushes.
void CaseTable::count_found() {
  const SessionState& s = session_.state();
  const bool any = session_.study() && !(s.where.empty() && s.brushes.empty());
  filter_->setVisible(any || s.filtered);
  count_->setVisible(any);
  filter_->setChecked(s.filtered);
  if (!any) return count_->clear();
  int left = 0;
  for (int i = 0; i < session_.study()->size(); ++i) {
    if (!session_.knows_brushed(i)) return count_->setText("...");  // until its figures have been read
    left += session_.brushed(i);
  }
  count_->setText(tr("%1 of %2 cases").arg(left).arg(session_.study()->size()));
  count_->setToolTip(tr("%1 of %2 cases are left; a click on one shows it where the condition holds")
                         .arg(left)
                         .arg(session_.study()->size()));
}

void CaseTable::find_next_figures() {
  const int cases = session_.study() ? session_.study()->size() : 0;
  while (next_ < cases && session_.knows_figures(next_)) ++next_;
  if (next_ >= cases) {
    idle_.stop();
    count_found();
    figures_known_();
    return;
  }
  try {
    session_.figures(next_);
    model_.row_changed(next_);
  } catch (const std::exception& e) {  // reported when the case is shown
  }
  ++next_;
}

/// Wide enough for the names and four digits.
void CaseTable::fit_columns() {
  const QFontMetrics metrics(table_->font());
  for (int column = 0; column < model_.columnCount(); ++column) {
    int widest = metrics.horizontalAdvance(column == 0 ? "888888" : "0.02345");
    for (const QString& line :
         model_.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString().split('\n'))
      widest = std::max(widest, metrics.horizontalAdvance(line));
    table_->setColumnWidth(column, widest + 10);
  }
}

void CaseTable::follow(const Changes& changes) {
  if (changes.study) {
    model_.new_study();
    fit_columns();
    next_ = 0;
    if (session_.study()) idle_.start(0);
  }
  if (changes.brushes) {
    table_->viewport()->update();  // only their colours: nothing is sorted anew
    condition_->setText(QString::fromStdString(session_.state().where));
    following_ = true;
    sorted_.filter_anew();
    following_ = false;
  }
  if (changes.study || changes.lists) sort();
  if (changes.brushes || changes.study) count_found();
  const bool marked = changes.study || changes.shown || changes.brushes || changes.lists;
  if (marked && session_.study() && !selecting_) mark_shown();
}

/// Those selected; else the one that is shown, and no row where what is shown is none of the cases.
void CaseTable::mark_shown() {
  following_ = true;
  const QModelIndex row =
      session_.between() ? QModelIndex() : sorted_.mapFromSource(model_.index(session_.state().shown, 0));
  if (!session_.state().selected.empty()) {
    QItemSelection rows;
    for (const int i : session_.state().selected)
      if (const QModelIndex at = sorted_.mapFromSource(model_.index(i, 0)); at.isValid()) rows.select(at, at);
    selection()->setCurrentIndex(row, QItemSelectionModel::NoUpdate);
    selection()->select(rows, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  } else if (!row.isValid()) {
    table_->selectionModel()->clear();
  } else if (table_->currentIndex().row() != row.row() || selected().size() != 1) {
    table_->setCurrentIndex(row);
    selection()->select(row, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    table_->scrollTo(row);
  }
  following_ = false;
}

}  // namespace cleft
