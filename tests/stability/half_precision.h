#pragma once

namespace mfar::stress {

/// Prints the errors of passes that compute in half precision, and which passes may use it. Every
/// operation is rounded, as on a GPU whose mediump has 16 bits.
void printHalfPrecision();

}  // namespace mfar::stress
