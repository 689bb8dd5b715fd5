#include "tests/stability/processes.h"

#include <fmt/format.h>

#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace mfar::stress {
namespace {

struct Process {
    pid_t id = 0;
    int results = -1;
};

std::string written(const Tally& tally) {
    std::string out = fmt::format("{} {} {}\n", tally.cases, tally.seeds, tally.failures);
    for (const auto& [pass, count] : tally.pixels)
        out += fmt::format("pixels {} {}\n", count, pass);
    for (const auto& [part, count] : tally.inputs)
        out += fmt::format("inputs {} {}\n", count, part);
    return out;
}

void add(const std::string& text, Tally& sum) {
    std::istringstream in(text);
    long cases = 0, seeds = 0, failures = 0;
    if (!(in >> cases >> seeds >> failures)) return;
    sum.cases += cases;
    sum.seeds += seeds;
    sum.failures += failures;
    std::string kind, name;
    for (long count = 0; in >> kind >> count && std::getline(in >> std::ws, name);)
        (kind == "pixels" ? sum.pixels : sum.inputs)[name] += count;
}

void writeAll(int to, const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
        const ssize_t count = write(to, text.data() + at, text.size() - at);
        if (count < 0 && errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "write");
        at += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
}

std::string readAll(int from) {
    std::string text;
    std::array<char, 4096> part{};
    for (;;) {
        const ssize_t count = read(from, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return text;
        text.append(part.data(), static_cast<std::size_t>(count));
    }
}

Process start(int index, const std::function<Tally(int)>& work) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::fflush(nullptr);
    const pid_t id = fork();
    if (id < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (id > 0) {
        close(ends[1]);
        return {id, ends[0]};
    }
    int status = 2;
    try {
        const Tally tally = work(index);
        writeAll(ends[1], written(tally));
        status = tally.failures > 0 ? 1 : 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "mfar-stress: {}\n", error.what());
    }
    std::fflush(nullptr);
    _exit(status);
}

bool ended(const Process& process, int status) {
    if (WIFSIGNALED(status) && WTERMSIG(status) != SIGTERM)
        fmt::print("FAILED process {}: ended by signal {} ({})\n", process.id, WTERMSIG(status),
                   strsignal(WTERMSIG(status)));
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

Tally inProcesses(int count, bool keepGoing, const std::function<Tally(int)>& work) {
    std::vector<Process> running;
    for (int i = 0; i < count; ++i)
        running.push_back(start(i, work));
    Tally sum;
    bool failed = false;
    while (!running.empty()) {
        int status = 0;
        const pid_t id = waitpid(-1, &status, 0);
        if (id < 0 && errno == EINTR) continue;
        if (id < 0) throw std::system_error(errno, std::generic_category(), "waitpid");
        const auto process =
            std::ranges::find_if(running, [id](const Process& p) { return p.id == id; });
        if (process == running.end()) continue;
        const bool sound = ended(*process, status);
        // A process can write all its output without waiting, because the output is smaller than a
        // pipe's capacity.
        add(readAll(process->results), sum);
        close(process->results);
        running.erase(process);
        if (!sound && !failed && !keepGoing)
            for (const Process& other : running)
                kill(other.id, SIGTERM);
        failed = failed || !sound;
    }
    if (failed && sum.failures == 0) sum.failures = 1;
    return sum;
}

}  // namespace mfar::stress
