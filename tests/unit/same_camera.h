#pragma once

#include "base/geometry.h"

#include <gtest/gtest.h>

namespace mfar::test {

inline void expectSame(const CameraModel& a, const CameraModel& b) {
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.fx, b.fx);
    EXPECT_EQ(a.fy, b.fy);
    EXPECT_EQ(a.cx, b.cx);
    EXPECT_EQ(a.cy, b.cy);
    EXPECT_EQ(a.distortion, b.distortion);
}

}  // namespace mfar::test
