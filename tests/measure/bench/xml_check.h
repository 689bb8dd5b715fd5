#pragma once

#include <string>
#include <vector>

namespace mfar::bench::test {

/// True if a document is well-formed XML: elements closed in reverse order, attributes quoted, &
/// and < escaped. Declarations are not checked.
inline bool isWellFormed(const std::string& xml) {
    std::vector<std::string> open;
    bool any = false;
    for (std::size_t i = 0; i < xml.size(); ++i) {
        if (xml[i] == '&') {
            const std::size_t end = xml.find(';', i);
            if (end == std::string::npos || end - i > 5) return false;
        }
        if (xml[i] != '<') continue;
        std::size_t end = i + 1;
        char quote = 0;
        for (; end < xml.size() && (quote != 0 || xml[end] != '>'); ++end) {
            if (xml[end] == '<') return false;
            if (xml[end] != '"') continue;
            if (quote == 0 && xml[end - 1] != '=') return false;
            quote = quote == 0 ? '"' : 0;
        }
        if (end >= xml.size()) return false;
        const std::string tag = xml.substr(i + 1, end - i - 1);
        const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
        if (tag[0] == '/') {
            if (open.empty() || "/" + open.back() != tag) return false;
            open.pop_back();
        } else if (tag.back() != '/') {
            if (any && open.empty()) return false;
            open.push_back(name);
        }
        any = true;
        i = end;
    }
    return any && open.empty();
}

}  // namespace mfar::bench::test
