// Versions of files that are more than their own reader's affair.
#pragma once

namespace cleft {

/// Of case.dffd. The identity of a case is made with it: where it rises, the next run encodes its cases
/// again.
inline constexpr int field_version = 3;

}  // namespace cleft
