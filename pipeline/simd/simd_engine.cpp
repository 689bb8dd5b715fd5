#include "pipeline/engine/engine.h"

#include <stdexcept>

namespace mfar {

std::unique_ptr<Engine> makeSimdEngine(const StepSetup&) {
    throw std::runtime_error("the SIMD engine has no steps yet");
}

}  // namespace mfar
