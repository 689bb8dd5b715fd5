#pragma once

#include "pipeline/engine/engine.h"

#include <gtest/gtest.h>

#include <string>

namespace mfar {

/// How a test with an engine as its parameter is called.
inline std::string engineOfTest(const testing::TestParamInfo<EngineKind>& engine) {
    return std::string(nameOf(engine.param));
}

}  // namespace mfar
