// Numbers and names from the session, in a window that is read from right to left.
#pragma once

#include <QApplication>
#include <QString>

namespace cleft {

/// Words that are read from left to right whatever the window's direction is: their signs and units stay
/// where they belong.
inline QString left_to_right(const QString& words) {
  constexpr ushort embed = 0x202a, end = 0x202c;  // Unicode's marks
  return QApplication::layoutDirection() == Qt::LeftToRight ? words : QChar(embed) + words + QChar(end);
}

}  // namespace cleft
