// Versions of files that other code than their reader depends on.
#pragma once

namespace cleft {

/// Version of case.dffd. It is part of the identity of a case: if it increases, the next run encodes its
/// cases again.
inline constexpr int field_version = 3;
/// Version of a field of several pieces.
inline constexpr int field_version_of_pieces = 4;
/// Version of either where a residual is in several blocks.
inline constexpr int field_version_of_blocks = 5;
/// Version of either where a further quantity has knots of its own.
inline constexpr int field_version_of_own_knots = 6;

}  // namespace cleft
