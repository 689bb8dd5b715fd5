#include "tests/measure/eval/labels.h"

#include <gtest/gtest.h>

namespace mfar::eval {
namespace {

TEST(Labels, LabelIsTheNameOfTheFolder) {
    EXPECT_EQ(labelsOf({"/a/office", "b/shelf/", "/c/./flat/."}),
              (std::vector<std::string>{"office", "shelf", "flat"}));
}

TEST(Labels, LabelIsThePathIfTheNameIsNotUnique) {
    EXPECT_EQ(labelsOf({"/a/x", "/b/x", "/b/y"}), (std::vector<std::string>{"/a/x", "/b/x", "y"}));
}

}  // namespace
}  // namespace mfar::eval
