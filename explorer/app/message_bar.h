// What went wrong, or what a command has answered: in full, to be copied or put away.
#pragma once

#include <QFrame>
#include <QLabel>

namespace cleft {

class MessageBar : public QFrame {
 public:
  MessageBar();
  /// A message in place of the one before; none is shown where it is empty.
  void tell(const QString& message);
  /// A further line of an answer.
  void answer(const QString& line);
  QString message() const { return text_->text(); }

 private:
  void show_as(const char* paper, const char* edge, const char* ink);

  QLabel* text_;
  QString paper_;  ///< as it was styled last
};

}  // namespace cleft
