#include "daemon/tools/status_text.h"

#include <gmock/gmock.h>

namespace mfar {
namespace {

using nlohmann::ordered_json;

TEST(StatusText, ValuesFollowTheirKeysAndMissingValuesAreShownAsNone) {
    EXPECT_EQ(
        statusText({{"state", "running"}, {"fault", nullptr}, {"frames", 12}, {"fps", 29.9712}}),
        "state      running\n"
        "fault      none\n"
        "frames     12\n"
        "fps        30.0\n");
}

TEST(StatusText, HealthIsASentence) {
    EXPECT_EQ(statusText({{"health",
                           {{"state", "ok"},
                            {"cause", nullptr},
                            {"since_s", 11.04},
                            {"picture_age_s", 0.03},
                            {"thread", nullptr}}}}),
              "health     ok for 11.0 s; last picture 0.0 s ago\n");
    EXPECT_EQ(statusText({{"health",
                           {{"state", "stalled"},
                            {"cause", "the picture thread hangs"},
                            {"since_s", 4.0},
                            {"picture_age_s", nullptr},
                            {"thread", "picture"}}}}),
              "health     stalled for 4.0 s: the picture thread hangs\n");
}

TEST(StatusText, EachCameraHasALineWithTheCountersThatAreNotZero) {
    const ordered_json video = {{"configured_hz", 30.0}, {"measured_hz", 29.5}, {"delivered", 512},
                                {"broken", 3},           {"startup", 0},        {"missed", 1},
                                {"distinct_age_s", 0.03}};
    const ordered_json still = {{"configured_hz", 0.0}, {"measured_hz", 0.0}, {"delivered", 0}};
    EXPECT_EQ(statusText({{"cameras", {{"video", video}, {"still", still}}}}),
              "cameras    video: 512 pictures, 29.5 of 30.0 per second, 1 missed, 3 broken, last "
              "new picture 0.0 s ago\n"
              "           still: 0 pictures\n");
}

TEST(StatusText, ValuesOfOtherTypesThanExpectedArePrintedToo) {
    EXPECT_EQ(statusText({{"health", "ok"}, {"cameras", {{"video", 7}}}, {"list", {1, 2}}}),
              "health     ok\n"
              "cameras    video: 0 pictures\n"
              "list       [1,2]\n");
}

}  // namespace
}  // namespace mfar
