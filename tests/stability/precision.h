#pragma once

namespace mfar::stress {

/// Prints the error of each geometric pass in single precision, compared with double precision.
/// Then calls printHalfPrecision().
void printPrecision();

}  // namespace mfar::stress
