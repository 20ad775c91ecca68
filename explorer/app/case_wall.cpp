#include "explorer/app/case_wall.h"

#include <QApplication>
#include <QBuffer>
#include <QHBoxLayout>
#include <QPainter>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <QVBoxLayout>
#include <algorithm>

#include "explorer/app/direction.h"

namespace cleft {

namespace {

constexpr int idle_ms = 30;      // between two pictures
constexpr int kept_after = 200;  // pictures
constexpr int margin = 4;        // pixels

/// A picture with its number and figure below it, in a frame if it is shown or selected.
class WallDelegate : public QStyledItemDelegate {
 public:
  WallDelegate(QObject* parent, Session& session, const CaseWall& wall, const CaseTable& table)
      : QStyledItemDelegate(parent), session_(session), wall_(wall), table_(table) {}

  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const override {
    return {thumbnail_width + 2 * margin, thumbnail_height + option.fontMetrics.height() + 3 * margin};
  }

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const int i = table_.case_of(index);
    const QRect room = option.rect;
    const QRect inside(room.left() + margin, room.top() + margin, thumbnail_width, thumbnail_height);
    painter->save();
    const bool is_faded = wall_.is_faded(i);
    if (is_faded) painter->setOpacity(faded);
    const QPixmap& picture = wall_.picture(i);
    if (picture.isNull())
      painter->fillRect(inside, option.palette.alternateBase());
    else
      painter->drawPixmap(inside, picture);
    painter->setOpacity(1);  // words can be read all the same
    painter->setPen(option.palette.color(is_faded ? QPalette::PlaceholderText : QPalette::Text));
    painter->drawText(
        QRect(inside.left(), inside.bottom() + 1, thumbnail_width, room.bottom() - inside.bottom()),
        Qt::AlignHCenter | Qt::AlignVCenter,
        option.fontMetrics.elidedText(wall_.text(i), Qt::ElideRight, thumbnail_width));
    const bool shown = i == session_.state().shown && !session_.between();
    if (shown || option.state & QStyle::State_Selected) {
      painter->setPen(QPen(shown ? QColor(213, 94, 0) : option.palette.color(QPalette::Highlight), 3));
      painter->drawRect(inside.adjusted(-2, -2, 2, 2));
    }
    painter->restore();
  }

 private:
  static constexpr double faded = 0.25;
  Session& session_;
  const CaseWall& wall_;
  const CaseTable& table_;
};

}  // namespace

CaseWall::CaseWall(Session& session, Say say, CaseTable& table)
    : session_(session), say_(std::move(say)), table_(table) {
  by_ = new QComboBox(this);
  by_->setObjectName("wall_sort");
  by_->setToolTip(tr("The parameter or figure by which pictures and table are sorted (sort NAME)"));
  by_->setAccessibleName(tr("Sort by"));
  order_ = new QToolButton(this);
  order_->setObjectName("wall_order");
  order_->setToolTip(tr("From the least to the greatest, or the other way round (sort NAME down)"));
  order_->setAccessibleName(tr("Order"));
  progress_ = new QLabel(this);
  progress_->setObjectName("wall_progress");
  auto* row = new QHBoxLayout;
  row->addWidget(new QLabel(tr("Sort by"), this));
  row->addWidget(by_);
  row->addWidget(order_);
  row->addWidget(progress_, 1);
  list_ = new QListView(this);
  list_->setObjectName("wall");
  list_->setAccessibleName(tr("Pictures of the cases"));
  list_->setToolTip(
      tr("A click shows a case; with Ctrl or Shift several are selected. Faded: outside of what was looked "
         "for"));
  list_->setViewMode(QListView::IconMode);
  list_->setMovement(QListView::Static);
  list_->setResizeMode(QListView::Adjust);
  list_->setUniformItemSizes(true);
  list_->setSpacing(2);
  list_->setSelectionBehavior(QAbstractItemView::SelectRows);
  list_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  list_->setModel(table_.model());
  list_->setSelectionModel(table_.selection());
  list_->setItemDelegate(new WallDelegate(list_, session_, *this, table_));
  list_->setMinimumSize(thumbnail_width, thumbnail_height / 2);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(4, 2, 4, 2);
  column->addLayout(row);
  column->addWidget(list_, 1);
  connect(by_, QOverload<int>::of(&QComboBox::activated), this, [this] { say_sort(); });
  connect(order_, &QToolButton::clicked, this, [this] {
    const SessionState& s = session_.state();
    say_("sort " + (s.sorted_by.empty() ? "none" : s.sorted_by) + (s.descending ? " up" : " down"));
  });
  idle_.setInterval(idle_ms);
  connect(&idle_, &QTimer::timeout, this, [this] { draw_next(); });
}

CaseWall::~CaseWall() { keep(); }

void CaseWall::say_sort() {
  const std::string name = by_->currentIndex() == 0 ? "none" : by_->currentText().toStdString();
  say_("sort " + name + (session_.state().descending ? " down" : ""));
}

void CaseWall::new_study() {
  keep();
  const QSignalBlocker quiet(by_);
  by_->clear();
  by_->addItem(tr("number"));
  pictures_.clear(), tried_.clear(), kept_.clear(), file_.clear();
  if (!session_.study()) return;
  const PublishedStudy& study = *session_.study();
  for (const std::string& name : session_.column_names()) by_->addItem(QString::fromStdString(name));
  pictures_.resize(static_cast<std::size_t>(study.size()));
  tried_.assign(pictures_.size(), false);
  file_ = wall_file_of(study);
  const WallPictures before = read_wall_file(file_, thumbnail_look);
  for (int i = 0; i < study.size(); ++i) {
    const auto known = before.find(study.hash(i));
    QPixmap& picture = pictures_[static_cast<std::size_t>(i)];
    if (known == before.end() || !picture.loadFromData(reinterpret_cast<const uchar*>(known->second.data()),
                                                       static_cast<uint>(known->second.size())))
      continue;
    tried_[static_cast<std::size_t>(i)] = true;
    kept_.insert(*known);
  }
}

QString CaseWall::text(int i) const {
  const std::string figure = session_.state().sorted_by.empty() ? "gape" : session_.state().sorted_by;
  const bool known = session_.knows_figures(i) || session_.study()->parameters(i).number(figure);
  return left_to_right(QString::number(i + 1) + ":  " +
                       (known ? QString::fromStdString(figure) + " " +
                                    QString::number(session_.column_value(i, figure), 'g', 3)
                              : QString()));
}

/// As in the table, nothing is read for brushes.
bool CaseWall::is_faded(int i) const {
  const SessionState& s = session_.state();
  if (s.brushes.empty() && s.where.empty()) return false;
  return session_.knows_brushed(i) && !session_.brushed(i);
}

void CaseWall::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (next_without() >= 0) idle_.start();
}

/// In the order of the list; -1: all are drawn that can be.
int CaseWall::next_without() const {
  for (int row = 0; row < list_->model()->rowCount(); ++row)
    if (const int i = table_.case_of(list_->model()->index(row, 0)); !tried_[static_cast<std::size_t>(i)])
      return i;
  return -1;
}

void CaseWall::draw_next() {
  if (!isVisible()) return idle_.stop();
  if (session_.state().playing || QApplication::mouseButtons() != Qt::NoButton) return;
  const int i = next_without();
  if (i >= 0) draw(i);
  if (i < 0 || fresh_ >= kept_after) keep();
  if (i < 0) idle_.stop();
  tell_progress();
}

void CaseWall::draw(int i) {
  const auto at = static_cast<std::size_t>(i);
  tried_[at] = true;
  try {
    if (!drawer_) drawer_ = std::make_unique<ThumbnailDrawer>();
    const std::vector<unsigned char> pixels = drawer_->draw(session_.scene_as_simulated(i));
    const QImage image(pixels.data(), thumbnail_width, thumbnail_height, 3 * thumbnail_width,
                       QImage::Format_RGB888);
    pictures_[at] = QPixmap::fromImage(image.copy());
    const std::string& hash = session_.study()->hash(i);
    QBuffer bytes;
    constexpr int quality = 88;
    if (!hash.empty() && bytes.open(QIODevice::WriteOnly) && image.save(&bytes, "JPG", quality))
      kept_[hash] = bytes.data().toStdString(), ++fresh_;
  } catch (const std::exception&) {  // it stays empty; that it cannot be shown is said when it is to be
  }
  list_->viewport()->update();
}

/// Where the folder cannot be written they are drawn again the next time.
void CaseWall::keep() {
  if (fresh_ == 0 || file_.empty()) return;
  fresh_ = 0;
  try {
    write_wall_file(file_, thumbnail_look, kept_);
  } catch (const std::exception& e) {
    progress_->setToolTip(tr("The pictures are not kept: ") + e.what());
  }
}

void CaseWall::tell_progress() {
  const auto drawn = std::count(tried_.begin(), tried_.end(), true);
  const bool all = drawn == static_cast<std::ptrdiff_t>(tried_.size());
  progress_->setText(all ? QString() : tr("%1 of %2 are drawn").arg(drawn).arg(tried_.size()));
}

void CaseWall::follow_lists() {
  const SessionState& s = session_.state();
  const QSignalBlocker quiet(by_);
  by_->setCurrentIndex(s.sorted_by.empty() ? 0 : by_->findText(QString::fromStdString(s.sorted_by)));
  order_->setText(s.descending ? QString(QChar(0x2193)) : QString(QChar(0x2191)));
}

void CaseWall::follow(const Changes& changes) {
  if (changes.study) new_study();
  if (changes.study || changes.lists) follow_lists();
  if ((changes.study || changes.lists || changes.brushes) && isVisible() && next_without() >= 0)
    idle_.start();
  if (changes.study) tell_progress();
  if (changes.study || changes.lists || changes.brushes || changes.shown || changes.look)
    list_->viewport()->update();
}

}  // namespace cleft
