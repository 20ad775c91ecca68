// What went wrong, in full, to be copied or put away.
#pragma once

#include <QFrame>
#include <QLabel>

namespace cleft {

class MessageBar : public QFrame {
 public:
  MessageBar();
  void tell(const QString& message);
  QString message() const { return text_->text(); }

 private:
  QLabel* text_;
};

}  // namespace cleft
