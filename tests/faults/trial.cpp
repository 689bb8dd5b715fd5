#include "tests/faults/trial.h"

#include "tests/faults/board.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sched.h>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

namespace mfar::faults {
namespace {

namespace fs = std::filesystem;

/// Limits in real time. A schedule takes about a second, a run without faults some minutes.
constexpr std::chrono::minutes kTrialTime{2}, kSoakTime{60};
constexpr std::size_t kContext = 40;

class Folder {
public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "mfar-faults-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw std::system_error(errno, std::generic_category(), name);
        path_ = name;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

// Only one thread of mfard runs at a time. So switching is fastest on a single processor.
void takeProcessor(int job) {
    cpu_set_t allowed, one;
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
    int skip = job % CPU_COUNT(&allowed);
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
        if (!CPU_ISSET(cpu, &allowed) || skip-- > 0) continue;
        CPU_ZERO(&one);
        CPU_SET(cpu, &one);
        sched_setaffinity(0, sizeof one, &one);
        return;
    }
}

constexpr const char* kAfterKill = "MFAR_FAULTS_AFTER_KILL";

[[noreturn]] void become(const TrialOptions& options, std::uint64_t seed, const fs::path& folder) {
    if (chdir(folder.c_str()) != 0) _exit(126);
    takeProcessor(options.job);
    for (const int fd : {STDOUT_FILENO, STDERR_FILENO})
        dup2(open(fd == STDOUT_FILENO ? "out" : "err", O_WRONLY | O_CREAT | O_TRUNC, 0666), fd);
    std::vector<std::pair<const char*, std::string>> environment = {
        {"MFAR_FAULTS_SEED", std::to_string(seed)},
        {"MFAR_FAULTS_EPISODES", std::to_string(options.episodes)},
        {"MFAR_FAULTS_ONLY", options.only},
        {"MFAR_FAULTS_SOAK", std::to_string(options.soakFrames)},
        {"MFAR_FAULTS_REPORT", "report"},
        {"MFAR_PRETENDED_V4L2", "cameras"},
        {"NOTIFY_SOCKET", "/nowhere"},  // messages to this address are intercepted
        {"WATCHDOG_USEC", "10000000"},
        {"LD_PRELOAD", MFAR_FAULTS_BOARD ":" MFAR_FAULTS_CAMERAS}};
    if (options.hasGpu) {
        environment.emplace_back("MFAR_FAULTY_GL", Board::kGpu);
        environment.emplace_back("LD_LIBRARY_PATH", MFAR_FAULTS_GL);
    }
    for (const auto& [name, value] : environment)
        setenv(name, value.c_str(), 1);
    execl(options.program.c_str(), "mfard", "--config", "mfard.toml", "--display", "y4m:screen.y4m",
          "--control", "control", "--engine", options.hasGpu ? "gles" : "simd", "--summary",
          "summary.json", nullptr);
    _exit(127);
}

/// Describes how the child process ended; empty for exit status 0.
std::string waitFor(pid_t child, std::chrono::minutes most) {
    const auto end = std::chrono::steady_clock::now() + most;
    int status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (std::chrono::steady_clock::now() > end) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            return fmt::format("mfard has taken more than {} min of real time", most.count());
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (WIFSIGNALED(status)) return fmt::format("mfard was ended by signal {}", WTERMSIG(status));
    const int code = WEXITSTATUS(status);
    return code == 0 ? "" : fmt::format("mfard ended with exit code {}", code);
}

std::string textOf(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> out;
    for (std::string line; std::getline(in, line);)
        out.push_back(line);
    return out;
}

bool tellsFailure(const std::string& line) {
    return line.find("FAILED: ") != line.npos;
}

std::string excerpt(const std::vector<std::string>& lines) {
    const auto first = std::ranges::find_if(lines, tellsFailure);
    const auto before = static_cast<std::size_t>(first - lines.begin());
    std::string out;
    for (std::size_t i = before > kContext ? before - kContext : 0; i < lines.size(); ++i)
        if ((i <= before || tellsFailure(lines[i])) && !lines[i].starts_with("COUNT"))
            out += "  " + lines[i] + "\n";
    return out;
}

std::string start(const TrialOptions& options, std::uint64_t seed, const fs::path& folder,
                  bool afterKill) {
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0) {
        if (afterKill) setenv(kAfterKill, "1", 1);
        become(options, seed, folder);
    }
    return waitFor(child, options.soakFrames > 0 ? kSoakTime : kTrialTime);
}

}  // namespace

TrialResult runTrial(const TrialOptions& options, std::uint64_t seed) {
    const Folder folder;
    std::string why = start(options, seed, folder.path(), false);
    if (textOf(folder.path() / "report").ends_with(" KILLED\n"))
        why = start(options, seed, folder.path(), true);
    const std::string report = textOf(folder.path() / "report");
    const std::vector<std::string> lines = linesOf(report);
    TrialResult out;
    for (const std::string& line : lines) {
        if (line.find(" KB") == line.npos && line.find(" MB resident") == line.npos)
            out.course += line + "\n";
        if (!line.starts_with("COUNT ")) continue;
        const std::size_t last = line.rfind(' ');
        out.counts[line.substr(6, last - 6)] += std::stol(line.substr(last));
    }
    if (why.empty() && report.find("ENDED with 0") == report.npos)
        why = "mfard has not reported its end";
    if (why.empty() && std::ranges::none_of(lines, tellsFailure)) return out;
    const std::string repeat =
        options.soakFrames > 0
            ? fmt::format("--soak {}", options.soakFrames)
            : fmt::format("--seed {} --episodes {} --only '{}'{}", seed, options.episodes,
                          options.only, options.hasGpu ? " --gpu" : "");
    out.failure = fmt::format("FAILED seed {}: {}\n{}repeat: ./run stress --faults {}\n", seed,
                              why.empty() ? "a check failed" : why, excerpt(lines), repeat);
    if (!why.empty()) out.failure += textOf(folder.path() / "err");
    return out;
}

}  // namespace mfar::faults
