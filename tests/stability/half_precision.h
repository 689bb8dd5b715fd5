#pragma once

namespace mfar::stress {

/// What half precision, rounded after every operation as a GPU with real mediump does, makes of the
/// passes that might use it; which of them may.
void printHalfPrecision();

}  // namespace mfar::stress
