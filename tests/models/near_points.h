#pragma once

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace mfar::test {

inline void expectNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    EXPECT_LT((a - b).norm(), 1e-6) << a.transpose() << " is not " << b.transpose();
}

}  // namespace mfar::test
