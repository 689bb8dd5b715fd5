#include "base/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gmock/gmock.h>
#include <string>
#include <utility>

namespace mfar {
namespace {

using std::chrono::milliseconds, std::chrono::seconds;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

class Output {
public:
    Output() : file_(open_memstream(&text_, &size_)) {}
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    ~Output() {
        std::fclose(file_);
        std::free(text_);
    }

    [[nodiscard]] std::FILE* file() const { return file_; }
    /// Returns everything that was written since the last call.
    std::string taken() {
        std::fflush(file_);
        const std::string all(text_, size_);
        return all.substr(std::exchange(read_, all.size()));
    }

private:
    char* text_ = nullptr;
    std::size_t size_ = 0, read_ = 0;
    std::FILE* file_;
};

TEST(ProgressText, EstimatesTheRemainingTime) {
    EXPECT_EQ(progressText(0.25, "flow", 65), " 25 %  flow; 1:05, about 3:15 left");
    EXPECT_EQ(progressText(0, "flow", 0), "  0 %  flow; 0:00");
    EXPECT_EQ(progressText(1, "flow", 3725), "100 %  flow; 1:02:05");
    EXPECT_EQ(progressText(std::nan(""), "seed 3", 5), "seed 3; 0:05");
    EXPECT_EQ(progressText(7, "late", 1), "100 %  late; 0:01");
}

TEST(Progress, ATerminalHasOneLineThatIsRewritten) {
    Output out;
    const auto begin = Progress::Clock::now();
    Progress progress(out.file(), true);
    progress.show(0, "one", begin);
    EXPECT_THAT(out.taken(), HasSubstr("\r\x1b[K  0 %  one"));
    progress.show(0.1, "two", begin + milliseconds(20));
    EXPECT_THAT(out.taken(), IsEmpty()) << "the next update is not due yet";
    progress.show(0.2, "three", begin + milliseconds(150));
    const std::string third = out.taken();
    EXPECT_THAT(third, HasSubstr("\r\x1b[K 20 %  three"));
    EXPECT_EQ(third.find('\n'), third.npos);
    progress.clear();
    EXPECT_THAT(out.taken(), EndsWith("\r\x1b[K"));
    progress.clear();
    EXPECT_THAT(out.taken(), IsEmpty());
}

TEST(Progress, APipeGetsALineEveryTenSeconds) {
    Output out;
    const auto begin = Progress::Clock::now();
    Progress progress(out.file(), false);
    for (int i = 0; i < 300; ++i)
        progress.show(i / 300.0, "frames", begin + milliseconds(100 * i + 50));
    progress.clear();
    const std::string text = out.taken();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
    EXPECT_EQ(text.find('\r'), text.npos);
}

TEST(Progress, AShortCommandIsSilentInAPipe) {
    Output out;
    {
        Progress progress(out.file(), false);
        progress.show(0.5, "frames");
    }
    EXPECT_THAT(out.taken(), IsEmpty());
}

TEST(ProgressPart, ANestedPartShowsItsShareOfTheWhole) {
    Output out;
    Progress progress(out.file(), true);
    const ProgressPart second = ProgressPart(progress).part(1, 2, "shelf");
    second.part(1, 4, "product").show(1, 2, frameOf(1, 2));
    EXPECT_THAT(out.taken(), HasSubstr(" 69 %  shelf, product, frame 2 of 2"));
}

TEST(ProgressPart, ASpanShowsItsShareOfTheWhole) {
    Output out;
    Progress progress(out.file(), true);
    ProgressPart(progress).span(0.6, 0.8, "occlusion").show(1, 2, "frame");
    EXPECT_THAT(out.taken(), HasSubstr(" 70 %  occlusion, frame"));
}

TEST(ProgressPart, APartWithoutAProgressCanBeShown) {
    ProgressPart().part(0, 0, "none").show(0, 0, "none");
}

}  // namespace
}  // namespace mfar
