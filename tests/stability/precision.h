#pragma once

namespace mfar::stress {

/// Prints the errors of each geometric pass against double precision, and what half precision would
/// make of those that might use it.
void printPrecision();

}  // namespace mfar::stress
