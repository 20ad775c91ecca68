#include "explorer/app/time_bar.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QPainter>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace cleft {

namespace {
constexpr int time_steps = 10000;  // of the slider, over the whole cut
constexpr int playback_ms = 16;
constexpr int least_slider = 110;  // pixels

/// Triangles and bars in the palette's ink, as the style's own icons vanish in the dark. Coordinates 0 to 1.
QIcon icon(const QColor& ink, const std::vector<QPolygonF>& shapes) {
  constexpr int size = 32;
  QPixmap picture(size, size);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(ink);
  painter.scale(size, size);
  for (const QPolygonF& shape : shapes) painter.drawPolygon(shape);
  return picture;
}

QPolygonF bar(double from, double to) { return QPolygonF(QRectF(from, 0.2, to - from, 0.6)); }
QPolygonF triangle(double base, double tip) {
  return QPolygonF(QVector<QPointF>{{base, 0.2}, {tip, 0.5}, {base, 0.8}});
}
}  // namespace

QToolButton* TimeBar::button(const char* name, const QString& tip) {
  auto* made = new QToolButton(this);
  made->setObjectName(name);
  made->setToolTip(tip);
  made->setAccessibleName(tip);
  made->setAutoRaise(true);
  return made;
}

TimeBar::TimeBar(Session& session, Say say) : session_(session), say_(std::move(say)) {
  back_ = button("step_back", tr("Back by 1 mm of cut (Left)"));
  play_ = button("play", tr("Play or pause (Space)"));
  forward_ = button("step_forward", tr("On by 1 mm of cut (Right)"));
  back_->setAutoRepeat(true), forward_->setAutoRepeat(true);
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setObjectName("time");
  slider_->setAccessibleName(tr("Length cut, mm"));
  slider_->setRange(0, time_steps);
  slider_->setPageStep(time_steps / 20);
  slider_->setToolTip(tr("Length cut, mm: drag to scrub"));
  label_ = new QLabel(this);
  label_->setObjectName("time_label");
  label_->setMinimumWidth(label_->fontMetrics().horizontalAdvance("888.8 of 888.8 mm cut "));
  loop_ = new QCheckBox(tr("Loop"), this);
  loop_->setObjectName("loop");
  loop_->setToolTip(tr("Begin again at the end"));
  speed_ = new QDoubleSpinBox(this);
  speed_->setObjectName("speed");
  speed_->setAccessibleName(tr("Speed of playing"));
  speed_->setRange(0.1, 1000);
  speed_->setDecimals(1);
  speed_->setSuffix(tr(" mm/s"));
  speed_->setToolTip(tr("Speed of the blade while playing, mm of cut a second"));

  slider_->setMinimumWidth(least_slider);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 2, 6, 2);
  for (QWidget* w : std::initializer_list<QWidget*>{back_, play_, forward_}) row->addWidget(w);
  row->addWidget(slider_, 1);
  for (QWidget* w : std::initializer_list<QWidget*>{label_, loop_, speed_}) row->addWidget(w);

  connect(back_, &QToolButton::clicked, this, [this] { say_("step -1"); });
  connect(forward_, &QToolButton::clicked, this, [this] { say_("step 1"); });
  connect(play_, &QToolButton::clicked, this, [this] { say_(session_.state().playing ? "pause" : "play"); });
  connect(slider_, &QSlider::valueChanged, this,
          [this](int value) { say_("time " + shortest(session_.duration() * value / time_steps)); });
  connect(loop_, &QCheckBox::toggled, this, [this](bool on) { say_(on ? "loop on" : "loop off"); });
  connect(speed_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this](double value) { say_("speed " + shortest(value)); });
  connect(&clock_, &QTimer::timeout, this,
          [this] { session_.tick(1e-3 * static_cast<double>(since_.restart())); });
}

/// Without what is left out where there is little room.
QSize TimeBar::minimumSizeHint() const {
  const QSize whole = QWidget::minimumSizeHint();
  const int spacing = layout()->spacing();
  const auto freed = [&](const QWidget* w) {
    return w->isVisibleTo(this) ? w->minimumSizeHint().width() + spacing : 0;
  };
  return {whole.width() - freed(loop_) - freed(speed_), whole.height()};
}

/// The slider is needed more than the others.
void TimeBar::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  int room = width() - TimeBar::minimumSizeHint().width();
  for (QWidget* w : std::initializer_list<QWidget*>{speed_, loop_}) {
    const int needed = w->minimumSizeHint().width() + layout()->spacing();
    w->setVisible(room >= needed);
    if (room >= needed) room -= needed;
  }
}

void TimeBar::paint_icons() {
  const QColor ink = QApplication::palette().color(QPalette::Text);
  back_->setIcon(icon(ink, {bar(0.22, 0.3), triangle(0.78, 0.34)}));
  forward_->setIcon(icon(ink, {bar(0.7, 0.78), triangle(0.22, 0.66)}));
  if (session_.state().playing)
    play_->setIcon(icon(ink, {bar(0.25, 0.43), bar(0.57, 0.75)}));
  else
    play_->setIcon(icon(ink, {triangle(0.25, 0.8)}));
}

void TimeBar::follow(const Changes& changes) {
  setEnabled(session_.has_scene());
  const SessionState& s = session_.state();
  const QSignalBlocker no_slider(slider_), no_loop(loop_), no_speed(speed_);
  const double duration = session_.has_scene() ? session_.duration() : 0;
  slider_->setValue(duration > 0 ? static_cast<int>(std::lround(time_steps * s.time / duration)) : 0);
  label_->setText(session_.is_imported()
                      ? QString::fromStdString(session_.progress_text(s.time, duration))
                      : tr("%1 of %2 mm cut").arg(s.time, 0, 'f', 1).arg(duration, 0, 'f', 1));
  loop_->setChecked(s.loop);
  speed_->setValue(s.speed);
  if (changes.look) paint_icons();
  if (!changes.playing) return;
  paint_icons();
  if (s.playing && !clock_.isActive()) {
    since_.start();
    clock_.start(playback_ms);
  } else if (!s.playing) {
    clock_.stop();
  }
}

}  // namespace cleft
