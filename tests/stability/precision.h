#pragma once

namespace mfar::stress {

/// Prints the errors of each geometric pass against double precision, and of passes that might use
/// half precision in that precision.
void printPrecision();

}  // namespace mfar::stress
