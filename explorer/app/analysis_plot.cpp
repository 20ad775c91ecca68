#include "explorer/app/analysis_plot.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <set>

namespace cleft {

namespace {

constexpr double gap = 8;           // pixels
constexpr double share_part = 0.3;  // of the width: bars; the rest: cases
const QColor bar_color(0, 114, 178), curve_color(213, 94, 0), fit_color(0, 158, 115);

/// The figure of case i and its error, mm, where the case's figures have it.
std::optional<std::pair<double, double>> figure_of_case(Session& session, const std::string& figure, int i) {
  if (!session.knows_figures(i)) return {};
  const CaseFigures& f = session.figures(i);
  if (figure == "gape") return std::pair{f.gape, f.gape_error};
  if (figure == "displacement") return std::pair{f.largest_displacement, f.error * f.largest_displacement};
  return {};
}

QString short_number(double value) { return QString::number(value, 'g', 3); }

}  // namespace

/// A row's place for cases, and what its axes go over.
struct AnalysisPlot::Frame {
  QRectF room;
  double least_x = HUGE_VAL, greatest_x = -HUGE_VAL, least_y = HUGE_VAL, greatest_y = -HUGE_VAL;

  void take(double x, double y) {
    least_x = std::min(least_x, x), greatest_x = std::max(greatest_x, x);
    least_y = std::min(least_y, y), greatest_y = std::max(greatest_y, y);
  }
  QPointF at(double x, double y) const {
    const double wide = greatest_x > least_x ? greatest_x - least_x : 1,
                 high = greatest_y > least_y ? greatest_y - least_y : 1;
    return {room.left() + room.width() * (x - least_x) / wide,
            room.bottom() - room.height() * (y - least_y) / high};
  }
};

AnalysisPlot::AnalysisPlot(Session& session, Say say) : session_(session), say_(std::move(say)) {
  setObjectName("analysis_plot");
  setAccessibleName(tr("What the figure depends on"));
  take_room();
  QFont small = font();
  small.setPointSizeF(0.8 * small.pointSizeF());
  setFont(small);
  setToolTip(tr(
      "Dark: the share of the figure's variance that a parameter makes alone; light: with all others. Dots: "
      "the cases with their errors (a click shows one; a drag around some selects them, with Shift these "
      "too); "
      "line: the mean over the other parameters with its error; dotted and dashed: where the parameter with "
      "which this one makes most together is small and large; green: what fits the measurements"));
}

const StudyAnalysis* AnalysisPlot::analysis() const {
  if (!session_.study() || session_.state().analyzed.empty()) return nullptr;
  return session_.cases().known_analysis(session_.state().analyzed);
}

void AnalysisPlot::take_room() {
  constexpr int least = 100, lines_a_row = 8;  // pixels
  const StudyAnalysis* found = analysis();
  const int rows = found ? static_cast<int>(found->effects.size()) : 0;
  setMinimumHeight(std::max(least, rows * lines_a_row * fontMetrics().height()));
}

AnalysisPlot::Frame AnalysisPlot::frame_of(std::size_t row) const {
  const StudyAnalysis& found = *analysis();
  const double line = fontMetrics().height(), high = double(height()) / double(found.effects.size());
  Frame frame;
  const double left = share_part * width() + 1.5 * gap + fontMetrics().horizontalAdvance("0.000");
  frame.room = QRectF(left, double(row) * high + line + 4, width() - left - gap, high - 2 * line - 10);
  const StudyAnalysis::Effect& effect = found.effects[row];
  for (std::size_t k = 0; k < effect.at.size(); ++k) {
    frame.take(effect.at[k], effect.mean[k] - found.error);
    frame.take(effect.at[k], effect.mean[k] + found.error);
  }
  if (const auto& partner = effect.partner)
    for (std::size_t k = 0; k < partner->at.size(); ++k)
      frame.take(partner->at[k], partner->mean_at_low[k]),
          frame.take(partner->at[k], partner->mean_at_high[k]);
  for (int i = 0; i < session_.study()->size(); ++i)
    if (const auto value = figure_of_case(session_, found.figure, i))
      if (const auto x = session_.study()->parameters(i).number(effect.name)) frame.take(*x, value->first);
  return frame;
}

QPointF AnalysisPlot::dot_of(std::size_t row, int i) const { return dot_in(frame_of(row), row, i); }

QPointF AnalysisPlot::dot_in(const Frame& frame, std::size_t row, int i) const {
  const StudyAnalysis& found = *analysis();
  const auto value = figure_of_case(session_, found.figure, i);
  const auto x = session_.study()->parameters(i).number(found.effects[row].name);
  return value && x ? frame.at(*x, value->first) : QPointF(-1e9, -1e9);
}

void AnalysisPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), palette().base());
  painter.setPen(palette().text().color());
  const StudyAnalysis* found = analysis();
  if (!found) {
    painter.drawText(
        rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap,
        session_.study() ? tr("\"Analyze\" tells what the figure depends on.") : tr("No study is open."));
    return;
  }
  for (std::size_t row = 0; row < found->effects.size(); ++row) paint_row(painter, row);
  painter.setPen(QPen(palette().text().color(), 1, Qt::DashLine));
  painter.drawPolyline(lasso_);
}

void AnalysisPlot::paint_row(QPainter& painter, std::size_t row) const {
  const StudyAnalysis& found = *analysis();
  const StudyAnalysis::Effect& effect = found.effects[row];
  const double line = fontMetrics().height(), high = double(height()) / double(found.effects.size());
  const QRectF whole(gap, double(row) * high, width() - 2 * gap, high);
  painter.setPen(palette().text().color());
  painter.drawText(QRectF(whole.left(), whole.top() + 2, whole.width(), line), Qt::AlignLeft,
                   fontMetrics().elidedText(QString::fromStdString(effect.name), Qt::ElideMiddle,
                                            static_cast<int>(whole.width())));
  paint_shares(painter, effect,
               QRectF(whole.left(), whole.top() + line + 4, share_part * width() - gap, high - line - 8));
  paint_cases(painter, row);
}

void AnalysisPlot::paint_shares(QPainter& painter, const StudyAnalysis::Effect& effect,
                                const QRectF& room) const {
  const double line = fontMetrics().height(), thick = std::min(line, room.height() / 3);
  const QColor ink = palette().text().color();
  const auto paint = [&](double top, double share, double error, const QColor& color) {
    const auto x_of = [&](double part) { return room.left() + room.width() * std::clamp(part, 0., 1.); };
    painter.fillRect(QRectF(room.left(), top, x_of(share) - room.left(), thick), color);
    painter.setPen(QPen(ink, 1.4));
    painter.drawLine(QPointF(x_of(share - error), top + thick / 2),
                     QPointF(x_of(share + error), top + thick / 2));
  };
  QColor light = bar_color;
  light.setAlpha(90);
  paint(room.top(), effect.total, effect.total_error, light);
  paint(room.top() + thick + 2, effect.first, effect.first_error, bar_color);
  painter.setPen(ink);
  painter.drawText(
      QRectF(room.left(), room.top() + 2 * thick + 4, room.width(), line), Qt::AlignLeft,
      tr("%1 \u00b1 %2 %").arg(100 * effect.total, 0, 'f', 0).arg(100 * effect.total_error, 0, 'f', 0));
}

void AnalysisPlot::paint_cases(QPainter& painter, std::size_t row) const {
  const StudyAnalysis& found = *analysis();
  const StudyAnalysis::Effect& effect = found.effects[row];
  const Frame frame = frame_of(row);
  const double line = fontMetrics().height();
  const QColor ink = palette().text().color();
  QColor faint = ink;
  faint.setAlpha(70);
  painter.setPen(QPen(faint, 1));
  painter.drawRect(frame.room);
  painter.setPen(ink);
  const QRectF below(frame.room.left(), frame.room.bottom() + 1, frame.room.width(), line);
  painter.drawText(below, Qt::AlignLeft, short_number(frame.least_x));
  painter.drawText(below, Qt::AlignRight, short_number(frame.greatest_x));
  const QRectF beside(0, frame.room.top(), frame.room.left() - 3, line);  // below the parameter's name
  painter.drawText(beside, Qt::AlignRight, short_number(frame.greatest_y));
  painter.drawText(beside.translated(0, frame.room.height() - line), Qt::AlignRight,
                   short_number(frame.least_y));
  painter.save();
  painter.setClipRect(frame.room.adjusted(-4, -4, 4, 4));
  if (const auto& fit = session_.cases().last_fit())
    for (const StudyFit::Value& value : fit->values)
      if (value.name == effect.name) {
        QColor band = fit_color;
        band.setAlpha(60);
        const double left = frame.at(value.low, 0).x(), right = frame.at(value.high, 0).x();
        painter.fillRect(QRectF(left, frame.room.top(), std::max(right - left, 1.), frame.room.height()),
                         band);
        const double most = frame.at(value.most_likely, 0).x();
        painter.setPen(QPen(fit_color, 1.6));
        painter.drawLine(QPointF(most, frame.room.top()), QPointF(most, frame.room.bottom()));
      }
  QPolygonF band, curve;
  for (std::size_t k = 0; k < effect.at.size(); ++k) {
    curve << frame.at(effect.at[k], effect.mean[k]);
    band << frame.at(effect.at[k], effect.mean[k] + found.error);
  }
  for (std::size_t k = effect.at.size(); k-- > 0;)
    band << frame.at(effect.at[k], effect.mean[k] - found.error);
  QColor pale = curve_color;
  pale.setAlpha(60);
  painter.setPen(Qt::NoPen);
  painter.setBrush(pale);
  painter.drawPolygon(band);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(curve_color, 1.8));
  painter.drawPolyline(curve);
  paint_partner(painter, effect, frame);
  for (int i = 0; i < session_.study()->size(); ++i) {
    const auto value = figure_of_case(session_, found.figure, i);
    const auto x = session_.study()->parameters(i).number(effect.name);
    if (!value || !x) continue;
    QColor color = i == session_.state().shown && !session_.between() ? curve_color : bar_color;
    if (!session_.brushed(i)) color.setAlpha(50);
    const QPointF at = frame.at(*x, value->first);
    painter.setPen(QPen(color, 1.2));
    if (std::isfinite(value->second))
      painter.drawLine(frame.at(*x, value->first - value->second),
                       frame.at(*x, value->first + value->second));
    painter.setBrush(color);
    painter.drawEllipse(at, 2.6, 2.6);
    painter.setBrush(Qt::NoBrush);
    const std::vector<int>& selected = session_.state().selected;
    if (std::find(selected.begin(), selected.end(), i) == selected.end()) continue;
    painter.setPen(QPen(ink, 1.4));
    painter.drawEllipse(at, 5, 5);
  }
  painter.restore();
}

/// The mean where the parameter with which this one makes most together is small, and where it is large.
void AnalysisPlot::paint_partner(QPainter& painter, const StudyAnalysis::Effect& effect,
                                 const Frame& frame) const {
  if (!effect.partner) return;
  const StudyAnalysis::Partner& partner = *effect.partner;
  const QString name = QString::fromStdString(partner.name.substr(partner.name.rfind('.') + 1));
  const double line = fontMetrics().height();
  const auto paint = [&](const std::vector<double>& mean, double value, Qt::PenStyle style) {
    QPolygonF curve;
    for (std::size_t k = 0; k < mean.size(); ++k) curve << frame.at(partner.at[k], mean[k]);
    painter.setPen(QPen(curve_color, 1.2, style));
    painter.drawPolyline(curve);
    const double top = std::clamp(curve.back().y() - line, frame.room.top(), frame.room.bottom() - line);
    painter.drawText(QRectF(frame.room.left(), top, frame.room.width() - 2, line), Qt::AlignRight,
                     name + " " + short_number(value));
  };
  paint(partner.mean_at_low, partner.low, Qt::DotLine);
  paint(partner.mean_at_high, partner.high, Qt::DashLine);
}

void AnalysisPlot::mousePressEvent(QMouseEvent* event) {
  if (!analysis() || event->button() != Qt::LeftButton) return;
  lasso_ = QPolygonF({event->localPos()});
}

void AnalysisPlot::mouseMoveEvent(QMouseEvent* event) {
  if (lasso_.isEmpty()) return;
  lasso_ << event->localPos();
  update();
}

/// A click shows a case; a drag selects those that it goes around, with Shift as well as those that are.
void AnalysisPlot::mouseReleaseEvent(QMouseEvent* event) {
  if (lasso_.isEmpty() || !analysis()) return lasso_.clear();
  constexpr double least_lasso = 8;  // pixels
  const QRectF around = lasso_.boundingRect();
  if (std::max(around.width(), around.height()) < least_lasso)
    show_nearest(event->localPos());
  else
    select_within_lasso(event->modifiers() & Qt::ShiftModifier);
  lasso_.clear();
  update();
}

void AnalysisPlot::select_within_lasso(bool as_well) {
  std::set<int> cases;
  if (as_well) cases.insert(session_.state().selected.begin(), session_.state().selected.end());
  for (std::size_t row = 0; row < analysis()->effects.size(); ++row) {
    const Frame frame = frame_of(row);
    for (int i = 0; i < session_.study()->size(); ++i)
      if (lasso_.containsPoint(dot_in(frame, row, i), Qt::OddEvenFill)) cases.insert(i);
  }
  std::string words = "select";
  for (const int i : cases) words += " " + std::to_string(i + 1);
  say_(cases.empty() ? "select none" : words);
}

void AnalysisPlot::show_nearest(const QPointF& place) {
  constexpr double reach = 8;  // pixels
  int nearest = -1;
  double least = reach;
  for (std::size_t row = 0; row < analysis()->effects.size(); ++row) {
    const Frame frame = frame_of(row);
    for (int i = 0; i < session_.study()->size(); ++i) {
      const QPointF off = dot_in(frame, row, i) - place;
      if (const double distance = std::hypot(off.x(), off.y()); distance < least)
        least = distance, nearest = i;
    }
  }
  if (nearest >= 0) say_("case " + std::to_string(nearest + 1));
}

}  // namespace cleft
