// The program `macula` as a user runs it. Needs MACULA_PROGRAM, its path.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace macula::test {

struct Ended {
    int code;         // -1: it could not be started
    std::string text; // standard output and errors
};

// Runs it by a shell in `folder` (empty: this one).
inline Ended run_macula(const std::string& arguments, const std::string& folder = {}) {
    const std::string command = (folder.empty() ? "" : "cd '" + folder + "' && ") +
                                ("'" MACULA_PROGRAM "' " + arguments + " 2>&1");
    FILE* pipe = popen(command.c_str(), "r");
    Ended ended{-1, {}};
    char buffer[4096];
    while (pipe != nullptr && fgets(buffer, sizeof buffer, pipe) != nullptr)
        ended.text += buffer;
    ended.code = pipe != nullptr ? WEXITSTATUS(pclose(pipe)) : -1;
    return ended;
}

} // namespace macula::test
