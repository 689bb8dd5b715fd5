#pragma once

namespace mfar::stress {

/// Prints the errors of passes in half precision, and which passes may use it. Rounds every
/// operation, like a GPU whose mediump has 16 bits.
void printHalfPrecision();

}  // namespace mfar::stress
