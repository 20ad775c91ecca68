#include "explorer/app/parameter_panel.h"

#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "explorer/study/case_figures.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {
constexpr int slider_steps = 1000;
constexpr int milliseconds_between_looks = 50;
}  // namespace

ParameterPanel::ParameterPanel(Session& session, Say say) : session_(session), say_(std::move(say)) {
  column_ = new QVBoxLayout(this);
  note_ = new QLabel(this);
  note_->setObjectName("parameter_note");
  note_->setWordWrap(true);
  note_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column_->addWidget(note_);
  session_.prepare_beside(true);  // sliders need not wait for the cases to be read
  preparing_ = new QWidget(this);
  auto* row = new QHBoxLayout(preparing_);
  row->setContentsMargins(0, 0, 0, 0);
  prepared_ = new QProgressBar(preparing_);
  prepared_->setObjectName("prepared");
  prepared_->setRange(0, slider_steps);
  prepared_->setToolTip(tr("how far the cases are read that the wound between them is made from"));
  auto* cancel = new QPushButton(tr("Cancel"), preparing_);
  cancel->setObjectName("cancel_preparing");
  cancel->setToolTip(tr("show the nearest case instead (between off)"));
  connect(cancel, &QPushButton::clicked, this, [this] { say_("between off"); });
  row->addWidget(prepared_, 1);
  row->addWidget(cancel);
  column_->addWidget(preparing_);
  connect(&waiting_, &QTimer::timeout, this, [this] {
    session_.take_prepared();
    show_preparing();
  });
  column_->addStretch(1);
}

void ParameterPanel::make_rows() {
  delete rows_widget_;
  rows_.clear();
  rows_widget_ = new QWidget(this);
  auto* column = new QVBoxLayout(rows_widget_);
  column->setContentsMargins(0, 0, 0, 0);
  column_->insertWidget(0, rows_widget_);
  if (!session_.study()) return;
  const PublishedStudy& study = *session_.study();
  for (const std::string& name : study.varying()) {
    const Parameter& row = find_parameter(name, "parameters");
    double least = HUGE_VAL, greatest = -HUGE_VAL;
    for (int i = 0; i < study.size(); ++i)
      if (const auto value = study.parameters(i).number(name))
        least = std::min(least, *value), greatest = std::max(greatest, *value);
    if (!(greatest > least)) continue;
    auto* text = new QLabel(rows_widget_);
    text->setWordWrap(true);  // so that a long name does not widen the panel
    auto* slider = new QSlider(Qt::Horizontal, rows_widget_);
    slider->setObjectName(QString::fromStdString(name));
    slider->setAccessibleName(slider->objectName());
    text->setObjectName(slider->objectName() + ".value");
    slider->setRange(0, slider_steps);
    slider->setPageStep(slider_steps / 10);
    const QString tip = tr("%1\n%2 to %3 %4 in this study")
                            .arg(QString::fromStdString(row.help))
                            .arg(least)
                            .arg(greatest)
                            .arg(QString::fromStdString(row.unit));
    slider->setToolTip(tip);
    text->setToolTip(tip);
    column->addWidget(text);
    column->addWidget(slider);
    rows_.push_back({name, row.unit, least, greatest, text, slider});
    connect(slider, &QSlider::valueChanged, this, [this, name, least, greatest](int value) {
      say_("set " + name + " " + shortest(least + (greatest - least) * value / slider_steps));
    });
  }
}

void ParameterPanel::show_values() {
  if (!session_.study()) {
    note_->setText(tr("No study is open."));
    return;
  }
  const SessionState& s = session_.state();
  const auto& shown = session_.study()->parameters(s.shown);
  for (const Row& row : rows_) {
    const auto asked = s.parameters.find(row.name);
    const auto value = shown.number(row.name);
    if (asked == s.parameters.end() || !value) continue;
    const QSignalBlocker quiet(row.slider);
    row.slider->setValue(static_cast<int>(
        std::lround(slider_steps * (asked->second - row.least) / (row.greatest - row.least))));
    QString text = QString("%1: <b>%2</b> %3")
                       .arg(QString::fromStdString(row.name))
                       .arg(session_.between() ? asked->second : *value, 0, 'g', 4)
                       .arg(QString::fromStdString(row.unit));
    const bool outside = asked->second < row.least || asked->second > row.greatest;
    if (outside)
      text += tr(" (%1 is <b>outside</b> the study, %2 to %3)")
                  .arg(asked->second, 0, 'g', 4)
                  .arg(row.least, 0, 'g', 4)
                  .arg(row.greatest, 0, 'g', 4);
    else if (!session_.between() && asked->second != *value)
      text += tr(" (asked: %1)").arg(asked->second, 0, 'g', 4);
    row.text->setText(text);
  }
  note_->setText(session_.between() ? note_between() : note_of_case());
}

QString ParameterPanel::note_between() const {
  return QString(tr("<b>%4 the cases: interpolated, not simulated.</b><br>Largest displacement %1 mm; %2.<br>"
                    "Nearest case: %3."))
      .arg(session_.between()->report.largest_displacement, 0, 'g', 3)
      .arg(QString::fromStdString(error_of_interpolation(*session_.between())))
      .arg(session_.state().shown + 1)
      .arg(session_.between()->interpolation->outside > 0 ? tr("Outside") : tr("Between"));
}

QString ParameterPanel::note_of_case() {
  const auto field = session_.field();
  QString note =
      QString(
          tr("Case %1 of %2, simulated.<br>Largest displacement %3 mm; what is drawn is off by at most %4 % "
             "of it at a node"))
          .arg(session_.state().shown + 1)
          .arg(session_.study()->size())
          .arg(field->report.largest_displacement, 0, 'g', 3)
          .arg(100 * field->report.spline_error, 0, 'g', 2);
  if (const auto error = error_of_gape(*field))
    note += tr(", the opening by at most %1 mm").arg(*error, 0, 'g', 2);
  note += ".";
  if (!session_.shows_exactly())
    note += tr("<br><b>No case has exactly these values: the nearest is shown</b> (%1).")
                .arg(QString::fromStdString(session_.why_nearest()));
  return note;
}

void ParameterPanel::follow(const Changes& changes) {
  if (changes.study) make_rows();
  if (changes.study || changes.shown || changes.layout || changes.cuts) show_values();
  show_preparing();
}

void ParameterPanel::show_preparing() {
  preparing_->setVisible(session_.preparing());
  prepared_->setValue(static_cast<int>(slider_steps * session_.prepared_part()));
  if (!session_.preparing()) waiting_.stop();
  if (session_.preparing() && !waiting_.isActive()) waiting_.start(milliseconds_between_looks);
}

}  // namespace cleft
