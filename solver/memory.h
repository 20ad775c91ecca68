// How much memory there is, and how much was taken.
#pragma once

namespace cleft {

/// Bytes that this machine (or the control group this process lives in) can still give.
double available_memory();

/// Most bytes this process has held at a time.
double peak_memory();

}  // namespace cleft
