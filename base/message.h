// Messages as users see them: readable on a terminal and in a window, whatever the text that they quote.
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace cleft {

/// The text with control characters but line breaks and tabs, and bytes that are no UTF-8, written as \x1b.
/// Of a very long text the middle is left out.
std::string printable(std::string_view text);

/// What went wrong, printable. An error of the file system is told as "FILE: File name too long".
std::string message_of(const std::exception& error);

/// Whether the user can mend it by another input: an InputError, or an error of the file system other than a
/// full or damaged disk.
bool is_users_mistake(const std::exception& error);

/// Of what a command wrote, its last error without the command's name and the error's kind; `nothing` if it
/// wrote nothing.
std::string last_error(std::string written, const std::string& nothing);

}  // namespace cleft
