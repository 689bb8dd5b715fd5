#pragma once

#include "pipeline/engine/engine.h"

#include <gtest/gtest.h>

#include <string>

namespace mfar {

inline std::string engineOfTest(const testing::TestParamInfo<EngineKind>& engine) {
    return std::string(nameOf(engine.param));
}

}  // namespace mfar
