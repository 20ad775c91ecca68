// Available and used memory.
#pragma once

#include <string>

namespace cleft {

/// Bytes that are available on this machine, or in the control group of this process.
double available_memory();

/// Largest number of bytes that this process has held.
double peak_memory();

/// Bytes that this process holds now.
double held_memory();

/// Bytes: "4" and "4GB" are 4e9, "500MB" 5e8. Throws InputError, that names `option`, if it is less than 1
/// MB.
double parse_memory(const std::string& text, const std::string& option);

/// Of an option's text; where it is empty, nine tenths of what is available.
double memory_to_use(const std::string& text, const std::string& option);

/// From now on blocks of many MB are returned to the system when they are freed. SuperLU_DIST, a dependency
/// of Trilinos, disables this when it is loaded, which fragments the memory.
void return_large_blocks();

/// From now on freed memory is kept for later allocations. Otherwise matrices of some MB get new pages at
/// each allocation, which took a seventh of the time of a fit.
void keep_freed_blocks();

}  // namespace cleft
