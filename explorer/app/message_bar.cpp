#include "explorer/app/message_bar.h"

#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QPushButton>

namespace cleft {

MessageBar::MessageBar() {
  setObjectName("message_bar");
  setStyleSheet(
      "#message_bar { background: #fbe3df; border-top: 2px solid #b3261e; }"
      "#message { color: #410e0b; } ");
  text_ = new QLabel(this);
  text_->setObjectName("message");
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::PlainText);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  auto* copy = new QPushButton("Copy", this);
  copy->setObjectName("copy_message");
  auto* close = new QPushButton("Close", this);
  close->setObjectName("close_message");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 10, 4);
  row->addWidget(text_, 1);
  row->addWidget(copy);
  row->addWidget(close);
  connect(copy, &QPushButton::clicked, this, [this] { QApplication::clipboard()->setText(text_->text()); });
  connect(close, &QPushButton::clicked, this, [this] { hide(); });
  hide();
}

void MessageBar::tell(const QString& message) {
  text_->setText(message);
  setVisible(!message.isEmpty());
}

}  // namespace cleft
