#pragma once

#include "tests/measure/eval/stopwatch.h"

namespace mfar::bench {

using eval::Clock;
using eval::msOf;

}  // namespace mfar::bench
