// A recording must be readable after a power cut at any moment. The linker's option --wrap
// redirects the recorder's system calls, which are logged. From the log, the test builds possible
// states of the disk: all data written before the last synchronisation, and any part of later data.
#include "base/whole_file.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/recorder.h"
#include "hal/virtual/recording.h"
#include "tests/unit/small_recording.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdarg>
#include <gmock/gmock.h>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <thread>
#include <variant>

namespace mfar {
namespace {

namespace fs = std::filesystem;

struct Written {
    std::string file, bytes;
};
struct Renamed {
    std::string from, to;
};
struct Synced {};  ///< the whole file system is synchronised
struct SyncedFile {
    std::string file;
};
using Operation = std::variant<Written, Renamed, Synced, SyncedFile>;

class Journal {
public:
    void begin(const fs::path& folder) {
        const std::lock_guard lock(mutex_);
        folder_ = folder.string();
        operations_.clear();
    }
    std::vector<Operation> end() {
        const std::lock_guard lock(mutex_);
        folder_.clear();
        return std::exchange(operations_, {});
    }
    void opened(int fd, const char* file) {
        const std::lock_guard lock(mutex_);
        files_.erase(fd);
        if (fd >= 0 && isOurs(file)) files_[fd] = file;
    }
    /// Returns call(*this), which makes a system call and adds it to the log. Holds the lock, so
    /// that the log has the order of the system calls.
    template <class Call>
    auto note(const Call& call) {
        const std::lock_guard lock(mutex_);
        return call(*this);
    }
    void add(Operation operation) { operations_.push_back(std::move(operation)); }
    [[nodiscard]] const std::string* fileOf(int fd) const {
        const auto at = files_.find(fd);
        return at == files_.end() || folder_.empty() ? nullptr : &at->second;
    }
    [[nodiscard]] bool isOurs(const char* file) const {
        return !folder_.empty() && std::string_view(file).starts_with(folder_);
    }

private:
    std::mutex mutex_;
    std::string folder_;
    std::map<int, std::string> files_;
    std::vector<Operation> operations_;
};

Journal& journal() {
    static Journal instance;
    return instance;
}

}  // namespace
}  // namespace mfar

// NOLINTBEGIN(readability-identifier-naming): the linker's names
extern "C" {
int __real_open(const char* file, int flags, ...);
ssize_t __real_write(int fd, const void* bytes, size_t count);
int __real_rename(const char* from, const char* to);
int __real_syncfs(int fd);
int __real_fsync(int fd);

int __wrap_open(const char* file, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    const int fd = __real_open(file, flags, mode);
    mfar::journal().opened(fd, file);
    return fd;
}
ssize_t __wrap_write(int fd, const void* bytes, size_t count) {
    return mfar::journal().note([&](mfar::Journal& j) {
        const ssize_t done = __real_write(fd, bytes, count);
        if (const std::string* file = j.fileOf(fd); file != nullptr && done > 0)
            j.add(
                mfar::Written{*file, {static_cast<const char*>(bytes), static_cast<size_t>(done)}});
        return done;
    });
}
int __wrap_rename(const char* from, const char* to) {
    return mfar::journal().note([&](mfar::Journal& j) {
        const int error = __real_rename(from, to);
        if (error == 0 && j.isOurs(to)) j.add(mfar::Renamed{from, to});
        return error;
    });
}
int __wrap_syncfs(int fd) {
    return mfar::journal().note([&](mfar::Journal& j) {
        const int error = __real_syncfs(fd);
        if (error == 0 && j.fileOf(fd) != nullptr) j.add(mfar::Synced{});
        return error;
    });
}
int __wrap_fsync(int fd) {
    return mfar::journal().note([&](mfar::Journal& j) {
        const int error = __real_fsync(fd);
        if (const std::string* file = j.fileOf(fd); file != nullptr && error == 0)
            j.add(mfar::SyncedFile{*file});
        return error;
    });
}
}
// NOLINTEND(readability-identifier-naming)

namespace mfar {
namespace {

using Files = std::map<std::string, std::string>;

StereoRig smallRig() {
    StereoRig rig;
    rig.video = {test::kSmallVideo, 20.5, 21.5, 7.5, 5.5, {}};
    rig.still = {test::kSmallStill, 40, 41, 15.5, 11.5, {}};
    rig.T_still_video.translation = {-0.014, 0, 0};
    return rig;
}

/// Records 12 video pictures, 4 stills and 12 poses. The recorder synchronises as often as
/// possible. Returns the log.
std::vector<Operation> record(const fs::path& folder) {
    journal().begin(folder);
    Recorder recorder(folder, smallRig(), 30, {.syncEvery = {}});
    for (int i = 1; i <= 12; ++i) {
        const auto level = static_cast<std::uint8_t>(10 * i);
        EXPECT_TRUE(recorder.video(test::plain(test::kSmallVideo, level).view(), {1000 * i}));
        if (i % 3 == 0) {
            EXPECT_TRUE(recorder.still(test::plain(test::kSmallStill, level).view(), {1000 * i}));
        }
        EXPECT_TRUE(recorder.pose({{1000 * i}, smallRig().T_still_video}));
        if (i == 6) recorder.addFile("tags.toml", "family = \"tag36h11\"\n");
        if (i % 4 == 1) recorder.finish();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    recorder.finish();
    return journal().end();
}

/// A possible state on disk of a file that was growing from `safe` to `now`: with a part of the new
/// bytes, or with zeros in place of this part. If the file was not growing but replaced, it is the
/// old or the new file.
std::string part(const std::string& safe, const std::string& now, std::mt19937& random) {
    if (!now.starts_with(safe)) return random() % 2 == 0 ? safe : now;
    const std::size_t more = random() % (now.size() - safe.size() + 1);
    std::string out = now.substr(0, safe.size() + more);
    if (random() % 4 == 0) out.replace(safe.size(), more, std::string(more, '\0'));
    return out;
}

Files afterCut(const std::vector<Operation>& operations, std::size_t count, std::mt19937& random) {
    Files safe, now;
    std::set<std::string>
        safeBytes;  // files whose content is on the disk, but possibly without their names
    for (std::size_t i = 0; i < count; ++i) {
        const Operation& operation = operations[i];
        if (const auto* written = std::get_if<Written>(&operation)) {
            now[written->file] += written->bytes;
            safeBytes.erase(written->file);
        } else if (const auto* renamed = std::get_if<Renamed>(&operation)) {
            now[renamed->to] = std::move(now[renamed->from]);
            now.erase(renamed->from);
            if (safeBytes.erase(renamed->from) > 0) safeBytes.insert(renamed->to);
        } else if (const auto* file = std::get_if<SyncedFile>(&operation)) {
            safeBytes.insert(file->file);
        } else {
            safe = now;
        }
    }
    Files disk = safe;
    for (const auto& [file, bytes] : now) {
        const auto before = safe.find(file);
        if (before != safe.end() && before->second == bytes) continue;
        // the name may be missing on the disk
        if (before == safe.end() && random() % 2 == 0) continue;
        disk[file] = safeBytes.contains(file)
                         ? bytes
                         : part(before == safe.end() ? "" : before->second, bytes, random);
    }
    return disk;
}

/// Number of rows of the file `list` that are certainly on the disk after the first `count`
/// operations.
std::size_t safeRows(const std::vector<Operation>& operations, std::size_t count,
                     const std::string& list) {
    std::size_t rows = 0, safe = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto* written = std::get_if<Written>(&operations[i]);
        if (written != nullptr && written->file == list)
            rows += static_cast<std::size_t>(std::ranges::count(written->bytes, '\n'));
        if (std::holds_alternative<Synced>(operations[i])) safe = rows;
    }
    return safe > 0 ? safe - 1 : 0;  // without the heading
}

/// Number of synchronisations after each addition of rows to `list`, before the next addition.
std::vector<int> syncsAfterRows(const std::vector<Operation>& operations, const std::string& list) {
    std::vector<int> out;
    for (const Operation& operation : operations) {
        const auto* written = std::get_if<Written>(&operation);
        if (written != nullptr && written->file == list) out.push_back(0);
        if (std::holds_alternative<Synced>(operation) && !out.empty()) ++out.back();
    }
    return out;
}

void expectWhole(const std::vector<RecordedImage>& images, Size size) {
    std::vector<std::uint8_t> rgba(std::size_t{4} * size.width * size.height);
    for (const RecordedImage& image : images) {
        loadImageInto(image.file, size, rgba.data(), std::size_t{4} * size.width);
        const auto level = static_cast<std::uint8_t>(image.time.ns / 100);
        EXPECT_EQ(rgba[0], level);
        EXPECT_EQ(rgba[rgba.size() - 2], level);
    }
}

class PowerCut : public testing::Test {
protected:
    /// Reads the recording that is left after the first `count` operations and a power cut. Returns
    /// nullopt if no row of a video picture was synchronised.
    std::optional<Recording> leftAfter(std::size_t count) {
        fs::remove_all(cut_.path() / "run");
        for (const char* folder : {"cam0/data", "cam1/data"})
            fs::create_directories(cut_.path() / "run" / folder);
        for (const auto& [file, bytes] : afterCut(operations_, count, random_))
            test::writeFile(cut_.path() / "run" / fs::relative(file, whole_.path()), bytes);
        if (safeRows(operations_, count, (whole_ / "cam0/data.csv").string()) == 0)
            return std::nullopt;
        return loadRecording(cut_.path() / "run");
    }

    // Uses a file system in memory if possible, because the folders are created a thousand times.
    const int inMemory_ = fs::is_directory("/dev/shm") ? setenv("TMPDIR", "/dev/shm", 1) : 0;
    test::TempFolder whole_, cut_;
    const std::vector<Operation> operations_ = record(whole_.path());
    std::mt19937 random_{7};
};

TEST_F(PowerCut, SynchronisedDataReadsBackAfterACutAtAnyMoment) {
    ASSERT_EQ(loadRecording(whole_.path()).video.size(), 12U);
    const std::string video = (whole_ / "cam0/data.csv").string(),
                      stills = (whole_ / "cam1/data.csv").string();
    int read = 0;
    for (int i = 0; i < 1000; ++i) {
        const std::size_t count = random_() % (operations_.size() + 1);
        SCOPED_TRACE(count);
        const std::optional<Recording> left = leftAfter(count);
        if (!left) continue;
        ++read;
        EXPECT_GE(left->video.size(), safeRows(operations_, count, video));
        EXPECT_GE(left->stills.size(), safeRows(operations_, count, stills));
        expectWhole(left->video, test::kSmallVideo);
        expectWhole(left->stills, test::kSmallStill);
        if (HasFailure()) return;
    }
    EXPECT_GT(read, 300);  // many cuts leave at least one picture
}

// The recorder synchronises twice between two additions of rows: first the rows that were added,
// then the pictures of the next rows.
TEST_F(PowerCut, RowsAreSynchronisedBeforeTheNextPictures) {
    std::vector<int> syncs = syncsAfterRows(operations_, (whole_ / "cam0/data.csv").string());
    ASSERT_GT(syncs.size(), 2U);
    ++syncs.back();  // no pictures follow the last rows, so one synchronisation is enough there
    EXPECT_THAT(syncs, testing::Each(testing::Ge(2)));
}

}  // namespace
}  // namespace mfar
