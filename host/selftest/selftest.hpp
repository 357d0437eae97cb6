/// What the owner of an untried device runs first: does this driver run Macula correctly?
/// Each check compares the device with the host, which compiles the same arithmetic.
#pragma once

#include "host/cl/device.hpp"
#include "host/kernel/library.hpp"

#include <functional>
#include <string>
#include <vector>

namespace macula::selftest {

struct Outcome {
    std::string check; // what was checked, e.g. "portable arithmetic"
    bool passed = false;
    std::string detail; // what was counted, or which rule broke on which input
};

/// Sizes of all shared structs and offsets of their members.
Outcome check_layout(const compute::Device& device, kernel::Library& library);

/// The rules of portable arithmetic over 2^16 inputs, bit for bit.
Outcome check_arithmetic(const compute::Device& device, kernel::Library& library);

/// The ordered prefix sum against the host's, over sizes around the work-group's.
Outcome check_prefix_sum(const compute::Device& device, kernel::Library& library);

/// One outcome for each applicable traversal variant and query kind: every ray of a small scene
/// with instances and alpha masks against the CPU reference, bit for bit.
std::vector<Outcome> check_traversal(const compute::Device& device, kernel::Library& library);

/// The hash of one small frame against the expected one.
Outcome check_frame(const compute::Device& device, kernel::Library& library);

/// All of the above in order, or without traversal and frame when `quick`; `report` is called as
/// each is known. An exception in a check is its failure. Returns true when all passed.
bool run_all(const compute::Device& device, kernel::Library& library, bool quick,
             const std::function<void(const Outcome&)>& report);

} // namespace macula::selftest
