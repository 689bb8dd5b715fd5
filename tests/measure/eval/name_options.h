#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mfar::eval {

/// Adds an option whose value is a list of names. `named` returns the value of a name, or nothing
/// if the name is unknown.
template <class T>
void addNames(CLI::App& sub, const char* option, std::vector<T>& values, const char* what,
              std::optional<T> (*named)(std::string_view)) {
    sub.add_option_function<std::vector<std::string>>(
           option,
           [&values, named](const std::vector<std::string>& names) {
               values.clear();
               for (const std::string& name : names)
                   values.push_back(*named(name));
           },
           what)
        ->delimiter(',')
        ->check([named](const std::string& name) {
            return named(name)
                       ? std::string()
                       : fmt::format("unknown name '{}'; mfar-sim --help lists the names", name);
        });
}

}  // namespace mfar::eval
