#include "base/toml_bounds.h"

#include <fmt/format.h>

#include <algorithm>

namespace mfar {
namespace {

class TomlScanner {
public:
    explicit TomlScanner(std::string_view text) : text_(text) {}

    std::optional<TomlExcess> excess() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'')
                skipString();
            else if (c == '#')
                at_ = std::min(text_.find('\n', at_), text_.size());
            else
                take(c);
            if (dots_ >= kDeepestToml)
                return here(fmt::format("a key has more than {} parts", kDeepestToml));
            if (depth_ > kDeepestToml)
                return here(
                    fmt::format("brackets are nested more than {} levels deep", kDeepestToml));
            if (values_ > kMostTomlValues)
                return here(fmt::format("the file has more than {} values, keys and brackets",
                                        kMostTomlValues));
        }
        return std::nullopt;
    }

private:
    void take(char c) {
        if (c == '[' || c == '{') ++depth_;
        if ((c == ']' || c == '}') && depth_ > 0) --depth_;
        // A dot also counts as a value, because each part of a dotted key creates a table.
        if (c == ',' || c == '=' || c == '[' || c == '{' || c == '.') ++values_;
        if (c == '.')
            ++dots_;
        else if (c == ',' || c == '=' || c == '\n' || c == '[' || c == '{')
            dots_ = 0;
        ++at_;
    }

    /// Skips a string. A single-line string without a closing quote ends at the end of its line. In
    /// double quotes, it continues on the next line if a backslash escapes the line break.
    void skipString() {
        const char quote = text_[at_];
        const bool isLong = text_.substr(at_, 3) == std::string(3, quote);
        at_ += isLong ? 3 : 1;
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\\' && quote == '"') {
                ++at_;
            } else if (c == '\n' && !isLong) {
                return;
            } else if (c == quote && !isLong) {
                ++at_;
                return;
            } else if (c == quote && text_.substr(at_, 3) == std::string(3, quote)) {
                at_ += 3;
                // A multi-line string may end with one or two quotes before the three closing
                // quotes.
                for (int i = 0; i < 2 && at_ < text_.size() && text_[at_] == quote; ++i)
                    ++at_;
                return;
            }
        }
        at_ = text_.size();
    }

    [[nodiscard]] TomlExcess here(std::string what) const {
        const std::string_view before = text_.substr(0, at_);
        const auto line = static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1;
        const std::size_t newline = before.rfind('\n');
        const std::size_t column = newline == before.npos ? at_ : at_ - newline - 1;
        return {line, std::max<std::size_t>(column, 1), std::move(what)};
    }

    std::string_view text_;
    std::size_t at_ = 0, dots_ = 0, depth_ = 0, values_ = 0;
};

}  // namespace

std::optional<TomlExcess> tomlExcess(std::string_view text) {
    return TomlScanner(text).excess();
}

}  // namespace mfar
