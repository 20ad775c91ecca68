#include "explorer/app/parallel_coordinates.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace cleft {

namespace {
constexpr double side = 34, above = 56, below = 22;  // margins, pixels
constexpr std::size_t most_smooth = 300;             // cases: more lines are drawn without antialiasing
}  // namespace

ParallelCoordinates::ParallelCoordinates(Session& session, Say say)
    : session_(session), say_(std::move(say)) {
  setObjectName("parallel_coordinates");
  setAccessibleName(tr("Parameters and figures of all cases"));
  setMinimumHeight(140);
  setToolTip(tr(
      "A line for every case. Drag along an axis to keep the cases in that range; double-click to keep all"));
}

void ParallelCoordinates::take_figures() {
  axes_.clear(), rows_.clear(), cases_.clear();
  if (session_.study()) {
    const std::vector<std::string> names = session_.column_names();
    for (int i = 0; i < session_.study()->size(); ++i) {
      if (!session_.knows_figures(i)) continue;
      rows_.emplace_back();
      cases_.push_back(i);
      for (const std::string& name : names) rows_.back().push_back(session_.column_value(i, name));
    }
    for (std::size_t a = 0; a < names.size(); ++a) {
      Axis axis{names[a], HUGE_VAL, -HUGE_VAL};
      for (const auto& row : rows_)
        if (std::isfinite(row[a]))
          axis.least = std::min(axis.least, row[a]), axis.greatest = std::max(axis.greatest, row[a]);
      if (axis.least > axis.greatest) axis.least = 0, axis.greatest = 1;
      if (axis.least == axis.greatest) axis.greatest += axis.least != 0 ? std::abs(axis.least) : 1;
      axes_.push_back(axis);
    }
  }
  lines_ = QPixmap();
  update();
}

double ParallelCoordinates::x_of(std::size_t axis) const {
  return axes_.size() < 2 ? width() / 2.
                          : side + (width() - 2 * side) * double(axis) / double(axes_.size() - 1);
}
double ParallelCoordinates::y_of(const Axis& axis, double value) const {
  return height() - below - (height() - above - below) * (value - axis.least) / (axis.greatest - axis.least);
}
double ParallelCoordinates::value_at(const Axis& axis, double y) const {
  const double part = (height() - below - y) / (height() - above - below);
  return axis.least + (axis.greatest - axis.least) * std::clamp(part, -0.01, 1.01);
}

std::optional<std::size_t> ParallelCoordinates::axis_at(double x) const {
  for (std::size_t a = 0; a < axes_.size(); ++a)
    if (std::abs(x - x_of(a)) < 14) return a;
  return {};
}

void ParallelCoordinates::paint_line(QPainter& painter, const std::vector<double>& values) const {
  QPolygonF line;
  for (std::size_t a = 0; a < axes_.size(); ++a)
    if (std::isfinite(values[a]))  // what lies beyond all cases is at the end of the axis
      line << QPointF(x_of(a), std::clamp(y_of(axes_[a], values[a]), above - 2, height() - below + 2));
  painter.drawPolyline(line);
}

/// Of the interpolated field, over the axes.
std::vector<double> ParallelCoordinates::values_between() const {
  const CaseFigures figures = case_figures(*session_.between());
  const auto value = [&](const std::string& name) {
    for (const FigureText& figure : figure_texts())
      if (figure.name == name) return figure.value(figures);
    const auto requested = session_.state().parameters.find(name);
    return requested == session_.state().parameters.end() ? std::nan("") : requested->second;
  };
  std::vector<double> values;
  for (const Axis& axis : axes_) values.push_back(value(axis.name));
  return values;
}

/// The lines of all cases: drawn anew where they or the brushes change, not where another case is shown.
void ParallelCoordinates::paint_lines() {
  const double ratio = devicePixelRatioF();
  lines_ = QPixmap(size() * ratio);
  lines_.setDevicePixelRatio(ratio);
  lines_.fill(palette().base().color());
  QPainter painter(&lines_);
  painter.setRenderHint(QPainter::Antialiasing, rows_.size() <= most_smooth);
  QColor faded = palette().text().color(), kept(0, 114, 178);
  faded.setAlpha(28), kept.setAlpha(rows_.size() > 100 ? 90 : 200);
  std::vector<bool> inside(rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row) inside[row] = session_.brushed(cases_[row]);
  for (const bool in : {false, true}) {
    painter.setPen(QPen(in ? kept : faded, rows_.size() <= most_smooth ? 1.3 : 0));
    for (std::size_t row = 0; row < rows_.size(); ++row)
      if (inside[row] == in) paint_line(painter, rows_[row]);
  }
}

void ParallelCoordinates::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor ink = palette().text().color();
  if (rows_.empty()) {
    painter.fillRect(rect(), palette().base());
    painter.drawText(rect(), Qt::AlignCenter,
                     session_.study() ? tr("Reading the cases ...") : tr("No study is open."));
    return;
  }
  if (lines_.size() != size() * devicePixelRatioF()) paint_lines();
  painter.drawPixmap(0, 0, lines_);
  const QColor shown(213, 94, 0);
  const std::vector<int>& selected = session_.state().selected;
  painter.setPen(QPen(palette().highlight().color(), 2.2));
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (std::find(selected.begin(), selected.end(), cases_[row]) != selected.end())
      paint_line(painter, rows_[row]);
  painter.setPen(QPen(shown, 2.6, session_.between() ? Qt::DashLine : Qt::SolidLine));
  if (session_.between()) paint_line(painter, values_between());
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (!session_.between() && cases_[row] == session_.state().shown) paint_line(painter, rows_[row]);

  QFont small = font();
  small.setPointSizeF(0.85 * small.pointSizeF());
  painter.setFont(small);
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    const double x = x_of(a);
    painter.setPen(QPen(ink, 1));
    painter.drawLine(QPointF(x, above), QPointF(x, height() - below));
    if (const auto b = session_.state().brushes.find(axes_[a].name); b != session_.state().brushes.end()) {
      QColor band = shown;
      band.setAlpha(90);
      const double high = above - 2, low = height() - below + 2;
      const double top = std::clamp(y_of(axes_[a], b->second.second), high, low);
      const double bottom = std::clamp(y_of(axes_[a], b->second.first), high, low);
      painter.fillRect(QRectF(x - 6, top, 12, std::max(bottom - top, 2.)), band);
    }
    std::string name = axes_[a].name;
    std::replace(name.begin(), name.end(), '_', '\n');
    std::replace(name.begin(), name.end(), '.', '\n');
    const double room = axes_.size() > 1 ? std::min(88., x_of(1) - x_of(0)) : 88;
    QStringList lines;  // none over those of the next axis
    for (const QString& line : QString::fromStdString(name).split('\n'))
      lines << painter.fontMetrics().elidedText(line, Qt::ElideRight, static_cast<int>(room) - 3);
    const QRectF over(x - 44, 1, 88, above - 14);
    painter.drawText(over, Qt::AlignHCenter | Qt::AlignBottom, lines.join('\n'));
    const auto number = [](double v) { return QString::number(v, 'g', 3); };
    painter.drawText(QRectF(x - side, above - 14, 2 * side, 13), Qt::AlignHCenter, number(axes_[a].greatest));
    painter.drawText(QRectF(x - side, height() - below + 2, 2 * side, below - 4), Qt::AlignHCenter,
                     number(axes_[a].least));
  }
}

void ParallelCoordinates::mousePressEvent(QMouseEvent* event) {
  dragged_ = axis_at(event->x());
  pressed_y_ = event->y();
  if (!dragged_ || event->type() == QEvent::MouseButtonDblClick) say_("brush clear");
}

void ParallelCoordinates::say_brush(double y) {
  const Axis& axis = axes_[*dragged_];
  const double a = value_at(axis, pressed_y_), b = value_at(axis, y);
  say_("brush " + axis.name + " " + shortest(std::min(a, b)) + " " + shortest(std::max(a, b)));
}

void ParallelCoordinates::mouseMoveEvent(QMouseEvent* event) {
  if (dragged_ && std::abs(event->y() - pressed_y_) > 2) say_brush(event->y());
}

void ParallelCoordinates::mouseReleaseEvent(QMouseEvent*) { dragged_.reset(); }

void ParallelCoordinates::follow(const Changes& changes) {
  if (changes.study) take_figures();
  if (changes.brushes || changes.look) lines_ = QPixmap();
  if (changes.shown || changes.brushes || changes.look || changes.lists) update();
}

}  // namespace cleft
