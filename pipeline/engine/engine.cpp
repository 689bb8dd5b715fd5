#include "pipeline/engine/engine.h"

#include <cstdlib>

namespace mfar {

std::string_view nameOf(EngineKind kind) {
    return kind == EngineKind::Gles ? "gles" : "simd";
}

EngineChoice EngineChoice::fromEnvironment() {
    const char* wanted = std::getenv("MFAR_ENGINE");
    const bool simd = wanted != nullptr && std::string_view(wanted) == nameOf(EngineKind::Simd);
    return all(simd ? EngineKind::Simd : EngineKind::Gles);
}

}  // namespace mfar
