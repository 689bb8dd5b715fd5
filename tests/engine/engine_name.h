#pragma once

#include "pipeline/engine/engine.h"

#include <gtest/gtest.h>

#include <string>

namespace mfar {

/// Name of a test parametrised by an engine.
inline std::string engineOfTest(const testing::TestParamInfo<EngineKind>& engine) {
    return std::string(nameOf(engine.param));
}

}  // namespace mfar
