#include "explorer/app/tornado_plot.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace cleft {

TornadoPlot::TornadoPlot(Session& session) : session_(session) {
  setObjectName("tornado");
  setAccessibleName(tr("What each parameter does to the gape"));
  setMinimumHeight(100);
  setToolTip(
      tr("The gape where a parameter has its least (blue) and its greatest value (orange), all others in the "
         "middle, by "
         "a fit over all cases"));
}

void TornadoPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), palette().base());
  painter.setPen(palette().text().color());
  const auto tell = [&](const QString& text) {
    painter.drawText(rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap, text);
  };
  if (!session_.study()) return tell(tr("No study is open."));
  for (int i = 0; i < session_.study()->size(); ++i)
    if (!session_.knows_figures(i)) return tell(tr("Reading the cases ..."));
  try {
    if (!tornado_ || study_ != session_.state().study) tornado_ = session_.tornado();
    study_ = session_.state().study;
    paint_bars(painter);
  } catch (const InputError& e) {
    tornado_.reset();
    tell(e.what());
  }
}

void TornadoPlot::paint_bars(QPainter& painter) const {
  const Tornado& t = *tornado_;
  double least = t.middle, greatest = t.middle;
  for (const Tornado::Bar& b : t.bars) {
    least = std::min({least, b.at_least, b.at_greatest});
    greatest = std::max({greatest, b.at_least, b.at_greatest});
  }
  const double line = fontMetrics().height(), left = 44, right = width() - 44.;
  const auto x_of = [&](double gape) {
    return greatest > least ? left + (right - left) * (gape - least) / (greatest - least)
                            : (left + right) / 2;
  };
  const auto number = [](double value) { return QString::number(value, 'g', 3); };
  const QColor ink = palette().text().color();
  painter.drawText(QRectF(0, 4, width(), 2 * line + 4), Qt::AlignHCenter | Qt::TextWordWrap,
                   tr("widest gape, mm; %1 explains %2 % of its variance")
                       .arg(t.logarithms ? tr("a power law") : "a plane")
                       .arg(100 * t.explained, 0, 'f', 0));
  const double top = 2.4 * line + 8,
               row = std::min((height() - top - 4) / std::max<double>(1, double(t.bars.size())), 3.4 * line);
  for (std::size_t k = 0; k < t.bars.size(); ++k) {
    const Tornado::Bar& b = t.bars[k];
    const double y = top + double(k) * row, middle = x_of(t.middle);
    painter.setPen(ink);
    painter.drawText(
        QRectF(4, y, width() - 8., line), Qt::AlignHCenter,
        tr("%1: %2 to %3").arg(QString::fromStdString(b.parameter), number(b.least), number(b.greatest)));
    for (const auto& [gape, color] :
         {std::pair{b.at_least, QColor(0, 114, 178)}, {b.at_greatest, QColor(213, 94, 0)}}) {
      const double x = x_of(gape);
      painter.fillRect(QRectF(std::min(x, middle), y + line + 2, std::abs(x - middle), line), color);
      painter.drawText(
          x < middle ? QRectF(x - 44, y + line + 2, 40, line) : QRectF(x + 4, y + line + 2, 40, line),
          (x < middle ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter, number(gape));
    }
    painter.drawLine(QPointF(middle, y + line), QPointF(middle, y + 2 * line + 4));
  }
}

}  // namespace cleft
