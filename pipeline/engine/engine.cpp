#include "pipeline/engine/engine.h"

namespace mfar {

std::string_view nameOf(EngineKind kind) {
    return kind == EngineKind::Gles ? "gles" : "simd";
}

}  // namespace mfar
