#include "base/whole_file.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>

namespace mfar {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::uint8_t, 3> kBytes{'a', 'b', 'c'};

std::size_t entriesIn(const fs::path& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WholeFile, ReplacesAFileAndLeavesNoOther) {
    const test::TempFolder folder;
    test::writeFile(folder / "file", "older and longer");
    writeWholeFile(folder / "file", kBytes);
    EXPECT_EQ(test::readFile(folder / "file"), "abc");
    EXPECT_EQ(entriesIn(folder.path()), 1U);
}

TEST(WholeFile, ReplacesTheFileToWhichALinkLeads) {
    const test::TempFolder folder;
    fs::create_directory(folder / "disk");
    test::writeFile(folder / "disk/file", "older");
    fs::create_symlink("disk/file", folder / "link");
    writeWholeFile(folder / "link", kBytes);
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(test::readFile(folder / "disk/file"), "abc");
}

TEST(WholeFile, SeveralFilesReplaceTheFilesToWhichLinksLead) {
    const test::TempFolder folder;
    fs::create_directory(folder / "disk");
    test::writeFile(folder / "disk/file", "older");
    fs::create_symlink("disk/file", folder / "link");
    fs::create_symlink("/dev/null", folder / "device");
    writeWholeFiles(std::array{NewFile{folder / "link", "abc"}, NewFile{folder / "new", "de"},
                               NewFile{folder / "device", "f"}});
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(test::readFile(folder / "disk/file"), "abc");
    EXPECT_EQ(test::readFile(folder / "new"), "de");
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "device")));
    EXPECT_EQ(entriesIn(folder.path()), 4U);
    EXPECT_EQ(entriesIn(folder / "disk"), 1U);
}

TEST(WholeFile, APipeIsWrittenAndNotReplaced) {
    const test::TempFolder folder;
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    writeWholeFile(pipe, kBytes);
    std::array<char, 8> got{};
    EXPECT_EQ(read(reader, got.data(), got.size()), 3);
    EXPECT_STREQ(got.data(), "abc");
    close(reader);
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(entriesIn(folder.path()), 1U);
}

}  // namespace
}  // namespace mfar
