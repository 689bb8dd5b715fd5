#include "tests/faults/board.h"

#include "tests/faults/judge.h"
#include "tests/faults/real_calls.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace mfar::faults {
namespace {

/// Start of the configuration file. setUp() appends the settings of the still camera's trigger and
/// of super-resolution.
constexpr std::string_view kConfiguration = R"(source = "cameras"
[record]
least_free_mb = 0
[pose]
source = "none"
[cameras.video]
driver = "v4l2"
camera = "/dev/video90"
width = 64
height = 48
rate_hz = 30.0
controls = { gain = 100 }
[cameras.still]
driver = "v4l2"
camera = "/dev/video91"
width = 128
height = 96
controls = { gain = 100 }
)";

constexpr std::string_view kTrigger = R"(rate_hz = 0.0
[cameras.trigger]
line = "TRIGGER"
pulse_ms = 50.0
[trigger]
mode = "rate"
rate_hz = 2.0
)";
constexpr std::string_view kNoTrigger = "rate_hz = 5.0\n";

constexpr std::string_view kSuperRes = R"([superres]
learn = false
)";

constexpr std::array<std::string_view, 6> kBad = {
    "nonsense",
    "[status]\ninterval_s = 99999999999999999999\n",
    "skip_unchanged = 3\n",
    "[cameras.video]\nwidth = 9007199254740993\n",
    "[status]\ninterval_s = nan\n",
    "[[object]]\nmodel = \"/nowhere.glb\"\n",
};

constexpr std::array<Ns, 4> kSteps = {3600 * kSecond, -3600 * kSecond, 315'360'000 * kSecond,
                                      -315'360'000 * kSecond};

// Replaces a file by renaming, so that a reader finds the old or the new file. Faults of disk and
// descriptors have no effect here.
void replace(const std::string& file, std::string_view text) {
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    const rlimit more{limit.rlim_max, limit.rlim_max};
    setrlimit(RLIMIT_NOFILE, &more);
    const std::string part = file + ".new";
    const int fd = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    real().syscall(SYS_write, fd, text.data(), text.size());
    close(fd);
    std::filesystem::rename(part, file);
    setrlimit(RLIMIT_NOFILE, &limit);
}

int idleClient(bool speaks) {
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, Board::kSocket, sizeof address.sun_path - 1);
    const auto* generic = reinterpret_cast<const sockaddr*>(&address);
    if (connect(fd, generic, sizeof address) == 0 && speaks)
        static_cast<void>(send(fd, "{\"comm", 6, MSG_NOSIGNAL | MSG_DONTWAIT));
    return fd;
}

std::string words(const Fault& fault) {
    std::string out(fault.kind->words);
    const std::size_t star = out.find('*');
    if (star != out.npos) out.replace(star, 1, std::to_string(fault.number));
    return out;
}

}  // namespace

Board& Board::get() {
    static auto* board = new Board;  // never destroyed: threads outlive main()
    return *board;
}

void Board::setUp(const Plan& plan) {
    constexpr std::string_view kRecord = "[record]\n";
    hasTrigger_ = plan.hasTrigger;
    configuration_ =
        fmt::format("{}{}{}", kConfiguration, hasTrigger_ ? kTrigger : kNoTrigger, kSuperRes);
    if (plan.recordsAtStart())
        configuration_.insert(configuration_.find(kRecord) + kRecord.size(),
                              fmt::format("directory = \"{}start\"\n", kRecording));
    static_cast<void>(std::filesystem::create_directories("cameras"));
    for (const Where device : {Where::Video, Where::Still, Where::Line, Where::Gpu})
        writeDevice(device);
    replace("mfard.toml", fmt::format("{}mode = \"{}\"\n", configuration_, plan.mode));
    if (mkfifo(kPipe, 0600) != 0 && errno != EEXIST)
        throw std::runtime_error("a pipe for the screen cannot be created");
}

void Board::writeDevice(Where which) const {
    std::string text = which == Where::Still ? "plain " : "";
    if (which == Where::Still && hasTrigger_) text += "triggered ";
    for (const Fault* fault : active_)
        if (fault->kind->where == which) text += words(*fault) + " ";
    const char* file = which == Where::Video   ? "cameras/video90"
                       : which == Where::Still ? "cameras/video91"
                       : which == Where::Line  ? "cameras/gpiochip0"
                                               : kGpu;
    replace(file, text);
}

bool Board::lineRests() const {
    std::ifstream line("cameras/line");
    char level = '0';
    return !(line >> level) || level == '0';
}

void Board::begin(const Fault& fault) {
    active_.push_back(&fault);
    disturb(fault, 1);
}

void Board::end(const Fault& fault) {
    std::erase(active_, &fault);
    disturb(fault, -1);
}

void Board::disturb(const Fault& fault, int by) {
    switch (fault.kind->where) {
    case Where::Video:
    case Where::Still:
    case Where::Gpu:
    case Where::Line: return writeDevice(fault.kind->where);
    case Where::Reader: readerStalls_ += by; return;
    case Where::Clients:
        for (int i = 0; by > 0 && i < fault.number; ++i)
            clients_.push_back(idleClient(i % 2 == 0));
        if (by > 0) return;
        for (const int fd : clients_)
            close(fd);
        return clients_.clear();
    case Where::Configuration:
        if (by > 0) changeConfiguration(fault);
        return;
    case Where::Wall:
        return Scheduler::get().stepWall(by * kSteps[static_cast<std::size_t>(fault.number)]);
    case Where::Disk: (fault.number == 0 ? diskFull_ : diskHangs_) += by; return;
    case Where::Descriptors:
        if (by > 0) return limitDescriptors(fault.number);
        if (descriptors_) setrlimit(RLIMIT_NOFILE, &*descriptors_);
        return descriptors_.reset();
    case Where::Machine: return Scheduler::get().setCost(by > 0 ? fault.number * 1000 : 500);
    }
}

void Board::limitDescriptors(int free) {
    if (descriptors_) return;
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    descriptors_ = limit;
    const int next = dup(STDERR_FILENO);
    close(next);
    limit.rlim_cur = static_cast<rlim_t>(next + free);
    setrlimit(RLIMIT_NOFILE, &limit);
}

void Board::changeConfiguration(const Fault& fault) {
    const auto which = static_cast<std::size_t>(fault.number);
    if (!Judge::get().isReady()) return;  // too early: nothing would handle the signal
    replace("mfard.toml", configuration_ + std::string(which < kBad.size() ? kBad[which] : ""));
    kill(getpid(), SIGHUP);
}

}  // namespace mfar::faults
