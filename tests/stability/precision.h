#pragma once

namespace mfar::stress {

/// Prints the error of each geometric pass against double precision. For passes that might use half
/// precision, prints their error in it.
void printPrecision();

}  // namespace mfar::stress
