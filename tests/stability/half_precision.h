#pragma once

namespace mfar::stress {

/// Prints the errors of passes in half precision, rounded after every operation as on a GPU with
/// real mediump, and which passes may use it.
void printHalfPrecision();

}  // namespace mfar::stress
