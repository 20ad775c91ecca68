// How much memory there is, and how much was taken.
#pragma once

namespace cleft {

/// Bytes that this machine (or the control group this process lives in) can still give.
double available_memory();

/// Most bytes this process has held at a time.
double peak_memory();

/// From here on blocks of many MB go back to the system as soon as they are freed. SuperLU_DIST, which
/// Trilinos brings along, switches that off when it is loaded, and what is freed then stays between what is
/// in use.
void return_large_blocks();

/// From here on what is freed is kept for what comes next. Matrices of some MB that come and go are made of
/// new pages each time otherwise: a seventh of the time of a fit.
void keep_freed_blocks();

}  // namespace cleft
