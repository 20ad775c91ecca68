#include "explorer/app/message_bar.h"

#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QPushButton>
#include <QScrollArea>

namespace cleft {

MessageBar::MessageBar() {
  setObjectName("message_bar");
  text_ = new QLabel(this);
  text_->setObjectName("message");
  text_->setWordWrap(true);
  text_->setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  text_->setTextFormat(Qt::PlainText);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  auto* copy = new QPushButton(tr("Copy"), this);
  copy->setObjectName("copy_message");
  auto* close = new QPushButton(tr("Close"), this);
  close->setObjectName("close_message");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 10, 4);
  auto* scrolled = new QScrollArea(this);  // an answer may have a line for every case
  scrolled->setWidget(text_);
  scrolled->setWidgetResizable(true);
  scrolled->setFrameShape(QFrame::NoFrame);
  scrolled->setMaximumHeight(6 * fontMetrics().lineSpacing());
  scrolled->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  row->addWidget(scrolled, 1);
  row->addWidget(copy);
  row->addWidget(close);
  connect(copy, &QPushButton::clicked, this, [this] { QApplication::clipboard()->setText(text_->text()); });
  connect(close, &QPushButton::clicked, this, [this] { hide(); });
  hide();
}

void MessageBar::tell(const QString& message) {
  text_->setText(message);
  setVisible(!message.isEmpty());
  if (message.isEmpty()) return;
  show_as("#fbe3df", "#b3261e", "#410e0b");
}

void MessageBar::answer(const QString& line) {
  text_->setText(text_->text().isEmpty() ? line : text_->text() + "\n" + line);
  show_as("#e3eef8", "#0072b2", "#0b2a41");
  show();
}

void MessageBar::show_as(const char* paper, const char* edge, const char* ink) {
  if (paper_ == paper) return;
  paper_ = paper;
  setStyleSheet(QString("#message_bar { background: %1; border-top: 2px solid %2; } #message_bar "
                        "QScrollArea, #message { background: transparent; color: %3; }")
                    .arg(paper, edge, ink));
}

}  // namespace cleft
