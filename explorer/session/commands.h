// The tables of commands, one for each file.
#pragma once

#include "explorer/session/command_table.h"

namespace cleft {

std::span<const Command> study_commands();
std::span<const Command> time_commands();
std::span<const Command> view_commands();
std::span<const Command> cut_commands();
std::span<const Command> closer_commands();
std::span<const Command> session_commands();
std::span<const Command> answer_commands();

}  // namespace cleft
