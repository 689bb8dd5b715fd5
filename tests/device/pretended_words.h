#pragma once

#include <sys/stat.h>

#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace mfar::pretended {

/// The words of a file. Each word maps to the number that follows it, or to 1.
using Words = std::map<std::string, double>;

/// A file of words, which may be replaced at any time. Thread-safe.
class WordFile {
public:
    explicit WordFile(std::string file) : file_(std::move(file)) {}

    [[nodiscard]] Words now() const {
        const std::lock_guard lock(mutex_);
        struct stat there{};
        if (stat(file_.c_str(), &there) != 0) return {};
        const bool same = there.st_ino == read_.st_ino && there.st_size == read_.st_size &&
                          there.st_ctim.tv_sec == read_.st_ctim.tv_sec &&
                          there.st_ctim.tv_nsec == read_.st_ctim.tv_nsec;
        std::ifstream in;
        if (!same) in.open(file_);
        // The file stays unread if no descriptor is free. Then the next call reads it.
        if (in.is_open()) {
            words_ = parsed(in);
            read_ = there;
        }
        return words_;
    }

private:
    [[nodiscard]] static Words parsed(std::ifstream& in) {
        Words out;
        for (std::string word; in >> word;) {
            double number = 1;
            const auto at = in.tellg();
            if (!(in >> number)) {
                in.clear();
                in.seekg(at);
                number = 1;
            }
            out[word] = number;
        }
        return out;
    }

    const std::string file_;
    mutable std::mutex mutex_;
    mutable struct stat read_{};
    mutable Words words_;
};

}  // namespace mfar::pretended
