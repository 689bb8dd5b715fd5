#include "daemon/exit_code.h"
#include "daemon/taken_line.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(TakenLine, TheStoredGpioLineIsReadBackUnchanged) {
    const test::TempFolder folder;
    const std::filesystem::path file = folder / "trigger";
    EXPECT_FALSE(takenLine(file));
    TriggerLineConfig line;
    line.chip = "pinctrl-bcm2711";
    line.line = "GPIO 17 \"x\"";
    line.activeLow = true;
    noteTakenLine(file, line);
    EXPECT_EQ(takenLine(file), line);
    line = {};
    noteTakenLine(file, line);
    EXPECT_EQ(takenLine(file), line);
    line.chip = "a\nline=b";
    EXPECT_THROW(noteTakenLine(file, line), std::runtime_error);
    EXPECT_THROW(noteTakenLine(folder / "none/trigger", {}), std::runtime_error);
}

TEST(TakenLine, InvalidContentIsReported) {
    const test::TempFolder folder;
    const std::filesystem::path file = folder / "trigger", sound = folder / "sound";
    test::writeFile(sound, "chip=a\nline=1\nactive_low=false\n");
    ASSERT_TRUE(takenLine(sound));
    const auto faultOf = [&] {
        try {
            (void)takenLine(file);
            return std::string("none");
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code, ExitCode::BadData);
            EXPECT_THAT(failure.what(), StartsWith(file.string() + ": "));
            return std::string(failure.what());
        }
    };
    std::filesystem::create_symlink(sound, file);
    EXPECT_THAT(faultOf(), HasSubstr("is a symbolic link"));
    std::filesystem::remove(file);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    EXPECT_THAT(faultOf(), HasSubstr("is not a regular file"));
    std::filesystem::remove(file);
    const std::pair<std::string, const char*> texts[] = {
        {"", "has no line chip="},
        {"chip=a\nline=1\n", "has no line active_low="},
        {"line=1\nchip=a\nactive_low=true\n", "has no line chip="},
        {"chip=a\nline=1\nactive_low=yes\n", "neither true nor false"},
        {"chip=a\nline=1\nactive_low=true\n[cameras]\n", "more than three lines"},
        {"chip=a\x01\nline=1\nactive_low=true\n", "the value of chip= is not a valid name"},
        {"chip=" + std::string(300, 'a') + "\nline=1\nactive_low=true\n",
         "the value of chip= is not a valid name"},
        {std::string(2000, 'a'), "has 2000 bytes; the limit is 1024"},
    };
    for (const auto& [text, what] : texts) {
        test::writeFile(file, text);
        EXPECT_THAT(faultOf(), HasSubstr(what)) << text;
    }
    if (geteuid() != 0) GTEST_SKIP() << "only root can create a file of another user";
    test::writeFile(file, test::readFile(sound));
    ASSERT_EQ(chown(file.c_str(), 1234, 1234), 0);
    EXPECT_THAT(faultOf(), HasSubstr("belongs to another user"));
}

}  // namespace
}  // namespace mfar
