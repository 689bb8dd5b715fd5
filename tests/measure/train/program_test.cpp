#include "tests/measure/eval/tiny_recording.h"

namespace mfar::eval {
namespace {

using test::execute;
using test::Outcome;
using test::TempFolder;

TEST(MfarTrainEnlarger, TooFewSharpPicturesAreRefusedAndNothingIsWritten) {
    const TempFolder folder;
    writeRecording(folder / "blurred", false);
    writeRecording(folder / "sharp", true);
    test::writeFile(folder / "kept", "filters");
    const auto train = [&](const std::string& recordings, const std::string& out) {
        return execute(folder, fmt::format("cd '{}' && '{}' {} --out {}", folder.path().string(),
                                           MFAR_TRAIN_ENLARGER, recordings, out));
    };
    const std::pair<const char*, const char*> cases[] = {
        {"blurred", "blurred: truth/highres has no picture"},
        {"sharp blurred", "blurred: truth/highres has no picture"},
        {"sharp", "at least 4 sharp pictures are needed"},
    };
    for (const auto& [recordings, message] : cases) {
        const Outcome ran = train(recordings, "kept");
        EXPECT_EQ(ran.status, 1) << recordings;
        EXPECT_NE(ran.text.find(message), std::string::npos) << ran.text;
        EXPECT_EQ(test::readFile(folder / "kept"), "filters") << recordings;
    }
}

TEST(MfarTrainEnlarger, AnOutputFileInAMissingFolderIsRefused) {
    const TempFolder folder;
    const Outcome ran = execute(folder, fmt::format("cd '{}' && '{}' absent --out nowhere/file",
                                                    folder.path().string(), MFAR_TRAIN_ENLARGER));
    EXPECT_NE(ran.status, 0);
    EXPECT_NE(ran.text.find("nowhere/file cannot be written"), std::string::npos) << ran.text;
}

TEST(MfarTrainEnlarger, TheSameRecordingsGiveTheSameFilters) {
    const TempFolder folder;
    writeRecording(folder / "sharp", true, 4);
    for (const char* const out : {"first", "second"}) {
        const Outcome ran =
            execute(folder, fmt::format("'{}' {}/sharp --out {}/{}", MFAR_TRAIN_ENLARGER,
                                        folder.path().string(), folder.path().string(), out));
        ASSERT_EQ(ran.status, 0) << ran.text;
        EXPECT_NE(ran.text.find("read 4 pictures"), std::string::npos) << ran.text;
    }
    const std::string filters = test::readFile(folder / "first");
    EXPECT_GT(filters.size(), 1000U);
    EXPECT_EQ(test::readFile(folder / "second"), filters);
}

}  // namespace
}  // namespace mfar::eval
