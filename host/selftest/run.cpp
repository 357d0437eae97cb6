#include "host/selftest/selftest.hpp"

namespace macula::selftest {

bool run_all(const compute::Device& device, kernel::Library& library, bool quick,
             const std::function<void(const Outcome&)>& report) {
    bool passed = true;
    const auto note = [&](const Outcome& outcome) {
        passed = passed && outcome.passed;
        report(outcome);
    };
    // Runs a check; what it throws is its failure, named by what was about to be checked.
    const auto attempt = [&](const char* what, const auto& check) {
        try {
            check();
        } catch (const std::exception& error) {
            note({what, false, error.what()});
        }
    };
    attempt("struct layout", [&] { note(check_layout(device, library)); });
    attempt("portable arithmetic", [&] { note(check_arithmetic(device, library)); });
    attempt("prefix sum", [&] { note(check_prefix_sum(device, library)); });
    if (quick)
        return passed;
    attempt("traversal", [&] {
        for (const Outcome& outcome : check_traversal(device, library))
            note(outcome);
    });
    attempt("frame", [&] { note(check_frame(device, library)); });
    return passed;
}

} // namespace macula::selftest
