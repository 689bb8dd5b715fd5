#pragma once

namespace mfar::stress {

/// Prints the error of each geometric pass in single precision against double precision. Then calls
/// printHalfPrecision().
void printPrecision();

}  // namespace mfar::stress
