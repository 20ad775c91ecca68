// Errors and answers of commands in full; they can be copied and dismissed.
#pragma once

#include <QCoreApplication>
#include <QFrame>
#include <QLabel>

namespace cleft {

class MessageBar : public QFrame {
  Q_DECLARE_TR_FUNCTIONS(MessageBar)

 public:
  MessageBar();
  /// Replaces the message; an empty one hides the bar.
  void tell(const QString& message);
  /// A further line of an answer.
  void answer(const QString& line);
  QString message() const { return text_->text(); }

 private:
  void show_as(const char* paper, const char* edge, const char* ink);

  QLabel* text_;
  QString paper_;  ///< the last style
};

}  // namespace cleft
